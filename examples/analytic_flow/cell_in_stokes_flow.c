/* SPDX-License-Identifier: MPL-2.0 */
/*
 * A red cell in a flow known by a formula, through npfem.h alone: shear u = (gamma y, 0, 0) plus the Stokes flow of the
 * forces that the vertices exert, each smeared over about eps (Cortez et al., Phys. Fluids 17 (2005) 031504):
 *   u(x) += [ f (r2 + 2 eps2) + (f . d) d ] / (8 pi mu (r2 + eps2)^(3/2)),   d = x - x_j, r2 = d . d
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "npfem/npfem.h"

static const double gamma_dot = 1e-3, viscosity = 1200, eps = 0.5; /* 1/us, fg/(um us), um */
static const double delta = 2, pi = 3.14159265358979323846;        /* us */
enum { vertices = 258, numbers = 3 * vertices };

static void fluid_velocity(const double* x, const double* force, double* u) {
  for (int i = 0; i < numbers; i += 3) {
    u[i] = gamma_dot * x[i + 1];
    u[i + 1] = u[i + 2] = 0;
    for (int j = 0; j < numbers; j += 3) {
      const double d[3] = {x[i] - x[j], x[i + 1] - x[j + 1], x[i + 2] - x[j + 2]};
      const double* const f = force + j;
      const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], s = r2 + eps * eps;
      const double factor = 1 / (8 * pi * viscosity * s * sqrt(s)), along = f[0] * d[0] + f[1] * d[1] + f[2] * d[2];
      for (int a = 0; a < 3; ++a) u[i + a] += factor * (f[a] * (s + eps * eps) + along * d[a]);
    }
  }
}

static int32_t check(int32_t result) { /* ends the program with the library's own words */
  char message[512];
  if (result >= 0) return result;
  npfem_last_error(message, sizeof message);
  fprintf(stderr, "%s\n", message);
  exit(1);
}

static double measure(int32_t cell, const char* key) {
  double value = 0;
  check(npfem_batch_measure(cell, key, 0, 1, &value, 1));
  return value;
}

int main(void) {
  static double start[numbers], x[numbers], u[numbers], force[numbers], mass[vertices];
  const int32_t material = check(npfem_material_preset("rbc")), mesh = check(npfem_material_mesh(material, 3));
  const int32_t model = check(npfem_model_create(mesh, material)), cell = check(npfem_batch_create(model, "cpu", 1));
  check(npfem_set_f64(cell, "time_step", delta));
  check(npfem_batch_relax(cell));
  check(npfem_batch_get(cell, "position", 0, 1, start, numbers));
  for (int i = 0; i < numbers; i += 3) { /* the axis from z to x: the disc stands across the flow */
    const double z = start[i + 2];
    start[i + 2] = -start[i];
    start[i] = z;
  }
  check(npfem_batch_set(cell, "position", 0, 1, start, numbers));
  /* a vertex moves at most at n / (6 pi mu a) per force when all are pulled: that is the inverse of m_f / delta */
  for (int v = 0; v < vertices; ++v) mass[v] = delta * 6 * pi * viscosity * 3 / vertices;
  check(npfem_batch_set(cell, "ambient_mass", 0, 1, mass, vertices));

  const double volume = measure(cell, "volume");
  double turned = 0;
  for (int step = 0; step <= 500; ++step) {
    check(npfem_batch_get(cell, "position", 0, 1, x, numbers));
    check(npfem_batch_get(cell, "held_force", 0, 1, force, numbers));
    if (step % 100 == 0) {
      double sine = 0, cosine = 0; /* of the angle about z that takes the start to x best */
      for (int i = 0; i < numbers; i += 3) sine += start[i] * x[i + 1] - start[i + 1] * x[i];
      for (int i = 0; i < numbers; i += 3) cosine += start[i] * x[i] + start[i + 1] * x[i + 1];
      turned = atan2(sine, cosine);
      printf("%4.0f us: extents %.3f %.3f %.3f um, turned by %.3f rad\n", step * delta, measure(cell, "extent_x"),
             measure(cell, "extent_y"), measure(cell, "extent_z"), turned);
    }
    fluid_velocity(x, force, u);
    check(npfem_batch_set(cell, "ambient_velocity", 0, 1, u, numbers));
    if (check(npfem_batch_step(cell, 1)) > 0) return 1; /* the cell failed: npfem_batch_status_text says why */
  }
  const double error = measure(cell, "volume") / volume - 1;
  printf("volume error %.1e\n", error);
  npfem_release(cell), npfem_release(model), npfem_release(mesh), npfem_release(material);
  return turned < -0.5 && turned > -1.2 && fabs(error) < 0.01 ? 0 : 1;
}
