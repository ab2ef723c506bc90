// SPDX-License-Identifier: MPL-2.0
#include "contact/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace npfem::flow {

TriangleGrid::Carried TriangleGrid::carry(const Vec3& position) const {
  Carried carried{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = position[axis] - window_.low[axis];
    if (!(window_.period[axis] > 0)) {
      carried.at[axis] = along;
      continue;
    }
    // A window that is not the whole of its direction has as much room before it as behind it.
    const double ahead = window_.is_whole[axis] ? 0 : 0.5 * (window_.period[axis] - window_.size[axis]);
    const double turns = std::floor((along + ahead) / window_.period[axis]);
    carried.turns[axis] = static_cast<int>(turns);
    carried.at[axis] = along - turns * window_.period[axis];
  }
  return carried;
}

void TriangleGrid::choose_cubes(double reach, std::size_t balls) {
  for (const double period : window_.period) {
    if (!(period > 0) || reach <= period) continue;
    throw std::logic_error("contacts reach over " + std::to_string(reach) +
                           " um, the longest triangle included: more " + "than the " + std::to_string(period) +
                           " um after which the domain repeats itself");
  }
  // No more cubes than there is use for.
  const double volume = window_.size[0] * window_.size[1] * window_.size[2];
  const double edge = std::max(reach, std::cbrt(0.5 * volume / static_cast<double>(std::max<std::size_t>(balls, 64))));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count_[axis] = std::max(1, static_cast<int>(window_.size[axis] / (edge * (1 + 1e-9))));
    cubes_per_length_[axis] = count_[axis] / window_.size[axis];
  }
}

/// Counting sort by cube.
void TriangleGrid::fill(std::span<const TriangleBall> balls, double reach, std::span<const char> meets_itself) {
  choose_cubes(reach, balls.size());
  const auto cubes =
      static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]);
  begin_.assign(cubes + 1, 0);
  alone_.assign(cubes, nothing);
  cube_.resize(balls.size());
  sorted_.resize(balls.size());
  for (std::size_t n = 0; n < balls.size(); ++n) {
    const TriangleBall& ball = balls[n];
    const std::size_t cube = cube_of({ball.x, ball.y, ball.z});
    cube_[n] = static_cast<std::int32_t>(cube);
    ++begin_[cube];
    const std::int32_t before = alone_[cube];
    const bool is_alone = (before == nothing || before == ball.cell) && !meets_itself[std::size_t(ball.cell)];
    alone_[cube] = is_alone ? ball.cell : several;
  }
  for (std::size_t cube = 1; cube <= cubes; ++cube) begin_[cube] += begin_[cube - 1];
  // begin_ now says where each cube ends; filled from the back, it says where each begins.
  for (std::size_t n = balls.size(); n-- > 0;) sorted_[--begin_[static_cast<std::size_t>(cube_[n])]] = balls[n];
}

std::int32_t TriangleGrid::cell_around(std::size_t cube) const {
  std::int32_t found = nothing;
  for_each_row(cube, [&](std::size_t first, std::size_t last, const std::array<int, 3>&) {
    for (std::size_t c = first; c < last; ++c) {
      if (alone_[c] == nothing || alone_[c] == found) continue;
      found = found == nothing ? alone_[c] : several;
    }
  });
  return found;
}

}  // namespace npfem::flow
