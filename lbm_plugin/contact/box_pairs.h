// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/bounds.h"
#include "geometry/domain.h"

namespace npfem::flow {

/// Two boxes that come near each other, the second moved by whole periods. Numbers of the same box stand for it and its
/// own image.
struct BoxPair {
  int first, second;
  std::array<int, 3> image;  ///< periods by which `second` is moved
};

/// Finds the boxes of a periodic domain that come within reach of each other, by a uniform grid of their centres.
class BoxPairs {
 public:
  explicit BoxPairs(const Domain& domain);

  /// Every pair once, with first < second, or first = second and the first number of `image` that is not 0 positive.
  /// Boxes anywhere, in any image. Overwrites `pairs`.
  void find(std::span<const Bounds> boxes, double reach, std::vector<BoxPair>& pairs);

 private:
  using Cube = std::array<int, 3>;

  void sort_into_cubes(std::span<const Bounds> boxes, double reach);
  std::size_t number(const Cube& cube) const {
    return static_cast<std::size_t>(cube[0] + count_[0] * (cube[1] + count_[1] * cube[2]));
  }
  std::array<std::vector<int>, 3> cubes_beside(const Cube& cube) const;
  void add_images(std::span<const Bounds> boxes, int first, int second, double reach,
                  std::vector<BoxPair>& pairs) const;

  Vec3 size_, period_;  // um; period 0 where not periodic
  Cube count_{1, 1, 1};
  std::vector<Cube> cube_;          // by box
  std::vector<std::size_t> begin_;  // by cube, into sorted_
  std::vector<int> sorted_;
};

}  // namespace npfem::flow
