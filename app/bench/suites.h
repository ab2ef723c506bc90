// SPDX-License-Identifier: MPL-2.0
// What npfem bench can measure. Every suite returns a list of rows, all with the same fields, and prints a short table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/fma_peak.h"
#include "communicator/communicator.h"

namespace npfem::app::bench {

using Json = nlohmann::ordered_json;

struct Plan {
  bool quick = false;        ///< a few rows, for a test of the program
  std::vector<int> meshes;   ///< vertices
  std::vector<int> batches;  ///< cells
  std::vector<int> threads;
  std::vector<int> precisions;  ///< indices in precision_names
  FmaPeak peak;
};

/// Time, iterations, error and share of the peak of a step of red cells in shear.
Json measure_cells(const Plan& plan);
/// Iterations near rest and far from it, over time steps, with the Hessian of the rest shape and without.
Json measure_convergence(const Plan& plan);
/// Error against a converged solution versus time, over time step, tolerance, integrator, precision and mesh.
Json measure_work_precision(const Plan& plan);

/// Updates of fluid nodes per second, and the share of the memory's speed in place that they take.
Json measure_fluid(const Plan& plan);
/// Time per vertex of the immersed boundary.
Json measure_ibm(const Plan& plan);
/// Time per step of suspensions at physiological haematocrit, by phase, and its error. Collective.
Json measure_coupled(const Plan& plan, flow::Communicator& communicator);

/// The setting that work-precision rows recommend: least time among those that err by less than 1 % of the motion in
/// every scenario. Null where there is none.
Json recommended(const Json& work_precision);
/// Their diagram as SVG, with the recommended setting marked.
std::string plot_work_precision(const Json& work_precision);

/// One line of progress on the error stream.
void say(const std::string& line);

}  // namespace npfem::app::bench
