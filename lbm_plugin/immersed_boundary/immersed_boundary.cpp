// SPDX-License-Identifier: MPL-2.0
#include "immersed_boundary/immersed_boundary.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "lattice/compensated_sum.h"

namespace npfem::flow {
namespace {

constexpr int kHalo = Lattice::kHalo;

Vec3 vector_at(std::span<const double> xyz, std::size_t i) {
  return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}

/// Calls `kernel` with the number of points as a compile-time constant.
template <class Function>
auto with_kernel(int points, Function&& function) {
  switch (points) {
    case 2:
      return function(std::integral_constant<int, 2>{});
    case 3:
      return function(std::integral_constant<int, 3>{});
    default:
      return function(std::integral_constant<int, 4>{});
  }
}

int threads() {
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

}  // namespace

ImmersedBoundary::ImmersedBoundary(int kernel_points, Lattice& lattice)
    : kernel_points_(kernel_points), lattice_(lattice), table_(lattice.decomposition(), lattice.nodes()) {
  if (kernel_points < 2 || kernel_points > 4) {
    throw std::invalid_argument("immersed boundary: a kernel of " + std::to_string(kernel_points) +
                                " points was asked for; there are kernels of 2, 3 and 4 points");
  }
  if (!lattice.options().node_force) throw std::invalid_argument("immersed boundary: a lattice without node forces");
  find_strips_near_walls();
}

void ImmersedBoundary::find_strips_near_walls() {
  const NodeMap& nodes = lattice_.nodes();
  near_wall_.assign(nodes.strips(), 0);
  for (int iz = -kHalo; iz < nodes.size(2) + kHalo; ++iz) {
    for (int iy = -kHalo; iy < nodes.size(1) + kHalo; ++iy) {
      for (int ix = -kHalo; ix < nodes.size(0) + kHalo; ++ix) {
        if (nodes.type(ix, iy, iz) == kFluid) continue;
        for (int z = std::max(iz - kHalo, -kHalo); z <= std::min(iz + kHalo, nodes.size(2) + kHalo - 1); ++z) {
          for (int y = std::max(iy - kHalo, -kHalo); y <= std::min(iy + kHalo, nodes.size(1) + kHalo - 1); ++y) {
            for (const int x : {std::max(ix - kHalo, -kHalo), std::min(ix + kHalo, nodes.size(0) + kHalo - 1)}) {
              const NodeNumber node = nodes.number(x, y, z);
              if (node != NodeMap::kNoNode) near_wall_[static_cast<std::size_t>(node / NodeMap::kStrip)] = 1;
            }
          }
        }
      }
    }
  }
}

void ImmersedBoundary::interpolate(std::span<const double> positions, std::span<const int> held,
                                   std::span<double> velocities) const {
  lattice_.visit_numbers([&](const auto& numbers) {
    using Real = std::remove_cvref_t<decltype(*numbers.velocity.data())>;
    const auto interpolate = transfer<Real>(lattice_.instruction_set(), kernel_points_).interpolate;
    const std::ptrdiff_t count = std::ssize(held);
    constexpr std::ptrdiff_t portion = 256;
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t first = 0; first < count; first += portion) {
      interpolate(table_, numbers.velocity.data(), positions.data(), held.data() + first,
                  std::min(portion, count - first), velocities.data() + 3 * first);
    }
  });
}

void ImmersedBoundary::spread(std::span<const double> positions, std::span<const double> forces) {
  lattice_.visit_numbers([&](auto& numbers) {
    using Real = std::remove_reference_t<decltype(*numbers.force.data())>;
    const auto spread = transfer<Real>(lattice_.instruction_set(), kernel_points_).spread;
    const int layers = lattice_.nodes().size(2);
    const int parts = std::min(threads(), layers);
#pragma omp parallel for schedule(static)
    for (int part = 0; part < parts; ++part) {
      spread(table_, numbers.force.data(), positions.data(), forces.data(), std::ssize(positions) / 3,
             part * layers / parts, (part + 1) * layers / parts);
    }
  });
}

/// Of the node that holds a vertex, local indices; true for a vertex beyond what this rank stores.
bool ImmersedBoundary::near_wall(const Index3& node) const {
  const NodeMap& nodes = lattice_.nodes();
  for (int axis = 0; axis < 3; ++axis) {
    const int i = node[static_cast<std::size_t>(axis)];
    if (i < -kHalo || i >= nodes.size(axis) + kHalo) return true;
  }
  const NodeNumber number = nodes.number(node[0], node[1], node[2]);
  return number == NodeMap::kNoNode || near_wall_[static_cast<std::size_t>(number / NodeMap::kStrip)] != 0;
}

template <int Points>
double ImmersedBoundary::weight_on_walls(const Vec3& position) const {
  const Index3 node = node_at(position);
  Index3 shift;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    shift[a] = lattice_.decomposition().wrap(axis, node[a]) - node[a] - table_.begin[axis];
  }
  if (!near_wall({node[0] + shift[0], node[1] + shift[1], node[2] + shift[2]})) return 0;
  const Stencil<Points> stencil(position);
  const auto local = [&](int axis, std::size_t p) {
    const auto a = static_cast<std::size_t>(axis);
    return std::clamp(stencil.first[a] + static_cast<int>(p) + shift[a], -kHalo, table_.size[axis] + kHalo - 1);
  };
  double weight = 0;
  for (std::size_t k = 0; k < Points; ++k) {
    for (std::size_t j = 0; j < Points; ++j) {
      for (std::size_t i = 0; i < Points; ++i) {
        if (lattice_.node_type(local(0, i), local(1, j), local(2, k)) == kFluid) continue;
        weight += stencil.weight[2][k] * stencil.weight[1][j] * stencil.weight[0][i];
      }
    }
  }
  return weight;
}

Vec3 ImmersedBoundary::force_on_walls(std::span<const double> positions, std::span<const int> held,
                                      std::span<const double> forces) const {
  return with_kernel(kernel_points_, [&](auto points) {
    std::array<CompensatedSum, 3> sum;
    for (const int v : held) {
      const auto i = static_cast<std::size_t>(v);
      const double weight = weight_on_walls<points>(vector_at(positions, i));
      if (weight == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis].add(weight * forces[3 * i + axis]);
    }
    return Vec3{sum[0].value(), sum[1].value(), sum[2].value()};
  });
}

}  // namespace npfem::flow
