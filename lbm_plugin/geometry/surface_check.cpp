// SPDX-License-Identifier: MPL-2.0
#include "geometry/surface_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

namespace npfem::flow {
namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;
using EdgeCounts = std::map<Edge, int>;  // of directed edges

std::string place(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) um", p[0], p[1], p[2]);
  return text;
}

std::string place(const TriangleSurface& surface, const Edge& edge) {
  return "the edge from " + place(surface.vertices[static_cast<std::size_t>(edge.first)]) + " to " +
         place(surface.vertices[static_cast<std::size_t>(edge.second)]);
}

Vec3 middle_of(const std::array<Vec3, 3>& t) {
  return scale(1.0 / 3.0, add(t[0], add(t[1], t[2])));
}

EdgeCounts edges_of(const TriangleSurface& surface) {
  EdgeCounts edges;
  for (const auto& t : surface.triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
  }
  return edges;
}

bool on_face(const Vec3& p, const SurroundingBox& box, std::size_t face) {
  const std::size_t axis = face / 2;
  return std::abs(p[axis] - (face % 2 == 0 ? 0.0 : box.size[axis])) <= box.tolerance;
}

/// The open face that both ends of the edge lie on.
std::optional<std::size_t> open_face_of(const TriangleSurface& surface, const Edge& edge, const SurroundingBox& box) {
  for (std::size_t face = 0; face < 6; ++face) {
    if (box.open[face] && on_face(surface.vertices[static_cast<std::size_t>(edge.first)], box, face) &&
        on_face(surface.vertices[static_cast<std::size_t>(edge.second)], box, face)) {
      return face;
    }
  }
  return std::nullopt;
}

std::string fault_of_vertices(const TriangleSurface& surface, const SurroundingBox& box) {
  for (const Vec3& p : surface.vertices) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (p[a] < -box.tolerance || p[a] > box.size[a] + box.tolerance) {
        return "reaches out of the box at " + place(p) + "; the box goes from (0, 0, 0) to " + place(box.size);
      }
    }
  }
  return "";
}

std::string fault_of_edges(const TriangleSurface& surface, const SurroundingBox& box) {
  const EdgeCounts edges = edges_of(surface);
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    const int back = opposite == edges.end() ? 0 : opposite->second;
    if (count + back > 2) {
      return "has more than two triangles at " + place(surface, edge);
    }
    if (count == 2) return "has two triangles of opposite orientation at " + place(surface, edge) + "; one is inverted";
    if (back == 0 && !open_face_of(surface, edge, box)) return "has a hole at " + place(surface, edge);
  }
  return "";
}

/// Does the segment from p to q pass through the triangle? Touching counts; `slack` is in shares of segment and
/// triangle and narrows both for triangles that share a vertex.
bool pierces(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t, double slack) {
  const Vec3 along = subtract(q, p);
  const Vec3 u = subtract(t[1], t[0]), v = subtract(t[2], t[0]);
  const Vec3 h = cross(along, v);
  const double det = dot(u, h);
  if (std::abs(det) <= 1e-12 * norm(along) * norm(cross(u, v))) return false;  // runs along the plane of the triangle
  const Vec3 from = subtract(p, t[0]);
  const double b1 = dot(from, h) / det;
  const Vec3 w = cross(from, u);
  const double b2 = dot(along, w) / det;
  const double s = dot(v, w) / det;
  return b1 >= slack && b2 >= slack && b1 + b2 <= 1 - slack && s >= slack && s <= 1 - slack;
}

bool cut_each_other(const TriangleSurface& surface, std::size_t a, std::size_t b) {
  const auto& ta = surface.triangles[a];
  const auto& tb = surface.triangles[b];
  const auto has = [](const std::array<std::int32_t, 3>& t, std::int32_t id) {
    return std::find(t.begin(), t.end(), id) != t.end();
  };
  int shared = 0;
  for (const std::int32_t id : ta) shared += has(tb, id) ? 1 : 0;
  const std::array<Vec3, 3> pa = surface.corners(a), pb = surface.corners(b);
  if (shared == 2) {  // folded back onto its neighbour?
    const Vec3 na = cross(subtract(pa[1], pa[0]), subtract(pa[2], pa[0]));
    const Vec3 nb = cross(subtract(pb[1], pb[0]), subtract(pb[2], pb[0]));
    return dot(na, nb) < -(1 - 1e-9) * norm(na) * norm(nb);
  }
  if (shared == 3) return true;
  const double slack = shared == 0 ? 0.0 : 1e-9;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3;
    // an edge that ends in a shared vertex touches there
    if (!(has(tb, ta[c]) || has(tb, ta[d])) && pierces(pa[c], pa[d], pb, slack)) return true;
    if (!(has(ta, tb[c]) || has(ta, tb[d])) && pierces(pb[c], pb[d], pa, slack)) return true;
  }
  return false;
}

/// Triangles by the bins of a uniform grid that their bounding boxes touch.
class TriangleBins {
 public:
  explicit TriangleBins(const TriangleSurface& surface) {
    double edge = 0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto p = surface.corners(t);
      for (std::size_t c = 0; c < 3; ++c) edge += norm(subtract(p[c], p[(c + 1) % 3]));
    }
    width_ = std::max(2 * edge / (3 * static_cast<double>(surface.triangles.size())), 1e-9);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto p = surface.corners(t);
      std::array<int, 3> low{}, high{};
      for (std::size_t a = 0; a < 3; ++a) {
        const auto [least, largest] = std::minmax({p[0][a], p[1][a], p[2][a]});
        low[a] = static_cast<int>(std::floor(least / width_));
        high[a] = static_cast<int>(std::floor(largest / width_));
      }
      for (int i = low[0]; i <= high[0]; ++i) {
        for (int j = low[1]; j <= high[1]; ++j) {
          for (int k = low[2]; k <= high[2]; ++k) bins_[{i, j, k}].push_back(t);
        }
      }
    }
  }
  const std::map<std::array<int, 3>, std::vector<std::size_t>>& bins() const { return bins_; }

 private:
  double width_;
  std::map<std::array<int, 3>, std::vector<std::size_t>> bins_;
};

std::string fault_of_crossings(const TriangleSurface& surface) {
  const TriangleBins grid(surface);
  for (const auto& [bin, triangles] : grid.bins()) {
    for (std::size_t m = 0; m < triangles.size(); ++m) {
      for (std::size_t n = 0; n < m; ++n) {
        if (cut_each_other(surface, triangles[m], triangles[n])) {
          return "cuts itself: the triangles around " + place(middle_of(surface.corners(triangles[n]))) + " and " +
                 place(middle_of(surface.corners(triangles[m]))) + " cross or touch";
        }
      }
    }
  }
  return "";
}

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
  return dot(a, cross(b, c));
}

}  // namespace

void drop_lids(TriangleSurface& surface, const SurroundingBox& box) {
  std::erase_if(surface.triangles, [&](const std::array<std::int32_t, 3>& t) {
    for (std::size_t face = 0; face < 6; ++face) {
      if (box.open[face] && std::all_of(t.begin(), t.end(), [&](std::int32_t id) {
            return on_face(surface.vertices[static_cast<std::size_t>(id)], box, face);
          })) {
        return true;
      }
    }
    return false;
  });
}

void turn_over(TriangleSurface& surface) {
  for (auto& t : surface.triangles) std::swap(t[1], t[2]);
}

std::string fault_of(const TriangleSurface& surface, const SurroundingBox& box) {
  std::string fault = fault_of_vertices(surface, box);
  if (fault.empty()) fault = fault_of_edges(surface, box);
  if (fault.empty()) fault = fault_of_crossings(surface);
  return fault;
}

double volume_inside(const TriangleSurface& surface, const SurroundingBox& box) {
  double six_volumes = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto p = surface.corners(t);
    six_volumes += determinant(p[0], p[1], p[2]);
  }
  // where it ends on an open face, a fan in that face closes it
  const EdgeCounts edges = edges_of(surface);
  for (const auto& [edge, count] : edges) {
    if (edges.contains({edge.second, edge.first})) continue;
    const std::optional<std::size_t> face = open_face_of(surface, edge, box);
    if (!face) continue;
    Vec3 apex = scale(0.5, box.size);
    apex[*face / 2] = *face % 2 == 0 ? 0.0 : box.size[*face / 2];
    six_volumes += determinant(surface.vertices[static_cast<std::size_t>(edge.second)],
                               surface.vertices[static_cast<std::size_t>(edge.first)], apex);
  }
  return six_volumes / 6;
}

}  // namespace npfem::flow
