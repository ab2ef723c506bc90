// SPDX-License-Identifier: MPL-2.0
#include "model/build_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "backend/reference/elasticity.h"
#include "cells.h"
#include "error.h"
#include "mesh/geometry.h"
#include "model/model_parts.h"

namespace npfem {
namespace {

double energy_at_start(const Model& model, std::vector<double>& by_energy) {
  VertexField x(model.num_vertices(), 3), gradient = VertexField::Zero(model.num_vertices(), 3);
  for (int i = 0; i < model.num_vertices(); ++i) {
    for (int k = 0; k < 3; ++k) x(i, k) = model.initial[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  }
  by_energy.assign(model.energy_names().size(), 0.0);
  return elastic_energy(model, x, gradient, by_energy);
}

TEST(BuildModel, LeavesOutEnergiesOfZeroWeight) {
  Material material;
  material.set_text("membrane_law", "neo_hookean");
  material.set("shear_modulus", 4);
  const Model model = build_model(octahedral_sphere(1), material);
  EXPECT_EQ(model.energy_names(), std::vector<std::string>{"neo_hookean"});
  EXPECT_FALSE(model.has_cell_terms());
}

TEST(BuildModel, EachEnergyHasItsOwnReference) {
  // In-plane the red cell is stress-free as a spheroid; angles, area and volume belong to the biconcave shape.
  const auto model = testing::red_cell_model(3);
  std::vector<double> energies;
  energy_at_start(*model, energies);
  const auto names = model->energy_names();
  ASSERT_EQ(names, (std::vector<std::string>{"skalak", "dihedral_bending", "global_area", "global_volume"}));
  EXPECT_GT(energies[0], 0.1);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(energies[i], 0, 1e-12) << names[i];
}

TEST(BuildModel, WithoutPrestressTheMeshIsAtRest) {
  Material material = Material::preset("rbc");
  material.set("stress_free_reduced_volume", 0);
  std::vector<double> energies;
  EXPECT_NEAR(energy_at_start(build_model(evans_fung_cell(3), material), energies), 0, 1e-10);
}

TEST(BuildModel, AreasAndMassesAddUp) {
  Material material = Material::preset("rbc");
  material.set("membrane_density", 2);
  material.set("solid_density", 3);
  const TriangleMesh mesh = evans_fung_cell(2);
  const Model model = build_model(mesh, material);
  EXPECT_NEAR(std::accumulate(model.vertex_area.begin(), model.vertex_area.end(), 0.0), surface_area(mesh), 1e-10);
  EXPECT_NEAR(std::accumulate(model.solid_mass.begin(), model.solid_mass.end(), 0.0),
              2 * surface_area(mesh) + 3 * signed_volume(mesh), 1e-9);
}

TEST(BuildModel, WeightIsSymmetricPositiveAndBlindToTranslations) {
  const auto model = testing::red_cell_model(2);
  const Eigen::MatrixXd weight(model->weight);
  EXPECT_LT((weight - weight.transpose()).cwiseAbs().maxCoeff(), 1e-12 * weight.maxCoeff());
  EXPECT_LT(weight.rowwise().sum().cwiseAbs().maxCoeff(), 1e-10 * weight.maxCoeff());
  Eigen::VectorXd direction(model->num_vertices());
  for (int i = 0; i < model->num_vertices(); ++i) direction(i) = (i * 37 % 11) - 5;
  EXPECT_GT(direction.dot(weight * direction), 0);
}

TEST(BuildModel, RefusesAMaterialWithoutEnergy) {
  try {
    build_model(octahedral_sphere(1), Material());
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::bad_input);
    EXPECT_NE(std::string(e.what()).find("has no energy"), std::string::npos);
  }
}

TEST(BuildModel, RefusesALawWithoutModulus) {
  Material material;
  material.set_text("membrane_law", "skalak");
  EXPECT_THROW(build_model(octahedral_sphere(1), material), Error);
}

/// The text of the error with which `build` ends.
template <class F>
std::string refusal(F&& build) {
  try {
    build();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::bad_input);
    return e.what();
  }
  return "";
}

TEST(BuildModel, RefusesAWeightMatrixThatDoesNotFeelTheMembrane) {
  Material material = Material::preset("palabos-rbc");
  material.set("lineage_membrane_weight", 0);
  const std::string text = refusal([&] { build_model(evans_fung_cell(2), material); });
  EXPECT_NE(text.find("positive lineage_membrane_weight"), std::string::npos) << text;
}

TEST(BuildModel, RefusesAWeightThatIsNotFinite) {
  Model model;
  model.initial = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  model.triangles = {{0, 1, 2}};
  add_element<Membrane<Skalak>>(model, {0, 1, 2}, model.initial, {1, 1});  // on a line: no area, no metric
  const std::string text = refusal([&] { complete_model(model); });
  EXPECT_NE(text.find("energy skalak, element 0"), std::string::npos) << text;
}

}  // namespace
}  // namespace npfem
