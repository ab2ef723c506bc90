/* SPDX-License-Identifier: MPL-2.0 */
/*
 * A red cell in somebody else's fluid, through npfem.h alone.
 *
 * The fluid here is a toy: a given shear flow, in which each vertex drags what is around it along as a small sphere
 * would, u = u_shear + F / zeta (Stokes). A real solver takes its place by doing the same two things in each step: say
 * how fast the fluid moves at the vertices, and take the forces that the vertices exert on it.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "npfem/npfem.h"

static const double shear_rate = 1e-3;         /* 1/us: 1000 1/s */
static const double viscosity = 1200.0;        /* fg/(um us): 1.2 mPa s */
static const double density = 1025.0;          /* fg/um3 */
static const double time_step = 0.5;           /* us */
static const double layer = 1.0;               /* um: thickness of the fluid that moves with the membrane */
static const double pi = 3.14159265358979323846;

/* Passes a result through; ends the program with the library's own words when it is an error. */
static int32_t check(int32_t result) {
  if (result < 0) {
    char message[512];
    npfem_last_error(message, sizeof message);
    fprintf(stderr, "%s\n", message);
    exit(1);
  }
  return result;
}

static double measure(int32_t batch, const char* key) {
  double value = 0;
  check(npfem_batch_measure(batch, key, 0, 1, &value, 1));
  return value;
}

static double* allocate(int32_t count) {
  double* values = calloc((size_t)count, sizeof(double));
  if (!values) exit(1);
  return values;
}

/* The toy fluid: its velocity at the vertices, given the forces that they exert on it. */
static void fluid_velocity(int32_t vertices, const double* position, const double* force, const double* area,
                           double* velocity) {
  for (int32_t v = 0; v < vertices; ++v) {
    const double drag = 6 * pi * viscosity * sqrt(area[v] / (4 * pi));
    for (int axis = 0; axis < 3; ++axis) velocity[3 * v + axis] = force[3 * v + axis] / drag;
    velocity[3 * v] += shear_rate * position[3 * v + 1];
  }
}

int main(void) {
  const int32_t material = check(npfem_material_preset("rbc"));
  const int32_t mesh = check(npfem_material_mesh(material, 3));
  const int32_t model = check(npfem_model_create(mesh, material));
  const int32_t cell = check(npfem_batch_create(model, "cpu", 1));
  const int32_t n = check(npfem_model_vertex_count(model));

  double* position = allocate(3 * n);
  double* velocity = allocate(3 * n);
  double* force = allocate(3 * n);
  double* area = allocate(n);
  double* mass = allocate(n);

  /* the cell at rest, its axis tilted from z towards y, across the flow */
  check(npfem_batch_relax(cell));
  check(npfem_batch_get(cell, "position", 0, 1, position, 3 * n));
  for (int32_t v = 0; v < n; ++v) {
    const double y = position[3 * v + 1];
    position[3 * v + 1] = 0.8 * y + 0.6 * position[3 * v + 2];
    position[3 * v + 2] = 0.8 * position[3 * v + 2] - 0.6 * y;
  }
  check(npfem_batch_set(cell, "position", 0, 1, position, 3 * n));

  /* each vertex carries the layer of fluid on its share of the surface */
  check(npfem_model_get(model, "rest_area", area, n));
  for (int32_t v = 0; v < n; ++v) mass[v] = density * area[v] * layer;
  check(npfem_batch_set(cell, "ambient_mass", 0, 1, mass, n));
  check(npfem_set_f64(cell, "time_step", time_step));

  const double volume = measure(cell, "volume");
  printf("%8s %10s %10s %10s %12s\n", "time/us", "x/um", "y/um", "z/um", "volume error");
  for (int step = 0; step <= 400; ++step) {
    if (step % 100 == 0) {
      printf("%8.1f %10.4f %10.4f %10.4f %12.2e\n", step * time_step, measure(cell, "extent_x"),
             measure(cell, "extent_y"), measure(cell, "extent_z"), measure(cell, "volume") / volume - 1);
    }
    check(npfem_batch_get(cell, "position", 0, 1, position, 3 * n));
    check(npfem_batch_get(cell, "held_force", 0, 1, force, 3 * n));
    fluid_velocity(n, position, force, area, velocity);
    check(npfem_batch_set(cell, "ambient_velocity", 0, 1, velocity, 3 * n));
    if (check(npfem_batch_step(cell, 1)) > 0) {
      char reason[256];
      npfem_batch_status_text(cell, 0, reason, sizeof reason);
      fprintf(stderr, "the cell failed: %s\n", reason);
      return 1;
    }
  }
  const double error = fabs(measure(cell, "volume") / volume - 1);

  free(position);
  free(velocity);
  free(force);
  free(area);
  free(mass);
  npfem_release(cell);
  npfem_release(model);
  npfem_release(mesh);
  npfem_release(material);
  return error < 0.02 ? 0 : 1;
}
