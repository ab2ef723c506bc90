// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/plan_storage.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "backend/cpu/shared_factor.h"

namespace npfem::cpu {
namespace {

/// Parameters and rest states are plain numbers (the contract test holds it): converted one by one.
template <class To, class From>
To in_numbers_of(const From& from, double, float) {
  static_assert(sizeof(From) % sizeof(double) == 0 && sizeof(To) * sizeof(double) == sizeof(From) * sizeof(float));
  std::array<double, sizeof(From) / sizeof(double)> numbers;
  std::memcpy(numbers.data(), &from, sizeof(From));
  std::array<float, sizeof(From) / sizeof(double)> narrowed;
  std::transform(numbers.begin(), numbers.end(), narrowed.begin(), [](double v) { return static_cast<float>(v); });
  To to;
  std::memcpy(&to, narrowed.data(), sizeof(To));
  return to;
}
template <class To, class From>
To in_numbers_of(const From& from, double, double) {
  return from;
}

template <class To, class R, class From>
std::vector<To> all_in_numbers_of(const std::vector<From>& from) {
  std::vector<To> to;
  to.reserve(from.size());
  for (const From& value : from) to.push_back(in_numbers_of<To>(value, double{}, R{}));
  return to;
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}
template <class T>
bool same_bits(const T* a, const std::vector<T>& b) {
  return std::memcmp(a, b.data(), b.size() * sizeof(T)) == 0;
}

/// Plain vertex numbers of elements, in the kernels' numbering.
template <class Elements>
std::vector<int> vertices_of(const Elements& elements, std::span<const int> place) {
  std::vector<int> vertices;
  for (const auto& element : elements) {
    for (const int v : element) vertices.push_back(place[static_cast<std::size_t>(v)]);
  }
  return vertices;
}

/// Vertices by when a walk that spreads from vertex 0 over the neighbours (those with a common weight) meets them.
std::vector<int> breadth_first_rank(const Model& model) {
  const int n = model.num_vertices();
  std::vector<int> rank(static_cast<std::size_t>(n), -1);
  int next = 0;
  for (int start = 0; start < n; ++start) {
    if (rank[static_cast<std::size_t>(start)] >= 0) continue;
    std::vector<int> front{start};
    rank[static_cast<std::size_t>(start)] = next++;
    for (std::size_t k = 0; k < front.size(); ++k) {
      for (Eigen::SparseMatrix<double>::InnerIterator neighbour(model.weight, front[k]); neighbour; ++neighbour) {
        int& met = rank[static_cast<std::size_t>(neighbour.row())];
        if (met >= 0) continue;
        met = next++;
        front.push_back(static_cast<int>(neighbour.row()));
      }
    }
  }
  return rank;
}

/// An order of the elements in which those that share vertices follow each other closely: what one has brought into the
/// first cache serves the next.
template <class Elements>
std::vector<std::size_t> walk(const Elements& elements, std::span<const int> rank) {
  std::vector<std::pair<int, std::size_t>> last;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    int most = 0;
    for (const int v : elements[e]) most = std::max(most, rank[static_cast<std::size_t>(v)]);
    last.emplace_back(most, e);
  }
  std::sort(last.begin(), last.end());
  std::vector<std::size_t> order;
  for (const auto& entry : last) order.push_back(entry.second);
  return order;
}

template <class T>
std::vector<T> in_order(const std::vector<T>& values, std::span<const std::size_t> order) {
  std::vector<T> sorted;
  for (const std::size_t k : order) sorted.push_back(values[k]);
  return sorted;
}

}  // namespace

template <class R>
template <class T>
T* PlanStorage<R>::keep(std::vector<T> values) {
  auto owner = std::make_shared<std::vector<T>>(std::move(values));
  kept_.push_back(owner);
  return owner->data();
}

template <class R>
template <class E>
void PlanStorage<R>::add_membrane(const Model& model, std::span<const int> place) {
  const ElementBlock<E>& block = model.block<E>();
  if (block.size() == 0) return;
  const auto order = walk(block.vertices, rank_);
  const std::vector<int> vertices = vertices_of(in_order(block.vertices, order), place);
  const auto rest = all_in_numbers_of<TriangleRest<R>, R>(in_order(block.rest, order));
  auto params = all_in_numbers_of<typename E::template Params<R>, R>(in_order(block.params, order));
  const bool uniform =
      std::all_of(params.begin(), params.end(), [&](const auto& p) { return same_bits(p, params[0]); });
  ParamView<E, R> law{keep(std::move(params)), uniform ? 0 : 1};
  for (auto& group : groups_) {
    if (group.count == static_cast<int>(block.size()) && same_bits(&group.vertices[0][0], vertices) &&
        (!group.rest || same_bits(group.rest, rest))) {
      group.rest = group.rest ? group.rest : keep(rest);
      static_cast<ParamView<E, R>&>(group) = law;
      return;
    }
  }
  TriangleGroup<MembraneEnergies, R> group;
  group.count = static_cast<int>(block.size());
  group.vertices = reinterpret_cast<const int(*)[3]>(keep(vertices));
  group.rest = keep(rest);
  static_cast<ParamView<E, R>&>(group) = law;
  groups_.push_back(group);
}

template <class R>
template <class E>
void PlanStorage<R>::add_elements(const Model& model, std::span<const int> place) {
  const ElementBlock<E>& block = model.block<E>();
  if (block.size() == 0) return;
  const auto order = walk(block.vertices, rank_);
  auto params = all_in_numbers_of<typename E::template Params<R>, R>(in_order(block.params, order));
  const bool uniform =
      std::all_of(params.begin(), params.end(), [&](const auto& p) { return same_bits(p, params[0]); });
  auto& view = plan_.elements.template of<E>();
  view.count = static_cast<int>(block.size());
  view.vertices =
      reinterpret_cast<const int(*)[E::num_vertices]>(keep(vertices_of(in_order(block.vertices, order), place)));
  view.rest = keep(all_in_numbers_of<typename E::template Rest<R>, R>(in_order(block.rest, order)));
  view.params = {keep(std::move(params)), uniform ? 0 : 1};
}

template <class R>
template <class G>
void PlanStorage<R>::add_groups(const Model& model, std::span<const int> place) {
  const GroupBlock<G>& block = model.group_block<G>();
  if (block.size() == 0) return;
  std::vector<int> vertices;
  for (const int v : block.vertices) vertices.push_back(place[static_cast<std::size_t>(v)]);
  auto& view = plan_.vertex_groups.template of<G>();
  view.count = static_cast<int>(block.size());
  view.offsets = keep(block.offsets);
  view.vertices = keep(std::move(vertices));
  view.rest = keep(all_in_numbers_of<typename G::template Rest<R>, R>(block.rest));
  view.params = {keep(all_in_numbers_of<typename G::template Params<R>, R>(block.params)), 1};
}

template <class R>
PlanStorage<R>::PlanStorage(const Model& model, std::span<const int> order) : rank_(breadth_first_rank(model)) {
  const std::vector<int> place = places_in(order);

  plan_.has_potential = model.has_potential();
  plan_.is_translation_invariant = model.is_translation_invariant();
  plan_.num_vertices = model.num_vertices();
  plan_.rest = {static_cast<R>(model.rest.area), static_cast<R>(model.rest.volume)};
  plan_.stiffest_diagonal = static_cast<R>(Eigen::VectorXd(model.weight.diagonal()).maxCoeff());

  // The surface comes first: membrane laws upon the same triangles join it.
  TriangleGroup<MembraneEnergies, R> surface;
  std::vector<int> corners = vertices_of(in_order(model.triangles, walk(model.triangles, rank_)), place);
  surface.count = static_cast<int>(model.triangles.size());
  surface.vertices = reinterpret_cast<const int(*)[3]>(keep(std::move(corners)));
  surface.is_surface = true;
  if (surface.count > 0) groups_.push_back(surface);

  plan_.surface = surface.vertices;
  plan_.num_surface_triangles = surface.count;
  plan_.is_viscous = model.is_viscous();
  plan_.viscosity = {static_cast<R>(model.viscosity.shear), static_cast<R>(model.viscosity.dilatational)};
  plan_.viscous_diagonal = static_cast<R>(Eigen::VectorXd(model.viscous_weight.diagonal()).maxCoeff());

  for_each_energy(MembraneEnergies{}, [&](auto tag) { add_membrane<typename decltype(tag)::type>(model, place); });
  for_each_energy(LoneElementEnergies{}, [&](auto tag) { add_elements<typename decltype(tag)::type>(model, place); });
  for_each_energy(GroupEnergies{}, [&](auto tag) { add_groups<typename decltype(tag)::type>(model, place); });
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (const auto& params = cell_term<E>(model)) {
      auto& view = plan_.cell_terms.template of<E>();
      view.present = true;
      view.params = in_numbers_of<typename E::template Params<R>>(*params, double{}, R{});
      plan_.needs_area = plan_.needs_area || E::uses_area;
      plan_.needs_volume = plan_.needs_volume || E::uses_volume;
    }
  });
  // A surface without a law has any rest state: only its areas and volumes are used.
  for (auto& group : groups_) {
    if (!group.rest)
      group.rest = keep(std::vector<TriangleRest<R>>(static_cast<std::size_t>(group.count),
                                                     TriangleRest<R>{R(1), R(0), R(1), R(0.5), R(1)}));
  }
  plan_.groups = groups_.data();
  plan_.num_groups = static_cast<int>(groups_.size());
}

template class PlanStorage<double>;
template class PlanStorage<float>;

}  // namespace npfem::cpu
