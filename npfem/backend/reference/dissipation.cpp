// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/dissipation.h"

#include <algorithm>

#include "model/hessian_assembler.h"

namespace npfem {
namespace {

struct Corners {
  Vec3<double> of[3];
};

Corners corners(const VertexField& field, const Triangle& t) {
  return {{at(field, t[0]), at(field, t[1]), at(field, t[2])}};
}

MembraneViscosity::Start<Dual> on_duals(const MembraneViscosity::Start<double>& s) {
  const auto vector = [](const Vec3<double>& v) { return Vec3<Dual>{v.x, v.y, v.z}; };
  const auto metric = [](const Metric<double>& m) { return Metric<Dual>{m.m11, m.m12, m.m22}; };
  return {vector(s.e1),  vector(s.e2), metric(s.lag), metric(s.inverse),
          s.metric_area, s.area,       s.area_lag,    s.weighed_area};
}

}  // namespace

Dissipation::Dissipation(const Model& model, const VertexField& start, const VertexField& last_move, double past,
                         double h)
    : model_(model), per_lead_(1 / h), per_time_{model.viscosity.shear / h, model.viscosity.dilatational / h} {
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

Eigen::SparseMatrix<double> Dissipation::hessian(const VertexField& displacement, Definite definite) const {
  HessianAssembler assembler({displacement.data(), static_cast<std::size_t>(displacement.size())}, definite);
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    assembler.add(model_.triangles[k], [&](const Vec3<Dual>* move, Vec3<Dual>* slopes) {
      const Vec3<Dual> d[3] = {move[0], move[1], move[2]};
      Vec3<Dual> slope[3];
      MembraneViscosity::energy_gradient(d, on_duals(triangles_[k]), per_time_, slope);
      std::copy_n(slope, 3, slopes);
    });
  }
  return assembler.matrix();
}

}  // namespace npfem
