// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cmath>
#include <span>

#include "backend/backend.h"

namespace npfem {

struct NearestObstacle {
  const LineageObstacle* obstacle;  ///< null: there is none
  double distance;                  ///< um
};

/// The obstacle point nearest to a vertex; of equally near ones the first.
inline NearestObstacle nearest_obstacle(std::span<const LineageObstacle> obstacles, const Point& x) {
  NearestObstacle nearest{nullptr, 0};
  double least = 0;
  for (const LineageObstacle& o : obstacles) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) square += (x[c] - o.target[c]) * (x[c] - o.target[c]);
    if (!nearest.obstacle || square < least) {
      nearest.obstacle = &o;
      least = square;
    }
  }
  nearest.distance = std::sqrt(least);
  return nearest;
}

}  // namespace npfem
