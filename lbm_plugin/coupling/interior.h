// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "communicator/communicator.h"
#include "coupling/cell_population.h"
#include "geometry/inside_rows.h"
#include "lattice/lattice.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// Viscosity of the fluid inside cells over that outside, where it is not 1; 1 where no cell has another.
/// std::invalid_argument where two types have different ones: the lattice knows one fluid inside and one outside.
double interior_viscosity_ratio(const Setup& setup);

inline bool has_viscosity_contrast(const Setup& setup) {
  return !setup.cells.empty() && interior_viscosity_ratio(setup) != 1;
}

/// Tells the lattice which nodes lie inside cells with a viscosity of their own. The rank that owns a cell knows all
/// its vertices; it finds the rows of nodes inside and sends them to the ranks that hold them.
class Interior {
 public:
  Interior(const Setup& setup, Communicator& communicator, Lattice& lattice)
      : setup_(setup), communicator_(communicator), lattice_(lattice) {}

  /// By the present positions of the cells. Collective.
  void mark(const CellPopulation& cells);

 private:
  void share_out(const NodeRow& row);
  void mark(const NodeRow& row);

  const Setup& setup_;
  Communicator& communicator_;
  Lattice& lattice_;
  std::vector<std::vector<NodeRow>> rows_;  // by rank that holds them; in the grid
};

}  // namespace npfem::flow
