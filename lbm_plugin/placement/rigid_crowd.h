// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "contact/box_pairs.h"
#include "geometry/bounds.h"
#include "placement/distance_table.h"
#include "placement/packing.h"
#include "placement/random.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// Points of a surface, and how much of it belongs to each.
struct SurfacePoints {
  std::vector<double> xyz;   // um, in the frame of the cell
  std::vector<double> area;  // um2
};

/// Rigid cells of full size, strewn at random through each other, that push each other apart: the first phase of
/// packing, in which overlaps are far too deep for membranes.
///
/// A vertex or middle of an edge nearer to another surface than `gap`, or inside it, is pushed along the gradient of
/// the signed distance to that surface (from a table), with a spring per area; walls push in the same way. The deeper
/// it is inside, the more it is pushed away from the middle of the other cell instead: cells that are skewered on each
/// other, and whose nearest ways out point to both sides, come apart that way. The cells then go down the slope of the
/// energy of all springs with inertia that is switched off whenever it leads uphill: FIRE (Bitzek et al., Phys. Rev.
/// Lett. 97 (2006) 170201), which finds its way through a crowd faster than steepest descent.
class RigidCrowd {
 public:
  /// `counts` cells of each type. Bits depend on the seed alone.
  RigidCrowd(const Domain& domain, std::span<const CellType> types, std::span<const int> counts, double gap,
             std::uint64_t seed);

  /// Puts the cells there instead.
  void start_from(std::vector<RigidCell> cells);

  /// Parts the centres as if each cell were a ball of its volume. Until then discs may be skewered like beads.
  void part_centres();

  /// One step of FIRE.
  void step();

  double energy() const { return energy_; }    ///< of the springs at the last step, um4
  double deepest() const { return deepest_; }  ///< overlap of a point with a cell or wall at the last step, um
  const std::vector<RigidCell>& cells() const { return cells_; }
  /// Volume (um3) of the cells that are left when, at the last step, the one with the most overlaps is taken out until
  /// there are none.
  double volume_without_overlap() const;
  /// xyz of the vertices of a cell, um.
  std::vector<double> positions(std::size_t cell) const;

 private:
  struct Shape {
    std::size_t vertices;  // the first of the points
    SurfacePoints points;
    DistanceTable distance;
    double whole_area, volume, radius, ball_radius, half_thickness;  // um2, um3, um
  };
  /// Force and torque on a cell; per unit of spring constant.
  struct Load {
    Vec3 force{}, torque{};
    void add(const Vec3& at, const Vec3& from_centre);
  };
  /// What one pair of cells does to each other.
  struct PairLoad {
    Load first, second;
    double energy = 0, deepest = 0;
  };

  void strew(std::span<const int> counts, std::uint64_t seed);
  std::vector<double> points_of_cell(std::size_t cell) const;
  void place_points();
  void find_loads();
  PairLoad load_of(const BoxPair& pair) const;
  void push(std::size_t a, std::size_t b, const Vec3& shift, Load& on_a, Load& on_b, PairLoad& sums) const;
  void push_from_wall(std::size_t cell);
  void move();
  const Shape& shape(std::size_t cell) const { return shapes_[static_cast<std::size_t>(cells_[cell].type)]; }

  Domain domain_;
  double gap_;
  std::vector<Shape> shapes_;
  std::vector<RigidCell> cells_;
  std::vector<std::vector<double>> xyz_;  // by cell, where its points are
  std::vector<Bounds> boxes_;
  BoxPairs box_pairs_;
  std::vector<BoxPair> pairs_;
  std::vector<PairLoad> pair_loads_;
  std::vector<Load> loads_;
  std::vector<Vec3> velocity_, spin_;
  double energy_ = 0, deepest_ = 0;
  double time_step_, mixing_;
  int downhill_ = 0;  // steps since the last uphill one
};

}  // namespace npfem::flow
