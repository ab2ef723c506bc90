// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/precision_check.h"

#include <gtest/gtest.h>

#include "cpu_cells.h"
#include "error.h"

namespace npfem {
namespace {

using cpu::rounding_in_float;
using cpu::stiffest_force;
using testing::get;

/// The message with which a step is refused; "" where it is taken. A refused step changes nothing.
std::string refusal(Batch& batch) {
  const auto hash = batch.state_hash(0);
  try {
    batch.step(1);
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::bad_input);
    EXPECT_EQ(batch.state_hash(0), hash);
    return e.what();
  }
  return "";
}

std::shared_ptr<const Model> red_cell_with(const char* modulus, double value) {
  Material material = testing::material_of("rbc");
  material.set(modulus, value);
  return std::make_shared<const Model>(build_model(evans_fung_cell(2), material));
}

TEST(PrecisionCheck, IsTheStiffnessTimesTheSize) {
  // A volume energy (k/2)(V - V0)^2/V0 has the second derivative (k/V0) dV/dx dV/dx, and dV/dx . x = 3 V.
  Material material;
  material.set("global_volume_modulus", 7);
  const Model bag = build_model(icosahedral_sphere(2), material);
  Batch batch(std::make_shared<const Model>(bag), "reference", 1);
  auto x = get(batch, Field::position);
  for (double& c : x) c *= 1 + 1e-7;
  batch.write(Field::position, 0, 1, x);
  batch.evaluate();
  // At a small strain e the force is (k/V0) 3 V0 e dV/dx.
  const double steepest = testing::largest_magnitude(get(batch, Field::elastic_force)) / (7 * 3e-7);
  const auto force = stiffest_force(bag);
  EXPECT_NEAR(force.reach, 1, 1e-12);
  EXPECT_NEAR(force.force, 7 * 3 * steepest, 1e-5 * force.force);
}

TEST(PrecisionCheck, TheShippedCellsFitIntoFloat) {
  for (const std::string& name : Material::preset_names()) {
    const Material material = testing::material_of(name);
    const MeshRecipe& mesh = material.mesh();
    const double rounding =
        rounding_in_float(stiffest_force(build_model(generate_mesh(mesh.shape, mesh.level, mesh.diameter), material)));
    std::printf("%s: forces round off at %.2g pN in float\n", name.c_str(), rounding);
    EXPECT_LT(rounding, 0.5 * SolverOptions().residual_bound) << name;
  }
}

TEST(PrecisionCheck, StiffnessBeyondTheDigitsOfFloatIsRefused) {
  for (const char* modulus : {"shear_modulus", "local_area_modulus", "bending_modulus", "global_area_modulus",
                              "global_volume_modulus", "skalak_C"}) {
    const bool dimensionless = std::string(modulus) == "skalak_C";
    Batch batch(red_cell_with(modulus, dimensionless ? 1e6 : 1e8), "cpu", 1);
    for (const int lone : {0, 1}) {
      batch.options().lone_cells = lone;
      batch.options().precision = 2;
      const std::string text = refusal(batch);
      EXPECT_NE(text.find("option \"precision\" = 2 (float)"), std::string::npos) << modulus << ": " << text;
      EXPECT_NE(text.find("allowed is residual_bound = 1 pN"), std::string::npos) << text;
      EXPECT_NE(text.find("Set precision = 0 (double)"), std::string::npos) << text;
    }
  }
}

TEST(PrecisionCheck, TheBoundIsResidualBound) {
  const auto model = testing::cell_of("rbc");
  const double rounding = rounding_in_float(stiffest_force(*model));
  Batch batch(model, "cpu", 1);
  batch.options().precision = 2;
  batch.options().residual_bound = 1.001 * rounding;
  EXPECT_EQ(refusal(batch), "");
  batch.options().residual_bound = 0.999 * rounding;
  EXPECT_NE(refusal(batch), "");
  for (const int precision : {0, 1}) {
    batch.options().precision = precision;
    EXPECT_EQ(refusal(batch), "");
  }
  Batch reference(model, "reference", 1);
  reference.options().precision = 2;
  reference.options().residual_bound = 0.999 * rounding;
  EXPECT_EQ(refusal(reference), "") << "the back end \"reference\" knows double only";
}

TEST(PrecisionCheck, AMatrixOutsideTheRangeOfFloatIsRefused) {
  const auto model = testing::cell_of("rbc");
  const auto vertices = static_cast<std::size_t>(model->num_vertices());
  for (const int precision : {1, 2}) {
    Batch batch(model, "cpu", 2);
    batch.write(Field::ambient_mass, 1, 1, std::vector<double>(vertices, 1e38));
    batch.options().precision = precision;
    const std::string text = refusal(batch);
    EXPECT_NE(text.find(precision == 1 ? "\"precision\" = 1 (mixed)" : "\"precision\" = 2 (float)"), std::string::npos)
        << text;
    EXPECT_NE(text.find("does not fit into float"), std::string::npos) << text;
  }
  Batch in_double(model, "cpu", 1);
  in_double.write(Field::ambient_mass, 0, 1, std::vector<double>(vertices, 1e38));
  EXPECT_EQ(refusal(in_double), "");
}

}  // namespace
}  // namespace npfem
