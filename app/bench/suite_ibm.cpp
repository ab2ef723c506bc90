// SPDX-License-Identifier: MPL-2.0
// The immersed boundary alone: time per vertex of interpolation and spreading.
#include <cmath>
#include <cstdio>
#include <numeric>

#include "bench/blood.h"
#include "bench/statistics.h"
#include "bench/suites.h"
#include "communicator/serial_communicator.h"
#include "coupling/cell_population.h"
#include "immersed_boundary/immersed_boundary.h"
#include "lattice/threads.h"

namespace npfem::app::bench {
namespace {

/// Positions (in node spacings) of all vertices of a scene, in the order of its cells.
std::vector<double> vertices_in_nodes(const flow::Setup& setup) {
  std::vector<double> all;
  for (const flow::CellStart& cell : setup.cells) {
    const flow::CellType& type = setup.types[static_cast<std::size_t>(cell.type)];
    for (const double x : flow::start_positions(cell, type)) all.push_back(x / setup.domain.dx);
  }
  return all;
}

/// |sum of node forces - sum of vertex forces| / sum of |vertex forces|.
double force_error(const flow::Lattice& lattice, const std::vector<double>& forces) {
  flow::Vec3 sum = lattice.fluid_force();
  double size = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    sum[i % 3] -= forces[i];
    size += std::abs(forces[i]);
  }
  return (std::abs(sum[0]) + std::abs(sum[1]) + std::abs(sum[2])) / size;
}

}  // namespace

Json measure_ibm(const Plan& plan) {
  const flow::Scene scene = blood_scene(plan.quick ? "shear20_ht20" : "shear50_ht35");
  const std::vector<double> positions = vertices_in_nodes(scene.setup);
  const std::size_t vertices = positions.size() / 3;
  std::vector<int> held(vertices);
  std::iota(held.begin(), held.end(), 0);
  std::vector<double> forces(positions.size()), velocities(positions.size());
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = 1e-5 * (1.0 + static_cast<double>(i % 7));

  Json rows = Json::array();
  std::printf("%zu vertices of %zu cells\n%6s %-6s %7s %14s %10s %10s\n", vertices, scene.setup.cells.size(), "points",
              "", "threads", "interpolate ns", "spread ns", "both us");
  for (const int threads : plan.threads) {
    for (const bool in_float : {false, true}) {
      flow::SerialCommunicator self;
      flow::LatticeOptions options{.tau = 1.0};
      options.precision = in_float ? flow::FluidPrecision::in_float : flow::FluidPrecision::in_double;
      flow::Lattice lattice(self, flow::Decomposition(scene.setup.domain.nodes, {true, true, true}, 1),
                            {[](int, int, int) { return flow::kFluid; }, {}}, options);
      flow::set_lattice_threads(threads);
      for (const int points : {4, 3, 2}) {
        flow::ImmersedBoundary boundary(points, lattice);
        const int repeats = plan.quick ? 3 : 9;
        const double interpolate = median_us(repeats, [&] { boundary.interpolate(positions, held, velocities); });
        const double spread = median_us(repeats, [&] { boundary.spread(positions, forces); });
        lattice.clear_force();
        boundary.spread(positions, forces);
        const double each = 1e3 / static_cast<double>(vertices);
        rows.push_back({{"points", points},
                        {"precision", in_float ? "float" : "double"},
                        {"threads", threads},
                        {"vertices", vertices},
                        {"interpolate_ns_per_vertex", interpolate * each},
                        {"spread_ns_per_vertex", spread * each},
                        {"us_per_vertex", 1e-3 * (interpolate + spread) * each},
                        {"error", force_error(lattice, forces)}});
        std::printf("%6d %-6s %7d %14.0f %10.0f %10.3f\n", points, in_float ? "float" : "double", threads,
                    interpolate * each, spread * each, 1e-3 * (interpolate + spread) * each);
      }
    }
  }
  return rows;
}

}  // namespace npfem::app::bench
