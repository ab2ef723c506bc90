// SPDX-License-Identifier: MPL-2.0
#pragma once

// Copies between the boxes of neighbouring ranks, axis by axis so that edges and corners come without messages of
// their own. Two directions:
//   fill_halo      own nodes -> the neighbour's halo (x, then y, then z): values known to their owner, wanted beside
//   it; return_halo    halo -> the neighbour's own nodes (z, then y, then x): values made beside a node, wanted by its
//   owner.
// An uncut periodic axis is copied locally; halo layers beyond a face that is not periodic are left alone.

#include <array>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/local_grid.h"

namespace npfem::flow {

// Component numbers that take part in the exchange through each face, the one the data leave through:
// [axis][0: low face, 1: high face].
using FaceComponents = std::array<std::array<std::vector<int>, 2>, 3>;

FaceComponents all_components(int count);

class HaloExchange {
 public:
  // Layers 1..width of the halo take part. Buffers are allocated here, once.
  HaloExchange(Communicator& communicator, const Decomposition& decomposition, const LocalGrid& grid, int width,
               FaceComponents components);

  void fill_halo(double* field);
  void return_halo(double* field);

 private:
  enum class Direction { fill, give_back };
  enum Side { low = 0, high = 1 };

  // A part of the local grid, local indices, last excluded.
  struct Slab {
    Index3 begin, end;
    int rows() const { return (end[1] - begin[1]) * (end[2] - begin[2]); }
    int row_length() const { return end[0] - begin[0]; }
  };

  void exchange_axis(double* field, int axis, Direction direction);
  void copy_around(double* field, int axis, Side side, Direction direction) const;
  void swap_with_neighbours(double* field, int axis, Side side, Direction direction);
  Slab slab(int axis, int first_layer, int layers) const;
  const std::vector<int>& components(int axis, Side side) const {
    return components_[std::size_t(axis)][std::size_t(side)];
  }

  Communicator& communicator_;
  LocalGrid grid_;
  int width_;
  FaceComponents components_;
  std::array<std::array<int, 2>, 3> neighbour_;  // [axis][side]
  std::vector<double> send_, receive_;
};

}  // namespace npfem::flow
