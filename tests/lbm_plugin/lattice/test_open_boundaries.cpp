// SPDX-License-Identifier: MPL-2.0
// Inlets and pressure faces: flow between plates along x, open at both ends.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

constexpr int kLength = 24, kHeight = 12;
constexpr double kSpeed = 1e-4;  // in the middle

double parabola(double y) {
  return 4.0 * y / kHeight * (1.0 - y / kHeight);
}

// Plates at rest; beyond both ends of the channel another boundary each.
Geometry channel(const Boundary& low, const Boundary& high) {
  return {[](int ix, int iy, int) -> NodeType {
            if (iy < 0 || iy >= kHeight) return wall(0);
            if (ix < 0) return wall(1);
            return ix >= kLength ? wall(2) : kFluid;
          },
          {Boundary{}, low, high}};
}

Boundary pressure_face(double density_deviation) {
  return {.kind = Boundary::Kind::pressure, .density_deviation = density_deviation};
}
Boundary parabolic_inlet() {
  return {.velocity = {kSpeed, 0, 0}, .profile = [](int, int iy, int) { return parabola(iy + 0.5); }};
}

class Channel {
 public:
  explicit Channel(const Geometry& geometry, LatticeOptions options = {.tau = 1.0})
      : lattice_(self_, Decomposition({kLength, kHeight, 4}, {false, false, true}, 1), geometry, options) {}

  void run(int steps) {
    for (int step = 0; step < steps; ++step) lattice_.step();
    lattice_.update_velocity();
  }
  double flow(int ix) const {
    double sum = 0;
    for (int iy = 0; iy < kHeight; ++iy) sum += lattice_.node_velocity(ix, iy, 1)[0];
    return sum;
  }
  double mean_density_deviation(int ix) const {
    double sum = 0;
    for (int iy = 0; iy < kHeight; ++iy) sum += lattice_.density_deviation(ix, iy, 1) / kHeight;
    return sum;
  }
  Lattice& lattice() { return lattice_; }

 private:
  SerialCommunicator self_;
  Lattice lattice_;
};

// Pressure drop per length G = drho / (3 L): u = G y (H - y) / (2 nu), L from the first to the last node.
TEST(OpenBoundaries, APressureDropDrivesPoiseuilleFlow) {
  const double nu = lattice_viscosity(1.0);
  const double gradient = 8.0 * nu * kSpeed / (kHeight * kHeight);
  const double half = 1.5 * gradient * (kLength - 1);
  Channel channel_flow(channel(pressure_face(half), pressure_face(-half)));
  channel_flow.run(2500);
  for (const int ix : {0, 5, kLength / 2, kLength - 1}) {
    for (int iy = 0; iy < kHeight; ++iy) {
      const Vec3 u = channel_flow.lattice().node_velocity(ix, iy, 2);
      EXPECT_NEAR(u[0], kSpeed * parabola(iy + 0.5), 0.01 * kSpeed) << ix << ' ' << iy;
      EXPECT_NEAR(u[1], 0.0, 0.004 * kSpeed);
    }
    const double expected = half * (1.0 - 2.0 * ix / (kLength - 1));
    EXPECT_NEAR(channel_flow.mean_density_deviation(ix), expected, 0.005 * half);
  }
}

TEST(OpenBoundaries, AnInletKeepsItsFlowAndTheOutletItsPressure) {
  Channel channel_flow(channel(parabolic_inlet(), pressure_face(0.003)));
  channel_flow.run(3000);
  double asked = 0;
  for (int iy = 0; iy < kHeight; ++iy) asked += kSpeed * parabola(iy + 0.5);
  for (const int ix : {0, 7, kLength - 1}) EXPECT_NEAR(channel_flow.flow(ix), asked, 0.001 * asked) << ix;
  for (int iy = 0; iy < kHeight; ++iy) {
    EXPECT_NEAR(channel_flow.lattice().node_velocity(kLength / 2, iy, 0)[0], kSpeed * parabola(iy + 0.5),
                0.01 * kSpeed);
  }
  EXPECT_NEAR(channel_flow.mean_density_deviation(kLength - 1), 0.003, 1e-6);
}

TEST(OpenBoundaries, FactorsScaleWhatEnters) {
  Channel full(channel(parabolic_inlet(), pressure_face(0)));
  Channel half(channel(parabolic_inlet(), pressure_face(0)));
  half.lattice().set_boundary_factor(1, 0.5);
  full.run(2500);
  half.run(2500);
  EXPECT_NEAR(half.flow(3), 0.5 * full.flow(3), 0.002 * full.flow(3));
  half.lattice().set_boundary_factor(1, 0.0);
  half.run(2500);
  EXPECT_NEAR(half.flow(3), 0.0, 1e-4 * full.flow(3));
}

// What the momentum of the fluid gains comes through its boundaries.
TEST(OpenBoundaries, MomentumCloses) {
  Channel open(channel(parabolic_inlet(), pressure_face(0.002)), {.tau = 0.7, .body_force = {1e-5, -2e-5, 3e-5}});
  double size = 0, defect = 0;
  for (int step = 0; step < 200; ++step) {
    const Vec3 before = open.lattice().bare_momentum();
    open.lattice().step();
    const Vec3 after = open.lattice().bare_momentum();
    const Vec3 body = open.lattice().fluid_force();
    const Vec3& walls = open.lattice().wall_impulse();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      defect += after[axis] - before[axis] - body[axis] - walls[axis];
      size += std::abs(walls[axis]) + std::abs(body[axis]);
    }
  }
  EXPECT_LT(std::abs(defect), 1e-13 * size);
}

}  // namespace
}  // namespace npfem::flow
