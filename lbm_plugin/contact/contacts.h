// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "contact/closed_surface.h"
#include "contact/contact_vertices.h"
#include "contact/fixed_point.h"
#include "contact/triangle_grid.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// The forces that keep surfaces apart (or hold them together, where an attraction is asked for) below the distance
/// that the flow between them resolves: cell against cell and cell against wall. Purely normal, no friction.
///
/// A vertex p feels the nearest point q of every other surface near it, at the signed distance d, negative behind that
/// surface: the force area(p)/2 * traction(d) along the line p - q, away from the outside, and the corners of q's
/// triangle take the opposite force in the shares by which they make up q. Both surfaces' vertices do so with half the
/// weight each, so that two parallel sheets feel the traction of the law per area, whatever their meshes. A wall acts
/// on a vertex with its whole area. The cell's own images count as others; its own surface does not.
///
/// Beside its force a vertex gets a stiffness that bounds the second derivative of the potential from above, as a
/// diagonal: 2 area/2 slope(d) |w_i|, w = 1 for p and the shares for the corners.
///
/// Each contact is found by the one process that holds p, from positions alone; all sums are of whole numbers
/// (fixed_point.h). The loads are the same bits for any number of ranks and threads.
class Contacts {
 public:
  /// `window`: where the held vertices are. std::invalid_argument where a law is negative, infinite or too strong for
  /// the numbers that carry it.
  Contacts(const Setup& setup, const TriangleGrid::Window& window);

  bool active() const { return reach_ > 0 || wall_reach_ > 0; }
  /// Distance (um) beyond which no contact acts, walls apart; 0 where there is none.
  double reach() const { return reach_; }

  /// Adds the loads of all contacts of held vertices to `loads`, one per vertex, cleared before.
  void evaluate(const ContactVertices& vertices, std::span<ContactLoad> loads);

  /// Sum of the wall forces at the last evaluate(), pN: what has come from outside. Forces between cells cancel.
  Vec3 force_of_walls() const;

  /// Contacts between cells at the last evaluate(), and the least signed distance among them (um; the reach where there
  /// is none): negative where a vertex is behind another surface.
  struct Finding {
    std::int64_t contacts = 0;
    double least_distance = 0;
  };
  Finding finding() const { return finding_; }

 private:
  /// A cell that has known vertices.
  struct Cell {
    std::size_t type;
    std::size_t first_vertex, last_vertex;      ///< among the vertices
    std::size_t first_triangle, last_triangle;  ///< among the known triangles
    std::size_t first_place;                    ///< of its type's vertex 0 in place_
    double largest_ball;                        ///< um
    char near_wall;
  };
  /// Where the surface of one cell, in one image, comes nearest to a vertex.
  struct Nearest {
    std::int32_t cell;
    std::array<int, 3> image;  ///< periods by which the cell is moved
    std::int32_t triangle;
    std::array<double, 3> weight;
    Vec3 apart;  ///< from there to the vertex, um
    double square;
  };
  struct Hit {
    std::int32_t vertex;
    std::array<std::int32_t, 3> corner;
    std::array<double, 3> weight;
    Vec3 force;  ///< on the vertex, pN
    double stiffness;
    double distance;
  };
  /// What the search through a part of the grid needs and finds.
  struct Work {
    std::vector<Nearest> nearest;  ///< to one vertex, by cell and image
    std::vector<Hit> hits;
    bool has_unknown_corner = false;
  };

  const ContactLaw& law(std::size_t a, std::size_t b) const { return laws_[a * surfaces_.size() + b]; }
  void take_laws(const ContactSettings& settings);
  void require_sound(const ContactLaw& law, double area, const std::string& between) const;

  Vec3 position(std::int32_t vertex) const;
  Corners corners(std::int32_t triangle, const std::array<int, 3>& image) const;
  void list_triangles();
  void list_triangles_of(Cell& cell);
  void measure();
  void measure(Cell& cell);
  void sort_held();
  void search();
  void search_cube(std::size_t cube, Work& work) const;
  void search_vertex(std::size_t held, std::size_t cube, Work& work) const;
  void note(Nearest candidate, std::vector<Nearest>& nearest) const;
  void meet(std::int32_t vertex, const Nearest& nearest, Work& work) const;
  void apply(const Hit& hit, std::span<ContactLoad> loads);
  void push_from_walls(std::span<ContactLoad> loads);

  Domain domain_;
  Vec3 period_{};
  std::vector<ClosedSurface> surfaces_;  // by type
  std::vector<std::size_t> type_of_;     // by global id of the cell
  std::vector<ContactLaw> laws_;         // between two types
  std::vector<ContactLaw> wall_laws_;    // by type
  double reach_ = 0, wall_reach_ = 0;
  float slack_ = 0;  // um, of positions in single precision
  TriangleGrid grid_;

  const ContactVertices* vertices_ = nullptr;
  std::vector<VertexId> listed_;  // the vertices for which the following four are
  std::vector<Cell> cells_;
  std::vector<std::int32_t> cell_of_;                // by vertex
  std::vector<std::int32_t> place_;                  // by cell and vertex of its type: -1 where it is not known
  std::vector<std::array<std::int32_t, 3>> corner_;  // by known triangle
  std::vector<std::int32_t> triangle_in_type_;       // by known triangle
  std::vector<TriangleBall> balls_;                  // by known triangle
  std::vector<char> meets_itself_;                   // by cell: its own image may come within reach
  double largest_ball_ = 0;

  std::vector<TriangleGrid::Carried> carried_;  // by held vertex
  std::vector<std::size_t> held_begin_;         // by cube, into held_
  std::vector<std::int32_t> held_, held_cube_;
  std::vector<Work> work_;
  std::array<std::int64_t, 3> force_of_walls_{};
  Finding finding_;
};

}  // namespace npfem::flow
