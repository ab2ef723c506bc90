// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/elasticity.h"

namespace npfem {
namespace {

template <class E>
double element_energy(const ElementBlock<E>& block, const VertexField& x, VertexField& gradient) {
  double energy = 0;
  for (std::size_t e = 0; e < block.size(); ++e) {
    Vec3<double> corner[E::num_vertices], slope[E::num_vertices];
    for (int i = 0; i < E::num_vertices; ++i) corner[i] = at(x, block.vertices[e][static_cast<std::size_t>(i)]);
    energy += E::energy_gradient(corner, block.rest[e], block.params[e], slope);
    for (int i = 0; i < E::num_vertices; ++i)
      add_to(gradient, block.vertices[e][static_cast<std::size_t>(i)], slope[i]);
  }
  return energy;
}

template <class G>
double group_energy(const GroupBlock<G>& block, const VertexField& x, VertexField& gradient) {
  double energy = 0;
  for (std::size_t g = 0; g < block.size(); ++g) {
    const std::span<const int> group = block.group(g);
    Vec3<double> member[G::max_vertices], slope[G::max_vertices];
    for (std::size_t i = 0; i < group.size(); ++i) member[i] = at(x, group[i]);
    energy += G::energy_gradient(member, static_cast<int>(group.size()), block.rest[g], block.params[g], slope);
    for (std::size_t i = 0; i < group.size(); ++i) add_to(gradient, group[i], slope[i]);
  }
  return energy;
}

/// Collects the energies one after the other, and their sum.
class Ledger {
 public:
  explicit Ledger(std::span<double> by_energy) : by_energy_(by_energy) {}
  void book(double energy) {
    total_ += energy;
    if (next_ < by_energy_.size()) by_energy_[next_] = energy;
    ++next_;
  }
  double total() const { return total_; }

 private:
  std::span<double> by_energy_;
  std::size_t next_ = 0;
  double total_ = 0;
};

void add_cell_energies(const Model& model, const VertexField& x, VertexField& gradient, Ledger& ledger) {
  VertexField area_gradient(x.rows(), 3), volume_gradient(x.rows(), 3);
  const CellSums<double> sums = surface_sums(model, x, area_gradient, volume_gradient);
  for_each_energy(CellEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    if (const auto& params = cell_term<E>(model)) {
      const CellResponse<double> response = E::respond(sums, model.rest, *params);
      gradient += response.by_area * area_gradient + response.by_volume * volume_gradient;
      ledger.book(response.energy);
    }
  });
}

}  // namespace

CellSums<double> surface_sums(const Model& model, const VertexField& x, VertexField& area_gradient,
                              VertexField& volume_gradient) {
  area_gradient.setZero();
  volume_gradient.setZero();
  // Volume is summed from the cell's centre, so that a cell far from the origin keeps all digits.
  const Vec3<double> centre{x.col(0).mean(), x.col(1).mean(), x.col(2).mean()};
  CellSums<double> sums{0, 0, 0};
  for (const Triangle& t : model.triangles) {
    const Vec3<double> a = at(x, t[0]) - centre, b = at(x, t[1]) - centre, c = at(x, t[2]) - centre;
    const Vec3<double> twice_area_vector = cross(b - a, c - a);
    const double twice_area = norm(twice_area_vector);
    const Vec3<double> unit_normal = (1 / larger(twice_area, 1e-30)) * twice_area_vector;
    sums.area += 0.5 * twice_area;
    sums.volume += dot(a + b + c, twice_area_vector) / 18;
    const Vec3<double> volume_share = (1.0 / 6) * twice_area_vector;  // the closed surface's dV/dx, one third to each
    const Vec3<double> corner[3] = {a, b, c};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<double> opposite = corner[(i + 2) % 3] - corner[(i + 1) % 3];
      add_to(area_gradient, t[i], 0.5 * cross(unit_normal, opposite));
      add_to(volume_gradient, t[i], volume_share);
    }
  }
  sums.volume_gradient_square = volume_gradient.squaredNorm();
  return sums;
}

double elastic_energy(const Model& model, const VertexField& x, VertexField& gradient, std::span<double> by_energy) {
  Ledger ledger(by_energy);
  for_each_energy(ElementEnergies{}, [&](auto tag) {
    using E = typename decltype(tag)::type;
    const ElementBlock<E>& block = model.block<E>();
    if (block.size() > 0) ledger.book(element_energy(block, x, gradient));
  });
  for_each_energy(GroupEnergies{}, [&](auto tag) {
    using G = typename decltype(tag)::type;
    const GroupBlock<G>& block = model.group_block<G>();
    if (block.size() > 0) ledger.book(group_energy(block, x, gradient));
  });
  if (model.has_cell_terms()) add_cell_energies(model, x, gradient, ledger);
  return ledger.total();
}

}  // namespace npfem
