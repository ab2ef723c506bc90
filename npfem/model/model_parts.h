// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "mesh/triangle_mesh.h"
#include "model/model.h"

namespace npfem {

inline Vec3<double> as_vec3(const Point& p) {
  return {p[0], p[1], p[2]};
}

/// Adds one element whose rest shape is given by its vertices in `rest` (um).
template <class E>
void add_element(Model& model, const std::array<int, E::num_vertices>& vertices, const std::vector<Point>& rest,
                 const typename E::template Params<double>& params) {
  Vec3<double> x[E::num_vertices];
  for (int i = 0; i < E::num_vertices; ++i) {
    const auto k = static_cast<std::size_t>(i);
    x[i] = as_vec3(rest[static_cast<std::size_t>(vertices[k])]);
  }
  auto& block = model.block<E>();
  block.vertices.push_back(vertices);
  block.params.push_back(params);
  block.rest.push_back(E::rest(x, params));
}

/// Adds one group whose rest shape is given by its vertices in `rest` (um); at most G::max_vertices of them.
template <class G>
void add_group(Model& model, std::span<const int> vertices, const std::vector<Point>& rest,
               const typename G::template Params<double>& params) {
  Vec3<double> x[G::max_vertices];
  for (std::size_t i = 0; i < vertices.size(); ++i) x[i] = as_vec3(rest[static_cast<std::size_t>(vertices[i])]);
  auto& block = model.group_block<G>();
  block.vertices.insert(block.vertices.end(), vertices.begin(), vertices.end());
  block.offsets.push_back(static_cast<int>(block.vertices.size()));
  block.params.push_back(params);
  block.rest.push_back(G::rest(x, static_cast<int>(vertices.size()), params));
}

/// Fills what follows from shape and elements: vertex areas, rest area and volume, the weight matrix.
void complete_model(Model& model);

}  // namespace npfem
