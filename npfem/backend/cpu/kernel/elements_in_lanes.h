// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "backend/cpu/kernel/rotation.h"
#include "backend/cpu/kernel/substitution.h"

namespace npfem::NPFEM_ISA {

/// One cell, W of its elements at a time: for a host that moves a single cell and waits for it. Fields are xyzxyz...,
/// read as whole registers; numbers behind the last vertex are zero and stay so. What is one number per cell is the
/// same in all lanes.
template <class R, class H, int W>
struct ElementsInLanes {
  using P = Pack<R, W>;
  using Q = Pack<H, W>;
  static constexpr int cells = 1, lanes = W;

  static int length(int num_vertices) { return (3 * num_vertices + W - 1) / W; }

  template <class T>
  NPFEM_LANES_INLINE static Pack<T, W> sum(Pack<T, W> a) {
    T total = 0;
    for (int l = 0; l < W; ++l) total += a[l];
    return Pack<T, W>(total);
  }
  NPFEM_LANES_INLINE static P largest(P a) {
    R most = a[0];
    for (int l = 1; l < W; ++l) most = larger(most, a[l]);
    return P(most);
  }
  NPFEM_LANES_INLINE static Q coefficient(const H* field, int i) { return *reinterpret_cast<const Q*>(field + i * W); }

  template <int corners>
  struct Gathered {
    int vertex[corners][W];
    int count;  ///< lanes in use
  };

  /// The vertices of elements `first` to first + W - 1; lanes behind the last element repeat it.
  template <int corners>
  NPFEM_LANES_INLINE static Gathered<corners> gather(const int (*vertices)[corners], int first, int count) {
    Gathered<corners> g;
    g.count = count - first < W ? count - first : W;
    for (int l = 0; l < W; ++l) {
      const int e = l < g.count ? first + l : count - 1;
      for (int i = 0; i < corners; ++i) g.vertex[i][l] = vertices[e][i];
    }
    return g;
  }
  template <int corners>
  NPFEM_LANES_INLINE static void load(const Gathered<corners>& g, const R* field, Vec3<P> (&x)[corners]) {
    for (int i = 0; i < corners; ++i) {
      R numbers[3][W];
      for (int l = 0; l < W; ++l) {
        for (int c = 0; c < 3; ++c) numbers[c][l] = field[3 * g.vertex[i][l] + c];
      }
      x[i] = {P::from(numbers[0]), P::from(numbers[1]), P::from(numbers[2])};
    }
  }
  template <int corners>
  NPFEM_LANES_INLINE static void add(const Gathered<corners>& g, R* field, const Vec3<P> (&value)[corners]) {
    for (int l = 0; l < g.count; ++l) {
      for (int i = 0; i < corners; ++i) {
        R* const at = field + 3 * g.vertex[i][l];
        at[0] += value[i].x[l], at[1] += value[i].y[l], at[2] += value[i].z[l];
      }
    }
  }
  /// Plain numbers per element (a rest state, parameters) as packs.
  template <class Packs, class Plain>
  NPFEM_LANES_INLINE static Packs transpose(const Plain* plain, int first, int count, int stride) {
    static_assert(sizeof(Packs) == W * sizeof(Plain));
    R numbers[sizeof(Plain) / sizeof(R)][W];
    for (int l = 0; l < W; ++l) {
      const int e = first + l < count ? first + l : count - 1;
      const R* const from = reinterpret_cast<const R*>(plain + e * stride);
      for (std::size_t k = 0; k < sizeof(Plain) / sizeof(R); ++k) numbers[k][l] = from[k];
    }
    Packs packs;
    __builtin_memcpy(&packs, numbers, sizeof(packs));
    return packs;
  }
  /// Energy of the lanes in use.
  template <class Count>
  NPFEM_LANES_INLINE static P counted(P energy, Count count) {
    for (int l = count; l < W; ++l) energy.set(l, R(0));
    return energy;
  }

  static void triangles(const cpu::TriangleGroup<MembraneEnergies, R>& group, const R* x, R* gradient, P* energies,
                        R* area_gradient, R* volume_gradient, RunningSum<R, P>& area, RunningSum<R, P>& volume) {
    for (int t = 0; t < group.count; t += W) {
      const Gathered<3> g = gather<3>(group.vertices, t, group.count);
      Vec3<P> corner[3];
      load(g, x, corner);
      const auto rest = transpose<TriangleRest<P>>(group.rest, t, group.count, 1);
      const TriangleStrain<P> strain = triangle_strain(corner, rest);
      SurfaceResponse<P> total{P(R(0)), P(R(0)), P(R(0))};
      for_each_energy(
          MembraneEnergies{}, [&](auto tag) __attribute__((always_inline)) {
            using E = typename decltype(tag)::type;
            const auto& law = group.template law<E>();
            if (!law.params) return;
            const auto params = transpose<typename E::template Params<P>>(law.params, t, group.count, law.stride);
            const SurfaceResponse<P> w = E::Law::respond(strain.square_sum, strain.area_ratio, params);
            energies[index_in<E>(ElementEnergies{})] += counted(rest.area * w.energy, g.count);
            total.by_square_sum += w.by_square_sum;
            total.by_area_ratio += w.by_area_ratio;
          });
      Vec3<P> slope[3];
      triangle_gradient(strain, rest, total, slope);
      add(g, gradient, slope);
      if (!group.is_surface) continue;
      if (area_gradient) {
        area.add(counted(R(0.5) * strain.twice_area, g.count));
        Vec3<P> share[3];
        share[1] = P(R(0.5)) * cross(strain.e2, strain.unit_normal);
        share[2] = P(R(0.5)) * cross(strain.unit_normal, strain.e1);
        share[0] = -(share[1] + share[2]);
        add(g, area_gradient, share);
      }
      if (volume_gradient) {
        volume.add(counted(R(1.0 / 18) * dot(corner[0] + corner[1] + corner[2], strain.area_vector), g.count));
        const Vec3<P> third = P(R(1.0 / 6)) * strain.area_vector;
        const Vec3<P> share[3] = {third, third, third};
        add(g, volume_gradient, share);
      }
    }
  }

  template <class E>
  static void elements(const cpu::ElementView<E, R>& view, const R* x, R* gradient, P& energy) {
    for (int e = 0; e < view.count; e += W) {
      const auto g = gather<E::num_vertices>(view.vertices, e, view.count);
      Vec3<P> corner[E::num_vertices], slope[E::num_vertices];
      load(g, x, corner);
      const auto rest = transpose<typename E::template Rest<P>>(view.rest, e, view.count, 1);
      const auto params =
          transpose<typename E::template Params<P>>(view.params.params, e, view.count, view.params.stride);
      energy += counted(E::energy_gradient(corner, rest, params, slope), g.count);
      add(g, gradient, slope);
    }
  }

  /// Groups differ in size, so they are taken one by one.
  template <class G>
  static void groups(const cpu::GroupView<G, R>& view, const R* x, R* gradient, P& energy) {
    R total = 0;
    Vec3<R> corner[G::max_vertices], slope[G::max_vertices];
    for (int g = 0; g < view.count; ++g) {
      const int* const v = view.vertices + view.offsets[g];
      const int count = view.offsets[g + 1] - view.offsets[g];
      for (int i = 0; i < count; ++i) corner[i] = {x[3 * v[i]], x[3 * v[i] + 1], x[3 * v[i] + 2]};
      total += G::energy_gradient(corner, count, view.rest[g], view.params.params[g * view.params.stride], slope);
      for (int i = 0; i < count; ++i) NPFEM_ISA::add(gradient, v[i], slope[i]);
    }
    energy.set(0, energy[0] + total);
  }

  static P forces(const cpu::CellPlan<R>& plan, const P* x, P* gradient, P* area_gradient, P* volume_gradient,
                  P* energies) {
    const int packs = length(plan.num_vertices);
    const P zero(R(0));
    const auto flat = [](P* field) { return reinterpret_cast<R*>(field); };
    R* const by_area = plan.needs_area ? flat(area_gradient) : nullptr;
    R* const by_volume = plan.needs_volume ? flat(volume_gradient) : nullptr;
    for (int i = 0; i < packs; ++i) area_gradient[i] = volume_gradient[i] = zero;
    RunningSum<R, P> area, volume;
    const R* const at = reinterpret_cast<const R*>(x);
    for (int g = 0; g < plan.num_groups; ++g)
      triangles(plan.groups[g], at, flat(gradient), energies, by_area, by_volume, area, volume);
    for_each_energy(
        LoneElementEnergies{}, [&](auto tag) __attribute__((always_inline)) {
          using E = typename decltype(tag)::type;
          const auto& view = plan.elements.template of<E>();
          if (view.count > 0) elements<E>(view, at, flat(gradient), energies[index_in<E>(ElementEnergies{})]);
        });
    for_each_energy(
        GroupEnergies{}, [&](auto tag) __attribute__((always_inline)) {
          using G = typename decltype(tag)::type;
          const auto& view = plan.vertex_groups.template of<G>();
          if (view.count > 0)
            groups<G>(view, at, flat(gradient), energies[cpu::first_group_energy + index_in<G>(GroupEnergies{})]);
        });
    for (int e = 0; e < cpu::first_cell_energy; ++e) energies[e] = sum(energies[e]);
    if (plan.needs_area || plan.needs_volume) {
      CellSums<P> cell{sum(area.total()), sum(volume.total()), zero};
      for (int i = 0; i < packs; ++i) cell.volume_gradient_square += volume_gradient[i] * volume_gradient[i];
      cell.volume_gradient_square = sum(cell.volume_gradient_square);
      const CellResponse<P> response = cell_response(plan, cell, energies);
      for (int i = 0; i < packs; ++i)
        gradient[i] += response.by_area * area_gradient[i] + response.by_volume * volume_gradient[i];
    }
    P total = zero;
    for (int e = 0; e < cpu::num_energies; ++e) total += energies[e];
    return total;
  }

  static P viscous_forces(const cpu::CellPlan<R>& plan, const MembraneViscosity::Params<R>& per_time, R past,
                          const P* start, const P* last_move, const P* move, P* gradient) {
    P energy(R(0));
    const auto flat = [](const P* field) { return reinterpret_cast<const R*>(field); };
    for (int t = 0; t < plan.num_surface_triangles; t += W) {
      const Gathered<3> g = gather<3>(plan.surface, t, plan.num_surface_triangles);
      Vec3<P> x[3], last[3], d[3], slope[3];
      load(g, flat(start), x);
      load(g, flat(last_move), last);
      load(g, flat(move), d);
      energy += counted(
          MembraneViscosity::energy_gradient(d, MembraneViscosity::start(x, last, P(past)), per_time, slope), g.count);
      add(g, reinterpret_cast<R*>(gradient), slope);
    }
    return sum(energy);
  }

  // The substitutions of one right-hand side leave nothing to put into lanes but the three coordinates.
  template <class T>
  struct alignas(T) One {
    T v;
    NPFEM_LANES_INLINE One(T value) : v(value) {}  // NOLINT: a number
    One() = default;
    NPFEM_LANES_INLINE friend One operator+(One a, One b) { return a.v + b.v; }
    NPFEM_LANES_INLINE friend One operator-(One a, One b) { return a.v - b.v; }
    NPFEM_LANES_INLINE friend One operator*(One a, One b) { return a.v * b.v; }
    NPFEM_LANES_INLINE One& operator+=(One b) {
      v += b.v;
      return *this;
    }
    NPFEM_LANES_INLINE One& operator-=(One b) {
      v -= b.v;
      return *this;
    }
  };

  template <class T>
  static void solve_scalar(const cpu::FactorView<T>& factor, int n, Pack<T, W>* b) {
    NPFEM_ISA::solve_scalar(factor, n, reinterpret_cast<One<T>*>(b));
  }
  static void solve_blocks(const cpu::FactorView<H>& factor, int n, Q* b) {
    NPFEM_ISA::solve_blocks(factor, n, reinterpret_cast<One<H>*>(b));
  }
  static void weigh(const cpu::LineageMatrices<R>& matrices, int n, const P* x, P* product) {
    NPFEM_ISA::weigh(matrices, n, reinterpret_cast<const One<R>*>(x), reinterpret_cast<One<R>*>(product));
    for (int i = 3 * n; i < W * length(n); ++i) reinterpret_cast<R*>(product)[i] = 0;
  }
  static void rotate(const Matrix3<Q>& rotation, int n, Q* field) { turn<false>(rotation, n, field); }
  static void rotate_back(const Matrix3<Q>& rotation, int n, Q* field) { turn<true>(rotation, n, field); }

 private:
  template <bool back>
  static void turn(const Matrix3<Q>& q, int n, Q* field) {
    H m[3][3];
    for (int r = 0; r < 3; ++r) {
      const H row[3] = {q.row[r].x[0], q.row[r].y[0], q.row[r].z[0]};
      for (int c = 0; c < 3; ++c) (back ? m[c][r] : m[r][c]) = row[c];
    }
    H* v = reinterpret_cast<H*>(field);
    for (int i = 0; i < n; ++i, v += 3) {
      const H x = v[0], y = v[1], z = v[2];
      for (int r = 0; r < 3; ++r) v[r] = m[r][0] * x + m[r][1] * y + m[r][2] * z;
    }
  }
};

}  // namespace npfem::NPFEM_ISA
