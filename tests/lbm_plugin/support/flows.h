// SPDX-License-Identifier: MPL-2.0
#pragma once

// Flows used by several tests, lattice units.

#include <array>
#include <cmath>
#include <cstdint>

#include "lattice/lattice.h"

namespace flows {

using npfem::flow::Geometry;
using npfem::flow::Index3;
using npfem::flow::kFluid;
using npfem::flow::NodeType;
using npfem::flow::Vec3;

inline Geometry periodic() {
  return {[](int, int, int) { return kFluid; }, {}};
}

// Walls beyond both ends of one axis, which has n nodes.
inline Geometry plates(int axis, int n, const Vec3& low_velocity, const Vec3& high_velocity) {
  return {[axis, n](int ix, int iy, int iz) -> NodeType {
            const int i = std::array{ix, iy, iz}[std::size_t(axis)];
            return i < 0 ? npfem::flow::wall(0) : (i >= n ? npfem::flow::wall(1) : kFluid);
          },
          {{.velocity = low_velocity}, {.velocity = high_velocity}}};
}

// Round tube along x through the middle of an n x n section.
inline Geometry tube(int n, double radius) {
  return {[n, radius](int, int iy, int iz) -> NodeType {
            const double y = iy - 0.5 * (n - 1);
            const double z = iz - 0.5 * (n - 1);
            return y * y + z * z < radius * radius ? kFluid : npfem::flow::wall(0);
          },
          {npfem::flow::Boundary{}}};
}

// The same numbers in [-1, 1) for the same keys, on any rank.
inline double random_value(std::int64_t a, std::int64_t b = 0) {
  std::uint64_t x = std::uint64_t(a) * 0x9e3779b97f4a7c15U + std::uint64_t(b) * 0xd1b54a32d192ed03U + 1;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  x ^= x >> 31;
  return double(x >> 11) * 0x1p-52 - 1.0;
}

inline Vec3 random_vector(std::int64_t a, std::int64_t b, double size) {
  return {size * random_value(a, 3 * b), size * random_value(a, 3 * b + 1), size * random_value(a, 3 * b + 2)};
}

// A random force on every own node, solid ones included, on top of the body force.
inline void add_random_force(npfem::flow::Lattice& lattice, std::int64_t step, double size) {
  const auto& grid = lattice.nodes();
  for (int iz = 0; iz < grid.size(2); ++iz) {
    for (int iy = 0; iy < grid.size(1); ++iy) {
      for (int ix = 0; ix < grid.size(0); ++ix) {
        const auto& begin = grid.own().begin;
        const auto id = lattice.decomposition().global_id(begin[0] + ix, begin[1] + iy, begin[2] + iz);
        const Vec3 f = random_vector(id, step, size);
        lattice.add_force(ix, iy, iz, f[0], f[1], f[2]);
      }
    }
  }
}

}  // namespace flows
