// SPDX-License-Identifier: MPL-2.0
// What the viscosity of the membrane does to a whole cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "error.h"
#include "released_cell.h"

namespace npfem {
namespace {

/// By back end.
class Dissipation : public ::testing::TestWithParam<const char*> {
 protected:
  const char* back_end = GetParam();
};
INSTANTIATE_TEST_SUITE_P(BackEnds, Dissipation, ::testing::Values("reference", "cpu"));

TEST_P(Dissipation, ALineageStepRefusesAViscosityThatItWouldIgnore) {
  Material material = Material::preset("palabos-rbc");
  material.set("membrane_dilatational_viscosity", 1);
  Batch batch(testing::red_cell(material), back_end, 1);
  batch.options().lineage = true;
  try {
    batch.step(1);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::wrong_order);
    EXPECT_NE(std::string(e.what()).find("membrane_shear_viscosity"), std::string::npos) << e.what();
  }
}

TEST_P(Dissipation, TheFluidReceivesTheViscousForceToo) {
  // Without own mass F is the whole membrane force. What it has beyond the elastic force opposes the motion.
  Material material = Material::preset("rbc");
  material.set("membrane_shear_viscosity", 1e5);
  Batch batch(testing::red_cell(material), back_end, 1);
  batch.relax();
  batch.options().tolerance = 1e-9;
  batch.write(Field::ambient_mass, 0, 1, testing::fluid_mass(batch.model()));
  const auto flow = testing::shear(testing::get(batch, Field::position), 1e-3);
  batch.write(Field::ambient_velocity, 0, 1, flow);
  ASSERT_EQ(batch.step(2), 0);
  batch.evaluate();
  auto viscous = testing::get(batch, Field::held_force);
  const auto elastic = testing::get(batch, Field::elastic_force), v = testing::get(batch, Field::velocity);
  double power = 0, rest = 0, size = 0;
  for (std::size_t i = 0; i < viscous.size(); ++i) {
    viscous[i] -= elastic[i];
    power += viscous[i] * v[i];
    size += std::abs(viscous[i] * v[i]);
  }
  EXPECT_LT(power, -0.2 * size);
  for (const double sum : testing::total(viscous)) rest = std::max(rest, std::abs(sum));
  EXPECT_LT(rest, 1e-5);
  EXPECT_GT(*std::max_element(viscous.begin(), viscous.end()), 1);
}

TEST_P(Dissipation, ARealViscosityAtASmallStepIsSolved) {
  // eta_s/dt is here 10^5 times the shear modulus; without its share of the matrix, steps end at the cap of 200.
  for (const int integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    Material material = Material::preset("rbc");
    material.set("membrane_density", 5);
    material.set("membrane_shear_viscosity", 420000);
    Batch batch(testing::red_cell(material), back_end, 1);
    testing::stretch_and_release(batch, 45);
    batch.options().integrator = integrator;
    int iterations = 0;
    for (int s = 0; s < 50; ++s) {
      ASSERT_EQ(batch.step(1), 0);
      ASSERT_EQ(batch.report(0).status, CellStatus::converged) << s;
      iterations += batch.report(0).iterations;
    }
    std::printf("integrator %d: %.1f iterations a step\n", integrator, iterations / 50.0);
    // The back end cpu tries the Hessian of the rest shape first, which is no guide to a cell stretched this far.
    EXPECT_LT(iterations, 50 * (back_end == std::string("cpu") ? 120 : 100));
  }
}

/// Recovery of a stretched red cell (Hochmuth, Worthy & Evans 1979): the time t_c of their law
///   L/W = r (K + exp(-t/t_c))/(K - exp(-t/t_c)),   K = (L_0/W_0 + r)/(L_0/W_0 - r),   r the ratio at rest,
/// which makes ln[(L/W - r)/(L/W + r)] linear in time.
struct Recovery {
  double start_ratio, time;  // 1, us
  int iterations;            // of the hardest step
};

Recovery recover(const char* back_end, const Material& material, double dt, double duration) {
  Batch batch(testing::red_cell(material), back_end, 1);
  batch.relax();
  const auto ratio = [&] { return batch.measure("extent_x", 0) / batch.measure("extent_y", 0); };
  const double at_rest = ratio();
  testing::stretch_and_release(batch, 45);
  Recovery result{ratio(), 0, 0};
  batch.options().time_step = dt;
  // In 1 us the elastic force on a vertex falls by 3e-4 pN: a residual of the default tolerance would slow it down.
  batch.options().tolerance = 1e-6;
  double n = 0, t_sum = 0, u_sum = 0, tt = 0, tu = 0;
  const int steps = static_cast<int>(duration / dt), stride = static_cast<int>(duration / 50 / dt);
  for (int s = stride; s <= steps; s += stride) {
    EXPECT_EQ(batch.step(stride), 0);
    result.iterations = std::max(result.iterations, batch.report(0).iterations);
    const double t = s * dt, u = std::log((ratio() - at_rest) / (ratio() + at_rest));
    n += 1, t_sum += t, u_sum += u, tt += t * t, tu += t * u;
  }
  result.time = -(n * tt - t_sum * t_sum) / (n * tu - t_sum * u_sum);
  return result;
}

TEST_P(Dissipation, TheHochmuthTimeDoesNotDependOnTheStep) {
  // A real cell (0.42 uN s/m) takes 0.13 s, 130 000 steps of 1 us. Without inertia time enters as t/eta_s alone, so a
  // cell of 1/65 of that viscosity does the same in 2000 us; its membrane is light enough to leave inertia aside.
  Material material = Material::preset("rbc");
  material.set("membrane_density", 0.1);
  const double viscosity = 6500;
  material.set("membrane_shear_viscosity", viscosity);
  const double scale = viscosity / material.get("shear_modulus");
  const Recovery fine = recover(back_end, material, 1, scale), coarse = recover(back_end, material, 20, scale);
  for (const Recovery& r : {fine, coarse}) {
    std::printf("L/W = %.3f, t_c = %.1f us = %.3f eta_s/G_s, at most %d iterations\n", r.start_ratio, r.time,
                r.time / scale, r.iterations);
  }
  EXPECT_NEAR(fine.start_ratio, 1.9, 0.1);
  EXPECT_NEAR(coarse.time, fine.time, 0.05 * fine.time);
  EXPECT_NEAR(fine.time, scale, 0.3 * scale);
}

}  // namespace
}  // namespace npfem
