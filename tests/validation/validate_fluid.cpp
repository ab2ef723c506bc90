// SPDX-License-Identifier: MPL-2.0
// Asks the fluid, without a scene, what a validation case cannot ask of `npfem run`: how vortices decay from a start
// of their own, and whether mass and momentum close from step to step. Prints JSON numbers, lattice units.
//
//   validate_fluid vortex NODES TAU SPEED DRIFT_X DRIFT_Y
//   validate_fluid conservation WALLS(0|1) STEPS
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <string>

#include "communicator/serial_communicator.h"
#include "flows.h"

namespace npfem::flow {
namespace {

/// A square array of vortices, periodic, carried along by a uniform stream:
/// u = drift + U exp(-2 nu k^2 t) (-cos k(x - drift t) sin k(y - drift t), sin cos), exact for Navier and Stokes.
struct Vortices {
  int nodes;
  double tau, speed;
  Vec3 drift;

  double wave_number() const { return 2 * std::numbers::pi / nodes; }
  double rate() const { return 2 * lattice_viscosity(tau) * wave_number() * wave_number(); }

  Vec3 velocity(int ix, int iy, double time) const {
    const double x = wave_number() * (ix - drift[0] * time), y = wave_number() * (iy - drift[1] * time);
    const double size = speed * std::exp(-rate() * time);
    return {drift[0] - size * std::cos(x) * std::sin(y), drift[1] + size * std::sin(x) * std::cos(y), 0};
  }
  FluidState start(int ix, int iy) const {
    const double two_k = 2 * wave_number();
    const double pressure = -0.25 * speed * speed * (std::cos(two_k * ix) + std::cos(two_k * iy));
    return {3 * pressure, velocity(ix, iy, 0)};
  }
};

template <class Visit>
void for_each_node(const Vortices& flow, Visit&& visit) {
  for (int iy = 0; iy < flow.nodes; ++iy) {
    for (int ix = 0; ix < flow.nodes; ++ix) visit(ix, iy);
  }
}

/// Sum of |u - drift|^2.
double energy(const Lattice& lattice, const Vortices& flow) {
  double sum = 0;
  for_each_node(flow, [&](int ix, int iy) {
    const Vec3 u = lattice.node_velocity(ix, iy, 0);
    sum += std::pow(u[0] - flow.drift[0], 2) + std::pow(u[1] - flow.drift[1], 2);
  });
  return sum;
}

/// Root mean square difference from the exact flow, relative to the vortices.
double error(const Lattice& lattice, const Vortices& flow, double time) {
  double difference = 0, all = 0;
  for_each_node(flow, [&](int ix, int iy) {
    const Vec3 u = lattice.node_velocity(ix, iy, 0), exact = flow.velocity(ix, iy, time);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      difference += std::pow(u[axis] - exact[axis], 2);
      all += std::pow(exact[axis] - flow.drift[axis], 2);
    }
  });
  return std::sqrt(difference / all);
}

/// Over one e-folding the start settles, which has no viscous stress; the error is taken at its end, the rate over the
/// next one.
void vortex(const Vortices& flow) {
  SerialCommunicator self;
  Lattice lattice(self, Decomposition({flow.nodes, flow.nodes, 1}, {true, true, true}, 1), flows::periodic(),
                  {flow.tau, 3.0 / 16.0, {}});
  lattice.initialise([&](int ix, int iy, int) { return flow.start(ix, iy); });
  const int steps = static_cast<int>(std::lround(1 / flow.rate()));
  for (int step = 0; step < steps; ++step) lattice.step();
  const double difference = error(lattice, flow, steps), before = energy(lattice, flow);
  for (int step = 0; step < steps; ++step) lattice.step();
  const double rate = 0.5 * std::log(before / energy(lattice, flow)) / steps;
  std::printf("{\"relative_rate\": %.17g, \"error\": %.17g}\n", rate / flow.rate(), difference);
}

/// Random start, random forces on every node in every step: change of mass per node, and of momentum beyond the
/// impulse of forces and walls over the sum of the forces' sizes.
void conservation(bool walls, int steps) {
  constexpr Index3 nodes{19, 12, 17};
  SerialCommunicator self;
  const Decomposition split(nodes, {true, !walls, true}, 1);
  Lattice lattice(self, split, walls ? flows::plates(1, nodes[1], {-0.02, 0, 0.01}, {0.03, 0, 0}) : flows::periodic(),
                  {0.7, 3.0 / 16.0, {1e-5, 0, -2e-5}});
  lattice.initialise([&](int ix, int iy, int iz) {
    const auto id = split.global_id(ix, iy, iz);
    return FluidState{1e-3 * flows::random_value(id, -1), flows::random_vector(id, -2, 0.02)};
  });
  Vec3 impulse{};
  double forces = 0;
  const Vec3 start = lattice.bare_momentum();
  const double mass = lattice.mass_deviation();
  for (int step = 0; step < steps; ++step) {
    lattice.update_velocity();
    lattice.clear_force();
    flows::add_random_force(lattice, step, 1e-4);
    const Vec3 force = lattice.fluid_force();
    lattice.nodes().for_each_fluid_node([&](int ix, int iy, int iz) {
      const Vec3 f = lattice.force_at(ix, iy, iz);
      forces += std::hypot(f[0], f[1], f[2]);
    });
    lattice.step();
    for (std::size_t a = 0; a < 3; ++a) impulse[a] += force[a] + lattice.wall_impulse()[a];
  }
  double defect = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    defect = std::max(defect, std::abs(lattice.bare_momentum()[a] - start[a] - impulse[a]) / forces);
  }
  const double change = std::abs(lattice.mass_deviation() - mass) / static_cast<double>(lattice.nodes().fluid_nodes());
  std::printf("{\"mass\": %.17g, \"momentum\": %.17g}\n", change, defect);
}

int run(int count, char** words) {
  const std::string what = count > 1 ? words[1] : "";
  if (what == "vortex" && count == 7) {
    vortex(
        {std::stoi(words[2]), std::stod(words[3]), std::stod(words[4]), {std::stod(words[5]), std::stod(words[6]), 0}});
  } else if (what == "conservation" && count == 4) {
    conservation(std::stoi(words[2]) != 0, std::stoi(words[3]));
  } else {
    std::fputs("validate_fluid vortex NODES TAU SPEED DRIFT_X DRIFT_Y | conservation WALLS STEPS\n", stderr);
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace npfem::flow

int main(int count, char** words) {
  try {
    return npfem::flow::run(count, words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "validate_fluid: %s\n", error.what());
    return 2;
  }
}
