// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "communicator/decomposition.h"

namespace npfem::flow {

/// The vertices known to one rank, sorted into cubes of a uniform grid, so that all vertices within `reach` of one are
/// found in its own cube and the 26 around it. Positions in node spacings, unwrapped.
///
/// The grid covers the block of the rank and two nodes around it. Where that is all of a periodic direction, the cubes
/// go around it; elsewhere the known vertices lie within the window.
class VertexGrid {
 public:
  /// `reach` in node spacings, at most two.
  VertexGrid(const Decomposition& decomposition, const Box& own, double reach);

  void fill(std::span<const double> in_nodes);

  /// Calls visit(index) once for every vertex in the cubes around vertex `v`, itself included, in no useful order.
  template <class Visit>
  void visit_near(std::size_t v, Visit&& visit) const {
    const Cube& centre = cube_of_[v];
    const auto z = neighbours(2, centre[2]);
    const auto y = neighbours(1, centre[1]);
    const auto x = neighbours(0, centre[0]);
    for (int k = 0; k < z.count; ++k) {
      for (int j = 0; j < y.count; ++j) {
        for (int i = 0; i < x.count; ++i) {
          const std::size_t cube = number_of({x.cube[std::size_t(i)], y.cube[std::size_t(j)], z.cube[std::size_t(k)]});
          for (std::size_t n = begin_[cube]; n < begin_[cube + 1]; ++n) visit(static_cast<std::size_t>(sorted_[n]));
        }
      }
    }
  }

 private:
  using Cube = std::array<int, 3>;
  struct Axis {
    double origin;  // node spacings
    double period;  // of the whole direction; 0 where it is not periodic
    double edge;    // of a cube
    int cubes;
    bool wraps;  // the first cube follows the last
  };
  struct Neighbours {
    std::array<int, 3> cube;
    int count;
  };

  int cube_on(const Axis& axis, double position) const;
  Neighbours neighbours(std::size_t axis, int cube) const;
  std::size_t number_of(const Cube& cube) const {
    return static_cast<std::size_t>(cube[0] + axes_[0].cubes * (cube[1] + axes_[1].cubes * cube[2]));
  }

  std::array<Axis, 3> axes_;
  std::vector<Cube> cube_of_;       // by vertex
  std::vector<std::size_t> begin_;  // by cube, into sorted_
  std::vector<int> sorted_;         // vertices by cube
};

}  // namespace npfem::flow
