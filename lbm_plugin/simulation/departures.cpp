// SPDX-License-Identifier: MPL-2.0
#include "simulation/departures.h"

#include <algorithm>
#include <cstring>

#include "coupling/cell_population.h"
#include "geometry/cell_shape.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

/// Of the vertex nearest to the face, um; negative beyond it.
double distance_from(const Domain& domain, Face face, std::span<const double> positions) {
  const std::size_t axis = axis_of(face);
  double nearest = domain.size()[axis];
  for (std::size_t i = axis; i < positions.size(); i += 3) {
    nearest = std::min(nearest, is_high(face) ? domain.size()[axis] - positions[i] : positions[i]);
  }
  return nearest;
}

std::vector<Departure> gathered(std::span<const Departure> own, Communicator& communicator) {
  std::vector<Departure> all;
  for (const Bytes& bytes : communicator.all_gather(std::as_bytes(own))) {
    const std::size_t begin = all.size();
    all.resize(begin + bytes.size() / sizeof(Departure));
    if (!bytes.empty()) std::memcpy(all.data() + begin, bytes.data(), bytes.size());
  }
  std::sort(all.begin(), all.end(), [](const Departure& a, const Departure& b) { return a.id < b.id; });
  return all;
}

}  // namespace

std::optional<Face> opening_reached(const Domain& domain, std::span<const double> positions) {
  std::optional<Face> reached;
  double least = domain.cells_leave_before_opening();
  for (const Opening& opening : domain.openings) {
    const double distance = distance_from(domain, opening.face, positions);
    if (!(distance < least)) continue;
    least = distance;
    reached = opening.face;
  }
  return reached;
}

std::string starts_in_an_opening(const Setup& setup) {
  if (setup.domain.openings.empty()) return "";
  for (std::size_t id = 0; id < setup.cells.size(); ++id) {
    const CellType& type = setup.types[static_cast<std::size_t>(setup.cells[id].type)];
    const std::optional<Face> face = opening_reached(setup.domain, start_positions(setup.cells[id], type));
    if (!face) continue;
    return "setup: cell " + std::to_string(id) + " (" + type.name + ") starts nearer to the opening " + name_of(*face) +
           " than " + text::format_number(setup.domain.cells_leave_before_opening()) +
           " um, where it would leave at once; move it away from there";
  }
  return "";
}

bool Departures::let_go(const Setup& setup, std::int64_t step, CellPopulation& cells, Communicator& communicator) {
  if (setup.domain.openings.empty()) return false;
  std::vector<Departure> leaving;
  std::vector<double> positions;
  cells.read("position", positions);
  for (const CellPopulation::Cell& cell : cells.cells()) {
    const auto own = std::span(positions).subspan(3 * cell.first_vertex, 3 * cells.vertices_of(cell.type));
    const std::optional<Face> face = opening_reached(setup.domain, own);
    if (!face) continue;
    const std::vector<std::int32_t>& triangles = setup.types[static_cast<std::size_t>(cell.type)].triangles;
    leaving.push_back(
        {cell.id, cell.type, step, *face, shape_of(own, triangles).centre, enclosed_volume(own, triangles)});
  }
  if (!communicator.any(!leaving.empty())) return false;
  for (const Departure& departure : leaving) cells.remove(departure.type, departure.id);
  const std::vector<Departure> fresh = gathered(leaving, communicator);
  all_.insert(all_.end(), fresh.begin(), fresh.end());
  return true;
}

}  // namespace npfem::flow
