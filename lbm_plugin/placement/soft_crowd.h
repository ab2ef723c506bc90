// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "contact/contacts.h"
#include "contact/minimum_gap.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// Deformable cells that settle under their own elasticity and their contacts, without any fluid: the second phase of
/// packing. One step is a step of the cell solver with the drag of a fluid at rest and no memory of velocity: the
/// minimum of elastic energy, contacts and drag about the present positions.
class SoftCrowd {
 public:
  /// `setup`: domain, types and contacts. `positions`: xyz of every cell, in order of the types, of which there are
  /// setup.cells. `threads`: of the cell solver; 0: OMP_NUM_THREADS.
  SoftCrowd(const Setup& setup, std::span<const std::vector<double>> positions, int threads);

  /// Returns the number of cells that the solver could not move.
  int step();

  /// Least signed distance (um) from a vertex to another surface or a wall before the last step; where it is larger
  /// than the range of contacts, that.
  double least_distance() const { return least_distance_; }
  double worst_volume_error() const { return worst_error("volume", volumes_); }  ///< |V/V_rest - 1|
  double worst_area_error() const { return worst_error("area", areas_); }
  double volume() const;  ///< of all cells, um3
  std::vector<CellSurface> surfaces() const;

 private:
  struct Kind {
    api::Batch batch;
    int count;
    std::size_t first_vertex;
    std::vector<double> still;  // zeros: velocity and held force of all cells
  };
  std::span<double> part(std::vector<double>& values, std::size_t kind, std::size_t components) const;
  double worst_error(const char* measure, std::span<const double> rest) const;

  const Setup& setup_;
  Contacts contacts_;
  ContactVertices vertices_;
  std::vector<ContactLoad> loads_;
  std::vector<double> force_, stiffness_;
  std::vector<Kind> kinds_;
  std::vector<double> volumes_, areas_;  // by type, at rest
  double least_distance_ = 0;
};

}  // namespace npfem::flow
