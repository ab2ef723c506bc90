// SPDX-License-Identifier: MPL-2.0
#include "contact/box_pairs.h"

#include <algorithm>
#include <cmath>

namespace npfem::flow {

BoxPairs::BoxPairs(const Domain& domain) : size_(domain.size()), period_{} {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (domain.periodic()[axis]) period_[axis] = size_[axis];
  }
}

/// Counting sort. An edge of a cube is at least as long as any box and the reach, so that what is near stands in
/// neighbouring cubes.
void BoxPairs::sort_into_cubes(std::span<const Bounds> boxes, double reach) {
  double longest = 0;
  for (const Bounds& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, box.high[axis] - box.low[axis]);
  }
  const double edge = (longest + reach) * (1 + 1e-9);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count_[axis] = std::clamp(static_cast<int>(size_[axis] / edge), 1, 1000);
  }
  cube_.resize(boxes.size());
  sorted_.resize(boxes.size());
  begin_.assign(number({0, 0, count_[2]}) + 1, 0);
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double at = 0.5 * (boxes[n].low[axis] + boxes[n].high[axis]);
      if (period_[axis] > 0) at -= period_[axis] * std::floor(at / period_[axis]);
      // What has left the domain through a wall stays in its last cubes.
      const double cube = std::floor(at * count_[axis] / size_[axis]);
      cube_[n][axis] = static_cast<int>(std::clamp(cube, 0.0, count_[axis] - 1.0));
    }
    ++begin_[number(cube_[n])];
  }
  for (std::size_t cube = 1; cube < begin_.size(); ++cube) begin_[cube] += begin_[cube - 1];
  for (std::size_t n = boxes.size(); n-- > 0;) sorted_[--begin_[number(cube_[n])]] = static_cast<int>(n);
}

std::array<std::vector<int>, 3> BoxPairs::cubes_beside(const Cube& cube) const {
  std::array<std::vector<int>, 3> beside;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int other = cube[axis] - 1; other <= cube[axis] + 1; ++other) {
      const bool inside = other >= 0 && other < count_[axis];
      if (!inside && !(period_[axis] > 0)) continue;
      const int wrapped = (other + count_[axis]) % count_[axis];
      auto& numbers = beside[axis];
      if (std::find(numbers.begin(), numbers.end(), wrapped) == numbers.end()) numbers.push_back(wrapped);
    }
  }
  return beside;
}

void BoxPairs::find(std::span<const Bounds> boxes, double reach, std::vector<BoxPair>& pairs) {
  pairs.clear();
  if (boxes.empty()) return;
  sort_into_cubes(boxes, reach);
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const auto [xs, ys, zs] = cubes_beside(cube_[n]);
    for (const int z : zs) {
      for (const int y : ys) {
        for (const int x : xs) {
          const std::size_t cube = number({x, y, z});
          for (std::size_t s = begin_[cube]; s < begin_[cube + 1]; ++s) {
            if (sorted_[s] >= static_cast<int>(n)) add_images(boxes, static_cast<int>(n), sorted_[s], reach, pairs);
          }
        }
      }
    }
  }
}

/// Every image of the second box that comes near the first one.
void BoxPairs::add_images(std::span<const Bounds> boxes, int first, int second, double reach,
                          std::vector<BoxPair>& pairs) const {
  const Bounds& a = boxes[static_cast<std::size_t>(first)];
  const Bounds& b = boxes[static_cast<std::size_t>(second)];
  std::array<int, 3> least{}, most{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(period_[axis] > 0)) {
      if (a.low[axis] > b.high[axis] + reach || b.low[axis] > a.high[axis] + reach) return;
      continue;
    }
    least[axis] = static_cast<int>(std::ceil((a.low[axis] - b.high[axis] - reach) / period_[axis]));
    most[axis] = static_cast<int>(std::floor((a.high[axis] - b.low[axis] + reach) / period_[axis]));
  }
  for (int x = least[0]; x <= most[0]; ++x) {
    for (int y = least[1]; y <= most[1]; ++y) {
      for (int z = least[2]; z <= most[2]; ++z) {
        const bool is_ahead = x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)));
        if (first != second || is_ahead) pairs.push_back({first, second, {x, y, z}});
      }
    }
  }
}

}  // namespace npfem::flow
