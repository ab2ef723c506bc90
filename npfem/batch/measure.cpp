// SPDX-License-Identifier: MPL-2.0
#include "batch/measure.h"

#include <cmath>
#include <string>
#include <vector>

#include "error.h"
#include "mesh/geometry.h"
#include "nearest.h"
#include "quantity.h"

namespace npfem {

double measure_shape(const Model& model, std::string_view key, std::span<const double> position) {
  TriangleMesh mesh{{}, model.triangles};
  for (std::size_t i = 0; i + 2 < position.size(); i += 3) {
    mesh.positions.push_back({position[i], position[i + 1], position[i + 2]});
  }
  if (key == "volume") return signed_volume(mesh);
  if (key == "area") return surface_area(mesh);
  if (key.size() == 8 && (key.substr(0, 7) == "extent_" || key.substr(0, 7) == "centre_")) {
    const auto axis = static_cast<std::size_t>(key[7] - 'x');
    if (axis < 3) return key[0] == 'e' ? extents(mesh)[axis] : mean_position(mesh)[axis];
  }
  throw Error(
      Status::unknown_name,
      "no measure \"" + std::string(key) + "\"" +
          text::suggestion(key, {"volume", "area", "extent_x", "extent_y", "extent_z", "centre_x", "centre_y",
                                 "centre_z", "evaluations", "hessian_iterations", "flops", "energy", "energy:<name>"}));
}

double measure_energy(const Model& model, std::string_view key, std::span<const double> energies) {
  if (key == "energy") {
    double sum = 0;
    for (const double e : energies) sum += e;
    return sum;
  }
  std::vector<std::string> keys;
  const std::vector<std::string> names = model.energy_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    keys.push_back("energy:" + names[i]);
    if (key == keys.back()) return energies[i];
  }
  throw Error(Status::unknown_name, "no measure \"" + std::string(key) + "\"" + text::suggestion(key, keys));
}

void require_balanced(std::span<const double> force, int cell) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0, magnitude = 0;
    for (std::size_t i = axis; i < force.size(); i += 3) {
      sum += force[i];
      magnitude += std::abs(force[i]);
    }
    if (std::abs(sum) > 1e-9 * magnitude) {
      throw Error(Status::bad_input, "external forces of cell " + std::to_string(cell) + " add up to " +
                                         text::format_number(sum) + " pN along " + "xyz"[axis] +
                                         "; a static equilibrium needs forces that balance");
    }
  }
}

}  // namespace npfem
