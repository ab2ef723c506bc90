// SPDX-License-Identifier: MPL-2.0
#include "contact/surface_crossing.h"

#include <array>

#include "contact/box_pairs.h"
#include "geometry/bounds.h"

namespace npfem::flow {
namespace {

/// Twice the area of the triangle abc times the height of d over it.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(cross(subtract(b, a), subtract(c, a)), subtract(d, a));
}

bool triangles_cross(const Corners& a, const Corners& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (segment_crosses(a[i], a[(i + 1) % 3], b) || segment_crosses(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

/// A triangle and the box around it.
struct Piece {
  Corners corner;
  Bounds box;
};

/// The triangles of a cell, moved, that come within the box.
std::vector<Piece> pieces_within(const Bounds& box, std::span<const std::int32_t> triangles, const CellSurface& cell,
                                 const Vec3& shift) {
  std::vector<Piece> pieces;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    Piece piece;
    for (std::size_t c = 0; c < 3; ++c) {
      const double* const x = cell.positions.data() + 3 * triangles[t + c];
      piece.corner[c] = add({x[0], x[1], x[2]}, shift);
      piece.box.include(piece.corner[c]);
    }
    if (piece.box.is_near(box, 0)) pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

bool segment_crosses(const Vec3& p, const Vec3& q, const Corners& t) {
  const double above = volume(t[0], t[1], t[2], p), below = volume(t[0], t[1], t[2], q);
  if ((above > 0) == (below > 0)) return false;
  const bool first = volume(p, q, t[0], t[1]) > 0;
  return first == (volume(p, q, t[1], t[2]) > 0) && first == (volume(p, q, t[2], t[0]) > 0);
}

/// Of two cells of different ranks, the rank of the first, by id, counts.
std::int64_t count_crossings(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                             std::span<const CellSurface> own) {
  const Surroundings around = surroundings(domain, types, communicator, own, 0);
  const std::vector<CellSurface>& cells = around.cells;
  std::vector<Bounds> boxes;
  for (const CellSurface& cell : cells) boxes.push_back(bounds_of(cell));
  std::vector<BoxPair> pairs;
  BoxPairs(domain).find(boxes, 0, pairs);
  std::erase_if(pairs, [&](const BoxPair& pair) { return !around.is_own[static_cast<std::size_t>(pair.first)]; });
  std::int64_t crossings = 0;
  const Vec3 size = domain.size();
  const auto count = static_cast<std::int64_t>(pairs.size());
#pragma omp parallel for schedule(dynamic, 16) reduction(+ : crossings)
  for (std::int64_t n = 0; n < count; ++n) {
    const BoxPair& pair = pairs[static_cast<std::size_t>(n)];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    const Vec3 shift{pair.image[0] * size[0], pair.image[1] * size[1], pair.image[2] * size[2]};
    const auto triangles_of = [&](std::size_t cell) -> const std::vector<std::int32_t>& {
      return types[static_cast<std::size_t>(cells[cell].type)].triangles;
    };
    const std::vector<Piece> mine = pieces_within(boxes[b].moved(shift), triangles_of(a), cells[a], {});
    Bounds near;
    for (const Piece& piece : mine) near.include(piece.box);
    for (const Piece& other : pieces_within(near, triangles_of(b), cells[b], shift)) {
      for (const Piece& piece : mine) {
        if (piece.box.is_near(other.box, 0) && triangles_cross(piece.corner, other.corner)) ++crossings;
      }
    }
  }
  communicator.sum(std::span(&crossings, 1));
  return crossings;
}

}  // namespace npfem::flow
