// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/dissipation.h"

namespace npfem {
namespace {

struct Corners {
  Vec3<double> of[3];
};

Corners corners(const VertexField& field, const Triangle& t) {
  return {{at(field, t[0]), at(field, t[1]), at(field, t[2])}};
}

}  // namespace

Dissipation::Dissipation(const Model& model, const VertexField& start, const VertexField& last_move, double past,
                         double h)
    : model_(model), per_time_{model.viscosity.shear / h, model.viscosity.dilatational / h} {
  if (!model.is_viscous()) return;
  triangles_.reserve(model.triangles.size());
  for (const Triangle& t : model.triangles) {
    triangles_.push_back(MembraneViscosity::start(corners(start, t).of, corners(last_move, t).of, past));
  }
}

double Dissipation::operator()(const VertexField& displacement, VertexField& gradient) const {
  double energy = 0;
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const Triangle& t = model_.triangles[k];
    Vec3<double> slope[3];
    energy += MembraneViscosity::energy_gradient(corners(displacement, t).of, triangles_[k], per_time_, slope);
    for (std::size_t i = 0; i < 3; ++i) add_to(gradient, t[i], slope[i]);
  }
  return energy;
}

}  // namespace npfem
