// SPDX-License-Identifier: MPL-2.0
// What is measured between the cells of many ranks: the same as alone, and from what surrounds each rank.
#include "contact/near_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cell_shapes.h"
#include "communicator/serial_communicator.h"
#include "contact/minimum_gap.h"
#include "contact/surface_crossing.h"
#include "flows.h"
#include "mpi_environment.h"

namespace npfem::flow {
namespace {

constexpr double length = 200, width = 12;  // um

/// A long channel along x, periodic along all axes.
Domain channel() {
  Domain domain;
  domain.nodes = {400, 24, 24};
  domain.dx = 0.5;
  return domain;
}

/// Spheres all along the channel with a little disorder, some of them whole periods away from it.
std::vector<CellSurface> row_of(const CellType& type, int count) {
  std::vector<CellSurface> cells;
  for (int n = 0; n < count; ++n) {
    const Vec3 disorder = flows::random_vector(n, 0, 0.4);
    const Vec3 centre{length / count * n + disorder[0] + length * (n % 3 - 1), disorder[1] + width * (n % 2),
                      disorder[2]};
    CellSurface& cell = cells.emplace_back(CellSurface{n, 0, type.shape});
    for (std::size_t i = 0; i < cell.positions.size(); ++i) cell.positions[i] += centre[i % 3];
  }
  return cells;
}

/// Each rank takes a stretch of the channel.
std::vector<CellSurface> share_of(const std::vector<CellSurface>& cells) {
  const auto count = static_cast<std::ptrdiff_t>(cells.size());
  const auto first = [&](int rank) { return cells.begin() + rank * count / world().size(); };
  return {first(world().rank()), first(world().rank() + 1)};
}

TEST(NearCells, GapsAndCrossingsAreThoseOfTheWholeSystem) {
  SerialCommunicator alone;
  const std::vector<CellType> types{testing::sphere(2.0, 2)};
  for (const int count : {58, 44, 32, 4}) {
    const std::vector<CellSurface> cells = row_of(types[0], count), own = share_of(cells);
    EXPECT_EQ(smallest_cell_gap(channel(), types, world(), own), smallest_cell_gap(channel(), types, alone, cells));
    const std::int64_t crossings = count_crossings(channel(), types, alone, cells);
    EXPECT_EQ(count_crossings(channel(), types, world(), own), crossings);
    EXPECT_EQ(crossings > 0, count > 50) << "the diameter is 4 um; " << count << " cells";
  }
}

TEST(NearCells, AreAFewOfAll) {
  const std::vector<CellType> types{testing::sphere(2.0, 1)};
  const std::vector<CellSurface> cells = row_of(types[0], 44), own = share_of(cells);
  const Surroundings found = surroundings(channel(), types, world(), own, 1.5);
  EXPECT_EQ(static_cast<std::size_t>(std::count(found.is_own.begin(), found.is_own.end(), true)), own.size());
  // two neighbours at each end of the stretch, as far as there are other ranks
  EXPECT_LE(found.cells.size(), std::min(cells.size(), own.size() + 4));
  EXPECT_GE(found.cells.size(), std::min(cells.size(), own.size() + 2));
  for (std::size_t n = 0; n < found.cells.size(); ++n) {
    EXPECT_EQ(found.cells[n].positions, cells[static_cast<std::size_t>(found.cells[n].id)].positions);
    EXPECT_TRUE(n == 0 || found.cells[n - 1].id < found.cells[n].id);
  }
}

TEST(NearCells, RanksWithoutCellsTakePart) {
  SerialCommunicator alone;
  const std::vector<CellType> types{testing::sphere(2.0, 1)};
  const std::vector<CellSurface> cells = row_of(types[0], 2);
  const bool mine = world().rank() == world().size() - 1;
  const std::vector<CellSurface> own = mine ? cells : std::vector<CellSurface>{};
  EXPECT_EQ(smallest_cell_gap(channel(), types, world(), own), smallest_cell_gap(channel(), types, alone, cells));
  EXPECT_EQ(count_crossings(channel(), types, world(), own), 0);
}

}  // namespace
}  // namespace npfem::flow
