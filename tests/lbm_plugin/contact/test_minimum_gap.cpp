// SPDX-License-Identifier: MPL-2.0
#include "contact/minimum_gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cell_shapes.h"
#include "communicator/serial_communicator.h"
#include "flows.h"
#include "geometry/vec3.h"

namespace npfem::flow {
namespace {

Domain box(DomainKind kind = DomainKind::periodic_box) {
  Domain domain;
  domain.kind = kind;
  domain.nodes = {40, 40, 40};
  domain.dx = 0.5;
  return domain;
}

CellSurface moved(const CellType& type, int id, const Vec3& centre) {
  CellSurface cell{id, 0, type.shape};
  for (std::size_t i = 0; i < cell.positions.size(); ++i) cell.positions[i] += centre[i % 3];
  return cell;
}

// Octahedral spheres have vertices on the axes.
TEST(MinimumGap, OfTwoSpheresSideBySide) {
  SerialCommunicator self;
  const std::vector<CellType> types{testing::sphere(2.0)};
  const std::vector<CellSurface> cells{moved(types[0], 0, {8, 10, 10}), moved(types[0], 1, {12.25, 10, 10})};
  EXPECT_NEAR(smallest_cell_gap(box(), types, self, cells), 0.25, 1e-12);
}

TEST(MinimumGap, IsFromVertexToFaceToo) {
  SerialCommunicator self;
  CellType cube_like = testing::sphere(2.0, 0);  // an octahedron
  const std::vector<CellType> types{cube_like};
  // The corner of the second points at the middle of a face of the first.
  const double s = 1 / std::sqrt(3.0);
  const Vec3 face{2.0 / 3, 2.0 / 3, 2.0 / 3};
  CellSurface other = moved(types[0], 1, {0, 0, 0});
  const double far = 0.5;
  // The only vertex near: put vertex 0 there, the others further out along the normal.
  for (std::size_t v = 0; v < 6; ++v) {
    for (std::size_t a = 0; a < 3; ++a)
      other.positions[3 * v + a] = face[a] + s * far + (v == 0 ? 0.0 : s * (3.0 + 0.1 * double(v)));
  }
  const std::vector<CellSurface> cells{moved(types[0], 0, {0, 0, 0}), other};
  EXPECT_NEAR(smallest_cell_gap(box(), types, self, cells), far, 1e-12);
}

TEST(MinimumGap, GoesAroundPeriodicFaces) {
  SerialCommunicator self;
  const std::vector<CellType> types{testing::sphere(2.0)};
  const std::vector<CellSurface> cells{moved(types[0], 0, {1, 10, 10}), moved(types[0], 1, {76.5, 10, -10})};
  EXPECT_NEAR(smallest_cell_gap(box(), types, self, cells), 0.5, 1e-10);
}

TEST(MinimumGap, AgreesWithAllPairs) {
  SerialCommunicator self;
  const std::vector<CellType> types{testing::red_cell(2)};
  for (int n = 0; n < 5; ++n) {
    std::vector<CellSurface> cells;
    for (int c = 0; c < 6; ++c) cells.push_back(moved(types[0], c, flows::random_vector(n, c, 12.0)));
    double all = std::numeric_limits<double>::infinity();
    for (const CellSurface& a : cells) {
      for (const CellSurface& b : cells) {
        if (a.id == b.id) continue;
        for (std::size_t v = 0; v < a.positions.size(); v += 3) {
          for (std::size_t w = 0; w < b.positions.size(); w += 3) {
            Vec3 d{};
            for (std::size_t i = 0; i < 3; ++i) {
              d[i] = a.positions[v + i] - b.positions[w + i];
              d[i] -= 20.0 * std::round(d[i] / 20.0);
            }
            all = std::min(all, norm(d));
          }
        }
      }
    }
    const double gap = smallest_cell_gap(box(), types, self, cells);
    EXPECT_LE(gap, all);
    // No face reaches further than its size beyond its corners.
    if (gap > 0) {
      EXPECT_GT(gap, all - 1.2);
    }
  }
}

TEST(MinimumGap, OfOneCellIsThatToItsOwnImage) {
  SerialCommunicator self;
  const std::vector<CellType> types{testing::sphere(2.0)};
  const std::vector<CellSurface> cells{moved(types[0], 0, {1, 10, 10})};
  EXPECT_NEAR(smallest_cell_gap(box(), types, self, cells), 16, 1e-12);
  EXPECT_TRUE(std::isinf(smallest_cell_gap(box(DomainKind::tube), types, self, {})));
  EXPECT_TRUE(std::isinf(smallest_wall_gap(box(), self, cells)));
}

TEST(MinimumGap, IsNegativeWhereCellsAreInsideEachOther) {
  SerialCommunicator self;
  const std::vector<CellType> types{testing::sphere(2.0), testing::sphere(0.25, 2)};
  std::vector<CellSurface> cells{moved(types[0], 0, {8, 10, 10}), moved(types[0], 1, {11.75, 10, 10})};
  EXPECT_NEAR(smallest_cell_gap(box(), types, self, cells), -0.25, 0.02);
  cells[1] = moved(types[1], 1, {8, 10, 10});
  cells[1].type = 1;
  EXPECT_NEAR(smallest_cell_gap(box(), types, self, cells), -1.75, 0.05) << "swallowed whole";
}

TEST(MinimumGap, ToTheWall) {
  SerialCommunicator self;
  const std::vector<CellType> types{testing::sphere(2.0)};
  const std::vector<CellSurface> cells{moved(types[0], 0, {1, 17.75, 10})};
  EXPECT_NEAR(smallest_wall_gap(box(DomainKind::plates), self, cells), 0.25, 1e-12);
}

}  // namespace
}  // namespace npfem::flow
