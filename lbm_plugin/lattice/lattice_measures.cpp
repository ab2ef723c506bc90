// SPDX-License-Identifier: MPL-2.0
// What can be asked of the fluid, and set node by node: local values, sums over the nodes of this rank, the hash of its
// state.

#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "lattice/compensated_sum.h"
#include "lattice/lattice.h"
#include "mix_bits.h"

namespace npfem::flow {
namespace {

using d3q19::kDirections;
using d3q19::kVelocity;

class VectorSum {
 public:
  void add(const Vec3& term) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum_[axis].add(term[axis]);
  }
  Vec3 value() const { return {sum_[0].value(), sum_[1].value(), sum_[2].value()}; }

 private:
  std::array<CompensatedSum, 3> sum_;
};

template <class Real>
Vec3 vector_at(const Real* vectors, NodeNumber node) {
  const Real* v = vectors + 3 * std::ptrdiff_t{node};
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}

Vec3 momentum_of(const Lattice::Populations& f) {
  std::array<double, 9> odd;
  for (std::size_t p = 0; p < 9; ++p) odd[p] = f[2 * p + 1] - f[2 * p + 2];
  return {odd[0] + (odd[3] + odd[4]) + (odd[5] + odd[6]), odd[1] + (odd[3] - odd[4]) + (odd[7] + odd[8]),
          odd[2] + (odd[5] - odd[6]) + (odd[7] - odd[8])};
}

Vec3 with_half(const Vec3& momentum, const Vec3& force) {
  return {momentum[0] + 0.5 * force[0], momentum[1] + 0.5 * force[1], momentum[2] + 0.5 * force[2]};
}

}  // namespace

std::ptrdiff_t Lattice::place_of(int ix, int iy, int iz, int i) const {
  if (i == 0) return population_index(nodes_.number(ix, iy, iz), 0);
  if (i % 2 == 1) return population_index(nodes_.number(ix, iy, iz), near_place(i, odd_step_));
  const auto& up = kVelocity[std::size_t(i - 1)];
  return population_index(nodes_.number(ix + up[0], iy + up[1], iz + up[2]), far_place(i - 1, odd_step_));
}

Lattice::Populations Lattice::populations_at(int ix, int iy, int iz) const {
  return visit_numbers([&](const auto& numbers) {
    Populations values;
    for (int i = 0; i < kDirections; ++i) {
      values[std::size_t(i)] = double{numbers.populations.data()[place_of(ix, iy, iz, i)]};
    }
    return values;
  });
}

void Lattice::set_populations_at(int ix, int iy, int iz, const Populations& populations) {
  visit_numbers([&](auto& numbers) {
    using Real = std::remove_reference_t<decltype(*numbers.populations.data())>;
    for (int i = 0; i < kDirections; ++i) {
      numbers.populations.data()[place_of(ix, iy, iz, i)] = static_cast<Real>(populations[std::size_t(i)]);
    }
  });
}

Vec3 Lattice::force_at(int ix, int iy, int iz) const {
  const NodeNumber node = nodes_.number(ix, iy, iz);
  if (node == NodeMap::kNoNode) return {};
  if (!options_.node_force) return node_type(ix, iy, iz) == kFluid ? options_.body_force : Vec3{};
  return visit_numbers([&](const auto& numbers) { return vector_at(numbers.force.data(), node); });
}

void Lattice::set_force_at(int ix, int iy, int iz, const Vec3& force) {
  const NodeNumber node = nodes_.number(ix, iy, iz);
  if (node == NodeMap::kNoNode || !options_.node_force) return;
  visit_numbers([&](auto& numbers) {
    using Real = std::remove_reference_t<decltype(*numbers.force.data())>;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers.force.data()[3 * std::size_t(node) + axis] = static_cast<Real>(force[axis]);
    }
  });
}

void Lattice::add_force(int ix, int iy, int iz, double fx, double fy, double fz) {
  const Vec3 held = force_at(ix, iy, iz);
  set_force_at(ix, iy, iz, {held[0] + fx, held[1] + fy, held[2] + fz});
}

Vec3 Lattice::velocity_at(int ix, int iy, int iz) const {
  const NodeNumber node = nodes_.number(ix, iy, iz);
  if (node == NodeMap::kNoNode) return {};
  if (!options_.node_force) return node_type(ix, iy, iz) == kFluid ? node_velocity(ix, iy, iz) : Vec3{};
  return visit_numbers([&](const auto& numbers) { return vector_at(numbers.velocity.data(), node); });
}

void Lattice::clear_inside() {
  std::fill(inside_.begin(), inside_.end(), std::uint8_t{0});
}

void Lattice::set_inside(int ix, int iy, int iz) {
  const NodeNumber node = nodes_.number(ix, iy, iz);
  if (node == NodeMap::kNoNode || inside_.empty()) return;
  std::uint8_t& strip = inside_[std::size_t(node / NodeMap::kStrip)];
  strip = static_cast<std::uint8_t>(strip | 1U << (node % NodeMap::kStrip));
}

bool Lattice::is_inside(int ix, int iy, int iz) const {
  const NodeNumber node = nodes_.number(ix, iy, iz);
  if (node == NodeMap::kNoNode || inside_.empty()) return false;
  return (inside_[std::size_t(node / NodeMap::kStrip)] >> (node % NodeMap::kStrip) & 1U) != 0;
}

Vec3 Lattice::node_bare_momentum(int ix, int iy, int iz) const {
  return momentum_of(populations_at(ix, iy, iz));
}

double Lattice::density_deviation(int ix, int iy, int iz) const {
  const Populations f = populations_at(ix, iy, iz);
  std::array<double, 9> even;
  for (std::size_t p = 0; p < 9; ++p) even[p] = f[2 * p + 1] + f[2 * p + 2];
  return f[0] + (even[0] + even[1] + even[2]) + (even[3] + even[4] + even[5]) + (even[6] + even[7] + even[8]);
}

Vec3 Lattice::node_velocity(int ix, int iy, int iz) const {
  return with_half(node_bare_momentum(ix, iy, iz), force_at(ix, iy, iz));
}

// S = -3/(2 tau) [sum c c (f - f_eq) + (F u + u F)/2] (Krueger et al., The Lattice Boltzmann Method, 2017,
// section 6.3).
SymmetricTensor Lattice::strain_rate(int ix, int iy, int iz) const {
  constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  const Populations f = populations_at(ix, iy, iz);
  const Vec3 force = force_at(ix, iy, iz);
  const Vec3 u = with_half(momentum_of(f), force);
  const double drho = density_deviation(ix, iy, iz);
  const double tau = is_inside(ix, iy, iz) ? options_.inside_tau : options_.tau;
  SymmetricTensor strain{};
  for (int i = 1; i < kDirections; ++i) {
    const double departure = f[std::size_t(i)] - d3q19::equilibrium(i, drho, u);
    const auto& c = kVelocity[std::size_t(i)];
    for (std::size_t k = 0; k < 6; ++k) strain[k] += c[kPairs[k][0]] * c[kPairs[k][1]] * departure;
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [a, b] = kPairs[k];
    strain[k] += 0.5 * (force[a] * u[b] + force[b] * u[a]);
    strain[k] *= -1.5 / tau;
  }
  return strain;
}

Vec3 Lattice::bare_momentum() const {
  VectorSum sum;
  nodes_.for_each_fluid_node([&](int ix, int iy, int iz) { sum.add(node_bare_momentum(ix, iy, iz)); });
  return sum.value();
}

Vec3 Lattice::momentum() const {
  VectorSum sum;
  nodes_.for_each_fluid_node([&](int ix, int iy, int iz) { sum.add(node_velocity(ix, iy, iz)); });
  return sum.value();
}

Vec3 Lattice::fluid_force() const {
  VectorSum sum;
  nodes_.for_each_fluid_node([&](int ix, int iy, int iz) { sum.add(force_at(ix, iy, iz)); });
  return sum.value();
}

Vec3 Lattice::wall_force() const {
  VectorSum sum;
  if (!options_.node_force) return sum.value();
  visit_numbers([&](const auto& numbers) {
    for (const OwnStrip& strip : nodes_.own_strips()) {
      if (strip.fluid == 0xff) continue;
      for (int l = 0; l < NodeMap::kStrip; ++l) {
        if ((strip.fluid >> l & 1U) == 0) sum.add(vector_at(numbers.force.data(), strip.strip * NodeMap::kStrip + l));
      }
    }
  });
  return sum.value();
}

double Lattice::mass_deviation() const {
  CompensatedSum sum;
  nodes_.for_each_fluid_node([&](int ix, int iy, int iz) { sum.add(density_deviation(ix, iy, iz)); });
  return sum.value();
}

double Lattice::max_speed() const {
  double largest = 0.0;  // squared
  nodes_.for_each_fluid_node([&](int ix, int iy, int iz) {
    const Vec3 u = velocity_at(ix, iy, iz);
    const double squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    largest = std::isfinite(squared) ? std::max(largest, squared) : std::numeric_limits<double>::infinity();
  });
  return std::sqrt(largest);
}

// A number that is not finite spoils the density of its node, and with it the population at rest, in the next step.
bool Lattice::is_finite() const {
  return visit_numbers([&](const auto& numbers) {
    for (const OwnStrip& strip : nodes_.own_strips()) {
      for (int l = 0; l < NodeMap::kStrip; ++l) {
        const bool fluid = (strip.fluid >> l & 1U) != 0;
        const NodeNumber node = strip.strip * NodeMap::kStrip + l;
        if (fluid && !std::isfinite(numbers.populations.data()[population_index(node, 0)])) return false;
      }
    }
    return true;
  });
}

std::uint64_t Lattice::state_hash() const {
  std::uint64_t hash = 0;
  const Index3& first = nodes_.own().begin;
  nodes_.for_each_fluid_node([&](int ix, int iy, int iz) {
    const std::int64_t id = decomposition_.global_id(first[0] + ix, first[1] + iy, first[2] + iz);
    const Populations f = populations_at(ix, iy, iz);
    for (int i = 0; i < kDirections; ++i) {
      const auto key = static_cast<std::uint64_t>(id * kDirections + i + 1);
      hash += mix_bits(std::bit_cast<std::uint64_t>(f[std::size_t(i)]) + mix_bits(key));
    }
  });
  return hash;
}

}  // namespace npfem::flow
