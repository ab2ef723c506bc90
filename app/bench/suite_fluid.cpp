// SPDX-License-Identifier: MPL-2.0
// The fluid alone: updates of nodes per second and what share of the memory's speed that takes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "bench/bandwidth.h"
#include "bench/clock.h"
#include "bench/statistics.h"
#include "bench/suites.h"
#include "communicator/serial_communicator.h"
#include "lattice/lattice.h"
#include "lattice/threads.h"

namespace npfem::app::bench {
namespace {

struct Box {
  const char* name;
  flow::Index3 nodes;
  bool tube;  // round, along z, with a quarter of the section open
};

flow::Geometry geometry_of(const Box& box) {
  if (!box.tube) return {[](int, int, int) { return flow::kFluid; }, {}};
  const double radius = 0.5 * box.nodes[0] * std::sqrt(1.0 / std::numbers::pi);
  return {[box, radius](int ix, int iy, int) -> flow::NodeType {
            const double x = ix + 0.5 - 0.5 * box.nodes[0], y = iy + 0.5 - 0.5 * box.nodes[1];
            return x * x + y * y < radius * radius ? flow::kFluid : flow::wall(0);
          },
          {flow::Boundary{}}};
}

double bytes_per_node(bool in_float, bool node_force) {
  const double number = in_float ? 4 : 8;
  return number * (2 * flow::d3q19::kDirections + (node_force ? 3 : 0));
}

/// Relative error of the speed of a shear wave after its amplitude has fallen to a half: what the numbers cost.
double shear_wave_error(flow::FluidPrecision precision) {
  flow::SerialCommunicator self;
  constexpr int n = 64;
  flow::LatticeOptions options{.tau = 0.8};
  options.precision = precision;
  flow::Lattice lattice(self, flow::Decomposition({4, n, 4}, {true, true, true}, 1),
                        {[](int, int, int) { return flow::kFluid; }, {}}, options);
  const double k = 2 * std::numbers::pi / n;
  lattice.initialise([&](int, int iy, int) { return flow::FluidState{0, {0.01 * std::sin(k * (iy + 0.5)), 0, 0}}; });
  const int steps = static_cast<int>(std::log(2.0) / (k * k * lattice.viscosity()));
  for (int step = 0; step < steps; ++step) lattice.step();
  double worst = 0;
  for (int iy = 0; iy < n; ++iy) {
    const double exact = 0.01 * std::sin(k * (iy + 0.5)) * std::exp(-k * k * lattice.viscosity() * steps);
    worst = std::max(worst, std::abs(lattice.node_velocity(1, iy, 1)[0] - exact) / 0.005);
  }
  return worst;
}

}  // namespace

Json measure_fluid(const Plan& plan) {
  const std::vector<Box> boxes =
      plan.quick ? std::vector<Box>{{"box", {48, 48, 48}, false}}
                 : std::vector<Box>{{"box", {100, 100, 100}, false}, {"tube", {100, 100, 100}, true}};
  Json rows = Json::array();
  std::printf("%-5s %-6s %7s %5s %9s %9s %7s %9s\n", "", "", "threads", "force", "MLUPS", "GB/s", "share", "ms/step");
  for (const int threads : plan.threads) {
    const double limit = in_place_bandwidth(threads);
    for (const Box& box : boxes) {
      for (const bool in_float : {false, true}) {
        for (const bool node_force : {false, true}) {
          flow::set_lattice_threads(threads);
          flow::SerialCommunicator self;
          flow::LatticeOptions options{.tau = 1.0, .body_force = {1e-7, 0, 0}};
          options.precision = in_float ? flow::FluidPrecision::in_float : flow::FluidPrecision::in_double;
          options.node_force = node_force;
          flow::Lattice lattice(self, flow::Decomposition(box.nodes, {!box.tube, !box.tube, true}, 1), geometry_of(box),
                                options);
          const double us = median_us(plan.quick ? 3 : 15, [&] { lattice.step(); });
          const auto nodes = static_cast<double>(lattice.nodes().fluid_nodes());
          const double bandwidth = bytes_per_node(in_float, node_force) * nodes / us * 1e6;
          rows.push_back({{"case", box.name},
                          {"precision", in_float ? "float" : "double"},
                          {"threads", threads},
                          {"node_force", node_force},
                          {"fluid_nodes", nodes},
                          {"ms_per_step", us * 1e-3},
                          {"mlups", nodes / us},
                          {"gb_per_s", bandwidth * 1e-9},
                          {"in_place_gb_per_s", limit * 1e-9},
                          {"share_of_in_place", bandwidth / limit},
                          {"error", shear_wave_error(options.precision)}});
          std::printf("%-5s %-6s %7d %5s %9.1f %9.1f %6.0f%% %9.2f\n", box.name, in_float ? "float" : "double", threads,
                      node_force ? "yes" : "no", nodes / us, bandwidth * 1e-9, 100 * bandwidth / limit, us * 1e-3);
        }
      }
    }
  }
  return rows;
}

}  // namespace npfem::app::bench
