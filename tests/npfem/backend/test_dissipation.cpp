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

TEST(Dissipation, ALineageStepRefusesAViscosityThatItWouldIgnore) {
  Material material = Material::preset("palabos-rbc");
  material.set("membrane_dilatational_viscosity", 1);
  Batch batch(testing::red_cell(material), "reference", 1);
  batch.options().lineage = true;
  try {
    batch.step(1);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Status::wrong_order);
    EXPECT_NE(std::string(e.what()).find("membrane_shear_viscosity"), std::string::npos) << e.what();
  }
}

/// Recovery of a stretched red cell (Hochmuth, Worthy & Evans 1979): the time t_c of their law
///   L/W = r (K + exp(-t/t_c))/(K - exp(-t/t_c)),   K = (L_0/W_0 + r)/(L_0/W_0 - r),   r the ratio at rest,
/// which makes ln[(L/W - r)/(L/W + r)] linear in time.
struct Recovery {
  double start_ratio, time;  // 1, us
  int iterations;            // of the hardest step
};

Recovery recover(const Material& material, double dt, double duration) {
  Batch batch(testing::red_cell(material), "reference", 1);
  batch.relax();
  const auto ratio = [&] { return batch.measure("extent_x", 0) / batch.measure("extent_y", 0); };
  const double at_rest = ratio();
  testing::stretch_and_release(batch, 45);
  Recovery result{ratio(), 0, 0};
  batch.options().time_step = dt;
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

TEST(Dissipation, TheHochmuthTimeDoesNotDependOnTheStep) {
  // A real cell (0.42 uN s/m) takes 0.13 s, 130 000 steps of 1 us. Without inertia time enters as t/eta_s alone, so a
  // cell of 1/65 of that viscosity does the same in 2000 us; its membrane is light enough to leave inertia aside.
  Material material = Material::preset("rbc");
  material.set("membrane_density", 0.1);
  const double viscosity = 6500;
  material.set("membrane_shear_viscosity", viscosity);
  const double scale = viscosity / material.get("shear_modulus");
  const Recovery fine = recover(material, 1, scale), coarse = recover(material, 20, scale);
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
