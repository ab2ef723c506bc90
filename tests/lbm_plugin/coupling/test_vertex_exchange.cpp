// SPDX-License-Identifier: MPL-2.0
// On any number of ranks: who knows which vertex, who holds it, and whether what is sent arrives where it belongs.
#include "coupling/vertex_exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "flows.h"
#include "immersed_boundary/stencil.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

constexpr Index3 kNodes{13, 8, 11};
constexpr double kDx = 0.5;
constexpr int kCells = 17;
constexpr int kVertices = 40;
constexpr int kReach = 3;  // of contacts, nodes

struct Everyone {
  std::vector<VertexId> id;
  std::vector<double> position, expected;
};

/// Vertices strewn over and beyond the domain, in any image; the cells with cell % ranks == owner, or all (owner -1).
Everyone vertices(int owner, int ranks) {
  Everyone all;
  for (int cell = 0; cell < kCells; ++cell) {
    if (owner >= 0 && cell % ranks != owner) continue;
    for (int v = 0; v < kVertices; ++v) {
      all.id.push_back({cell, v});
      const Vec3 position = flows::random_vector(cell, v, 12.0);
      all.position.insert(all.position.end(), position.begin(), position.end());
      for (const double x : position) all.expected.push_back(x + 0.125);
    }
  }
  return all;
}

/// A number that belongs to one vertex.
double label(const VertexId& id, int component) {
  return 1000.0 * id.cell + id.vertex + 0.125 * component;
}

class VertexExchangeTest : public testing::TestWithParam<bool> {
 protected:
  VertexExchangeTest()
      : split(kNodes, {true, GetParam(), true}, world().size()),
        exchange(world(), split, kDx),
        own(vertices(world().rank(), world().size())) {
    exchange.share_positions(own.id, own.position, own.expected, kReach);
  }

  bool near_own_block(const Vec3& position, int reach = 2) const {
    const Index3 node = node_in_grid(split, {position[0] / kDx, position[1] / kDx, position[2] / kDx});
    const Box box = split.box(world().rank());
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      bool near = false;
      for (int i = node[a] - reach; i <= node[a] + reach; ++i) {
        const int there = node_in_grid(split, axis, i);
        near = near || (there >= box.begin[a] && there < box.end[a]);
      }
      if (!near) return false;
    }
    return true;
  }

  /// The labels of all held vertices.
  std::vector<double> known_numbers(int components) const {
    std::vector<double> values;
    for (const int k : exchange.known().held) {
      for (int c = 0; c < components; ++c) values.push_back(label(exchange.known().id[static_cast<std::size_t>(k)], c));
    }
    return values;
  }

  Decomposition split;
  VertexExchange exchange;
  Everyone own;
};
INSTANTIATE_TEST_SUITE_P(PeriodicAndWalls, VertexExchangeTest, testing::Bool());

TEST_P(VertexExchangeTest, EveryRankKnowsTheVerticesAroundItsBlockInOrder) {
  const KnownVertices& known = exchange.known();
  std::size_t k = 0;
  const Everyone all = vertices(-1, 0);
  for (std::size_t v = 0; v < all.id.size(); ++v) {
    const Vec3 position{all.position[3 * v], all.position[3 * v + 1], all.position[3 * v + 2]};
    if (!near_own_block(position)) continue;
    ASSERT_LT(k, known.id.size());
    EXPECT_EQ(std::tie(known.id[k].cell, known.id[k].vertex), std::tie(all.id[v].cell, all.id[v].vertex));
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_EQ(known.position[3 * k + a], position[a]);
      EXPECT_EQ(known.in_nodes[3 * k + a], position[a] / kDx);
    }
    ++k;
  }
  EXPECT_EQ(k, known.id.size());
}

TEST_P(VertexExchangeTest, EveryVertexIsHeldByOneRank) {
  std::vector<std::int64_t> holders(kCells * kVertices);
  for (const int k : exchange.known().held) {
    const VertexId id = exchange.known().id[static_cast<std::size_t>(k)];
    ++holders[static_cast<std::size_t>(id.cell * kVertices + id.vertex)];
  }
  world().sum(holders);
  EXPECT_EQ(std::count(holders.begin(), holders.end(), 1), kCells * kVertices);
}

TEST_P(VertexExchangeTest, ValuesReturnToTheirOwners) {
  for (const int components : {3, 6}) {
    const auto width = static_cast<std::size_t>(components);
    const std::vector<double> values = known_numbers(components);
    std::vector<double> returned(width * own.id.size(), -1.0);
    exchange.return_to_owners(values, components, returned);
    for (std::size_t v = 0; v < own.id.size(); ++v) {
      for (int c = 0; c < components; ++c) {
        EXPECT_EQ(returned[width * v + static_cast<std::size_t>(c)], label(own.id[v], c));
      }
    }
  }
}

TEST_P(VertexExchangeTest, ContactsKnowTheVerticesWithinTheirReachInOrder) {
  const ContactVertices& near = exchange.contact_vertices();
  std::size_t k = 0;
  std::vector<int> held;
  const Everyone all = vertices(-1, 0);
  for (std::size_t v = 0; v < all.id.size(); ++v) {
    const Vec3 position{all.position[3 * v], all.position[3 * v + 1], all.position[3 * v + 2]};
    if (!near_own_block(position, kReach)) continue;
    ASSERT_LT(k, near.id.size());
    EXPECT_EQ(near.id[k], all.id[v]);
    for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(near.position[3 * k + a], all.expected[3 * v + a]);
    if (near_own_block(position, 0)) held.push_back(static_cast<int>(k));
    ++k;
  }
  EXPECT_EQ(k, near.id.size());
  EXPECT_EQ(near.held, held);
}

TEST_P(VertexExchangeTest, ContactLoadsFoundAnywhereAddUpAtTheOwner) {
  const ContactVertices& near = exchange.contact_vertices();
  std::vector<ContactLoad> loads(near.id.size()), own_loads(own.id.size(), ContactLoad{{7, 7, 7}, 7});
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (near.id[k].vertex % 3 > 0) loads[k] = {{near.id[k].cell, -near.id[k].vertex, 1}, 5};
  }
  std::vector<double> values(known_numbers(2)), returned(2 * own.id.size(), -1.0);
  exchange.return_to_owners(values, 2, returned, loads, own_loads);
  std::vector<std::int64_t> knowers(kCells * kVertices);
  for (const VertexId& id : near.id) ++knowers[static_cast<std::size_t>(id.cell * kVertices + id.vertex)];
  world().sum(knowers);
  for (std::size_t v = 0; v < own.id.size(); ++v) {
    const VertexId id = own.id[v];
    const std::int64_t n = id.vertex % 3 > 0 ? knowers[static_cast<std::size_t>(id.cell * kVertices + id.vertex)] : 0;
    EXPECT_EQ(own_loads[v], (ContactLoad{{n * id.cell, -n * id.vertex, n}, 5 * n}));
    for (int c = 0; c < 2; ++c) EXPECT_EQ(returned[2 * v + static_cast<std::size_t>(c)], label(id, c));
  }
}

TEST_P(VertexExchangeTest, ForcesReachEveryoneWhoKnowsTheVertex) {
  std::vector<double> forces, arrived;
  for (const VertexId& id : own.id) {
    for (int c = 0; c < 3; ++c) forces.push_back(label(id, c));
  }
  exchange.share_forces(forces, arrived);
  ASSERT_EQ(arrived.size(), 3 * exchange.known().id.size());
  for (std::size_t k = 0; k < exchange.known().id.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(arrived[3 * k + static_cast<std::size_t>(c)], label(exchange.known().id[k], c));
    }
  }
}

TEST_P(VertexExchangeTest, MayBeUsedAgainWithOtherPositions) {
  for (double& x : own.position) x = 0.3 * x + 1.0;
  exchange.share_positions(own.id, own.position, own.expected, kReach);
  std::vector<double> values, returned(3 * own.id.size(), -1.0);
  for (const int k : exchange.known().held) {
    const auto at = 3 * static_cast<std::size_t>(k);
    values.insert(values.end(), &exchange.known().position[at], &exchange.known().position[at] + 3);
  }
  exchange.return_to_owners(values, 3, returned);
  EXPECT_EQ(returned, own.position);
}

TEST_P(VertexExchangeTest, WorksWithoutAnyCell) {
  exchange.share_positions({}, {}, {}, kReach);
  EXPECT_TRUE(exchange.known().id.empty());
  std::vector<double> arrived(7);
  exchange.return_to_owners({}, 3, {});
  exchange.share_forces({}, arrived);
  EXPECT_TRUE(arrived.empty());
}

}  // namespace
}  // namespace npfem::flow
