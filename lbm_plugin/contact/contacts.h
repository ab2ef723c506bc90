// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "contact/box_pairs.h"
#include "contact/closed_surface.h"
#include "contact/contact_vertices.h"
#include "contact/fixed_point.h"
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
///
/// Who may touch whom is listed with a skin to spare (Verlet, Phys. Rev. 159 (1967) 98), by boxes around cells and
/// around blocks of their vertices and triangles, and listed anew when a vertex has moved by half the skin or others
/// are known. What is not listed cannot touch: the lists change no bit.
class Contacts {
 public:
  /// std::invalid_argument where a law is negative, infinite or too strong for the numbers that carry it.
  explicit Contacts(const Setup& setup);

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
    std::size_t first_vertex, last_vertex;     ///< among the vertices
    std::ptrdiff_t first_place;                ///< of its type's vertex 0 in place_; -1: all are known, in order
    std::size_t vertex_boxes, triangle_boxes;  ///< the first of its blocks'
    bool near_wall;
  };
  /// Between two parallel planes: all corners of a block of triangles.
  struct Slab {
    Vec3 normal;       ///< unit
    double low, high;  ///< of position . normal, um
  };
  /// Vertices of one cell before the surface of another, which is moved by `shift`: those that may come within reach
  /// before the lists are made anew.
  struct Meeting {
    std::size_t mine, other;
    Vec3 shift;
    std::size_t first_vertex, last_vertex;  ///< in Part::vertices
    std::size_t first_visit, last_visit;
  };
  /// The vertices of a meeting that may touch a block of the other cell's triangles.
  struct Visit {
    std::size_t block;
    std::size_t first, last;  ///< in Part::visitors
  };
  /// The nearest point of a surface to a vertex.
  struct Nearest {
    std::int32_t triangle = -1;  ///< of its type; -1: none is within reach
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
  /// A few neighbouring triangles of the other cell, side by side for the processor: their balls and planes.
  struct Patch {
    static constexpr std::size_t size = ClosedSurface::per_block;
    std::size_t count = 0;
    std::array<std::int32_t, size> triangle;
    std::array<Corners, size> corner;
    std::array<double, size> x, y, z;     ///< middle, um
    std::array<double, size> ball;        ///< square of a distance from there beyond which no point is within reach
    std::array<double, size> nx, ny, nz;  ///< normal, um2
    std::array<double, size> plane;       ///< the same for (distance from there along the normal) * |normal|
  };
  /// Vertices of one block that are near the other cell, and the box around them as the other cell sees it.
  struct Group {
    std::size_t first, last;
    Bounds box;
  };
  /// A share of the pairs of cells, for one thread at a time: its lists, and what it finds by them.
  struct Part {
    std::vector<Meeting> meetings;
    std::vector<Visit> visits;
    std::vector<std::int32_t> vertices;  ///< of the meetings
    std::vector<std::int32_t> visitors;  ///< numbers among the vertices of the meeting
    std::vector<std::size_t> blocks;     ///< while the lists are made
    std::vector<Group> groups;
    std::vector<Vec3> points;
    Patch patch;
    std::vector<Nearest> nearest;  ///< by vertex of the present meeting
    std::vector<Hit> hits;
    bool has_unknown_corner = false;
  };

  const ContactLaw& law(std::size_t a, std::size_t b) const { return laws_[a * surfaces_.size() + b]; }
  void take_laws(const ContactSettings& settings);
  void require_sound(const ContactLaw& law, double area, const std::string& between) const;
  Vec3 position(std::int32_t vertex) const {
    const double* const at = &vertices_->position[3 * static_cast<std::size_t>(vertex)];
    return {at[0], at[1], at[2]};
  }
  /// A vertex of the cell's type among the known vertices; -1 where it is not known.
  std::int32_t place(const Cell& cell, std::int32_t vertex) const {
    if (cell.first_place < 0) return static_cast<std::int32_t>(cell.first_vertex) + vertex;
    return place_[static_cast<std::size_t>(cell.first_place + vertex)];
  }

  // contact_lists.cpp
  bool lists_hold() const;
  void make_lists();
  void list_cells();
  void measure(std::size_t cell);
  Slab slab_around(const Cell& cell, std::size_t block) const;
  bool is_near(const Bounds& box, const Slab& slab) const;
  void list_meeting(std::size_t mine, std::size_t other, const Vec3& shift, Part& part) const;
  Bounds take_blocks(const Meeting& meeting, Part& part) const;
  Bounds take_vertices(const Meeting& meeting, const Bounds& near, Part& part) const;
  void list_visit(const Meeting& meeting, std::size_t block, Part& part) const;

  // contact_search.cpp
  void search();
  void meet(const Meeting& meeting, Part& part) const;
  void load(const Cell& cell, std::size_t block, Patch& patch) const;
  void come_nearer(const Vec3& point, const Patch& patch, Nearest& nearest) const;
  void press(const Meeting& meeting, std::int32_t vertex, const Nearest& nearest, Part& part) const;

  void apply(const Hit& hit, std::span<ContactLoad> loads);
  void push_from_walls(std::span<ContactLoad> loads);

  Domain domain_;
  Vec3 period_{};
  std::vector<ClosedSurface> surfaces_;  // by type
  std::vector<std::size_t> type_of_;     // by global id of the cell
  std::vector<ContactLaw> laws_;         // between two types
  std::vector<ContactLaw> wall_laws_;    // by type
  double reach_ = 0, wall_reach_ = 0;
  double skin_ = 0;  // um, that the lists reach further
  BoxPairs box_pairs_;

  const ContactVertices* vertices_ = nullptr;
  ContactVertices listed_;     // the vertices when the lists were made
  std::vector<char> is_held_;  // by vertex
  std::vector<Cell> cells_;
  std::vector<std::int32_t> place_;   // by cell and vertex of its type: -1 where it is not known
  std::vector<Bounds> cell_boxes_;    // by cell
  std::vector<Bounds> vertex_boxes_;  // by cell and block of vertices
  std::vector<Bounds> triangle_boxes_;
  std::vector<Slab> slabs_;  // as triangle_boxes_
  std::vector<BoxPair> pairs_;
  std::vector<Part> parts_;
  std::array<std::int64_t, 3> force_of_walls_{};
  Finding finding_;
};

}  // namespace npfem::flow
