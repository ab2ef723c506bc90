// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "coupling/cell_population.h"
#include "coupling/node_stress.h"
#include "geometry/vertex_patches.h"
#include "lattice/lattice.h"
#include "simulation/setup.h"
#include "units.h"

namespace npfem::flow {

/// The force of the fluid on a cell as Palabos-npFEM takes it (Kotsalos, Latt & Chopard, J. Comput. Phys. 398 (2019)
/// 108905): the stress at one node outside each vertex,
///   f = A [sigma_viscous n - (p - p0) n],   p0 = sum p A / sum A over the cell,
/// at that of the 4 x 4 x 4 fluid nodes around the vertex which lies farthest along the outward normal n. A vertex
/// crowded by another surface takes p = 0 and no viscous stress. Each component is then replaced by its median over the
/// vertex and those it shares an edge with (of an even number, the mean of the middle two).
///
/// The fluid inside the cell is not asked, nor is the force related to the one that the cell exerts on the fluid.
class OuterTraction {
 public:
  OuterTraction(const Setup& setup, const Units& units, Communicator& communicator, const Lattice& lattice);

  /// `positions`: xyz of the own vertices, um; `crowded`: one number each, not 0 where a foreign surface is too near.
  /// `force`: xyz per own vertex, pN. Collective.
  void sample(const CellPopulation& cells, std::span<const double> positions, std::span<const double> crowded,
              std::vector<double>& force);

 private:
  void find_patches(const CellPopulation& cells, std::span<const double> positions);
  Index3 outermost_node(const Vec3& position, const Vec3& normal) const;
  void load_cell(std::size_t first, std::size_t vertices, std::span<const NodeStress> stress,
                 std::span<const double> crowded);
  void take_medians(const std::vector<std::vector<std::size_t>>& around, std::size_t first,
                    std::vector<double>& force) const;

  const Setup& setup_;
  Units units_;
  Communicator& communicator_;
  const Lattice& lattice_;
  std::vector<std::vector<std::vector<std::size_t>>> around_;  // by type and vertex: itself and its neighbours
  std::vector<VertexPatch> patches_;                           // own vertices
  std::vector<double> raw_;                                    // own vertices, pN, before the median
};

}  // namespace npfem::flow
