// SPDX-License-Identifier: MPL-2.0
#include "model/build_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
  ASSERT_EQ(names, (std::vector<std::string>{"skalak", "collapse_barrier", "dihedral_bending", "global_area",
                                             "global_volume"}));
  EXPECT_GT(energies[0], 0.1);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(energies[i], 0, 1e-12) << names[i];
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

TEST(BuildModel, EveryLawOfAMaterialIsBuiltAndAtRestInItsOwnShape) {
  const struct {
    const char *membrane, *bending, *area;
    std::vector<std::string> names;
  } cases[] = {{"yeoh", "none", "smooth", {"yeoh", "local_area"}},
               {"neo_hookean", "juelicher", "lineage", {"neo_hookean", "lineage_area", "juelicher_bending"}},
               {"wlc", "cotangent", "smooth", {"local_area", "wlc", "cotangent_bending"}}};
  for (const auto& c : cases) {
    Material material;
    material.set_text("membrane_law", c.membrane);
    material.set_text("bending_law", c.bending);
    material.set_text("local_area_form", c.area);
    for (const char* key : {"shear_modulus", "yeoh_c3", "bending_modulus", "local_area_modulus"}) material.set(key, 3);
    const Model model = build_model(evans_fung_cell(2), material);
    EXPECT_EQ(model.energy_names(), c.names);
    EXPECT_EQ(model.shear_modulus, 3);
    EXPECT_TRUE(model.is_translation_invariant());
    std::vector<double> energies;
    EXPECT_NEAR(energy_at_start(model, energies), 0, 1e-10) << c.membrane;
    const Eigen::MatrixXd weight(model.weight);
    EXPECT_LT(weight.rowwise().sum().cwiseAbs().maxCoeff(), 1e-10 * weight.maxCoeff());
  }
}

TEST(BuildModel, ForceOfAWholeCellIsTheSlopeOfItsEnergy) {
  // Rings share vertices: a wrong id in one of them would show here and in no test of a single group.
  Material material;
  material.set_text("membrane_law", "wlc");
  material.set_text("bending_law", "juelicher");
  material.set_text("rest_angles", "flat");
  material.set("shear_modulus", 5);
  material.set("bending_modulus", 0.3);
  material.set("spontaneous_curvature", -0.4);
  const Model model = build_model(evans_fung_cell(2), material);
  VertexField x(model.num_vertices(), 3), gradient = VertexField::Zero(model.num_vertices(), 3), unused = gradient;
  for (int i = 0; i < model.num_vertices(); ++i) {
    for (int k = 0; k < 3; ++k) {
      x(i, k) = model.initial[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] * (1 + 0.03 * k) + 0.01 * i * k;
    }
  }
  elastic_energy(model, x, gradient);
  const double h = 1e-5;
  for (int i = 0; i < model.num_vertices(); i += 7) {
    for (int k = 0; k < 3; ++k) {
      VertexField above = x, below = x;
      above(i, k) += h;
      below(i, k) -= h;
      const double slope = (elastic_energy(model, above, unused) - elastic_energy(model, below, unused)) / (2 * h);
      EXPECT_NEAR(slope, gradient(i, k), 1e-6 * gradient.cwiseAbs().maxCoeff());
    }
  }
}

std::string refusal(const TriangleMesh& mesh, const Material& material) {
  try {
    build_model(mesh, material);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(BuildModel, NamesTheParameterThatALawMisses) {
  Material material;
  material.set_text("membrane_law", "wlc");
  EXPECT_EQ(refusal(octahedral_sphere(1), material),
            "material \"unnamed\": membrane_law \"wlc\" needs a positive shear_modulus (uN/m), found 0");
  material.set_text("membrane_law", "lineage");
  material.set("lineage_lambda", 5);
  EXPECT_EQ(refusal(octahedral_sphere(1), material),
            "material \"unnamed\": membrane_law \"lineage\" needs a positive lineage_membrane_weight (uN/m), found 0");
}

TEST(BuildModel, RefusesASpontaneousCurvatureBesideThatOfTheShape) {
  Material material;
  material.set_text("bending_law", "juelicher");
  material.set("bending_modulus", 0.3);
  material.set("spontaneous_curvature", -0.5);
  EXPECT_EQ(refusal(octahedral_sphere(1), material),
            "material \"unnamed\": spontaneous_curvature = -0.5 1/um needs rest_angles \"flat\"; with \"shape\" the "
            "initial shape says what curvature is preferred");
}

TEST(BuildModel, RefusesAVertexWithTooManyNeighbours) {
  // A double cone: two tips joined by a ring of 40 vertices.
  TriangleMesh cone{{{0, 0, 1}, {0, 0, -1}}, {}};
  for (int i = 0; i < 40; ++i) {
    cone.positions.push_back({std::cos(M_PI * i / 20), std::sin(M_PI * i / 20), 0});
    const int here = i + 2, next = (i + 1) % 40 + 2;
    cone.triangles.push_back({0, here, next});
    cone.triangles.push_back({1, next, here});
  }
  Material material;
  material.set_text("bending_law", "cotangent");
  material.set("bending_modulus", 0.3);
  EXPECT_EQ(refusal(cone, material),
            "material \"unnamed\": bending_law \"cotangent\" allows at most 31 neighbours of a vertex; vertex 0 of the "
            "mesh has 40");
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
  for (const char* law : {"skalak", "neo_hookean", "yeoh", "wlc"}) {
    Material material;
    material.set_text("membrane_law", law);
    EXPECT_EQ(refusal(octahedral_sphere(1), material), "material \"unnamed\": membrane_law \"" + std::string(law) +
                                                           "\" needs a positive shear_modulus (uN/m), found 0");
  }
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
