// SPDX-License-Identifier: MPL-2.0
// Cells and loads on which the back end "cpu" is compared with "reference" and with itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "backend/cpu/dispatch.h"
#include "cells.h"
#include "random_shape.h"

namespace npfem::testing {

/// One way in which the back end "cpu" takes a step.
struct CpuSetting {
  std::string instruction_set;
  int precision;  ///< as the option: 0 double, 1 mixed, 2 float
  int lone;       ///< 1: elements of one cell in the lanes; 0: cells

  std::string back_end() const { return "cpu-" + instruction_set; }
  void apply(SolverOptions& options) const {
    options.precision = precision;
    options.lone_cells = lone;
  }
  std::string name() const {
    const char* const precisions[] = {"double", "mixed", "float"};
    return instruction_set + " " + precisions[precision] + (lone ? " lone cells" : " cells in lanes");
  }
  friend void PrintTo(const CpuSetting& setting, std::ostream* out) { *out << setting.name(); }
};

/// All of them that this machine runs.
inline std::vector<CpuSetting> cpu_settings() {
  std::vector<CpuSetting> settings;
  for (const std::string& set : cpu::instruction_sets()) {
    for (const int precision : {0, 1, 2}) {
      for (const int lone : {0, 1}) settings.push_back({set, precision, lone});
    }
  }
  return settings;
}

/// The material `name`: a preset, or the red cell with a law of that name in place of its own; each with a mass.
inline Material material_of(const std::string& name) {
  const std::vector<std::string> presets = Material::preset_names();
  const bool is_preset = std::find(presets.begin(), presets.end(), name) != presets.end();
  Material material = Material::preset(is_preset ? name : "rbc");
  if (material.get("solid_density") == 0) material.set("membrane_density", 5);
  if (name == "yeoh" || name == "wlc" || name == "neo_hookean") material.set_text("membrane_law", name);
  if (name == "yeoh") material.set("yeoh_c3", 0.4);
  if (name == "juelicher" || name == "cotangent") material.set_text("bending_law", name);
  if (name == "smooth local area") {
    material.set_text("local_area_form", "smooth");
    material.set("local_area_modulus", 100);
  }
  if (name == "viscous") {
    material.set("membrane_shear_viscosity", 200);
    material.set("membrane_dilatational_viscosity", 500);
  }
  return material;
}

inline const std::vector<std::string> materials{"rbc",         "palabos-rbc", "platelet",         "palabos-platelet",
                                                "yeoh",        "wlc",         "juelicher",        "cotangent",
                                                "neo_hookean", "viscous",     "smooth local area"};

/// A cell of 66 vertices in the shape that its material is made for.
inline std::shared_ptr<const Model> cell_of(const std::string& material_name) {
  const Material material = material_of(material_name);
  return std::make_shared<const Model>(
      build_model(generate_mesh(material.mesh().shape, 2, material.mesh().diameter), material));
}

/// A motion of the cell that stretches, shears and ruffles it, about 1 nm in a step of 0.25 us; each seed its own.
inline void set_in_motion(Batch& batch, int cell, unsigned seed, double speed = 0.005) {
  Random random(seed);
  const auto x = get(batch, Field::position, cell);
  double gradient[3][3];
  for (auto& row : gradient) {
    for (double& g : row) g = random(-0.5, 0.5);
  }
  std::vector<double> v(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    v[i] = random(-1, 1);
    for (std::size_t c = 0; c < 3; ++c) v[i] += gradient[i % 3][c] * x[i - i % 3 + c];
    v[i] *= speed;
  }
  batch.write(Field::velocity, cell, 1, v);
}

/// Loads at random that do not balance.
inline void load(Batch& batch, int cell, unsigned seed, double force) {
  Random random(seed);
  auto f = get(batch, Field::external_force, cell);
  for (double& component : f) component = random(-force, force);
  batch.write(Field::external_force, cell, 1, f);
}

/// A shear flow about the cell, with the mass of the fluid that moves with it.
inline void immerse(Batch& batch, int cell, double rate, double mass_scale = 1) {
  auto mass = fluid_mass(batch.model());
  for (double& m : mass) m *= mass_scale;
  batch.write(Field::ambient_mass, cell, 1, mass);
  batch.write(Field::ambient_velocity, cell, 1, shear(get(batch, Field::position, cell), rate));
}

/// Ties the vertices at either end of the cell together.
inline void tie_ends(Batch& batch, double stiffness) {
  const auto x = get(batch, Field::position);
  const double reach = *std::max_element(x.begin(), x.end());
  for (const double side : {-1.0, 1.0}) {
    std::vector<int> end;
    for (std::size_t i = 0; i < x.size(); i += 3) {
      if (side * x[i] > 0.6 * reach) end.push_back(static_cast<int>(i / 3));
    }
    batch.add_patch(end, stiffness);
  }
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

inline double largest_magnitude(const std::vector<double>& a) {
  return largest_difference(a, std::vector<double>(a.size(), 0.0));
}

}  // namespace npfem::testing
