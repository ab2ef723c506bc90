// SPDX-License-Identifier: MPL-2.0
#include "immersed_boundary/immersed_boundary.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lattice/compensated_sum.h"

namespace npfem::flow {
namespace {

constexpr int kNotHere = -1;

Vec3 vector_at(std::span<const double> xyz, std::size_t i) {
  return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}

/// Calls `kernel` with the number of points as a compile-time constant: one decision per phase, none per vertex.
template <class Function>
void with_kernel(int points, Function&& function) {
  switch (points) {
    case 2:
      return function(std::integral_constant<int, 2>{});
    case 3:
      return function(std::integral_constant<int, 3>{});
    default:
      return function(std::integral_constant<int, 4>{});
  }
}

}  // namespace

ImmersedBoundary::ImmersedBoundary(int kernel_points, const Decomposition& decomposition, int rank)
    : kernel_points_(kernel_points), decomposition_(decomposition), own_(decomposition.box(rank)) {
  if (kernel_points < 2 || kernel_points > 4) {
    throw std::invalid_argument("immersed boundary: a kernel of " + std::to_string(kernel_points) +
                                " points was asked for; there are kernels of 2, 3 and 4 points");
  }
}

/// Local indices, halo included. Beyond a wall there is nothing but wall: the outermost layer stands for it.
template <int Points>
auto ImmersedBoundary::nodes_to_read(const Vec3& position, const Stencil<Points>& stencil) const -> LocalNodes<Points> {
  const Index3 node = node_at(position);
  LocalNodes<Points> nodes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int shift = decomposition_.wrap(axis, node[a]) - node[a] - own_.begin[a];
    for (int p = 0; p < Points; ++p) {
      nodes[a][static_cast<std::size_t>(p)] =
          std::clamp(stencil.first[a] + p + shift, -Lattice::kHalo, own_.size(axis) + Lattice::kHalo - 1);
    }
  }
  return nodes;
}

/// Local indices of own nodes, kNotHere for the others. False where no node of the stencil is this rank's.
template <int Points>
bool ImmersedBoundary::nodes_to_write(const Stencil<Points>& stencil, LocalNodes<Points>& nodes) const {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    bool some = false;
    for (int p = 0; p < Points; ++p) {
      const int local = decomposition_.wrap(axis, stencil.first[a] + p) - own_.begin[a];
      const bool here = local >= 0 && local < own_.size(axis);
      nodes[a][static_cast<std::size_t>(p)] = here ? local : kNotHere;
      some = some || here;
    }
    if (!some) return false;
  }
  return true;
}

template <int Points>
Vec3 ImmersedBoundary::velocity_at(const Lattice& lattice, const Vec3& position) const {
  const Stencil<Points> stencil(position);
  const LocalNodes<Points> nodes = nodes_to_read<Points>(position, stencil);
  Vec3 velocity{};
  for (std::size_t k = 0; k < Points; ++k) {
    for (std::size_t j = 0; j < Points; ++j) {
      const double weight = stencil.weight[2][k] * stencil.weight[1][j];
      const std::ptrdiff_t row = lattice.grid().index(0, nodes[1][j], nodes[2][k]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double* u = lattice.velocity(static_cast<int>(axis)) + row;
        double sum = 0;
        for (std::size_t i = 0; i < Points; ++i) sum += stencil.weight[0][i] * u[nodes[0][i]];
        velocity[axis] += weight * sum;
      }
    }
  }
  return velocity;
}

template <int Points>
void ImmersedBoundary::spread_one(Lattice& lattice, const Vec3& position, const Vec3& force) const {
  const Stencil<Points> stencil(position);
  LocalNodes<Points> nodes;
  if (!nodes_to_write<Points>(stencil, nodes)) return;
  for (std::size_t k = 0; k < Points; ++k) {
    if (nodes[2][k] == kNotHere) continue;
    for (std::size_t j = 0; j < Points; ++j) {
      if (nodes[1][j] == kNotHere) continue;
      const double weight = stencil.weight[2][k] * stencil.weight[1][j];
      for (std::size_t i = 0; i < Points; ++i) {
        if (nodes[0][i] == kNotHere) continue;
        const double w = weight * stencil.weight[0][i];
        lattice.add_force(nodes[0][i], nodes[1][j], nodes[2][k], w * force[0], w * force[1], w * force[2]);
      }
    }
  }
}

template <int Points>
double ImmersedBoundary::weight_on_walls(const Lattice& lattice, const Vec3& position) const {
  const Stencil<Points> stencil(position);
  const LocalNodes<Points> nodes = nodes_to_read<Points>(position, stencil);
  double weight = 0;
  for (std::size_t k = 0; k < Points; ++k) {
    for (std::size_t j = 0; j < Points; ++j) {
      for (std::size_t i = 0; i < Points; ++i) {
        if (lattice.node_type(nodes[0][i], nodes[1][j], nodes[2][k]) == kFluid) continue;
        weight += stencil.weight[2][k] * stencil.weight[1][j] * stencil.weight[0][i];
      }
    }
  }
  return weight;
}

void ImmersedBoundary::interpolate(const Lattice& lattice, std::span<const double> positions, std::span<const int> held,
                                   std::span<double> velocities) const {
  with_kernel(kernel_points_, [&](auto points) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      const Vec3 velocity = velocity_at<points>(lattice, vector_at(positions, static_cast<std::size_t>(held[i])));
      std::copy(velocity.begin(), velocity.end(), velocities.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  });
}

void ImmersedBoundary::spread(Lattice& lattice, std::span<const double> positions,
                              std::span<const double> forces) const {
  with_kernel(kernel_points_, [&](auto points) {
    for (std::size_t i = 0; i < positions.size() / 3; ++i) {
      spread_one<points>(lattice, vector_at(positions, i), vector_at(forces, i));
    }
  });
}

Vec3 ImmersedBoundary::force_on_walls(const Lattice& lattice, std::span<const double> positions,
                                      std::span<const int> held, std::span<const double> forces) const {
  std::array<CompensatedSum, 3> sum;
  with_kernel(kernel_points_, [&](auto points) {
    for (const int v : held) {
      const auto i = static_cast<std::size_t>(v);
      const double weight = weight_on_walls<points>(lattice, vector_at(positions, i));
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis].add(weight * forces[3 * i + axis]);
    }
  });
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

}  // namespace npfem::flow
