// SPDX-License-Identifier: MPL-2.0
#include "model/hessian.h"

#include "model/hessian_assembler.h"

namespace npfem {
namespace {

/// Area of a triangle, and its gradient.
template <class T>
T area_gradient(const Vec3<T>* x, Vec3<T>* gradient) {
  const Vec3<T> normal = cross(x[1] - x[0], x[2] - x[0]);
  const T twice_area = norm(normal);
  const Vec3<T> half_unit_normal = (0.5 / larger(twice_area, T(1e-30))) * normal;
  for (int i = 0; i < 3; ++i) gradient[i] = cross(half_unit_normal, x[(i + 2) % 3] - x[(i + 1) % 3]);
  return 0.5 * twice_area;
}

/// What a triangle adds to the enclosed volume's gradient: a third of its area vector at each vertex. Exact in the sum
/// over a closed surface, and blind to where the origin is.
template <class T>
void volume_gradient(const Vec3<T>* x, Vec3<T>* gradient) {
  const Vec3<T> share = (1.0 / 6) * cross(x[1] - x[0], x[2] - x[0]);
  for (int i = 0; i < 3; ++i) gradient[i] = share;
}

struct SurfaceShape {
  CellSums<double> sums;
  Eigen::VectorXd by_area, by_volume;  ///< dA/dx (um), dV/dx (um^2)
};

SurfaceShape surface_shape(const Model& model, std::span<const double> x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  SurfaceShape shape{{0, 0, 0}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const Vec3<double> origin = vertex_at(x, 0);
  for (const Triangle& t : model.triangles) {
    Vec3<double> corner[3], area_slope[3], volume_slope[3];
    for (std::size_t i = 0; i < 3; ++i) corner[i] = vertex_at(x, t[i]) - origin;
    shape.sums.area += area_gradient(corner, area_slope);
    volume_gradient(corner, volume_slope);
    shape.sums.volume += dot(corner[0] + corner[1] + corner[2], volume_slope[0]) / 3;
    for (std::size_t i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        shape.by_area(3 * t[i] + axis) += coordinate(area_slope[i], axis);
        shape.by_volume(3 * t[i] + axis) += coordinate(volume_slope[i], axis);
      }
    }
  }
  shape.sums.volume_gradient_square = shape.by_volume.squaredNorm();
  return shape;
}

/// Calls f(params, E) for each energy of the whole cell that the model has.
template <class F>
void for_each_cell_term(const Model& model, F&& f) {
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (const auto& params = cell_term<E>(model)) f(*params, tag);
  });
}

/// The terms that come from the curvature of area and volume themselves.
void add_surface_curvature(const Model& model, const CellSums<double>& sums, HessianAssembler& assembler) {
  double tension = 0, pressure = 0;  // dE/dA, pN/um, and dE/dV, Pa
  for_each_cell_term(model, [&](const auto& params, auto tag) {
    const auto response = decltype(tag)::type::respond(sums, model.rest, params);
    tension += response.by_area;
    pressure += response.by_volume;
  });
  for (const Triangle& t : model.triangles) {
    assembler.add(t, [&](const Vec3<Dual>* corners, Vec3<Dual>* slopes) {
      Vec3<Dual> by_area[3], by_volume[3];
      area_gradient(corners, by_area);
      volume_gradient(corners, by_volume);
      for (int i = 0; i < 3; ++i) slopes[i] = tension * by_area[i] + pressure * by_volume[i];
    });
  }
}

}  // namespace

Eigen::SparseMatrix<double> elastic_hessian(const Model& model, std::span<const double> x, Definite definite) {
  HessianAssembler assembler(x, definite);
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    assembler.add(model.block<E>());
  });
  for_each_energy(GroupEnergies{}, [&](auto tag) {
    using G = typename decltype(tag)::type;
    const GroupBlock<G>& block = model.group_block<G>();
    for (std::size_t g = 0; g < block.size(); ++g) {
      const auto count = static_cast<int>(block.group(g).size());
      assembler.add(block.group(g), [&](const Vec3<Dual>* corners, Vec3<Dual>* slopes) {
        G::energy_gradient(corners, count, block.rest[g], block.params[g], slopes);
      });
    }
  });
  if (model.has_cell_terms()) add_surface_curvature(model, surface_shape(model, x).sums, assembler);
  return assembler.matrix();
}

std::vector<GlobalStiffness> global_stiffness(const Model& model, std::span<const double> x) {
  std::vector<GlobalStiffness> parts;
  if (!model.has_cell_terms()) return parts;
  const SurfaceShape shape = surface_shape(model, x);
  double by_area = 0, by_volume = 0;
  for_each_cell_term(model, [&](const auto& params, auto tag) {
    using E = typename decltype(tag)::type;
    CellSums<Dual> sums{shape.sums.area, shape.sums.volume, shape.sums.volume_gradient_square};
    sums.area.slope = 1;
    by_area += E::respond(sums, model.rest, params).by_area.slope;
    sums.area.slope = 0;
    sums.volume.slope = 1;
    by_volume += E::respond(sums, model.rest, params).by_volume.slope;
  });
  if (by_area != 0) parts.push_back({shape.by_area, by_area});
  if (by_volume != 0) parts.push_back({shape.by_volume, by_volume});
  return parts;
}

}  // namespace npfem
