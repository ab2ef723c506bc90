// SPDX-License-Identifier: MPL-2.0
#include "contact/contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "cell_shapes.h"
#include "flows.h"
#include "placement/random.h"

namespace npfem::flow {
namespace {

constexpr ContactLaw law{0.6, 10.0, 0, 0};  // um, Pa

Setup box_of(double size, DomainKind kind = DomainKind::periodic_box) {
  Setup setup;
  setup.domain.kind = kind;
  const int nodes = static_cast<int>(std::lround(2 * size));
  setup.domain.nodes = {nodes, nodes, nodes};
  setup.domain.dx = 0.5;
  setup.contact.cells = law;
  return setup;
}

/// Cells of a setup as they stand, all vertices held.
class Suspension {
 public:
  explicit Suspension(Setup given) : setup(std::move(given)) {}

  void place(int type, const Vec3& centre, const Rotation& turn = identity_rotation) {
    const int id = static_cast<int>(setup.cells.size());
    setup.cells.push_back({type, centre, turn});
    const std::vector<double>& shape = setup.types[static_cast<std::size_t>(type)].shape;
    first.push_back(vertices.id.size());
    for (std::size_t v = 0; v < shape.size() / 3; ++v) {
      const Vec3 x = add(centre, rotate(turn, {shape[3 * v], shape[3 * v + 1], shape[3 * v + 2]}));
      vertices.held.push_back(static_cast<int>(vertices.id.size()));
      vertices.id.push_back({id, static_cast<int>(v)});
      vertices.position.insert(vertices.position.end(), x.begin(), x.end());
    }
  }

  std::vector<ContactLoad> loads() {
    Contacts contacts(setup);
    std::vector<ContactLoad> all(vertices.id.size());
    contacts.evaluate(vertices, all);
    finding = contacts.finding();
    walls = contacts.force_of_walls();
    return all;
  }

  /// Sum over the vertices of one cell, pN.
  Vec3 force_on(std::size_t cell, std::span<const ContactLoad> all) const {
    const std::size_t end = cell + 1 < first.size() ? first[cell + 1] : all.size();
    Vec3 sum{};
    for (std::size_t v = first[cell]; v < end; ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += force_of(all[v].force[axis]);
    }
    return sum;
  }

  Setup setup;
  ContactVertices vertices;
  std::vector<std::size_t> first;
  Contacts::Finding finding;
  Vec3 walls{};
};

/// Red cells and platelets at random, overlapping as they like.
Suspension crowd(double size, int cells, std::uint64_t seed = 1) {
  Suspension suspension(box_of(size));
  suspension.setup.types = {testing::red_cell(2), testing::platelet(1)};
  Random random(seed);
  for (int n = 0; n < cells; ++n) {
    const Vec3 centre{random.uniform(-size, 2 * size), random.uniform(0, size), random.uniform(0, size)};
    suspension.place(n % 5 == 4, centre, random.rotation());
  }
  return suspension;
}

std::array<std::int64_t, 3> total(std::span<const ContactLoad> loads) {
  std::array<std::int64_t, 3> sum{};
  for (const ContactLoad& load : loads) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += load.force[axis];
  }
  return sum;
}

/// A box with a flat square lid, its upper and lower faces cut into n x n squares.
CellType slab(double width, double height, int n) {
  CellType type;
  type.name = "slab";
  std::map<std::array<int, 3>, int> number;
  const auto vertex = [&](int i, int j, int k) {
    const auto [entry, fresh] = number.try_emplace({i, j, k}, static_cast<int>(type.shape.size() / 3));
    if (fresh) {
      type.shape.insert(type.shape.end(), {width * (double(i) / n - 0.5), width * (double(j) / n - 0.5), height * k});
    }
    return entry->second;
  };
  const auto square = [&](int a, int b, int c, int d) {
    type.triangles.insert(type.triangles.end(), {a, b, c, a, c, d});
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      square(vertex(i, j, 1), vertex(i + 1, j, 1), vertex(i + 1, j + 1, 1), vertex(i, j + 1, 1));
      square(vertex(i, j, 0), vertex(i, j + 1, 0), vertex(i + 1, j + 1, 0), vertex(i + 1, j, 0));
    }
    square(vertex(i, 0, 0), vertex(i + 1, 0, 0), vertex(i + 1, 0, 1), vertex(i, 0, 1));
    square(vertex(i + 1, n, 0), vertex(i, n, 0), vertex(i, n, 1), vertex(i + 1, n, 1));
    square(vertex(0, i + 1, 0), vertex(0, i, 0), vertex(0, i, 1), vertex(0, i + 1, 1));
    square(vertex(n, i, 0), vertex(n, i + 1, 0), vertex(n, i + 1, 1), vertex(n, i, 1));
  }
  return type;
}

/// The same surface cut into four times as many triangles.
CellType subdivided(const CellType& coarse) {
  CellType fine = coarse;
  fine.triangles.clear();
  std::map<std::pair<int, int>, int> middle;
  const auto between = [&](int a, int b) {
    const auto [entry, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(fine.shape.size() / 3));
    for (std::size_t c = 0; fresh && c < 3; ++c) {
      fine.shape.push_back(0.5 * (coarse.shape[3 * std::size_t(a) + c] + coarse.shape[3 * std::size_t(b) + c]));
    }
    return entry->second;
  };
  for (std::size_t t = 0; t < coarse.triangles.size(); t += 3) {
    const int a = coarse.triangles[t], b = coarse.triangles[t + 1], c = coarse.triangles[t + 2];
    const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
    fine.triangles.insert(fine.triangles.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return fine;
}

TEST(Contacts, TwoPlatesFeelTheLawPerArea) {
  constexpr double distance = 0.25;
  Suspension plates(box_of(20));
  plates.setup.types = {slab(6, 1, 12), slab(6, 1, 20)};
  plates.place(0, {10, 10, 5});
  plates.place(1, {10, 10, 6 + distance});
  const auto loads = plates.loads();
  // Half of the sides, 6 x 1 each, belongs to the vertices of either face.
  const double expected = (36 + 12) * law.traction(distance);
  EXPECT_NEAR(plates.force_on(1, loads)[2], expected, 1e-9);
  EXPECT_NEAR(plates.finding.least_distance, distance, 1e-12);
  Suspension alike(box_of(20));
  alike.setup.types = {slab(6, 1, 12)};
  alike.place(0, {10, 10, 5});
  alike.place(0, {10, 10, 6 + distance});
  const auto same = alike.loads();
  for (std::size_t v = 0; v < same.size(); ++v) {
    const double* const x = &alike.vertices.position[3 * v];
    const bool inner = std::abs(x[0] - 10) < 2 && std::abs(x[1] - 10) < 2 && std::abs(x[2] - 6) < 0.01;
    if (!inner) continue;
    EXPECT_NEAR(force_of(same[v].force[2]), -0.25 * law.traction(distance), 1e-11);
    EXPECT_NEAR(stiffness_of(same[v].stiffness), 0.25 * 2 * law.slope(distance), 1e-5);
  }
}

// Derjaguin: two spheres of radius a at the gap h press with pi a times the work of bringing two plates to h.
TEST(Contacts, TwoSpheresAgreeWithDerjaguin) {
  constexpr double a = 5, gap = 0.1;
  const double expected = std::numbers::pi * a * law.strength * law.range / 3 * std::pow(1 - gap / law.range, 3);
  Suspension spheres(box_of(30));
  spheres.setup.types = {testing::sphere(a, 5)};
  spheres.place(0, {10, 15, 15});
  spheres.place(0, {20 + gap, 15, 15}, rotation_about({1, 0, 0}, 0.3));
  const Vec3 force = spheres.force_on(1, spheres.loads());
  EXPECT_NEAR(force[0], expected, 0.06 * expected);
  EXPECT_NEAR(norm(force), force[0], 0.001 * force[0]);
}

TEST(Contacts, DoNotDependOnTheMesh) {
  std::vector<double> forces;
  for (const bool fine : {false, true}) {
    Suspension stack(box_of(20));
    stack.setup.types = {testing::red_cell(3)};
    if (fine) stack.setup.types = {subdivided(stack.setup.types[0])};
    stack.place(0, {10, 10, 8});
    stack.place(0, {10.7, 10.4, 10.85}, rotation_about({1, 0, 0}, 0.1));
    const auto loads = stack.loads();
    EXPECT_GT(stack.finding.contacts, 20);
    forces.push_back(norm(stack.force_on(1, loads)));
  }
  EXPECT_NEAR(forces[0], forces[1], 0.1 * forces[1]);
}

TEST(Contacts, AreEqualAndOppositeToTheLastBit) {
  Suspension suspension = crowd(16, 30);
  const auto loads = suspension.loads();
  EXPECT_GT(suspension.finding.contacts, 500);
  EXPECT_LT(suspension.finding.least_distance, 0);
  EXPECT_EQ(total(loads), (std::array<std::int64_t, 3>{0, 0, 0}));
}

TEST(Contacts, DoNotDependOnTheNumbersOfTheCells) {
  Suspension suspension = crowd(16, 20);
  const auto loads = suspension.loads();
  Suspension backwards(box_of(16));
  backwards.setup.types = suspension.setup.types;
  for (std::size_t n = suspension.setup.cells.size(); n-- > 0;) {
    const CellStart& cell = suspension.setup.cells[n];
    backwards.place(cell.type, cell.centre, cell.rotation);
  }
  const auto other = backwards.loads();
  const std::size_t cells = suspension.first.size();
  for (std::size_t n = 0; n < cells; ++n) {
    const std::size_t count = suspension.setup.types[std::size_t(suspension.setup.cells[n].type)].shape.size() / 3;
    for (std::size_t v = 0; v < count; ++v) {
      EXPECT_EQ(loads[suspension.first[n] + v], other[backwards.first[cells - 1 - n] + v]);
    }
  }
}

// What the ranks of a parallel run do: each finds the contacts of some vertices, knows the vertices around, and all
// loads are added up.
TEST(Contacts, MayBeFoundInParts) {
  Suspension suspension = crowd(16, 30);
  const auto all = suspension.loads();
  std::vector<ContactLoad> sum(all.size());
  const double half = 0.5 * suspension.setup.domain.size()[0], around = law.range + 2.2;  // the longest edge, um
  const auto distance_to_octant = [&](std::size_t v, int corner) {
    double most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = suspension.vertices.position[3 * v + axis] - (corner >> axis & 1) * half;
      const double turned = along - 2 * half * std::floor(along / (2 * half));
      most = std::max(most, turned < half ? 0.0 : std::min(turned - half, 2 * half - turned));
    }
    return most;
  };
  for (int corner = 0; corner < 8; ++corner) {
    ContactVertices some;
    std::vector<std::size_t> number;
    for (std::size_t v = 0; v < all.size(); ++v) {
      const double distance = distance_to_octant(v, corner);
      if (distance > around) continue;
      if (distance == 0) some.held.push_back(static_cast<int>(number.size()));
      number.push_back(v);
      some.id.push_back(suspension.vertices.id[v]);
      const double* const x = &suspension.vertices.position[3 * v];
      some.position.insert(some.position.end(), x, x + 3);
    }
    EXPECT_LT(number.size(), all.size());
    Contacts contacts(suspension.setup);
    std::vector<ContactLoad> part(number.size());
    contacts.evaluate(some, part);
    for (std::size_t n = 0; n < number.size(); ++n) sum[number[n]].add(part[n]);
  }
  EXPECT_EQ(sum, all);
}

// Every vertex against every triangle of every image.
TEST(Contacts, MissNone) {
  constexpr double size = 12;
  Suspension suspension = crowd(size, 12, 3);
  suspension.loads();
  std::int64_t near = 0;
  for (std::size_t v = 0; v < suspension.vertices.id.size(); ++v) {
    const Vec3 p{suspension.vertices.position[3 * v], suspension.vertices.position[3 * v + 1],
                 suspension.vertices.position[3 * v + 2]};
    for (std::size_t c = 0; c < suspension.first.size(); ++c) {
      const auto& triangles = suspension.setup.types[std::size_t(suspension.setup.cells[c].type)].triangles;
      for (int image = 0; image < 343; ++image) {
        const Vec3 shift{size * (image % 7 - 3), size * (image / 7 % 7 - 3), size * (image / 49 - 3)};
        if (std::size_t(suspension.vertices.id[v].cell) == c && shift == Vec3{}) continue;
        const Vec3 apart = subtract(subtract(p, shift), suspension.setup.cells[c].centre);
        if (norm(apart) > 5) continue;
        bool found = false;
        for (std::size_t t = 0; t < triangles.size() && !found; t += 3) {
          Corners corner;
          for (std::size_t i = 0; i < 3; ++i) {
            const double* const x =
                &suspension.vertices.position[3 * (suspension.first[c] + std::size_t(triangles[t + i]))];
            corner[i] = {x[0], x[1], x[2]};
          }
          const Vec3 at = subtract(p, shift);
          found = norm(subtract(at, weighted(nearest_on_triangle(at, corner), corner))) < law.range;
        }
        near += found;
      }
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_EQ(suspension.finding.contacts, near);
}

// The lists of a Contacts that has seen the cells move, against those of a new one.
TEST(Contacts, DoNotDependOnWhenTheirListsWereMade) {
  Suspension suspension = crowd(16, 30, 5);
  Contacts old(suspension.setup);
  std::vector<ContactLoad> kept(suspension.vertices.id.size()), before;
  for (int step = 0; step < 30; ++step) {
    for (std::size_t i = 0; i < suspension.vertices.position.size(); ++i) {
      const int cell = suspension.vertices.id[i / 3].cell;
      suspension.vertices.position[i] += 0.01 * flows::random_value(cell, static_cast<std::int64_t>(i % 3));
    }
    old.evaluate(suspension.vertices, kept);
    ASSERT_EQ(kept, suspension.loads()) << "after step " << step;
    EXPECT_NE(kept, before);
    before = kept;
  }
}

TEST(Contacts, ActAcrossPeriodicFacesAndOnOwnImages) {
  Suspension near(box_of(20));
  near.setup.types = {testing::sphere(2, 3)};
  near.place(0, {1, 10, 10});
  near.place(0, {76.8, 10, -10});
  const auto loads = near.loads();
  EXPECT_GT(near.force_on(0, loads)[0], 1);
  EXPECT_NEAR(near.finding.least_distance, 0.2, 1e-6);

  Suspension alone(box_of(20));
  alone.setup.domain.nodes = {9, 40, 40};
  alone.setup.types = near.setup.types;
  alone.place(0, {1, 10, 10});
  const auto own = alone.loads();
  EXPECT_NEAR(alone.finding.least_distance, 0.5, 1e-6);
  EXPECT_GT(alone.finding.contacts, 0);
  EXPECT_EQ(total(own), (std::array<std::int64_t, 3>{0, 0, 0}));
}

TEST(Contacts, PushAVertexThatIsInsideOut) {
  Suspension two(box_of(20));
  two.setup.types = {testing::sphere(3, 3), testing::sphere(1, 1)};
  two.place(0, {10, 10, 10});
  for (const double depth : {0.05, 0.2, 0.5}) {
    two.vertices.id.resize(two.setup.types[0].shape.size() / 3);
    two.vertices.position.resize(two.setup.types[0].shape.size());
    two.vertices.held.resize(two.vertices.id.size());
    two.setup.cells.resize(1);
    two.first.resize(1);
    two.place(1, {14 - depth, 10, 10});  // its vertex at -x is `depth` inside
    const auto loads = two.loads();
    EXPECT_NEAR(two.finding.least_distance, -depth, 0.02);
    EXPECT_GT(two.force_on(1, loads)[0], 0);
    for (std::size_t v = two.first[1]; v < loads.size(); ++v) {
      if (two.vertices.position[3 * v] >= 13) continue;
      EXPECT_GT(loads[v].force[0], 0) << depth;
    }
  }
}

TEST(Contacts, HaveLawsOfTheirOwnByPair) {
  Suspension both(box_of(20));
  both.setup.types = {testing::sphere(2, 3), testing::sphere(2, 3)};
  both.setup.contact.pairs = {{0, 1, {0.6, 30.0, 0, 0}}};
  both.place(0, {4, 10, 10});
  both.place(0, {8.2, 10, 10});
  both.place(1, {12.4, 10, 10});
  const auto loads = both.loads();
  EXPECT_NEAR(both.force_on(2, loads)[0], -3 * both.force_on(0, loads)[0], 1e-9);
}

TEST(Contacts, AttractWhereAskedTo) {
  Suspension pair(box_of(20));
  pair.setup.types = {testing::sphere(2, 4)};
  pair.setup.contact.cells = {0.3, 20, 2.0, 0.1};
  pair.place(0, {5, 10, 10});
  pair.place(0, {9.4, 10, 10});
  EXPECT_LT(pair.force_on(1, pair.loads())[0], -0.1);
}

TEST(Contacts, AddUpTheForcesOfWalls) {
  Suspension falling(box_of(20, DomainKind::plates));
  falling.setup.contact.walls = {0.6, 3.0, 0, 0};
  falling.setup.types = {slab(6, 1, 12)};
  falling.place(0, {10, 10, 10}, rotation_about({1, 0, 0}, 0.5 * std::numbers::pi));
  double lowest = 1e9;
  for (std::size_t i = 1; i < falling.vertices.position.size(); i += 3)
    lowest = std::min(lowest, falling.vertices.position[i]);
  for (std::size_t i = 1; i < falling.vertices.position.size(); i += 3) falling.vertices.position[i] += 0.3 - lowest;
  const auto loads = falling.loads();
  EXPECT_NEAR(falling.force_on(0, loads)[1], (36 + 12) * falling.setup.contact.walls.traction(0.3), 1e-9);
  EXPECT_DOUBLE_EQ(falling.walls[1], falling.force_on(0, loads)[1]);
}

TEST(Contacts, RefuseLawsThatTheirNumbersCannotCarry) {
  flow::Setup setup = box_of(20);
  setup.types = {testing::sphere(2, 2)};
  const auto made = [&](const ContactLaw& its) {
    setup.contact.cells = its;
    Contacts contacts(setup);
  };
  EXPECT_NO_THROW(made({0.5, 100, 0, 0}));
  EXPECT_THROW(made({0.5, 1e5, 0, 0}), std::invalid_argument);
  EXPECT_THROW(made({0.5, -1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(made({std::nan(""), 1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(made({0.5, 1, 1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
