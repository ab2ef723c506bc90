// SPDX-License-Identifier: MPL-2.0
// What can be asked of the fluid: local values, sums over the nodes of this rank, the hash of its state.

#include <bit>
#include <cmath>
#include <limits>

#include "lattice/collide.h"
#include "lattice/compensated_sum.h"
#include "lattice/lattice.h"

namespace npfem::flow {
namespace {

using d3q19::kDirections;
using d3q19::kVelocity;

template <class Value>  // value(n) -> Vec3
Vec3 sum_over_fluid(const LocalGrid& grid, const NodeMap& nodes, Value value) {
  std::array<CompensatedSum, 3> sum;
  for (int iz = 0; iz < grid.size(2); ++iz) {
    for (const FluidRun& run : nodes.runs(iz)) {
      for (std::ptrdiff_t n = run.first; n < run.first + run.length; ++n) {
        const Vec3 term = value(n);
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis].add(term[axis]);
      }
    }
  }
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

// Finaliser of splitmix64 (Steele, Lea & Flood 2014): every bit of the input reaches every bit of the output.
constexpr std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace

Lattice::Populations Lattice::populations_at(int ix, int iy, int iz) const {
  Populations values;
  for (int i = 0; i < kDirections; ++i) values[std::size_t(i)] = population(i)[grid_.index(ix, iy, iz)];
  return values;
}

void Lattice::set_populations_at(int ix, int iy, int iz, const Populations& populations) {
  for (int i = 0; i < kDirections; ++i) population(i)[grid_.index(ix, iy, iz)] = populations[std::size_t(i)];
}

Vec3 Lattice::force_at(int ix, int iy, int iz) const {
  const std::ptrdiff_t n = grid_.index(ix, iy, iz);
  return {force(0)[n], force(1)[n], force(2)[n]};
}

void Lattice::set_force_at(int ix, int iy, int iz, const Vec3& value) {
  const std::ptrdiff_t n = grid_.index(ix, iy, iz);
  for (int axis = 0; axis < 3; ++axis) force(axis)[n] = value[std::size_t(axis)];
}

Vec3 Lattice::velocity_at(int ix, int iy, int iz) const {
  const std::ptrdiff_t n = grid_.index(ix, iy, iz);
  return {velocity(0)[n], velocity(1)[n], velocity(2)[n]};
}

Vec3 Lattice::node_bare_momentum(std::ptrdiff_t n) const {
  return load_pairs(populations_.data() + n, stride_).momentum();
}

double Lattice::density_deviation(int ix, int iy, int iz) const {
  return load_pairs(populations_.data() + grid_.index(ix, iy, iz), stride_).density_deviation();
}

Vec3 Lattice::node_velocity(int ix, int iy, int iz) const {
  const std::ptrdiff_t n = grid_.index(ix, iy, iz);
  const Vec3 j = node_bare_momentum(n);
  return {j[0] + 0.5 * force(0)[n], j[1] + 0.5 * force(1)[n], j[2] + 0.5 * force(2)[n]};
}

// S = -3/(2 tau) [sum c c (f - f_eq) + (F u + u F)/2] (Krueger et al., The Lattice Boltzmann Method, 2017,
// section 6.3).
SymmetricTensor Lattice::strain_rate(int ix, int iy, int iz) const {
  constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  const std::ptrdiff_t n = grid_.index(ix, iy, iz);
  const Vec3 u = node_velocity(ix, iy, iz);
  const double drho = density_deviation(ix, iy, iz);
  SymmetricTensor strain{};
  for (int i = 1; i < kDirections; ++i) {
    const double departure = population(i)[n] - d3q19::equilibrium(i, drho, u);
    const auto& c = kVelocity[std::size_t(i)];
    for (std::size_t k = 0; k < 6; ++k) strain[k] += c[kPairs[k][0]] * c[kPairs[k][1]] * departure;
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [a, b] = kPairs[k];
    strain[k] += 0.5 * (force(int(a))[n] * u[b] + force(int(b))[n] * u[a]);
    strain[k] *= -1.5 / options_.tau;
  }
  return strain;
}

Vec3 Lattice::bare_momentum() const {
  return sum_over_fluid(grid_, nodes_, [&](std::ptrdiff_t n) { return node_bare_momentum(n); });
}

Vec3 Lattice::momentum() const {
  return sum_over_fluid(grid_, nodes_, [&](std::ptrdiff_t n) {
    const Vec3 j = node_bare_momentum(n);
    return Vec3{j[0] + 0.5 * force(0)[n], j[1] + 0.5 * force(1)[n], j[2] + 0.5 * force(2)[n]};
  });
}

Vec3 Lattice::fluid_force() const {
  return sum_over_fluid(grid_, nodes_, [&](std::ptrdiff_t n) { return Vec3{force(0)[n], force(1)[n], force(2)[n]}; });
}

Vec3 Lattice::wall_force() const {
  std::array<CompensatedSum, 3> sum;
  for (int iz = 0; iz < grid_.size(2); ++iz) {
    for (int iy = 0; iy < grid_.size(1); ++iy) {
      for (int ix = 0; ix < grid_.size(0); ++ix) {
        const std::ptrdiff_t n = grid_.index(ix, iy, iz);
        if (nodes_.type(n) == kFluid) continue;
        for (int axis = 0; axis < 3; ++axis) sum[std::size_t(axis)].add(force(axis)[n]);
      }
    }
  }
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

double Lattice::mass_deviation() const {
  return sum_over_fluid(grid_, nodes_, [&](std::ptrdiff_t n) {
    return Vec3{load_pairs(populations_.data() + n, stride_).density_deviation(), 0.0, 0.0};
  })[0];
}

double Lattice::max_speed() const {
  double largest = 0.0;  // squared
  for (int iz = 0; iz < grid_.size(2); ++iz) {
    for (const FluidRun& run : nodes_.runs(iz)) {
      for (std::ptrdiff_t n = run.first; n < run.first + run.length; ++n) {
        const Vec3 u{velocity(0)[n], velocity(1)[n], velocity(2)[n]};
        const double squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
        if (!std::isfinite(squared)) return std::numeric_limits<double>::infinity();
        if (squared > largest) largest = squared;
      }
    }
  }
  return std::sqrt(largest);
}

std::uint64_t Lattice::state_hash() const {
  std::uint64_t hash = 0;
  const Index3& first = grid_.own().begin;
  for (int iz = 0; iz < grid_.size(2); ++iz) {
    for (const FluidRun& run : nodes_.runs(iz)) {
      for (int k = 0; k < run.length; ++k) {
        const std::int64_t id = decomposition_.global_id(first[0] + run.ix + k, first[1] + run.iy, first[2] + run.iz);
        for (int i = 0; i < kDirections; ++i) {
          const auto key = static_cast<std::uint64_t>(id * kDirections + i + 1);
          hash += mix(std::bit_cast<std::uint64_t>(population(i)[run.first + k]) + mix(key));
        }
      }
    }
  }
  return hash;
}

}  // namespace npfem::flow
