// SPDX-License-Identifier: MPL-2.0
#include "coupling/interior.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace npfem::flow {

double interior_viscosity_ratio(const Setup& setup) {
  const CellType* contrast = nullptr;
  for (const CellType& type : setup.types) {
    if (type.interior_viscosity_ratio == 1) continue;
    if (contrast && contrast->interior_viscosity_ratio != type.interior_viscosity_ratio) {
      throw std::invalid_argument(
          "setup: cells \"" + contrast->name + "\" and \"" + type.name + "\" have interior viscosity ratios of " +
          std::to_string(contrast->interior_viscosity_ratio) + " and " + std::to_string(type.interior_viscosity_ratio) +
          "; all ratios other than 1 must be the same");
    }
    contrast = &type;
  }
  return contrast ? contrast->interior_viscosity_ratio : 1;
}

void Interior::mark(const CellPopulation& cells) {
  rows_.resize(static_cast<std::size_t>(communicator_.size()));
  for (std::vector<NodeRow>& rows : rows_) rows.clear();
  std::vector<double> positions;
  cells.read("position", positions);
  for (double& x : positions) x /= setup_.domain.dx;
  for (const CellPopulation::Cell& cell : cells.cells()) {
    const CellType& type = setup_.types[static_cast<std::size_t>(cell.type)];
    if (type.interior_viscosity_ratio == 1) continue;
    const auto own = std::span(positions).subspan(3 * cell.first_vertex, 3 * cells.vertices_of(cell.type));
    for (const NodeRow& row : rows_inside(own, type.triangles)) share_out(row);
  }
  std::vector<Outgoing> outgoing;
  for (std::size_t rank = 0; rank < rows_.size(); ++rank) {
    if (!rows_[rank].empty()) outgoing.push_back({static_cast<int>(rank), std::as_bytes(std::span(rows_[rank]))});
  }
  std::vector<Incoming> incoming;
  communicator_.exchange(outgoing, incoming);
  lattice_.clear_inside();
  for (const Incoming& message : incoming) {
    for (std::size_t at = 0; at < message.bytes.size(); at += sizeof(NodeRow)) {
      NodeRow row;
      std::memcpy(&row, message.bytes.data() + at, sizeof row);
      mark(row);
    }
  }
}

/// Cuts the row where it passes from rank to rank or around the grid; beyond walls there are no nodes.
void Interior::share_out(const NodeRow& row) {
  const Decomposition& grid = lattice_.decomposition();
  const int j = grid.wrap(1, row.j), k = grid.wrap(2, row.k);
  const Box whole{{0, 0, 0}, grid.nodes()};
  for (int i = row.begin; i < row.end;) {
    const int first = grid.wrap(0, i);
    if (!whole.contains(first, j, k)) {
      ++i;
      continue;
    }
    const int holder = grid.owner_of(first, j, k);
    const int count = std::min(row.end - i, grid.box(holder).end[0] - first);
    rows_[static_cast<std::size_t>(holder)].push_back({first, first + count, j, k});
    i += count;
  }
}

void Interior::mark(const NodeRow& row) {
  const Index3& first = lattice_.nodes().own().begin;
  for (int i = row.begin; i < row.end; ++i) lattice_.set_inside(i - first[0], row.j - first[1], row.k - first[2]);
}

}  // namespace npfem::flow
