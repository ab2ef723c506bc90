// SPDX-License-Identifier: MPL-2.0
#include "output/cell_arrays.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "output/principal_stretches.h"

namespace npfem::flow {
namespace {

constexpr std::uint8_t vtk_triangle = 5;

/// Where the vertices and triangles of each cell stand among those of all cells, in the order of ids. One that has left
/// has none.
struct Layout {
  std::vector<std::int64_t> first_vertex, first_triangle;  // one more than there are cells
};

Layout layout_of(const Setup& setup, std::span<const Departure> departures) {
  Layout layout{{0}, {0}};
  for (const CellStart& cell : setup.cells) {
    const CellType& type = setup.types[static_cast<std::size_t>(cell.type)];
    layout.first_vertex.push_back(std::ssize(type.shape) / 3);
    layout.first_triangle.push_back(std::ssize(type.triangles) / 3);
  }
  for (std::vector<std::int64_t>* const first : {&layout.first_vertex, &layout.first_triangle}) {
    for (const Departure& departure : departures) (*first)[static_cast<std::size_t>(departure.id) + 1] = 0;
    std::partial_sum(first->begin(), first->end(), first->begin());
  }
  if (3 * layout.first_triangle.back() > std::numeric_limits<std::int32_t>::max()) {
    throw std::runtime_error("too many triangles for one VTU file with 32-bit numbers");
  }
  return layout;
}

Vec3 whole_periods_into_box(const CellState& cell, const Domain& domain) {
  Vec3 shift{};
  const auto vertices = static_cast<double>(cell.position.size() / 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!domain.periodic()[axis]) continue;
    double mean = 0;
    for (std::size_t v = axis; v < cell.position.size(); v += 3) mean += cell.position[v] / vertices;
    shift[axis] = -std::floor(mean / domain.size()[axis]) * domain.size()[axis];
  }
  return shift;
}

std::vector<double> shifted(const std::vector<double>& xyz, const Vec3& shift) {
  std::vector<double> moved(xyz);
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] += shift[n % 3];
  return moved;
}

std::vector<float> to_float(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

std::vector<float> to_float(const std::vector<PrincipalStretches>& stretches, double PrincipalStretches::*which) {
  std::vector<float> values;
  for (const PrincipalStretches& stretch : stretches) values.push_back(static_cast<float>(stretch.*which));
  return values;
}

template <class T>
std::span<const T> view(const std::vector<T>& values) {
  return values;
}

}  // namespace

CellArrays cell_arrays(const Setup& setup, std::span<const Departure> departures,
                       std::span<const CellState> local_cells, bool into_box) {
  using Type = VtkFile::Type;
  const Layout layout = layout_of(setup, departures);
  CellArrays a;
  a.vertices = layout.first_vertex.back();
  a.triangles = layout.first_triangle.back();
  a.points = a.file.declare("points_um", Type::float64, 3, 3 * a.vertices);
  a.connectivity = a.file.declare("connectivity", Type::int32, 1, 3 * a.triangles);
  a.offsets = a.file.declare("offsets", Type::int32, 1, a.triangles);
  a.types = a.file.declare("types", Type::uint8, 1, a.triangles);
  a.velocity = a.file.declare("velocity_um_per_us", Type::float32, 3, 3 * a.vertices);
  a.force = a.file.declare("force_pN", Type::float32, 3, 3 * a.vertices);
  a.cell_id = a.file.declare("cell_id", Type::int32, 1, a.triangles);
  a.cell_type = a.file.declare("cell_type", Type::int32, 1, a.triangles);
  a.larger = a.file.declare("larger_stretch", Type::float32, 1, a.triangles);
  a.smaller = a.file.declare("smaller_stretch", Type::float32, 1, a.triangles);

  for (const CellState& cell : local_cells) {
    const auto id = static_cast<std::size_t>(cell.id);
    const std::int64_t vertex = layout.first_vertex[id];
    const std::int64_t triangle = layout.first_triangle[id];
    const CellType& type = setup.types[static_cast<std::size_t>(cell.type)];
    const auto stretches = principal_stretches(type.shape, cell.position, type.triangles);
    std::vector<std::int32_t> corners = type.triangles;
    for (std::int32_t& corner : corners) corner += static_cast<std::int32_t>(vertex);
    const std::size_t count = corners.size() / 3;
    std::vector<std::int32_t> ends(count);
    std::int32_t end = static_cast<std::int32_t>(3 * triangle);
    for (std::int32_t& corner_end : ends) corner_end = end += 3;

    const Vec3 shift = into_box ? whole_periods_into_box(cell, setup.domain) : Vec3{};
    a.file.put(a.points, 3 * vertex, view(shifted(cell.position, shift)));
    a.file.put(a.connectivity, 3 * triangle, view(corners));
    a.file.put(a.offsets, triangle, view(ends));
    a.file.put(a.types, triangle, view(std::vector<std::uint8_t>(count, vtk_triangle)));
    a.file.put(a.velocity, 3 * vertex, view(to_float(cell.velocity)));
    a.file.put(a.force, 3 * vertex, view(to_float(cell.force)));
    a.file.put(a.cell_id, triangle, view(std::vector<std::int32_t>(count, cell.id)));
    a.file.put(a.cell_type, triangle, view(std::vector<std::int32_t>(count, cell.type)));
    a.file.put(a.larger, triangle, view(to_float(stretches, &PrincipalStretches::larger)));
    a.file.put(a.smaller, triangle, view(to_float(stretches, &PrincipalStretches::smaller)));
  }

  return a;
}

}  // namespace npfem::flow
