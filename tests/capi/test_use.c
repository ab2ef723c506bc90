/* SPDX-License-Identifier: MPL-2.0 */
/* The library as a C host uses it: a red cell is relaxed, stretched, let go and stepped in time. */
#include "check.h"

enum { vertices = 66, coordinates = 3 * vertices };

static double measure(int32_t batch, const char* key) {
  double value = 0;
  OK(npfem_batch_measure(batch, key, 0, 1, &value, 1));
  return value;
}

static void check_library(void) {
  char text[256];
  HOLDS(npfem_abi_version() == 1);
  HOLDS(npfem_version(text, (int32_t)sizeof text) == (int32_t)strlen(text) && strlen(text) >= 5);
  OK(npfem_build_info(text, (int32_t)sizeof text));
  HOLDS(strstr(text, "\"reference\"") != NULL);
  OK(npfem_status_name(NPFEM_ERROR_HANDLE, text, (int32_t)sizeof text));
  HOLDS(strcmp(text, "NPFEM_ERROR_HANDLE") == 0);
  HOLDS(npfem_last_error(text, (int32_t)sizeof text) == 0 && text[0] == '\0');
}

static void check_mesh(int32_t mesh) {
  static double xyz[coordinates];
  static int32_t triangles[3 * 128];
  double area = 0, measured = 0;
  int32_t again;
  HOLDS(npfem_mesh_vertex_count(mesh) == vertices);
  HOLDS(npfem_mesh_triangle_count(mesh) == 128);
  OK(npfem_mesh_get_positions(mesh, xyz, coordinates));
  OK(npfem_mesh_get_triangles(mesh, triangles, 3 * 128));
  again = OK(npfem_mesh_create(xyz, coordinates, triangles, 3 * 128));
  OK(npfem_mesh_measure(mesh, "area", &area));
  OK(npfem_mesh_measure(again, "area", &measured));
  HOLDS(area == measured && area > 100 && area < 140);
  OK(npfem_mesh_measure(mesh, "extent_x", &measured));
  HOLDS(fabs(measured - 7.82) < 1e-12);
  OK(npfem_release(again));
}

static void check_parameters(int32_t handle) {
  int32_t i;
  const int32_t count = OK(npfem_param_count(handle));
  HOLDS(count > 10);
  for (i = 0; i < count; ++i) {
    char name[64], unit[64], doc[512], word[64];
    double least = 0, largest = 0, fallback = 0, value = 0;
    OK(npfem_param_name(handle, i, name, (int32_t)sizeof name));
    OK(npfem_param_unit(handle, i, unit, (int32_t)sizeof unit));
    HOLDS(npfem_param_doc(handle, i, doc, (int32_t)sizeof doc) > 10);
    if (npfem_param_kind(handle, i) == 0) {
      OK(npfem_param_range(handle, i, &least, &largest, &fallback));
      HOLDS(least <= fallback && fallback <= largest);
      OK(npfem_get_f64(handle, name, &value));
      HOLDS(least <= value && value <= largest);
      OK(npfem_set_f64(handle, name, value));
    } else {
      HOLDS(npfem_param_kind(handle, i) == 1);
      OK(npfem_get_text(handle, name, word, (int32_t)sizeof word));
      HOLDS(strstr(doc, word) != NULL);
      OK(npfem_set_text(handle, name, word));
    }
  }
}

static void check_material(int32_t material) {
  static char toml[8192];
  int32_t again;
  double value = 0;
  HOLDS(npfem_material_to_text(material, NULL, 0) > 100);
  HOLDS(npfem_material_to_text(material, toml, (int32_t)sizeof toml) == (int32_t)strlen(toml));
  again = OK(npfem_material_parse(toml));
  OK(npfem_set_f64(again, "shear_modulus", 7.5));
  OK(npfem_get_f64(again, "shear_modulus", &value));
  HOLDS(value == 7.5);
  OK(npfem_release(again));
}

static void check_model(int32_t model) {
  static double area[vertices], mass[vertices];
  double rest_area = 0, sum = 0;
  int32_t i;
  char name[64];
  OK(npfem_model_get(model, "rest_area", area, vertices));
  OK(npfem_model_get(model, "solid_mass", mass, vertices));
  OK(npfem_model_measure(model, "rest_area", &rest_area));
  for (i = 0; i < vertices; ++i) {
    sum += area[i];
    HOLDS(fabs(mass[i] - 10 * area[i]) < 1e-9);
  }
  HOLDS(fabs(sum - rest_area) < 1e-9);
  HOLDS(npfem_model_energy_count(model) == 5);
  OK(npfem_model_energy_name(model, 0, name, (int32_t)sizeof name));
  HOLDS(strlen(name) > 0);
}

/* Pulls the vertices of largest and smallest x with `force` pN each way. */
static void pull(int32_t batch, double force) {
  static double xyz[coordinates], load[coordinates];
  int i, left = 0, right = 0;
  OK(npfem_batch_get(batch, "position", 0, 1, xyz, coordinates));
  for (i = 0; i < vertices; ++i) {
    if (xyz[3 * i] < xyz[3 * left]) left = i;
    if (xyz[3 * i] > xyz[3 * right]) right = i;
  }
  memset(load, 0, sizeof load);
  load[3 * left] = -force;
  load[3 * right] = force;
  OK(npfem_batch_set(batch, "external_force", 0, 1, load, coordinates));
}

static void check_stretch(int32_t batch) {
  double free_length, free_width;
  int32_t status = -1, iterations = 0;
  double residual = 1;
  char text[256];
  HOLDS(npfem_batch_relax(batch) == 0);
  free_length = measure(batch, "extent_x");
  free_width = measure(batch, "extent_y");
  pull(batch, 20);
  HOLDS(npfem_batch_relax(batch) == 0);
  HOLDS(measure(batch, "extent_x") > 1.1 * free_length);
  HOLDS(measure(batch, "extent_y") < free_width);
  OK(npfem_batch_get_status(batch, 0, 1, &status, 1));
  OK(npfem_batch_get_iterations(batch, 0, 1, &iterations, 1));
  OK(npfem_batch_get_residual(batch, 0, 1, &residual, 1));
  HOLDS(status == NPFEM_CELL_CONVERGED && iterations > 0 && residual < 1e-4);
  HOLDS(npfem_batch_status_text(batch, 0, text, (int32_t)sizeof text) > 10);
  pull(batch, 0);
  HOLDS(npfem_batch_relax(batch) == 0);
  HOLDS(fabs(measure(batch, "extent_x") - free_length) < 1e-2);
}

static void check_patch(int32_t batch) {
  const int32_t ids[3] = {0, 1, 2};
  static double load[coordinates], before[coordinates], after[coordinates];
  int i, k;
  HOLDS(npfem_batch_add_patch(batch, ids, 3, 1e4) == 0);
  OK(npfem_batch_get(batch, "position", 0, 1, before, coordinates));
  memset(load, 0, sizeof load);
  load[0] = 30;
  load[3 * (vertices - 1)] = -30;
  OK(npfem_batch_set(batch, "external_force", 0, 1, load, coordinates));
  HOLDS(npfem_batch_relax(batch) == 0);
  OK(npfem_batch_get(batch, "position", 0, 1, after, coordinates));
  for (i = 1; i < 3; ++i) {
    for (k = 0; k < 3; ++k) HOLDS(fabs(after[3 * i + k] - before[3 * i + k] - after[k] + before[k]) < 1e-2);
  }
  OK(npfem_batch_clear_patches(batch));
}

static void check_steps(int32_t batch) {
  static double velocity[2 * coordinates], packed[8 * coordinates];
  static float narrow[coordinates];
  int64_t hash[2] = {0, 1};
  int32_t i, steps = 0;
  const int32_t length = OK(npfem_batch_pack_length(batch));
  HOLDS(npfem_batch_add(batch, 2) == 1 && npfem_batch_cell_count(batch) == 3);
  OK(npfem_batch_remove(batch, 0));
  HOLDS(npfem_batch_cell_count(batch) == 2);
  for (i = 0; i < 2 * coordinates; ++i) velocity[i] = i % 3 == 0 ? 0.01 : 0;
  OK(npfem_batch_set(batch, "velocity", 0, 2, velocity, 2 * coordinates));
  HOLDS(npfem_batch_step(batch, 5) == 0);
  OK(npfem_batch_state_hash(batch, 0, 2, hash, 2));
  HOLDS(hash[0] == hash[1]);
  HOLDS(fabs(measure(batch, "centre_x") - 5 * 0.25 * 0.01) < 1e-9);
  HOLDS(npfem_batch_step_for_ms(batch, 1, &steps) == 0 && steps >= 1);
  HOLDS(length <= 8 * coordinates);
  OK(npfem_batch_pack(batch, 0, packed, length));
  OK(npfem_batch_step(batch, 1));
  OK(npfem_batch_unpack(batch, 1, packed, length));
  OK(npfem_batch_state_hash(batch, 0, 2, hash, 2));
  HOLDS(hash[0] != hash[1]);
  OK(npfem_batch_unpack(batch, 0, packed, length));
  OK(npfem_batch_state_hash(batch, 0, 2, hash, 2));
  HOLDS(hash[0] == hash[1]);
  OK(npfem_batch_get_f32(batch, "position", 0, 1, narrow, coordinates));
  OK(npfem_batch_get(batch, "position", 0, 1, velocity, coordinates));
  for (i = 0; i < coordinates; ++i) HOLDS(narrow[i] == (float)velocity[i]);
  OK(npfem_batch_evaluate(batch));
  HOLDS(measure(batch, "energy") >= 0);
  OK(npfem_request_stop(batch));
}

static void check_options(int32_t batch) {
  char word[16];
  double least = 0, largest = 0, fallback = 0, value = 0;
  OK(npfem_param_name(batch, 0, word, (int32_t)sizeof word));
  HOLDS(strcmp(word, "time_step") == 0);
  OK(npfem_param_range(batch, 0, &least, &largest, &fallback));
  HOLDS(least == 1e-9 && largest == 1e12 && fallback == 0.25);
  OK(npfem_set_f64(batch, "time_step", 2));
  OK(npfem_get_f64(batch, "time_step", &value));
  HOLDS(value == 2);
  OK(npfem_set_f64(batch, "time_step", fallback));
  OK(npfem_set_text(batch, "method", "lineage"));
  OK(npfem_get_text(batch, "method", word, (int32_t)sizeof word));
  HOLDS(strcmp(word, "lineage") == 0);
  OK(npfem_set_text(batch, "method", "default"));
}

int main(void) {
  int32_t mesh, material, model, batch;
  check_library();
  material = OK(npfem_material_preset("rbc"));
  OK(npfem_set_f64(material, "membrane_density", 10));
  mesh = OK(npfem_material_mesh(material, 2));
  check_mesh(mesh);
  check_parameters(material);
  check_material(material);
  model = OK(npfem_model_create(mesh, material));
  check_model(model);
  batch = OK(npfem_batch_create(model, "reference", 1));
  OK(npfem_release(mesh));
  OK(npfem_release(material));
  OK(npfem_release(model));
  check_parameters(batch);
  check_options(batch);
  check_stretch(batch);
  check_patch(batch);
  check_steps(batch);
  OK(npfem_release(batch));
  return failures == 0 ? 0 : 1;
}
