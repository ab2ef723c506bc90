// SPDX-License-Identifier: MPL-2.0
#include "placement/pack_cells.h"

#include <algorithm>
#include <cmath>

#include "communicator/serial_communicator.h"
#include "contact/surface_crossing.h"
#include "geometry/cell_shape.h"
#include "geometry/morton.h"
#include "placement/rigid_crowd.h"
#include "placement/rigid_fit.h"
#include "placement/soft_crowd.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

constexpr double rigid_gap = 0.05;         // that rigid cells try to keep, in radii of the largest cell
constexpr double contact_range = 0.1;      // in radii of the largest cell
constexpr double contact_strength = 50;    // Pa
constexpr double clear = 0.1;              // of the contact range: a gap that counts as no overlap
constexpr double volume_tolerance = 0.01;  // of a cell
constexpr int rigid_patience = 300;        // steps in which the energy must have fallen by a hundredth
constexpr int most_rigid_steps = 6000;
constexpr int soft_patience = 150;  // steps in which the deepest overlap must have become less
constexpr int most_soft_steps = 3000;

double largest_radius(std::span<const CellType> types) {
  double square = 0;
  for (const CellType& type : types) {
    for (std::size_t i = 0; i < type.shape.size(); i += 3) {
      const Vec3 x{type.shape[i], type.shape[i + 1], type.shape[i + 2]};
      square = std::max(square, dot(x, x));
    }
  }
  return std::sqrt(square);
}

void require_room(const Domain& domain, std::span<const CellType> types, std::span<const int> counts) {
  const Vec3 size = domain.size();
  Vec3 room = size;
  std::sort(room.begin(), room.end());
  for (std::size_t type = 0; type < types.size(); ++type) {
    if (counts[type] == 0) continue;
    Bounds box;
    for (std::size_t i = 0; i < types[type].shape.size(); i += 3) {
      box.include(Vec3{types[type].shape[i], types[type].shape[i + 1], types[type].shape[i + 2]});
    }
    Vec3 extent = subtract(box.high, box.low);
    std::sort(extent.begin(), extent.end());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (extent[axis] < room[axis]) continue;
      const auto in_um = [](const Vec3& v) {
        return text::format_rounded(v[0]) + " x " + text::format_rounded(v[1]) + " x " + text::format_rounded(v[2]) +
               " um";
      };
      throw PlacementError("a cell \"" + types[type].name + "\" (" + in_um(extent) + ") is larger than the domain (" +
                           in_um(size) + "); take a larger domain");
    }
  }
}

class Packer {
 public:
  Packer(const Domain& domain, std::span<const CellType> types, const PackRequest& request)
      : request_(request), radius_(largest_radius(types)) {
    setup_.domain = domain;
    setup_.types.assign(types.begin(), types.end());
    setup_.contact.cells = {contact_range * radius_, contact_strength, 0, 0};
    setup_.contact.walls = setup_.contact.cells;
    for (std::size_t type = 0; type < types.size(); ++type) {
      for (int n = 0; n < request.counts[type]; ++n) setup_.cells.push_back({static_cast<int>(type), {}, {}, {}});
    }
  }

  PackedCells run() {
    if (setup_.cells.empty()) return {};
    RigidCrowd crowd(setup_.domain, setup_.types, request_.counts, rigid_gap * radius_, request_.seed);
    if (!request_.start.empty()) crowd.start_from(as_rigid());
    result_.overlap_before = std::max(0.0, -gap_of(request_.start.empty() ? surfaces_of(crowd) : surfaces_given()));
    if (request_.start.empty()) crowd.part_centres();
    if (!part(crowd) || !settle(crowd)) {
      result_.interrupted = true;
      return result_;
    }
    return result_;
  }

 private:
  std::vector<RigidCell> as_rigid() const {
    std::vector<RigidCell> cells;
    for (const CellStart& cell : request_.start) {
      const std::vector<double>& shape = setup_.types[static_cast<std::size_t>(cell.type)].shape;
      const Rotation rotation = rotation_between(shape, cell.positions);
      const Vec3 centre = subtract(middle_of(cell.positions), rotate(rotation, middle_of(shape)));
      cells.push_back({cell.type, centre, rotation, 1.0, false});
    }
    return cells;
  }

  std::vector<CellSurface> surfaces_given() const {
    std::vector<CellSurface> cells;
    for (std::size_t c = 0; c < request_.start.size(); ++c) {
      const CellStart& cell = request_.start[c];
      cells.push_back({static_cast<int>(c), cell.type, cell.positions});
    }
    return cells;
  }

  std::vector<CellSurface> surfaces_of(const RigidCrowd& crowd) const {
    std::vector<CellSurface> cells;
    for (std::size_t c = 0; c < crowd.cells().size(); ++c) {
      cells.push_back({static_cast<int>(c), crowd.cells()[c].type, crowd.positions(c)});
    }
    return cells;
  }

  double gap_of(const std::vector<CellSurface>& cells) {
    return smallest_cell_gap(setup_.domain, setup_.types, alone_, cells);
  }

  /// False where it was interrupted.
  bool part(RigidCrowd& crowd) {
    double least = 1e300;
    int last_progress = 0;
    for (int& step = result_.rigid_steps; step < most_rigid_steps && step - last_progress < rigid_patience;) {
      crowd.step();
      ++step;
      if (crowd.energy() < 0.99 * least) {
        least = crowd.energy();
        last_progress = step;
      }
      if (!(crowd.deepest() > 0)) break;
      if (!request_.goes_on({"rigid", step, crowd.deepest()})) return false;
    }
    if (crowd.deepest() > setup_.contact.cells.range) give_up(crowd, crowd.deepest());
    return true;
  }

  bool settle(RigidCrowd& crowd) {
    std::vector<std::vector<double>> positions;
    for (std::size_t c = 0; c < crowd.cells().size(); ++c) positions.push_back(crowd.positions(c));
    SoftCrowd cells(setup_, positions, request_.threads);
    double best = -1e300;
    int last_progress = 0;
    for (int& step = result_.soft_steps; step < most_soft_steps && step - last_progress < soft_patience;) {
      if (cells.step() > 0) throw std::runtime_error("packing: the cell solver failed for a cell under contact");
      ++step;
      if (cells.least_distance() > best + 1e-3 * setup_.contact.cells.range) {
        best = cells.least_distance();
        last_progress = step;
      }
      if (!request_.goes_on({"soft", step, std::max(0.0, -cells.least_distance())})) return false;
      if (cells.least_distance() > clear * setup_.contact.cells.range && is_done(cells)) return true;
    }
    give_up(crowd, std::max(0.0, -cells.least_distance()));
  }

  bool is_done(const SoftCrowd& cells) {
    result_.worst_volume_error = cells.worst_volume_error();
    if (result_.worst_volume_error > volume_tolerance) return false;
    const std::vector<CellSurface> surfaces = cells.surfaces();
    result_.least_wall_gap = smallest_wall_gap(setup_.domain, alone_, surfaces);
    if (!(result_.least_wall_gap > 0)) return false;
    result_.crossings = count_crossings(setup_.domain, setup_.types, alone_, surfaces);
    if (result_.crossings > 0) return false;
    result_.least_gap = gap_of(surfaces);
    if (!(result_.least_gap > 0)) return false;
    result_.worst_area_error = cells.worst_area_error();
    result_.volume = cells.volume();
    take(surfaces);
    return true;
  }

  /// The cells in the box, those of a type along Morton's curve.
  void take(const std::vector<CellSurface>& surfaces) {
    const Vec3 size = setup_.domain.size();
    std::vector<std::pair<std::uint64_t, CellStart>> numbered;
    for (const CellSurface& surface : surfaces) {
      CellStart cell{surface.type, {}, identity_rotation, surface.positions};
      for (std::size_t i = 0; i < cell.positions.size(); ++i) cell.centre[i % 3] += cell.positions[i];
      cell.centre = scale(3.0 / static_cast<double>(cell.positions.size()), cell.centre);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!setup_.domain.periodic()[axis]) continue;
        const double shift = size[axis] * std::floor(cell.centre[axis] / size[axis]);
        cell.centre[axis] -= shift;
        for (std::size_t i = axis; i < cell.positions.size(); i += 3) cell.positions[i] -= shift;
      }
      numbered.emplace_back(morton_number(cell.centre, {{0, 0, 0}, size}), std::move(cell));
    }
    std::stable_sort(numbered.begin(), numbered.end(), [](const auto& a, const auto& b) {
      return a.second.type != b.second.type ? a.second.type < b.second.type : a.first < b.first;
    });
    for (auto& entry : numbered) result_.cells.push_back(std::move(entry.second));
  }

  [[noreturn]] void give_up(const RigidCrowd& crowd, double overlap) const {
    double asked = 0;
    for (const CellStart& cell : setup_.cells) {
      const CellType& type = setup_.types[static_cast<std::size_t>(cell.type)];
      asked += enclosed_volume(type.shape, type.triangles);
    }
    const double volume = setup_.domain.fluid_volume();
    throw PlacementError("no room for " + std::to_string(setup_.cells.size()) + " cells (haematocrit " +
                         text::format_rounded(asked / volume) + "): packing stopped with an overlap of " +
                         text::format_rounded(overlap) + " um; without the cells that overlap others it has reached " +
                         "haematocrit " + text::format_rounded(crowd.volume_without_overlap() / volume) +
                         "; lower the haematocrit, or take a larger domain or another seed");
  }

  const PackRequest& request_;
  double radius_;
  Setup setup_;
  SerialCommunicator alone_;
  PackedCells result_;
};

}  // namespace

PackedCells pack_cells(const Domain& domain, std::span<const CellType> types, const PackRequest& request) {
  require_room(domain, types, request.counts);
  return Packer(domain, types, request).run();
}

}  // namespace npfem::flow
