// SPDX-License-Identifier: MPL-2.0
#include "placement/soft_crowd.h"

#include <algorithm>
#include <cmath>

#include "contact/closed_surface.h"
#include "geometry/cell_shape.h"

namespace npfem::flow {
namespace {

constexpr double time_step = 1;  // us: without memory of velocity only the drag per square of it counts
constexpr double drag = 0.1;     // of a vertex, in units of the stiffness of its contact at touch

}  // namespace

SoftCrowd::SoftCrowd(const Setup& setup, std::span<const std::vector<double>> positions, int threads)
    : setup_(setup), contacts_(setup) {
  int cell = 0;
  for (std::size_t type = 0; type < setup.types.size(); ++type) {
    const CellType& its = setup.types[type];
    const ClosedSurface surface(its.shape, its.triangles);
    const int count = static_cast<int>(std::count_if(
        setup.cells.begin(), setup.cells.end(), [&](const CellStart& c) { return c.type == static_cast<int>(type); }));
    Kind kind{api::Batch(*its.model, "cpu", count), count, vertices_.id.size(), {}};
    kind.batch.set("time_step", time_step);
    kind.batch.set("threads", threads);
    for (const auto& [key, value] : its.options) kind.batch.set(key, value);
    double whole_area = 0;
    std::vector<double> mass;
    for (std::size_t v = 0; v < surface.vertices(); ++v) {
      const double stiffness = setup.contact.cells.slope(0) * surface.area(v);
      mass.push_back(drag * stiffness * time_step * time_step);
      whole_area += surface.area(v);
    }
    for (int n = 0; n < count; ++n, ++cell) {
      const std::vector<double>& xyz = positions[static_cast<std::size_t>(cell)];
      kind.batch.write("position", n, 1, xyz);
      kind.batch.write("ambient_mass", n, 1, mass);
      vertices_.position.insert(vertices_.position.end(), xyz.begin(), xyz.end());
      for (int v = 0; v < static_cast<int>(surface.vertices()); ++v) {
        vertices_.held.push_back(static_cast<int>(vertices_.id.size()));
        vertices_.id.push_back({cell, v});
      }
    }
    kind.still.assign(3 * surface.vertices() * static_cast<std::size_t>(count), 0.0);
    volumes_.push_back(enclosed_volume(its.shape, its.triangles));
    areas_.push_back(whole_area);
    kinds_.push_back(std::move(kind));
  }
  loads_.resize(vertices_.id.size());
  force_.resize(3 * loads_.size());
  stiffness_.resize(loads_.size());
}

std::span<double> SoftCrowd::part(std::vector<double>& values, std::size_t kind, std::size_t components) const {
  const std::size_t first = kinds_[kind].first_vertex;
  const std::size_t last = kind + 1 < kinds_.size() ? kinds_[kind + 1].first_vertex : loads_.size();
  return std::span(values).subspan(components * first, components * (last - first));
}

int SoftCrowd::step() {
  contacts_.evaluate(vertices_, loads_);
  least_distance_ = contacts_.finding().least_distance;
  for (std::size_t v = 0; v < loads_.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) force_[3 * v + axis] = force_of(loads_[v].force[axis]);
    stiffness_[v] = stiffness_of(loads_[v].stiffness);
  }
  int failed = 0;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    Kind& kind = kinds_[k];
    if (kind.count == 0) continue;
    kind.batch.write("external_force", 0, kind.count, part(force_, k, 3));
    kind.batch.write("contact_stiffness", 0, kind.count, part(stiffness_, k, 1));
    kind.batch.write("velocity", 0, kind.count, kind.still);
    kind.batch.write("held_force", 0, kind.count, kind.still);
    failed += kind.batch.step();
    kind.batch.read("position", 0, kind.count, part(vertices_.position, k, 3));
  }
  return failed;
}

double SoftCrowd::worst_error(const char* measure, std::span<const double> rest) const {
  double worst = 0;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    for (const double value : kinds_[k].batch.measure(measure)) {
      worst = std::max(worst, std::abs(value / rest[k] - 1));
    }
  }
  return worst;
}

double SoftCrowd::volume() const {
  double sum = 0;
  for (const Kind& kind : kinds_) {
    for (const double volume : kind.batch.measure("volume")) sum += volume;
  }
  return sum;
}

std::vector<CellSurface> SoftCrowd::surfaces() const {
  std::vector<CellSurface> cells;
  for (std::size_t v = 0; v < vertices_.id.size(); ++v) {
    const int cell = vertices_.id[v].cell;
    if (vertices_.id[v].vertex == 0) {
      cells.push_back({cell, setup_.cells[static_cast<std::size_t>(cell)].type, {}});
    }
    const double* const x = &vertices_.position[3 * v];
    cells.back().positions.insert(cells.back().positions.end(), x, x + 3);
  }
  return cells;
}

}  // namespace npfem::flow
