// SPDX-License-Identifier: MPL-2.0
#pragma once

// Spherical capsules in a small fluid, for the tests of the coupled simulation. One node spacing, time step and density
// are 1 um, 1 us and 1 fg/um3 here, so every number is in lattice units too.

#include <memory>
#include <string>
#include <vector>

#include "npfem/npfem.hpp"
#include "simulation/setup.h"

namespace capsules {

using npfem::flow::CellStart;
using npfem::flow::CellType;
using npfem::flow::DomainKind;
using npfem::flow::Setup;
using npfem::flow::Vec3;

inline constexpr std::array<double, 9> kUpright{1, 0, 0, 0, 1, 0, 0, 0, 1};

/// Text of a material: `parameters` are lines of TOML for its section [parameters].
inline std::string material_text(const std::string& parameters) {
  return "schema_version = 1\nname = \"capsule\"\n[mesh]\n[parameters]\n" + parameters + "\n[sources]\n";
}

inline std::string neo_hookean(double shear_modulus) {
  return "membrane_law = \"neo_hookean\"\nshear_modulus = \"" + std::to_string(1e6 * shear_modulus) + "e-6 uN/m\"\n";
}

inline std::string skalak(double shear_modulus, double c) {
  return "membrane_law = \"skalak\"\nshear_modulus = \"" + std::to_string(1e6 * shear_modulus) +
         "e-6 uN/m\"\nskalak_C = " + std::to_string(c) + "\n";
}

/// A capsule whose rest shape is a sphere of `radius` (um). `mesh`: "sphere" or "icosphere".
inline CellType capsule(const std::string& mesh, int level, double radius, const std::string& parameters) {
  const auto surface = npfem::api::Mesh::generate(mesh, level, 2 * radius);
  const auto material = npfem::api::Material::parse(material_text(parameters));
  CellType type;
  type.name = "capsule";
  type.model = std::make_shared<const npfem::api::Model>(surface, material);
  type.shape = type.model->get("rest_position");
  type.triangles = type.model->triangles();
  type.options = {{"tolerance", 1e-12}, {"residual_bound", 1e-6}};
  return type;
}

/// The type with its shape blown up by a factor: cells that start under tension.
inline CellType inflated(CellType type, double factor) {
  for (double& x : type.shape) x *= factor;
  return type;
}

inline Setup fluid(DomainKind kind, const std::array<int, 3>& nodes, double tau) {
  Setup setup;
  setup.domain.kind = kind;
  setup.domain.nodes = nodes;
  setup.domain.dx = 1;
  setup.domain.tube_radius = 0.5 * nodes[0];
  setup.time_step = 1;
  setup.density = 1;
  setup.kinematic_viscosity = (tau - 0.5) / 3.0;
  return setup;
}

inline void place(Setup& setup, int type, const Vec3& centre) {
  setup.cells.push_back({type, centre, kUpright});
}

}  // namespace capsules
