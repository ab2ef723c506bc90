// SPDX-License-Identifier: MPL-2.0
#include "batch/operation_count.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstring>

#include "backend/cpu/shared_factor.h"

namespace npfem {
namespace {

/// Triangles with one strain for all membrane laws upon them.
struct TriangleGroup {
  const std::vector<Triangle>* vertices;
  const std::vector<TriangleRest<double>>* rest;  ///< null: the surface, while no law has joined it
};

template <class E>
void join_group(const ElementBlock<E>& block, std::vector<TriangleGroup>& groups) {
  for (TriangleGroup& group : groups) {
    if (*group.vertices != block.vertices) continue;
    const auto same = [&] {
      return std::memcmp(group.rest->data(), block.rest.data(), block.size() * sizeof(block.rest[0])) == 0;
    };
    if (group.rest && !same()) continue;
    group.rest = &block.rest;
    return;
  }
  groups.push_back({&block.vertices, &block.rest});
}

/// Strain and gradient of one triangle, with the additions at its vertices.
long count_strain(const Model& model) {
  long counter = 0;
  Vec3<Counted> x[3], gradient[3];
  counted_corners(model.triangles.front(), model.initial, counter, x);
  const TriangleRest<double> rest{1, 0, 1, 0.5, 1};
  const TriangleStrain<Counted> strain = triangle_strain(x, rest);
  const Counted any{1, counter};
  triangle_gradient(strain, rest, {any, any, any}, gradient);
  return counter + 9;
}

/// Answer of one law to a strain, added to the energy and to the answers of the other laws.
template <class E>
long count_law(const ElementBlock<E>& block) {
  long counter = 0;
  E::Law::respond(Counted(2, counter), Counted(1, counter), block.params.front());
  return counter + 4;
}

/// Area and volume of one triangle of the surface and their gradients, with the additions at its vertices.
long count_surface_sums(bool area, bool volume) {
  long counter = 0;
  const Counted any{1, counter};
  const Vec3<Counted> v{any, any, any};
  if (area) {
    const Counted share = 0.5 * any;
    const Vec3<Counted> at1 = 0.5 * cross(v, v), at2 = 0.5 * cross(v, v), at0 = at1 + at2;
    static_cast<void>(share), static_cast<void>(at0);
    counter += 1 + 9;
  }
  if (volume) {
    const Counted share = 1.0 / 18 * dot(v + v + v, v);
    const Vec3<Counted> third = 1.0 / 6 * v;
    static_cast<void>(share), static_cast<void>(third);
    counter += 1 + 9;
  }
  return counter;
}

double count_cell_terms(const Model& model, bool area, bool volume) {
  long counter = 0;
  const Counted any{1, counter};
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (const auto& params = cell_term<E>(model)) {
      E::respond(CellSums<Counted>{any, any, any}, model.rest, *params);
      counter += 3;
    }
  });
  // The slopes times the gradients of area and volume; the square of the latter.
  const double unknowns = 3.0 * model.num_vertices();
  return static_cast<double>(counter) + (area ? 2 * unknowns : 0) + (volume ? 4 * unknowns : 0);
}

/// One group with its energy added and its additions at the vertices.
template <class G>
long count_group(const Model& model, const GroupBlock<G>& block, std::size_t g) {
  long counter = 0;
  Vec3<Counted> x[G::max_vertices], gradient[G::max_vertices];
  const std::span<const int> group = block.group(g);
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Point& p = model.initial[static_cast<std::size_t>(group[i])];
    x[i] = {Counted(p[0], counter), Counted(p[1], counter), Counted(p[2], counter)};
  }
  const auto count = static_cast<int>(group.size());
  G::energy_gradient(x, count, block.rest[g], block.params[g], gradient);
  return counter + 1 + 3 * count;
}

double count_elastic(const Model& model) {
  std::vector<TriangleGroup> groups;
  if (!model.triangles.empty()) groups.push_back({&model.triangles, nullptr});
  double total = 0;
  const auto add = [&](std::size_t elements, long each) {
    total += static_cast<double>(elements) * static_cast<double>(each);
  };
  for_each_energy(MembraneEnergies{}, [&](auto tag) {
    const auto& block = model.block<typename decltype(tag)::type>();
    if (block.size() == 0) return;
    join_group(block, groups);
    add(block.size(), count_law(block));
  });
  for (const TriangleGroup& group : groups) add(group.vertices->size(), count_strain(model));
  for_each_energy(LoneElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    const std::size_t size = model.block<E>().size();
    if (size > 0) add(size, count_element<E>(model) + 1 + 3 * E::num_vertices);
  });
  for_each_energy(GroupEnergies{}, [&](auto tag) {
    const auto& block = model.group_block<typename decltype(tag)::type>();
    for (std::size_t g = 0; g < block.size(); ++g) add(1, count_group(model, block, g));
  });
  bool area = false, volume = false;
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    area = area || (cell_term<E>(model) && E::uses_area);
    volume = volume || (cell_term<E>(model) && E::uses_volume);
  });
  add(model.triangles.size(), count_surface_sums(area, volume));
  return total + count_cell_terms(model, area, volume);
}

double count_viscous(const Model& model) {
  if (!model.is_viscous() || model.triangles.empty()) return 0;
  long counter = 0;
  Vec3<Counted> x[3], last[3], move[3], gradient[3];
  for (auto* corners : {&x, &last, &move}) counted_corners(model.triangles.front(), model.initial, counter, *corners);
  const auto start = MembraneViscosity::start(x, last, Counted(1.0 / 3));
  MembraneViscosity::energy_gradient(move, start, model.viscosity, gradient);
  return static_cast<double>(model.triangles.size()) * static_cast<double>(counter + 1 + 9);
}

/// Entries of L strictly below the diagonal: numbers of the scalar factor, 3 x 3 blocks of the other.
double factor_entries(const Model& model) {
  Eigen::SparseMatrix<double> pattern = model.weight;
  for (int column = 0; column < pattern.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(pattern, column); entry; ++entry) {
      // Any positive definite matrix of this pattern.
      entry.valueRef() = entry.row() == entry.col() ? 1e3 : 1;
    }
  }
  const std::vector<int> order = cpu::elimination_order(model.weight);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(
      cpu::reordered(pattern, order, 1));
  const Eigen::SparseMatrix<double> lower = factor.matrixL();
  return static_cast<double>(lower.nonZeros()) - model.num_vertices();
}

int num_cell_terms(const Model& model) {
  int terms = 0;
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    terms += cell_term<E>(model) ? 1 : 0;
  });
  return terms;
}

}  // namespace

OperationCount count_operations(const Model& model) {
  const double n = model.num_vertices(), entries = factor_entries(model), terms = num_cell_terms(model);
  OperationCount count{};
  count.unknowns = 3 * n;
  count.elastic = count_elastic(model);
  count.viscous = count_viscous(model);
  // Forward and backward each multiply and subtract every entry for three coordinates.
  count.scalar_solve = 2 * 6 * entries + 3 * n;
  const double block_product = 15;
  count.block_solve = 2 * 18 * entries + 3 * block_product * n + terms * 4 * count.unknowns;
  count.weigh = 6.0 * static_cast<double>(model.weight.nonZeros());
  return count;
}

double operations_of_step(const OperationCount& count, const SolverOptions& options, const CellReport& report) {
  double pairs = 0;  // of the L-BFGS memory, over all search directions
  for (int i = 0; i < report.iterations; ++i) pairs += std::min(i, options.history);
  const double iterations = report.iterations, by_blocks = report.hessian_iterations;
  // A pair costs two inner products and two updates; a new one two differences and three inner products.
  const double search = (iterations - by_blocks) * count.scalar_solve + by_blocks * count.block_solve +
                        count.unknowns * (8 * pairs + 8 * iterations);
  if (options.lineage) {
    // The first point comes from a solve and is evaluated before the counted trials; each trial: new point, departure,
    // damped inertia, and two slopes; each iteration: the norm of the gradient and the slope at its start.
    const double evaluations = report.evaluations + 1;
    return count.scalar_solve + evaluations * (count.elastic + count.weigh + 10 * count.unknowns) + search +
           4 * iterations * count.unknowns;
  }
  // Each evaluation: new point, inertia and work of the loads; each iteration: the slope along its direction.
  return report.evaluations * (count.elastic + count.viscous + 10 * count.unknowns) + search +
         2 * iterations * count.unknowns;
}

}  // namespace npfem
