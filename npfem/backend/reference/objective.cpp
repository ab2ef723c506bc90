// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/objective.h"

#include <cmath>

#include "backend/reference/elasticity.h"

namespace npfem {
namespace {

double patch_energy(const Patch& patch, const VertexField& displacement, VertexField& gradient) {
  Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
  for (const int i : patch.vertices) mean += displacement.row(i);
  mean /= static_cast<double>(patch.vertices.size());
  double energy = 0;
  for (const int i : patch.vertices) {
    const Eigen::RowVector3d departure = displacement.row(i) - mean;
    gradient.row(i) += patch.stiffness * departure;
    energy += 0.5 * patch.stiffness * departure.squaredNorm();
  }
  return energy;
}

}  // namespace

double StepObjective::operator()(const VertexField& displacement, VertexField& gradient, double& scale) const {
  const VertexField from_drift = displacement - drift;
  gradient = inertia.asDiagonal() * from_drift;
  const double kinetic = 0.5 * inner(gradient, from_drift);
  const double work = inner(force, displacement);
  gradient -= force;
  const double elastic = elastic_energy(model, start + displacement, gradient);
  const double dissipated = dissipation(displacement, gradient);
  double held = 0;
  if (!patches.empty()) {
    const VertexField since_tied = start - tied_at + displacement;
    for (const Patch& patch : patches) held += patch_energy(patch, since_tied, gradient);
  }
  scale = std::abs(kinetic) + std::abs(work) + std::abs(elastic) + dissipated + held;
  return kinetic - work + elastic + dissipated + held;
}

}  // namespace npfem
