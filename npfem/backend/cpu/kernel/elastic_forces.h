// SPDX-License-Identifier: MPL-2.0
// Energies and their gradients with one cell in every lane: all lanes walk over the same elements, so positions and
// forces are read and written without gathers.
#pragma once

#include "backend/cpu/cell_plan.h"
#include "backend/cpu/kernel/pack.h"

namespace npfem::NPFEM_ISA {

template <class P>
NPFEM_LANES_INLINE Vec3<P> load(const P* field, int vertex) {
  const P* at = field + 3 * vertex;
  return {at[0], at[1], at[2]};
}
template <class P>
NPFEM_LANES_INLINE void store(P* field, int vertex, const Vec3<P>& value) {
  P* at = field + 3 * vertex;
  at[0] = value.x, at[1] = value.y, at[2] = value.z;
}
template <class P>
NPFEM_LANES_INLINE void add(P* field, int vertex, const Vec3<P>& value) {
  P* at = field + 3 * vertex;
  at[0] += value.x, at[1] += value.y, at[2] += value.z;
}

/// A sum that keeps what rounding cuts off (Kahan 1965), for single precision: stiff moduli of total area and volume
/// multiply its error.
template <class R, class P>
struct RunningSum {
  P sum = P(R(0)), cut_off = P(R(0));
  NPFEM_LANES_INLINE void add(P term) {
    const P next = sum + term;
    if constexpr (sizeof(R) == sizeof(float)) cut_off += (sum - next) + term;
    sum = next;
  }
  NPFEM_LANES_INLINE P total() const { return sum + cut_off; }
};

/// Sums over one cell, and where its gradients go (null: not wanted).
template <class R, class P>
struct SurfaceSums {
  RunningSum<R, P> area, volume;
  P* area_gradient;
  P* volume_gradient;
};

template <class R, class P>
NPFEM_LANES_INLINE void add_to_surface(const TriangleStrain<P>& s, const Vec3<P> (&x)[3], const int (&v)[3],
                                       SurfaceSums<R, P>& sums) {
  if (sums.area_gradient) {
    sums.area.add(R(0.5) * s.twice_area);
    const Vec3<P> at1 = R(0.5) * cross(s.e2, s.unit_normal), at2 = R(0.5) * cross(s.unit_normal, s.e1);
    add(sums.area_gradient, v[1], at1);
    add(sums.area_gradient, v[2], at2);
    add(sums.area_gradient, v[0], -(at1 + at2));
  }
  if (sums.volume_gradient) {
    sums.volume.add(R(1.0 / 18) * dot(x[0] + x[1] + x[2], s.area_vector));
    const Vec3<P> share = R(1.0 / 6) * s.area_vector;
    for (int i = 0; i < 3; ++i) add(sums.volume_gradient, v[i], share);
  }
}

/// All membrane laws of a group of triangles in one pass: one strain serves them all.
template <class R, class P>
void triangle_forces(const cpu::TriangleGroup<MembraneEnergies, R>& group, const P* x, P* gradient, P* energies,
                     SurfaceSums<R, P>& sums) {
  for (int t = 0; t < group.count; ++t) {
    const int(&v)[3] = group.vertices[t];
    const TriangleRest<R>& rest = group.rest[t];
    const Vec3<P> corner[3] = {load(x, v[0]), load(x, v[1]), load(x, v[2])};
    const TriangleStrain<P> strain = triangle_strain(corner, rest);
    SurfaceResponse<P> total{P(R(0)), P(R(0)), P(R(0))};
    for_each_energy(
        MembraneEnergies{}, [&](auto tag) __attribute__((always_inline)) {
          using E = typename decltype(tag)::type;
          const auto& law = group.template law<E>();
          if (!law.params) return;
          const SurfaceResponse<P> w =
              E::Law::respond(strain.square_sum, strain.area_ratio, law.params[t * law.stride]);
          energies[index_in<E>(ElementEnergies{})] += rest.area * w.energy;
          total.by_square_sum += w.by_square_sum;
          total.by_area_ratio += w.by_area_ratio;
        });
    Vec3<P> slope[3];
    triangle_gradient(strain, rest, total, slope);
    for (int i = 0; i < 3; ++i) add(gradient, v[i], slope[i]);
    if (group.is_surface) add_to_surface<R>(strain, corner, v, sums);
  }
}

template <class E, class R, class P>
void element_forces(const cpu::ElementView<E, R>& view, const P* x, P* gradient, P& energy) {
  for (int e = 0; e < view.count; ++e) {
    const auto& v = view.vertices[e];
    Vec3<P> corner[E::num_vertices], slope[E::num_vertices];
    for (int i = 0; i < E::num_vertices; ++i) corner[i] = load(x, v[i]);
    energy += E::energy_gradient(corner, view.rest[e], view.params.params[e * view.params.stride], slope);
    for (int i = 0; i < E::num_vertices; ++i) add(gradient, v[i], slope[i]);
  }
}

template <class G, class R, class P>
void group_forces(const cpu::GroupView<G, R>& view, const P* x, P* gradient, P& energy) {
  Vec3<P> corner[G::max_vertices], slope[G::max_vertices];
  for (int g = 0; g < view.count; ++g) {
    const int* const v = view.vertices + view.offsets[g];
    const int count = view.offsets[g + 1] - view.offsets[g];
    for (int i = 0; i < count; ++i) corner[i] = load(x, v[i]);
    energy += G::energy_gradient(corner, count, view.rest[g], view.params.params[g * view.params.stride], slope);
    for (int i = 0; i < count; ++i) add(gradient, v[i], slope[i]);
  }
}

/// Answers of the energies of the whole cell to its sums, added up.
template <class R, class P>
NPFEM_LANES_INLINE CellResponse<P> cell_response(const cpu::CellPlan<R>& plan, const CellSums<P>& sums, P* energies) {
  CellResponse<P> total{P(R(0)), P(R(0)), P(R(0))};
  for_each_energy(
      CellEnergies{}, [&](auto tag) __attribute__((always_inline)) {
        using E = typename decltype(tag)::type;
        const auto& term = plan.cell_terms.template of<E>();
        if (!term.present) return;
        const CellResponse<P> response = E::respond(sums, plan.rest, term.params);
        energies[cpu::first_cell_energy + index_in<E>(CellEnergies{})] += response.energy;
        total.by_area += response.by_area;
        total.by_volume += response.by_volume;
      });
  return total;
}

/// Adds dE/dx (pN) at positions x (um) to `gradient`; returns E (pN um) and adds its parts to `energies`. The fields
/// `area_gradient` and `volume_gradient` are scratch.
template <class R, class P>
P elastic_forces(const cpu::CellPlan<R>& plan, const P* x, P* gradient, P* area_gradient, P* volume_gradient,
                 P* energies) {
  const int n = 3 * plan.num_vertices;
  const P zero(R(0));
  SurfaceSums<R, P> sums{
      {}, {}, plan.needs_area ? area_gradient : nullptr, plan.needs_volume ? volume_gradient : nullptr};
  for (int i = 0; sums.area_gradient && i < n; ++i) area_gradient[i] = zero;
  for (int i = 0; sums.volume_gradient && i < n; ++i) volume_gradient[i] = zero;
  for (int g = 0; g < plan.num_groups; ++g) triangle_forces(plan.groups[g], x, gradient, energies, sums);
  for_each_energy(
      LoneElementEnergies{}, [&](auto tag) __attribute__((always_inline)) {
        using E = typename decltype(tag)::type;
        const auto& view = plan.elements.template of<E>();
        if (view.count > 0) element_forces<E>(view, x, gradient, energies[index_in<E>(ElementEnergies{})]);
      });
  for_each_energy(
      GroupEnergies{}, [&](auto tag) __attribute__((always_inline)) {
        using G = typename decltype(tag)::type;
        const auto& view = plan.vertex_groups.template of<G>();
        if (view.count > 0)
          group_forces<G>(view, x, gradient, energies[cpu::first_group_energy + index_in<G>(GroupEnergies{})]);
      });
  if (plan.needs_area || plan.needs_volume) {
    CellSums<P> cell{sums.area.total(), sums.volume.total(), zero};
    for (int i = 0; sums.volume_gradient && i < n; ++i)
      cell.volume_gradient_square += volume_gradient[i] * volume_gradient[i];
    const CellResponse<P> response = cell_response(plan, cell, energies);
    for (int i = 0; sums.area_gradient && i < n; ++i) gradient[i] += response.by_area * area_gradient[i];
    for (int i = 0; sums.volume_gradient && i < n; ++i) gradient[i] += response.by_volume * volume_gradient[i];
  }
  P total = zero;
  for (int e = 0; e < cpu::num_energies; ++e) total += energies[e];
  return total;
}

/// What the viscosity of the membrane costs in a step (see reference/dissipation.h): adds dD/dx to `gradient` and
/// returns D. `start`: x_n, `last_move`: x_n - x_{n-1}, `move`: x - x_n; `per_time`: viscosities over h.
template <class R, class P>
P viscous_forces(const cpu::CellPlan<R>& plan, const MembraneViscosity::Params<R>& per_time, R past, const P* start,
                 const P* last_move, const P* move, P* gradient) {
  P energy(R(0));
  for (int t = 0; t < plan.num_surface_triangles; ++t) {
    const int(&v)[3] = plan.surface[t];
    const Vec3<P> x[3] = {load(start, v[0]), load(start, v[1]), load(start, v[2])};
    const Vec3<P> last[3] = {load(last_move, v[0]), load(last_move, v[1]), load(last_move, v[2])};
    const Vec3<P> d[3] = {load(move, v[0]), load(move, v[1]), load(move, v[2])};
    Vec3<P> slope[3];
    energy += MembraneViscosity::energy_gradient(d, MembraneViscosity::start(x, last, P(past)), per_time, slope);
    for (int i = 0; i < 3; ++i) add(gradient, v[i], slope[i]);
  }
  return energy;
}

}  // namespace npfem::NPFEM_ISA
