// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/precision_check.h"

#include <cmath>
#include <limits>
#include <string>

#include "error.h"
#include "model/hessian.h"
#include "quantity.h"

namespace npfem::cpu {
namespace {

constexpr double float_spacing = std::numeric_limits<float>::epsilon();

const char* name_of(int precision) {
  return precision == Precision::mixed_precision ? "1 (mixed)" : "2 (float)";
}

}  // namespace

StiffestForce stiffest_force(const Model& model) {
  const auto n = static_cast<Eigen::Index>(model.num_vertices());
  Eigen::VectorXd about_centre = Eigen::Map<const Eigen::VectorXd>(model.initial.front().data(), 3 * n);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    auto component = about_centre(Eigen::seqN(axis, n, 3));
    component.array() -= component.mean();
  }
  StiffestForce stiffest{model.weight.diagonal().maxCoeff(), about_centre.cwiseAbs().maxCoeff(), 0};
  stiffest.force = stiffest.stiffness * stiffest.reach;
  for (const GlobalStiffness& term :
       global_stiffness(model, {model.initial.front().data(), static_cast<std::size_t>(3 * n)})) {
    const double steepest = term.direction.cwiseAbs().maxCoeff(), k = std::abs(term.stiffness);
    stiffest.stiffness += k * steepest * steepest;
    stiffest.force += k * steepest * std::abs(term.direction.dot(about_centre));
  }
  return stiffest;
}

double rounding_in_float(const StiffestForce& stiffest) {
  return 2 * float_spacing * stiffest.force;
}

void require_forces_in_float(const StiffestForce& stiffest, const SolverOptions& options) {
  const double rounding = rounding_in_float(stiffest);
  if (rounding <= options.residual_bound) return;
  throw Error(Status::bad_input,
              std::string("option \"precision\" = ") + name_of(options.precision) + ": a stiffness of " +
                  text::format_rounded(stiffest.stiffness) + " pN/um on a cell that reaches " +
                  text::format_rounded(stiffest.reach) + " um leaves forces a rounding error of " +
                  text::format_rounded(rounding) +
                  " pN in float; allowed is residual_bound = " + text::format_number(options.residual_bound) +
                  " pN. Set precision = 0 (double) or 1 (mixed), a larger residual_bound, or smaller moduli");
}

void refuse_factor_in_float(const SolverOptions& options) {
  throw Error(Status::bad_input,
              std::string("option \"precision\" = ") + name_of(options.precision) +
                  ": masses/time_step^2 and stiffnesses lie so far apart that the matrix of a step does not fit into "
                  "float (numbers from 1e-38 to 3e38 and their inverses). Set precision = 0 (double)");
}

}  // namespace npfem::cpu
