// SPDX-License-Identifier: MPL-2.0
#include "geometry/surface_solid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace npfem::flow {
namespace {

constexpr double band_nodes = 3;

double angle_at(const Vec3& apex, const Vec3& p, const Vec3& q) {
  const Vec3 u = subtract(p, apex), v = subtract(q, apex);
  return std::atan2(norm(cross(u, v)), dot(u, v));
}

/// Normals of faces, edges and vertices whose side of the nearest point tells inside from outside: that of a vertex
/// weighs each face by its angle there (Baerentzen & Aanaes 2005).
class PseudoNormals {
 public:
  explicit PseudoNormals(const TriangleSurface& surface) : vertex_(surface.vertices.size(), Vec3{}) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto p = surface.corners(t);
      const Vec3 n = cross(subtract(p[1], p[0]), subtract(p[2], p[0]));
      const double area = norm(n);
      face_.push_back(area > 0 ? scale(1 / area, n) : Vec3{});
      const auto& ids = surface.triangles[t];
      for (std::size_t c = 0; c < 3; ++c) {
        Vec3& at_vertex = vertex_[static_cast<std::size_t>(ids[c])];
        at_vertex = add(at_vertex, scale(angle_at(p[c], p[(c + 1) % 3], p[(c + 2) % 3]), face_.back()));
        Vec3& at_edge = edge_[std::minmax(ids[c], ids[(c + 1) % 3])];
        at_edge = add(at_edge, face_.back());
      }
    }
  }
  const Vec3& face(std::size_t t) const { return face_[t]; }
  const Vec3& edge(std::int32_t a, std::int32_t b) const { return edge_.at(std::minmax(a, b)); }
  const Vec3& vertex(std::int32_t v) const { return vertex_[static_cast<std::size_t>(v)]; }

 private:
  std::vector<Vec3> face_, vertex_;
  std::map<std::pair<std::int32_t, std::int32_t>, Vec3> edge_;
};

/// The part of a triangle that is nearest to a point.
struct Nearest {
  Vec3 point;
  enum class On { face, edge, vertex } on;
  std::size_t corner;  // the vertex, or the first of the edge
};

/// By the regions of Voronoi of the triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Nearest nearest_on(const std::array<Vec3, 3>& t, const Vec3& p) {
  using On = Nearest::On;
  const Vec3 ab = subtract(t[1], t[0]), ac = subtract(t[2], t[0]);
  const Vec3 ap = subtract(p, t[0]), bp = subtract(p, t[1]), cp = subtract(p, t[2]);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {t[0], On::vertex, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {t[1], On::vertex, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {add(t[0], scale(d1 / (d1 - d3), ab)), On::edge, 0};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {t[2], On::vertex, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {add(t[0], scale(d2 / (d2 - d6), ac)), On::edge, 2};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {add(t[1], scale(w, subtract(t[2], t[1]))), On::edge, 1};
  }
  const double sum = va + vb + vc;
  return {add(t[0], add(scale(vb / sum, ab), scale(vc / sum, ac))), On::face, 0};
}

const Vec3& normal_at(const PseudoNormals& normals, const TriangleSurface& surface, std::size_t t, const Nearest& at) {
  const auto& ids = surface.triangles[t];
  if (at.on == Nearest::On::face) return normals.face(t);
  if (at.on == Nearest::On::vertex) return normals.vertex(ids[at.corner]);
  return normals.edge(ids[at.corner], ids[(at.corner + 1) % 3]);
}

}  // namespace

SurfaceSolid::SurfaceSolid(const TriangleSurface& surface, const Grid& grid, bool fluid_inside)
    : grid_(grid), band_(band_nodes * grid.dx) {
  for (std::size_t a = 0; a < 3; ++a) {
    centre_[a] = 0.5 * grid.nodes[a] * grid.dx;
    stride_[a] = static_cast<std::size_t>(grid.nodes[a]) + 2;
  }
  values_.assign(stride_[0] * stride_[1] * stride_[2], std::numeric_limits<float>::infinity());
  measure(surface);
  fill_far_nodes();
  if (fluid_inside) {
    for (float& value : values_) value = -value;
  }
  shared_ = std::make_shared<const std::vector<float>>(std::move(values_));
  values_ = {};
}

/// The nodes whose distance to a shifted triangle may be within the band.
SurfaceSolid::NodeRange SurfaceSolid::nodes_near(const std::array<Vec3, 3>& corners, const Vec3& shift) const {
  NodeRange range{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax({corners[0][a], corners[1][a], corners[2][a]});
    range.first[a] = std::max(-1, static_cast<int>(std::ceil((low + shift[a] - band_) / grid_.dx - 0.5)));
    range.last[a] = std::min(grid_.nodes[a], static_cast<int>(std::floor((high + shift[a] + band_) / grid_.dx - 0.5)));
  }
  return range;
}

/// Distances of the nodes in the band, negative inside of the surface and of its periodic images; the others keep
/// infinity.
void SurfaceSolid::measure(const TriangleSurface& surface) {
  const PseudoNormals normals(surface);
  for (int image = 0; image < 27; ++image) {
    const std::array<int, 3> periods{image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
    Vec3 shift{};
    bool exists = true;
    for (std::size_t a = 0; a < 3; ++a) {
      shift[a] = periods[a] * grid_.nodes[a] * grid_.dx;
      exists = exists && (periods[a] == 0 || grid_.periodic[a]);
    }
    for (std::size_t t = 0; exists && t < surface.triangles.size(); ++t) {
      const auto corners = surface.corners(t);
      const NodeRange range = nodes_near(corners, shift);
      for (int k = range.first[2]; k <= range.last[2]; ++k) {
        for (int j = range.first[1]; j <= range.last[1]; ++j) {
          for (int i = range.first[0]; i <= range.last[0]; ++i) {
            const Vec3 node = subtract(scale(grid_.dx, {i + 0.5, j + 0.5, k + 0.5}), shift);
            const Nearest nearest = nearest_on(corners, node);
            const Vec3 from_surface = subtract(node, nearest.point);
            const double distance = norm(from_surface);
            float& value = values_[index(i, j, k)];
            if (distance > band_ || distance >= static_cast<double>(std::abs(value))) continue;
            const bool outside = dot(from_surface, normal_at(normals, surface, t, nearest)) >= 0;
            value = static_cast<float>(outside ? distance : -distance);
          }
        }
      }
    }
  }
}

/// A node beyond the band lies on the same side as each node beside it: the surface is too far away to pass between.
void SurfaceSolid::fill_far_nodes() {
  const auto band = static_cast<float>(band_);
  const auto take_side = [&](float& value, float beside) {
    if (std::isinf(value) && !std::isinf(beside)) value = std::copysign(band, beside);
  };
  // from the first known node on to the end, then back from there to the beginning
  for (const int way : {-1, 1}) {
    for (int k = 0; k < static_cast<int>(stride_[2]); ++k) {
      for (int j = 0; j < static_cast<int>(stride_[1]); ++j) {
        for (int i = 0; i < static_cast<int>(stride_[0]); ++i) {
          const std::array<int, 3> last{static_cast<int>(stride_[0]) - 1, static_cast<int>(stride_[1]) - 1,
                                        static_cast<int>(stride_[2]) - 1};
          const std::array<int, 3> at =
              way < 0 ? std::array<int, 3>{i, j, k} : std::array<int, 3>{last[0] - i, last[1] - j, last[2] - k};
          float& value = values_[index(at[0] - 1, at[1] - 1, at[2] - 1)];
          for (std::size_t a = 0; a < 3; ++a) {
            std::array<int, 3> beside = at;
            beside[a] += way;
            if (beside[a] < 0 || beside[a] > last[a]) continue;
            take_side(value, values_[index(beside[0] - 1, beside[1] - 1, beside[2] - 1)]);
          }
        }
      }
    }
  }
}

WallDistance SurfaceSolid::distance(const Vec3& position) const {
  std::array<int, 3> cell{};
  Vec3 f{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double s = std::clamp(position[a] / grid_.dx - 0.5, -1.0, static_cast<double>(grid_.nodes[a]));
    cell[a] = std::min(static_cast<int>(std::floor(s)), grid_.nodes[a] - 1);
    f[a] = s - cell[a];
  }
  double value = 0;
  Vec3 gradient{};
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> c{corner & 1, corner >> 1 & 1, corner >> 2 & 1};
    const auto v = static_cast<double>((*shared_)[index(cell[0] + c[0], cell[1] + c[1], cell[2] + c[2])]);
    Vec3 w{};
    for (std::size_t a = 0; a < 3; ++a) w[a] = c[a] == 1 ? f[a] : 1 - f[a];
    value += v * w[0] * w[1] * w[2];
    for (std::size_t a = 0; a < 3; ++a) gradient[a] += v * (c[a] == 1 ? 1 : -1) * w[(a + 1) % 3] * w[(a + 2) % 3];
  }
  const double steepness = norm(gradient);
  // beyond the band every direction is as good as another
  return {value, steepness > 0 ? scale(1 / steepness, gradient) : Vec3{1, 0, 0}};
}

}  // namespace npfem::flow
