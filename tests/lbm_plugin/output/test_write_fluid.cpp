// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include "folder_of_rank_zero.h"
#include "mpi_environment.h"
#include "output/write_fluid.h"
#include "scratch_folder.h"
#include "vtk_reader.h"

namespace npfem::flow {
namespace {

TEST(WriteFluid, ReadsBackNodeByNodeInPhysicalUnits) {
  const Index3 nodes{7, 6, 11};
  const Decomposition grid(nodes, {true, false, true}, world().size());
  Geometry geometry;
  geometry.node_type = [](int, int iy, int iz) { return iy < 0 || iy > 5 || (iy == 0 && iz == 4) ? wall(0) : kFluid; };
  geometry.boundaries = {Boundary{}};
  Lattice lattice(world(), grid, geometry, {});
  const auto state = [](int ix, int iy, int iz) {
    return FluidState{1e-3 * (ix + 10 * iy + 100 * iz), {1e-4 * ix, 1e-4 * iy, 1e-4 * iz}};
  };
  lattice.initialise(state);
  const Units units{0.5, 0.25, 1000};

  const ScratchFolder own("write_fluid");
  const auto path = folder_of_rank_zero(own) / "fluid.vti";
  write_fluid(world(), path, 3, fluid_arrays(lattice, units));
  world().barrier();
  const std::string file = content_of(path);
  EXPECT_EQ(attribute(file, "WholeExtent", "WholeExtent"), "0 6 0 5 0 10");
  EXPECT_EQ(attribute(file, "WholeExtent", "Origin"), "0.25 0.25 0.25");
  EXPECT_EQ(attribute(file, "WholeExtent", "Spacing"), "0.5 0.5 0.5");
  const auto velocity = array_of<float>(file, "velocity_um_per_us");
  const auto pressure = array_of<float>(file, "pressure_Pa");
  const auto flags = array_of<std::uint8_t>(file, "flags");
  ASSERT_EQ(pressure.size(), 7u * 6 * 11);
  ASSERT_EQ(velocity.size(), 3 * pressure.size());
  std::size_t n = 0;
  for (int iz = 0; iz < 11; ++iz) {
    for (int iy = 0; iy < 6; ++iy) {
      for (int ix = 0; ix < 7; ++ix, ++n) {
        const bool solid = iy == 0 && iz == 4;
        const FluidState expected = solid ? FluidState{} : state(ix, iy, iz);
        ASSERT_EQ(flags[n], solid ? 1 : 0);
        for (std::size_t a = 0; a < 3; ++a) ASSERT_NEAR(velocity[3 * n + a], 2 * expected.velocity[a], 1e-9);
        ASSERT_NEAR(pressure[n], expected.density_deviation / 3 * 4000, 1e-3);
      }
    }
  }
  world().barrier();
}

}  // namespace
}  // namespace npfem::flow
