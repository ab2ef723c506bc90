// SPDX-License-Identifier: MPL-2.0
#include "output/rheology.h"

#include <gtest/gtest.h>

#include <cmath>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "geometry/cell_shape.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

/// The last line of the table after `steps` steps, by the means of its single line.
std::vector<std::pair<std::string, double>> measured(const flow::Setup& setup, int steps) {
  const ScratchFolder folder("rheology");
  const auto path = folder.path() / "rheology.csv";
  SerialCommunicator self;
  Simulation simulation(setup, self);
  for (int i = 0; i < steps; ++i) simulation.step();
  RheologyTable table(self, path, simulation.setup(), {});
  const auto cells = simulation.local_cells();
  table.append(simulation, cells);
  return rheology_means(path);
}

double value(const std::vector<std::pair<std::string, double>>& means, const std::string& name) {
  for (const auto& [key, number] : means) {
    if (key == name) return number;
  }
  ADD_FAILURE() << name << " is not in the table";
  return 0;
}

TEST(Rheology, CouetteWithoutCells) {
  flow::Setup setup = capsules::fluid(DomainKind::shear_box, {8, 11, 6}, 0.9);
  setup.domain.plate_speed = 0.02;
  setup.start_developed = true;
  const auto flow = measured(setup, 3000);
  EXPECT_NEAR(value(flow, "relative_viscosity"), 1, 1e-9);
  EXPECT_NEAR(value(flow, "wall_stress_Pa"), setup.kinematic_viscosity * 0.02 / 11, 1e-12);
  EXPECT_NEAR(value(flow, "mean_velocity_um_per_us"), 0, 1e-12);
  EXPECT_TRUE(std::isnan(value(flow, "discharge_haematocrit")));
}

TEST(Rheology, PoiseuilleWithoutCells) {
  flow::Setup setup = capsules::fluid(DomainKind::plates, {8, 11, 6}, 0.9);
  setup.body_force = {1e-5, 0, 0};
  setup.start_developed = true;
  const auto flow = measured(setup, 3000);
  EXPECT_NEAR(value(flow, "relative_viscosity"), 1, 1e-6);
  EXPECT_NEAR(value(flow, "wall_stress_Pa"), 1e-5 * 11 / 2, 1e-11);
  // half-way nodes see a parabola by the midpoint rule: 1 + 1/(2 N^2) of its mean
  const double mean = 1e-5 * 121 / (12 * setup.kinematic_viscosity);
  EXPECT_NEAR(value(flow, "mean_velocity_um_per_us"), mean * (1 + 0.5 / 121), 1e-6 * mean);
  EXPECT_NEAR(value(flow, "flow_rate_um3_per_us"), value(flow, "mean_velocity_um_per_us") * 11 * 6, 1e-9);
}

TEST(Rheology, TubeWithoutCells) {
  flow::Setup setup = capsules::fluid(DomainKind::tube, {24, 24, 4}, 0.9);
  setup.domain.tube_radius = 12;
  setup.body_force = {0, 0, 1e-5};
  setup.start_developed = true;
  const auto flow = measured(setup, 4000);
  EXPECT_NEAR(value(flow, "relative_viscosity"), 1, 0.05);  // of the staircase
  EXPECT_NEAR(value(flow, "wall_stress_Pa"), 1e-5 * 12 / 2, 0.03 * 6e-5);
}

/// In steady flow the walls carry all of the body force, cells or not.
TEST(Rheology, CellsThicken) {
  flow::Setup setup = capsules::fluid(DomainKind::plates, {16, 14, 12}, 0.9);
  setup.body_force = {2e-5, 0, 0};
  setup.start_developed = true;
  setup.types = {capsules::capsule("icosphere", 1, 3.2, capsules::neo_hookean(0.02))};
  capsules::place(setup, 0, {4, 5.6, 6});
  capsules::place(setup, 0, {12, 8.6, 6});
  const auto flow = measured(setup, 1200);
  EXPECT_GT(value(flow, "relative_viscosity"), 1.02);
  EXPECT_NEAR(value(flow, "wall_stress_Pa"), 2e-5 * 14 / 2, 2e-3 * 1.4e-4);
  const double share = 2 * enclosed_volume(setup.types[0].shape, setup.types[0].triangles) / (16 * 14 * 12);
  EXPECT_NEAR(value(flow, "haematocrit"), share, 0.01 * share);
  EXPECT_GT(value(flow, "discharge_haematocrit"), value(flow, "haematocrit")) << "cells near the middle go faster";
  EXPECT_GT(value(flow, "cell_free_layer_um"), 2);
  EXPECT_LT(value(flow, "cell_free_layer_um"), 5.5);
  EXPECT_GT(value(flow, "msd_capsule_x_um2"), 1);
  EXPECT_LT(value(flow, "msd_capsule_z_um2"), 1e-3);
}

}  // namespace
}  // namespace npfem::flow
