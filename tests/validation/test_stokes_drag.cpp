// SPDX-License-Identifier: MPL-2.0
// Stokes drag of a sphere in a periodic cubic array: the immersed boundary against H. Hasimoto, J. Fluid Mech. 5 (1959)
// 317. The sphere is a surface of vertices under uniform traction; the fluid holds the opposite body force.
//
// Kernels smear the surface over their width, so a sphere drags like a slightly larger one. The excess of its radius is
// a property of the kernel: it is measured here in one box and must explain the drag in others.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "immersed_boundary/immersed_boundary.h"

namespace npfem::flow {
namespace {

/// F / (6 pi mu a U) for a simple cubic array of spheres, c the share of volume they take.
double hasimoto(double a_over_length) {
  const double c = 4.0 / 3.0 * std::numbers::pi * std::pow(a_over_length, 3);
  return 1.0 / (1.0 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c);
}

struct Drag {
  double radius, length;
  double force_over_viscosity_speed;  // F / (mu U), node spacings

  double raw_error() const {
    return force_over_viscosity_speed / (6 * std::numbers::pi * radius * hasimoto(radius / length)) - 1;
  }
  /// Radius of the sphere that has this drag, by bisection: a K(a/L) grows with a.
  double effective_radius() const {
    double low = 0.5 * radius, high = 2 * radius;
    for (int i = 0; i < 60; ++i) {
      const double a = 0.5 * (low + high);
      (6 * std::numbers::pi * a * hasimoto(a / length) < force_over_viscosity_speed ? low : high) = a;
    }
    return low;
  }
};

Drag measured(int kernel_points, double radius, int length, double tau) {
  SerialCommunicator self;
  const Decomposition split({length, length, length}, {true, true, true}, 1);
  const double total_force = 1e-4;
  const double volume = std::pow(length, 3);
  Lattice lattice(self, split, {[](int, int, int) { return kFluid; }, {}},
                  {tau, 3.0 / 16.0, {0, 0, -total_force / volume}});
  ImmersedBoundary boundary(kernel_points, lattice);

  const CellType sphere = capsules::capsule("icosphere", 3, radius, capsules::neo_hookean(1));
  const std::vector<double> area = sphere.model->get("rest_area");
  const double whole = std::accumulate(area.begin(), area.end(), 0.0);
  std::vector<double> positions = sphere.shape, forces(positions.size()), velocities(positions.size());
  for (double& x : positions) x += 0.5 * length + 0.21;  // not a place of symmetry among the nodes
  for (std::size_t v = 0; v < area.size(); ++v) forces[3 * v + 2] = total_force * area[v] / whole;
  std::vector<int> all(area.size());
  std::iota(all.begin(), all.end(), 0);

  lattice.clear_force();
  boundary.spread(positions, forces);
  const double viscous_time = length * length / (4 * std::numbers::pi * std::numbers::pi * lattice.viscosity());
  for (int i = 0; i < 10 * viscous_time; ++i) lattice.step();

  lattice.update_velocity();
  boundary.interpolate(positions, all, velocities);
  double speed = -lattice.momentum()[2] / volume;  // relative to the fluid as a whole
  for (std::size_t v = 0; v < area.size(); ++v) speed += velocities[3 * v + 2] * area[v] / whole;
  return {radius, static_cast<double>(length), total_force / (lattice.viscosity() * speed)};
}

TEST(StokesDrag, HasimotosFormulaGivesHisTable) {
  EXPECT_NEAR(hasimoto(0.0625), 1.2140, 2e-4);
  EXPECT_NEAR(hasimoto(0.1), 1.3881, 2e-4);
  EXPECT_NEAR(hasimoto(0.125), 1.5304, 3e-4);
}

struct Sphere {
  double radius;  // node spacings
  int box;        // node spacings
};

void expect_one_excess_of_radius(int kernel_points, double least, double most, std::span<const Sphere> others) {
  const Drag calibration = measured(kernel_points, 4, 32, 4);
  const double excess = calibration.effective_radius() - calibration.radius;
  std::cout << kernel_points << " points: effective radius larger by " << excess << " dx; raw error "
            << 100 * calibration.raw_error() << " % at a = 4 dx, L = 32 dx\n";
  EXPECT_GT(excess, least);
  EXPECT_LT(excess, most);
  for (const auto& [radius, length] : others) {
    const Drag drag = measured(kernel_points, radius, length, 4);
    const Drag larger{radius + excess, drag.length, drag.force_over_viscosity_speed};
    std::cout << kernel_points << " points: a = " << radius << " dx, L = " << length << " dx: raw error "
              << 100 * drag.raw_error() << " %, with the effective radius " << 100 * larger.raw_error() << " %\n";
    EXPECT_LT(std::abs(larger.raw_error()), 0.03);
  }
}

TEST(StokesDrag, FourPoints) {
  constexpr std::array others{Sphere{5, 32}, Sphere{3, 36}, Sphere{5, 40}};
  expect_one_excess_of_radius(4, 0.40, 0.52, others);
}
TEST(StokesDrag, ThreePoints) {
  constexpr std::array others{Sphere{3, 30}};
  expect_one_excess_of_radius(3, 0.30, 0.42, others);
}
TEST(StokesDrag, TwoPoints) {
  constexpr std::array others{Sphere{3, 30}};
  expect_one_excess_of_radius(2, 0.22, 0.32, others);
}

// Steady Stokes flow on the lattice depends on the magic parameter only (d'Humieres & Ginzburg, 2009).
TEST(StokesDrag, DoesNotDependOnTheRelaxationTime) {
  const Drag slow = measured(4, 3, 18, 1), fast = measured(4, 3, 18, 4);
  EXPECT_NEAR(slow.force_over_viscosity_speed / fast.force_over_viscosity_speed, 1, 1e-3);
}

}  // namespace
}  // namespace npfem::flow
