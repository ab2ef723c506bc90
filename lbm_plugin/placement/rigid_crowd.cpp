// SPDX-License-Identifier: MPL-2.0
#include "placement/rigid_crowd.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/cell_shape.h"

namespace npfem::flow {
namespace {

// FIRE as published, in units of the period of a cell that is pushed on all its surface.
constexpr double first_time_step = 0.2, longest_time_step = 0.8;
constexpr double first_mixing = 0.1, mixing_decay = 0.99, growth = 1.1, cut = 0.5;
constexpr int patience = 5;
constexpr double longest_move = 0.08;  // in one step, in radii

/// The vertices and the middles of the edges: two rims may cross, edge through edge, without a vertex inside either.
SurfacePoints points_of(const CellType& type) {
  SurfacePoints points{type.shape, std::vector<double>(type.shape.size() / 3, 0.0)};
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> middle;
  for (std::size_t t = 0; t < type.triangles.size(); t += 3) {
    const std::int32_t* const corner = &type.triangles[t];
    const Vec3 a = vector_at(type.shape, static_cast<std::size_t>(corner[0]));
    const Vec3 b = vector_at(type.shape, static_cast<std::size_t>(corner[1]));
    const Vec3 c = vector_at(type.shape, static_cast<std::size_t>(corner[2]));
    const double sixth = norm(cross(subtract(b, a), subtract(c, a))) / 12;
    for (std::size_t side = 0; side < 3; ++side) {
      const auto [first, second] = std::minmax(corner[side], corner[(side + 1) % 3]);
      const auto [entry, is_new] = middle.try_emplace({first, second}, points.area.size());
      if (is_new) {
        const Vec3 at = scale(0.5, add(vector_at(type.shape, static_cast<std::size_t>(first)),
                                       vector_at(type.shape, static_cast<std::size_t>(second))));
        points.xyz.insert(points.xyz.end(), at.begin(), at.end());
        points.area.push_back(0);
      }
      points.area[static_cast<std::size_t>(corner[side])] += sixth;
      points.area[entry->second] += sixth;
    }
  }
  return points;
}

}  // namespace

void RigidCrowd::Load::add(const Vec3& at, const Vec3& from_centre) {
  force = flow::add(force, at);
  torque = flow::add(torque, cross(from_centre, at));
}

RigidCrowd::RigidCrowd(const Domain& domain, std::span<const CellType> types, std::span<const int> counts, double gap,
                       std::uint64_t seed)
    : domain_(domain), gap_(gap), box_pairs_(domain), time_step_(first_time_step), mixing_(first_mixing) {
  for (const CellType& type : types) {
    Bounds box;
    double radius = 0, whole_area = 0;
    for (std::size_t v = 0; v < type.shape.size() / 3; ++v) {
      box.include(vector_at(type.shape, v));
      radius = std::max(radius, norm(vector_at(type.shape, v)));
    }
    SurfacePoints points = points_of(type);
    for (const double area : points.area) whole_area += area;
    const Vec3 extent = subtract(box.high, box.low);
    const double volume = enclosed_volume(type.shape, type.triangles);
    const double ball = std::cbrt(0.75 * volume / std::numbers::pi);
    // The table must tell the depth of what is deep inside.
    const double band = std::max(gap, 0.5 * std::min({extent[0], extent[1], extent[2]}));
    shapes_.push_back({type.shape.size() / 3, std::move(points), DistanceTable(type.shape, type.triangles, band),
                       whole_area, volume, radius, ball, 0.5 * std::min({extent[0], extent[1], extent[2]})});
  }
  strew(counts, seed);
}

/// Anywhere between the walls, any way up.
void RigidCrowd::strew(std::span<const int> counts, std::uint64_t seed) {
  constexpr int trials = 100000;
  Random random(seed);
  const Vec3 size = domain_.size();
  for (std::size_t type = 0; type < counts.size(); ++type) {
    for (int n = 0; n < counts[type]; ++n) {
      Vec3 centre{};
      for (int trial = 0; trial < trials; ++trial) {
        centre = {random.uniform(0, size[0]), random.uniform(0, size[1]), random.uniform(0, size[2])};
        if (domain_.wall_distance(centre).distance > shapes_[type].half_thickness) break;
      }
      cells_.push_back({static_cast<int>(type), centre, random.rotation(), 1.0, false});
    }
  }
  start_from(std::move(cells_));
}

void RigidCrowd::start_from(std::vector<RigidCell> cells) {
  cells_ = std::move(cells);
  xyz_.resize(cells_.size());
  boxes_.resize(cells_.size());
  velocity_.assign(cells_.size(), Vec3{});
  spin_.assign(cells_.size(), Vec3{});
}

void RigidCrowd::part_centres() {
  constexpr int sweeps = 200;
  constexpr double share = 0.4;  // of an overlap, removed in one sweep
  const Vec3 size = domain_.size();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const double r = shape(c).ball_radius;
      boxes_[c] = {subtract(cells_[c].centre, {r, r, r}), add(cells_[c].centre, {r, r, r})};
    }
    box_pairs_.find(boxes_, 0, pairs_);
    std::vector<Vec3> moves(cells_.size());
    for (const BoxPair& pair : pairs_) {
      if (pair.first == pair.second) continue;
      const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
      const Vec3 shift{pair.image[0] * size[0], pair.image[1] * size[1], pair.image[2] * size[2]};
      const Vec3 apart = subtract(cells_[a].centre, add(cells_[b].centre, shift));
      const double distance = norm(apart), least = shape(a).ball_radius + shape(b).ball_radius;
      if (!(distance < least && distance > 0)) continue;
      const Vec3 push = scale(0.5 * share * (least - distance) / distance, apart);
      moves[a] = add(moves[a], push);
      moves[b] = subtract(moves[b], push);
    }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      Vec3& centre = cells_[c].centre;
      centre = add(centre, moves[c]);
      const WallDistance wall = domain_.wall_distance(centre);
      const double missing = shape(c).half_thickness - wall.distance;
      if (missing > 0) centre = add(centre, scale(missing, wall.normal));
    }
  }
}

std::vector<double> RigidCrowd::positions(std::size_t cell) const {
  std::vector<double> placed = points_of_cell(cell);
  placed.resize(3 * shape(cell).vertices);
  return placed;
}

std::vector<double> RigidCrowd::points_of_cell(std::size_t cell) const {
  const std::vector<double>& xyz = shape(cell).points.xyz;
  std::vector<double> placed(xyz.size());
  for (std::size_t p = 0; p < xyz.size() / 3; ++p) {
    const Vec3 at = add(cells_[cell].centre, rotate(cells_[cell].rotation, vector_at(xyz, p)));
    std::copy(at.begin(), at.end(), placed.begin() + static_cast<std::ptrdiff_t>(3 * p));
  }
  return placed;
}

void RigidCrowd::place_points() {
  const auto count = static_cast<int>(cells_.size());
#pragma omp parallel for schedule(static)
  for (int n = 0; n < count; ++n) {
    const auto c = static_cast<std::size_t>(n);
    xyz_[c] = points_of_cell(c);
    boxes_[c] = {};
    for (std::size_t v = 0; v < xyz_[c].size() / 3; ++v) boxes_[c].include(vector_at(xyz_[c], v));
  }
}

/// Pairs in parallel, their sums one after the other: the same bits on any number of threads.
void RigidCrowd::find_loads() {
  place_points();
  box_pairs_.find(boxes_, gap_, pairs_);
  pair_loads_.resize(pairs_.size());
  const auto count = static_cast<int>(pairs_.size());
#pragma omp parallel for schedule(dynamic, 16)
  for (int p = 0; p < count; ++p) {
    pair_loads_[static_cast<std::size_t>(p)] = load_of(pairs_[static_cast<std::size_t>(p)]);
  }
  energy_ = deepest_ = 0;
  loads_.assign(cells_.size(), {});
  const auto add_to = [](Load& sum, const Load& load) {
    sum.force = flow::add(sum.force, load.force);
    sum.torque = flow::add(sum.torque, load.torque);
  };
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    add_to(loads_[static_cast<std::size_t>(pairs_[p].first)], pair_loads_[p].first);
    add_to(loads_[static_cast<std::size_t>(pairs_[p].second)], pair_loads_[p].second);
    energy_ += pair_loads_[p].energy;
    deepest_ = std::max(deepest_, pair_loads_[p].deepest);
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) push_from_wall(c);
}

RigidCrowd::PairLoad RigidCrowd::load_of(const BoxPair& pair) const {
  PairLoad sums;
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const Vec3 size = domain_.size();
  const Vec3 shift{pair.image[0] * size[0], pair.image[1] * size[1], pair.image[2] * size[2]};
  push(a, b, shift, sums.first, sums.second, sums);
  push(b, a, scale(-1, shift), sums.second, sums.first, sums);
  return sums;
}

/// Springs from the points of a to the surface of b, which is moved by `shift`.
void RigidCrowd::push(std::size_t a, std::size_t b, const Vec3& shift, Load& on_a, Load& on_b, PairLoad& sums) const {
  const Shape &mine = shape(a), &other = shape(b);
  const double h = 0.02 * other.radius;  // for the slope of the table
  const Bounds box = boxes_[b].moved(shift);
  const Vec3 centre = add(cells_[b].centre, shift);
  const Vec3 apart = subtract(cells_[a].centre, centre);
  const Vec3 away = norm(apart) > 0 ? scale(1 / norm(apart), apart) : Vec3{0, 0, 1};
  for (std::size_t v = 0; v < mine.points.area.size(); ++v) {
    const Vec3 at = vector_at(xyz_[a], v);
    if (!box.is_near({at, at}, gap_)) continue;
    const Vec3 inside = rotate_back(cells_[b].rotation, subtract(at, centre));
    const double missing = gap_ - other.distance.at(inside);
    if (!(missing > 0)) continue;
    Vec3 slope{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 up = inside, down = inside;
      up[axis] += h;
      down[axis] -= h;
      slope[axis] = (other.distance.at(up) - other.distance.at(down)) / (2 * h);
    }
    const double deep = std::clamp((missing - gap_) / (0.5 * other.half_thickness), 0.0, 1.0);
    const Vec3 outward = add(scale(1 - deep, rotate(cells_[b].rotation, slope)), scale(deep, away));
    const Vec3 force = scale(mine.points.area[v] * missing, outward);
    on_a.add(force, subtract(at, cells_[a].centre));
    on_b.add(scale(-1, force), subtract(at, centre));
    sums.energy += 0.5 * mine.points.area[v] * missing * missing;
    sums.deepest = std::max(sums.deepest, missing - gap_);
  }
}

void RigidCrowd::push_from_wall(std::size_t cell) {
  const Shape& its = shape(cell);
  if (!(domain_.wall_distance(cells_[cell].centre).distance < its.radius + gap_)) return;
  for (std::size_t v = 0; v < its.points.area.size(); ++v) {
    const Vec3 at = vector_at(xyz_[cell], v);
    const WallDistance wall = domain_.wall_distance(at);
    const double missing = gap_ - wall.distance;
    if (!(missing > 0)) continue;
    loads_[cell].add(scale(its.points.area[v] * missing, wall.normal), subtract(at, cells_[cell].centre));
    energy_ += 0.5 * its.points.area[v] * missing * missing;
    deepest_ = std::max(deepest_, missing - gap_);
  }
}

void RigidCrowd::step() {
  find_loads();
  move();
}

double RigidCrowd::volume_without_overlap() const {
  std::vector<std::vector<std::size_t>> overlaps(cells_.size());
  double volume = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) volume += shape(c).volume;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (!(pair_loads_[p].deepest > 0)) continue;
    const auto a = static_cast<std::size_t>(pairs_[p].first), b = static_cast<std::size_t>(pairs_[p].second);
    overlaps[a].push_back(b);
    overlaps[b].push_back(a);
  }
  for (;;) {
    const auto worst = std::max_element(overlaps.begin(), overlaps.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (worst == overlaps.end() || worst->empty()) return volume;
    const auto out = static_cast<std::size_t>(worst - overlaps.begin());
    volume -= shape(out).volume;
    for (auto& others : overlaps) std::erase(others, out);
    overlaps[out].clear();
  }
}

/// Mass of a cell: its area; moment of inertia: that of a shell of two thirds of its radius.
void RigidCrowd::move() {
  double power = 0, speed = 0, force = 0;
  const auto mass = [&](std::size_t c) { return shape(c).whole_area; };
  const auto inertia = [&](std::size_t c) { return 0.3 * mass(c) * shape(c).radius * shape(c).radius; };
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    velocity_[c] = add(velocity_[c], scale(time_step_ / mass(c), loads_[c].force));
    spin_[c] = add(spin_[c], scale(time_step_ / inertia(c), loads_[c].torque));
    power += dot(loads_[c].force, velocity_[c]) + dot(loads_[c].torque, spin_[c]);
    speed += mass(c) * dot(velocity_[c], velocity_[c]) + inertia(c) * dot(spin_[c], spin_[c]);
    force += dot(loads_[c].force, loads_[c].force) / mass(c) + dot(loads_[c].torque, loads_[c].torque) / inertia(c);
  }
  const bool uphill = power <= 0;
  const double towards_force = force > 0 ? mixing_ * std::sqrt(speed / force) : 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double keep = uphill ? 0 : 1 - mixing_, along = uphill ? 0 : towards_force;
    velocity_[c] = add(scale(keep, velocity_[c]), scale(along / mass(c), loads_[c].force));
    spin_[c] = add(scale(keep, spin_[c]), scale(along / inertia(c), loads_[c].torque));
    const double radius = shape(c).radius;
    const double move = time_step_ * (norm(velocity_[c]) + radius * norm(spin_[c]));
    const double share = move > longest_move * radius ? longest_move * radius / move : 1;
    cells_[c].centre = add(cells_[c].centre, scale(share * time_step_, velocity_[c]));
    const double angle = share * time_step_ * norm(spin_[c]);
    if (angle > 0) {
      const Rotation turn = rotation_about(scale(1 / norm(spin_[c]), spin_[c]), angle);
      cells_[c].rotation = compose(turn, cells_[c].rotation);
    }
  }
  downhill_ = uphill ? 0 : downhill_ + 1;
  if (uphill) {
    time_step_ *= cut;
    mixing_ = first_mixing;
  } else if (downhill_ > patience) {
    time_step_ = std::min(time_step_ * growth, longest_time_step);
    mixing_ *= mixing_decay;
  }
}

}  // namespace npfem::flow
