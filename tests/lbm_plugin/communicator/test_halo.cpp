// SPDX-License-Identifier: MPL-2.0
#include "communicator/halo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "mpi_environment.h"

namespace npfem::flow {
namespace {

constexpr double kUntouched = -1.0;

struct Case {
  Index3 nodes;
  std::array<bool, 3> periodic;
  int width;
};

double value_at(const Decomposition& split, int component, const Index3& node) {
  return double(3 * split.global_id(node[0], node[1], node[2]) + component);
}

// body(local index triple, global triple with periodic axes wrapped, node beyond a face that is not periodic)
template <class Body>
void for_each_node(const Decomposition& split, const LocalGrid& grid, int margin, Body body) {
  for (int iz = -margin; iz < grid.size(2) + margin; ++iz) {
    for (int iy = -margin; iy < grid.size(1) + margin; ++iy) {
      for (int ix = -margin; ix < grid.size(0) + margin; ++ix) {
        Index3 global{ix, iy, iz};
        bool outside = false;
        for (int axis = 0; axis < 3; ++axis) {
          int& i = global[std::size_t(axis)];
          i = split.wrap(axis, i + grid.own().begin[std::size_t(axis)]);
          outside = outside || i < 0 || i >= split.nodes()[std::size_t(axis)];
        }
        body(grid.index(ix, iy, iz), global, outside);
      }
    }
  }
}

class Halo : public testing::TestWithParam<Case> {};

TEST_P(Halo, HoldsTheValuesOfTheOwners) {
  const Case& test = GetParam();
  const Decomposition split(test.nodes, test.periodic, world().size());
  const LocalGrid grid(split.box(world().rank()), 2);
  std::vector<double> field(3 * std::size_t(grid.component_stride()), kUntouched);
  for (int component = 0; component < 3; ++component) {
    for_each_node(split, grid, 0, [&](std::ptrdiff_t n, const Index3& global, bool) {
      field[std::size_t(component * grid.component_stride() + n)] = value_at(split, component, global);
    });
  }
  HaloExchange exchange(world(), split, grid, test.width, all_components(3));
  exchange.fill_halo(field.data());
  for (int component = 0; component < 3; ++component) {
    for_each_node(split, grid, test.width, [&](std::ptrdiff_t n, const Index3& global, bool outside) {
      const double expected = outside ? kUntouched : value_at(split, component, global);
      ASSERT_EQ(field[std::size_t(component * grid.component_stride() + n)], expected)
          << global[0] << ' ' << global[1] << ' ' << global[2];
    });
  }
}

// Every node pushes its value one step along a diagonal; after return_halo each owner has what was pushed to it.
TEST_P(Halo, ReturnsWhatWasPushedAcrossFaces) {
  const Case& test = GetParam();
  const Decomposition split(test.nodes, test.periodic, world().size());
  const LocalGrid grid(split.box(world().rank()), 2);
  for (const Index3& step : {Index3{1, 1, 1}, Index3{-1, 0, 1}, Index3{0, -1, 0}, Index3{1, -1, -1}}) {
    std::vector<double> field(std::size_t(grid.component_stride()), kUntouched);
    for_each_node(split, grid, 0, [&](std::ptrdiff_t n, const Index3& global, bool) {
      field[std::size_t(n + grid.offset(step))] = value_at(split, 0, global);
    });
    FaceComponents components;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (step[axis] != 0) components[axis][step[axis] < 0 ? 0 : 1].push_back(0);
    }
    HaloExchange exchange(world(), split, grid, 1, components);
    exchange.return_halo(field.data());
    for_each_node(split, grid, 0, [&](std::ptrdiff_t n, const Index3& global, bool) {
      Index3 from = global;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        from[axis] = split.wrap(int(axis), global[axis] - step[axis]);
        if (from[axis] < 0 || from[axis] >= split.nodes()[axis]) return;  // nobody pushed to this node
      }
      ASSERT_EQ(field[std::size_t(n)], value_at(split, 0, from)) << global[0] << ' ' << global[1] << ' ' << global[2];
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Halo,
                         testing::Values(Case{{11, 9, 13}, {true, true, true}, 2},
                                         Case{{11, 9, 13}, {false, false, false}, 2},
                                         Case{{11, 9, 13}, {true, false, true}, 1},
                                         Case{{1, 17, 3}, {true, true, false}, 2},
                                         Case{{17, 1, 1}, {true, true, true}, 2}));

TEST(HaloExchange, RefusesMoreThanTheHalo) {
  const Decomposition split({11, 9, 13}, {true, true, true}, world().size());
  const LocalGrid grid(split.box(world().rank()), 1);
  EXPECT_THROW(HaloExchange(world(), split, grid, 2, all_components(1)), std::invalid_argument);
}

}  // namespace
}  // namespace npfem::flow
