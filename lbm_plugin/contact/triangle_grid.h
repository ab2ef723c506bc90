// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec3.h"

namespace npfem::flow {

/// A triangle by the ball around it, which is all that most of them are ever asked for. Distances from the corner of
/// the grid, in single precision: the radius is a little larger than the ball's to make up for it.
struct TriangleBall {
  float x, y, z, radius;
  std::int32_t cell;      ///< number among the known cells
  std::int32_t triangle;  ///< number among the known triangles
};

/// Balls around triangles, sorted into the cubes of a uniform grid whose edge is the reach: what comes within reach of
/// a point has its centre in the point's own cube or one of the 26 around it.
///
/// The grid covers a window of the domain. Along a periodic direction that it covers whole, cubes go around; elsewhere
/// what lies beyond the window stays in its last cubes.
class TriangleGrid {
 public:
  struct Window {
    Vec3 low, size;                ///< um
    Vec3 period;                   ///< um; 0 where not periodic
    std::array<bool, 3> is_whole;  ///< the window is the whole of a periodic direction
  };
  static constexpr std::int32_t nothing = -1, several = -2;

  /// A position carried into the window by whole periods.
  struct Carried {
    Vec3 at;                   ///< um, from the low corner of the window
    std::array<int, 3> turns;  ///< periods taken off
  };

  explicit TriangleGrid(const Window& window) : window_(window) {}

  Carried carry(const Vec3& position) const;

  /// `balls` in any order; those of one cell at least, when it must not be passed over as alone (it may meet its own
  /// image), count as several: `meets_itself` by cell.
  void fill(std::span<const TriangleBall> balls, double reach, std::span<const char> meets_itself);

  std::size_t cubes() const { return begin_.size() - 1; }
  std::size_t cube_of(const Vec3& at) const { return number(cube_on(0, at[0]), cube_on(1, at[1]), cube_on(2, at[2])); }

  /// The one cell that has balls in the 27 cubes around this one; `nothing` or `several`.
  std::int32_t cell_around(std::size_t cube) const;

  /// Calls visit(ball, shift) once for every ball in the 27 cubes around this one; seen from the cube, the ball stands
  /// moved by shift[axis] periods.
  template <class Visit>
  void visit_around(std::size_t cube, Visit&& visit) const {
    for_each_row(cube, [&](std::size_t first, std::size_t last, const std::array<int, 3>& shift) {
      for (std::size_t n = begin_[first]; n < begin_[last]; ++n) visit(sorted_[n], shift);
    });
  }

 private:
  /// Rows of cubes side by side along x: [first, last), as far as they have the same shift.
  template <class Row>
  void for_each_row(std::size_t cube, Row&& row) const {
    const auto c = static_cast<int>(cube);
    const int i = c % count_[0], j = c / count_[0] % count_[1], k = c / (count_[0] * count_[1]);
    for (int dz = -1; dz <= 1; ++dz) {
      const Beside z = beside(2, k + dz);
      if (z.cube < 0) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        const Beside y = beside(1, j + dy);
        if (y.cube < 0) continue;
        const bool inside = i > 0 && i + 1 < count_[0];
        if (inside) {
          row(number(i - 1, y.cube, z.cube), number(i + 1, y.cube, z.cube) + 1, {0, y.shift, z.shift});
          continue;
        }
        for (int dx = -1; dx <= 1; ++dx) {
          const Beside x = beside(0, i + dx);
          if (x.cube < 0) continue;
          const std::size_t first = number(x.cube, y.cube, z.cube);
          row(first, first + 1, {x.shift, y.shift, z.shift});
        }
      }
    }
  }
  struct Beside {
    int cube;   // -1: beyond the window
    int shift;  // periods
  };
  Beside beside(std::size_t axis, int cube) const {
    if (cube >= 0 && cube < count_[axis]) return {cube, 0};
    if (!window_.is_whole[axis]) return {-1, 0};
    return cube < 0 ? Beside{cube + count_[axis], -1} : Beside{cube - count_[axis], 1};
  }

  int cube_on(std::size_t axis, double at) const {
    const double along = at * cubes_per_length_[axis];
    return along > 0 ? (along < count_[axis] ? static_cast<int>(along) : count_[axis] - 1) : 0;
  }
  std::size_t number(int i, int j, int k) const {
    return static_cast<std::size_t>(i + count_[0] * (j + count_[1] * k));
  }
  void choose_cubes(double reach, std::size_t balls);

  Window window_;
  std::array<int, 3> count_{1, 1, 1};
  Vec3 cubes_per_length_{};
  std::vector<std::size_t> begin_;   // by cube, into sorted_
  std::vector<std::int32_t> alone_;  // by cube: the cell that has balls in it, nothing or several
  std::vector<std::int32_t> cube_;   // by ball
  std::vector<TriangleBall> sorted_;
};

}  // namespace npfem::flow
