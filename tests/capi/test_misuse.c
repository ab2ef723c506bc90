/* SPDX-License-Identifier: MPL-2.0 */
/* The library as a careless C host uses it: every mistake gives its status and
 * an exact message, and nothing changes.
 */
#include "check.h"

enum { vertices = 66, coordinates = 3 * vertices };

/* A call that must fail with `status` and exactly this message. */
#define FAILS(call, status, message) must_fail((call), status, message, #call, __LINE__)
static void must_fail(int32_t found, int32_t status, const char* message, const char* call, int line) {
  char text[2048] = "";
  npfem_last_error(text, (int32_t)sizeof text);
  report(found == status, found, call, line);
  if (strcmp(text, message) != 0) {
    fprintf(stderr, "line %d: %s\n  expected: %s\n  found:    %s\n", line, call, message, text);
    ++failures;
  }
}

/* The message begins like this. */
static void must_fail_like(int32_t found, int32_t status, const char* beginning, int line) {
  char text[2048] = "";
  npfem_last_error(text, (int32_t)sizeof text);
  report(found == status, found, beginning, line);
  if (strncmp(text, beginning, strlen(beginning)) != 0) {
    fprintf(stderr, "line %d\n  expected: %s...\n  found:    %s\n", line, beginning, text);
    ++failures;
  }
}

struct Objects {
  int32_t mesh, material, model, batch;
};

static void misuse_library(void) {
  char text[8];
  FAILS(npfem_version(NULL, 8), NPFEM_ERROR_ARGUMENT, "npfem_version: buffer is NULL");
  FAILS(npfem_version(text, -1), NPFEM_ERROR_ARGUMENT, "npfem_version: capacity is -1; allowed: 0 or more");
  FAILS(npfem_status_name(1, text, 8), NPFEM_ERROR_ARGUMENT,
        "npfem_status_name: status 1 does not exist; allowed: -9 to 0");
  FAILS(npfem_status_name(-10, text, 8), NPFEM_ERROR_ARGUMENT,
        "npfem_status_name: status -10 does not exist; allowed: -9 to 0");
  HOLDS(npfem_status_name(NPFEM_ERROR_HANDLE, text, 8) == 18 && strcmp(text, "NPFEM_E") == 0);
}

static void misuse_handles(const struct Objects* o) {
  double value = 0;
  const int32_t stale = OK(npfem_mesh_generate("sphere", 0, 0));
  OK(npfem_release(stale));
  FAILS(npfem_mesh_vertex_count(0), NPFEM_ERROR_HANDLE,
        "npfem_mesh_vertex_count: handle 0 is no object; expected a mesh");
  FAILS(npfem_mesh_vertex_count(-7), NPFEM_ERROR_HANDLE,
        "npfem_mesh_vertex_count: handle -7 is no object; expected a mesh");
  FAILS(npfem_mesh_vertex_count(4321), NPFEM_ERROR_HANDLE,
        "npfem_mesh_vertex_count: handle 4321 was never created; expected a "
        "mesh");
  FAILS(npfem_mesh_vertex_count(0x7fffffff), NPFEM_ERROR_HANDLE,
        "npfem_mesh_vertex_count: handle 2147483647 was never created; "
        "expected a mesh");
  FAILS(npfem_mesh_vertex_count(stale), NPFEM_ERROR_HANDLE,
        "npfem_mesh_vertex_count: handle 5 was released; expected a mesh");
  FAILS(npfem_release(stale), NPFEM_ERROR_HANDLE, "npfem_release: handle 5 was released; expected an object");
  FAILS(npfem_mesh_vertex_count(o->material), NPFEM_ERROR_HANDLE,
        "npfem_mesh_vertex_count: handle 2 is a material; expected a mesh");
  FAILS(npfem_material_mesh(o->mesh, -1), NPFEM_ERROR_HANDLE,
        "npfem_material_mesh: handle 1 is a mesh; expected a material");
  FAILS(npfem_model_create(o->material, o->mesh), NPFEM_ERROR_HANDLE,
        "npfem_model_create: handle 2 is a material; expected a mesh");
  FAILS(npfem_model_vertex_count(o->batch), NPFEM_ERROR_HANDLE,
        "npfem_model_vertex_count: handle 4 is a batch; expected a model");
  FAILS(npfem_batch_step(o->model, 1), NPFEM_ERROR_HANDLE, "npfem_batch_step: handle 3 is a model; expected a batch");
  FAILS(npfem_request_stop(o->model), NPFEM_ERROR_HANDLE, "npfem_request_stop: handle 3 is a model; expected a batch");
  FAILS(npfem_param_count(o->mesh), NPFEM_ERROR_HANDLE,
        "npfem_param_count: handle 1 is a mesh; expected a material or a batch");
  FAILS(npfem_set_f64(o->model, "time_step", 1), NPFEM_ERROR_HANDLE,
        "npfem_set_f64: handle 3 is a model; expected a material or a batch");
  FAILS(npfem_get_f64(stale, "time_step", &value), NPFEM_ERROR_HANDLE,
        "npfem_get_f64: handle 5 was released; expected a material or a batch");
}

static void misuse_parameters(const struct Objects* o) {
  char text[64];
  double a = 0, b = 0;
  FAILS(npfem_set_f64(o->material, NULL, 1), NPFEM_ERROR_ARGUMENT, "npfem_set_f64: key is NULL");
  FAILS(npfem_get_f64(o->material, "shear_modulus", NULL), NPFEM_ERROR_ARGUMENT, "npfem_get_f64: value is NULL");
  FAILS(npfem_set_text(o->material, "membrane_law", NULL), NPFEM_ERROR_ARGUMENT, "npfem_set_text: value is NULL");
  FAILS(npfem_get_text(o->batch, "method", NULL, 5), NPFEM_ERROR_ARGUMENT, "npfem_get_text: buffer is NULL");
  FAILS(npfem_set_f64(o->batch, "time_stepp", 1), NPFEM_ERROR_NAME,
        "npfem_set_f64: no parameter \"time_stepp\"; did you mean "
        "\"time_step\"? allowed: time_step, integrator, tolerance, "
        "residual_bound, max_iterations, relax_iterations, newton_iterations, history, "
        "max_line_search, precision, threads, matrix, lone_cells, lineage_alpha, lineage_beta, "
        "lineage_tolerance, lineage_window, lineage_attempts, lineage_armijo, "
        "lineage_curvature, method");
  FAILS(npfem_set_f64(o->batch, "time_step", 0), NPFEM_ERROR_INPUT,
        "npfem_set_f64: option \"time_step\" = 0 us: allowed are numbers from "
        "1e-9 to 1000000000000");
  FAILS(npfem_set_f64(o->batch, "time_step", NAN), NPFEM_ERROR_INPUT,
        "npfem_set_f64: option \"time_step\" = nan us: allowed are numbers "
        "from 1e-9 to 1000000000000");
  FAILS(npfem_set_f64(o->batch, "history", 2.5), NPFEM_ERROR_INPUT,
        "npfem_set_f64: option \"history\" = 2.5 1: allowed are whole numbers "
        "from 0 to 1000");
  FAILS(npfem_set_f64(o->material, "shear_modulus", -1), NPFEM_ERROR_INPUT,
        "npfem_set_f64: shear_modulus = -1 is outside 0 to 1000000000 uN/m");
  FAILS(npfem_set_f64(o->material, "shear_modulus", HUGE_VAL), NPFEM_ERROR_INPUT,
        "npfem_set_f64: shear_modulus = inf is outside 0 to 1000000000 uN/m");
  FAILS(npfem_set_f64(o->batch, "method", 1), NPFEM_ERROR_ARGUMENT,
        "npfem_set_f64: parameter \"method\" is a word; use npfem_set_text and "
        "npfem_get_text");
  FAILS(npfem_set_text(o->material, "shear_modulus", "5 uN/m"), NPFEM_ERROR_ARGUMENT,
        "npfem_set_text: parameter \"shear_modulus\" is a number; use "
        "npfem_set_f64 and npfem_get_f64");
  FAILS(npfem_set_text(o->batch, "method", "linage"), NPFEM_ERROR_NAME,
        "npfem_set_text: method \"linage\"; did you mean \"lineage\"? allowed: "
        "default, lineage");
  FAILS(npfem_set_text(o->material, "membrane_law", "skalac"), NPFEM_ERROR_INPUT,
        "npfem_set_text: membrane_law: unknown word \"skalac\"; did you mean "
        "\"skalak\"? allowed: none, skalak, "
        "neo_hookean, yeoh, wlc, lineage");
  FAILS(npfem_param_name(o->batch, 21, text, 64), NPFEM_ERROR_ARGUMENT,
        "npfem_param_name: parameter 21 does not exist; there are 21, from 0");
  FAILS(npfem_param_kind(o->batch, -1), NPFEM_ERROR_ARGUMENT,
        "npfem_param_kind: parameter -1 does not exist; there are 21, from 0");
  FAILS(npfem_param_range(o->batch, 0, &a, NULL, &b), NPFEM_ERROR_ARGUMENT, "npfem_param_range: largest is NULL");
  FAILS(npfem_param_range(o->batch, 20, &a, &b, &b), NPFEM_ERROR_ARGUMENT,
        "npfem_param_range: parameter \"method\" is a word; use npfem_set_text "
        "and npfem_get_text");
}

static void misuse_meshes(const struct Objects* o) {
  const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double broken[12] = {0, 0, 0, 1, 0, NAN, 0, 1, 0, 0, 0, 1};
  const int32_t closed[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  const int32_t inside_out[12] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3};
  const int32_t out_of_range[12] = {0, 2, 1, 0, 1, 9, 1, 2, 3, 0, 3, 2};
  double buffer[coordinates];
  const int32_t tetrahedron = OK(npfem_mesh_create(xyz, 12, closed, 12));
  OK(npfem_release(tetrahedron));
  FAILS(npfem_mesh_create(NULL, 12, closed, 12), NPFEM_ERROR_ARGUMENT, "npfem_mesh_create: xyz is NULL");
  FAILS(npfem_mesh_create(xyz, 12, NULL, 12), NPFEM_ERROR_ARGUMENT, "npfem_mesh_create: triangles is NULL");
  FAILS(npfem_mesh_create(xyz, 11, closed, 12), NPFEM_ERROR_ARGUMENT,
        "npfem_mesh_create: the length of xyz is 11; allowed: multiples of 3");
  FAILS(npfem_mesh_create(xyz, 12, closed, -3), NPFEM_ERROR_ARGUMENT,
        "npfem_mesh_create: the length of triangles is -3; allowed: 0 or more");
  FAILS(npfem_mesh_create(NULL, 0, NULL, 0), NPFEM_ERROR_INPUT,
        "npfem_mesh_create: mesh \"in memory\": has 0 vertices and 0 "
        "triangles; a surface needs some of both");
  FAILS(npfem_mesh_create(broken, 12, closed, 12), NPFEM_ERROR_INPUT,
        "npfem_mesh_create: mesh \"in memory\": vertex 1 has a coordinate that "
        "is not finite");
  FAILS(npfem_mesh_create(xyz, 12, closed, 9), NPFEM_ERROR_INPUT,
        "npfem_mesh_create: mesh \"in memory\": the edge between vertices 0 "
        "and 2 of triangle 0 is open (no other "
        "triangle "
        "shares it); close the surface");
  FAILS(npfem_mesh_create(xyz, 12, inside_out, 12), NPFEM_ERROR_INPUT,
        "npfem_mesh_create: mesh \"in memory\": its volume is "
        "-0.16666666666666666 um3: the triangles face inwards; reverse the "
        "vertex "
        "order of all of them");
  FAILS(npfem_mesh_create(xyz, 12, out_of_range, 12), NPFEM_ERROR_INPUT,
        "npfem_mesh_create: mesh \"in memory\": triangle 1 refers to vertex 9, "
        "but there are 4 vertices, numbered from "
        "0");
  FAILS(npfem_mesh_generate("rbc", 99, 0), NPFEM_ERROR_INPUT,
        "npfem_mesh_generate: mesh level 99 is outside 0 to 8 (a red cell of "
        "level 3 has 258 vertices, each level four "
        "times "
        "more)");
  FAILS(npfem_mesh_generate("rbc", 2, NAN), NPFEM_ERROR_INPUT,
        "npfem_mesh_generate: the diameter of the mesh is nan um; it must be "
        "greater than 0 and at most 1e6 um");
  FAILS(npfem_mesh_generate("rcb", 2, 0), NPFEM_ERROR_NAME,
        "npfem_mesh_generate: unknown mesh shape \"rcb\"; did you mean "
        "\"rbc\"? allowed: rbc, platelet, sphere, "
        "icosphere");
  FAILS(npfem_mesh_generate(NULL, 2, 0), NPFEM_ERROR_ARGUMENT, "npfem_mesh_generate: shape is NULL");
  FAILS(npfem_mesh_load(NULL), NPFEM_ERROR_ARGUMENT, "npfem_mesh_load: path is NULL");
  FAILS(npfem_mesh_load("/nowhere/cell.off"), NPFEM_ERROR_IO,
        "npfem_mesh_load: cannot read \"/nowhere/cell.off\": no such file");
  FAILS(npfem_mesh_load("cell.xyz"), NPFEM_ERROR_INPUT,
        "npfem_mesh_load: mesh file \"cell.xyz\": the extension must be .off, "
        ".obj, .stl or .ply");
  FAILS(npfem_mesh_save(o->mesh, "/nowhere/cell.off"), NPFEM_ERROR_IO,
        "npfem_mesh_save: cannot write \"/nowhere/cell.off\": No such file or "
        "directory");
  FAILS(npfem_mesh_get_positions(o->mesh, buffer, 12), NPFEM_ERROR_ARGUMENT,
        "npfem_mesh_get_positions: xyz needs an array of 198 numbers, found 12");
  FAILS(npfem_mesh_get_positions(o->mesh, NULL, coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_mesh_get_positions: xyz is NULL");
  FAILS(npfem_mesh_measure(o->mesh, "volum", buffer), NPFEM_ERROR_NAME,
        "npfem_mesh_measure: no measure \"volum\"; did you mean \"volume\"? "
        "allowed: area, volume, reduced_volume, "
        "extent_x, extent_y, extent_z, edge_min, edge_mean, edge_max");
  FAILS(npfem_mesh_measure(o->mesh, "volume", NULL), NPFEM_ERROR_ARGUMENT, "npfem_mesh_measure: value is NULL");
}

static void misuse_materials_and_models(const struct Objects* o) {
  char text[64];
  double value = 0;
  FAILS(npfem_material_preset("rcb"), NPFEM_ERROR_NAME,
        "npfem_material_preset: unknown material \"rcb\"; did you mean "
        "\"rbc\"? allowed: rbc, rbc-viscous, platelet, "
        "palabos-rbc, palabos-platelet");
  FAILS(npfem_material_preset_name(99, text, 64), NPFEM_ERROR_ARGUMENT,
        "npfem_material_preset_name: preset 99 does not exist; there are 5, "
        "from 0");
  FAILS(npfem_material_load("/nowhere/rbc.toml"), NPFEM_ERROR_IO,
        "npfem_material_load: cannot read \"/nowhere/rbc.toml\": no such file");
  FAILS(npfem_material_parse("name = "), NPFEM_ERROR_INPUT,
        "npfem_material_parse: material text:1:8: Error while parsing "
        "key-value pair: encountered end-of-file");
  FAILS(npfem_material_parse(NULL), NPFEM_ERROR_ARGUMENT, "npfem_material_parse: toml_text is NULL");
  FAILS(npfem_material_mesh(o->material, 99), NPFEM_ERROR_INPUT,
        "npfem_material_mesh: mesh level 99 is outside 0 to 8 (a red cell of "
        "level 3 has 258 vertices, each level four "
        "times "
        "more)");
  FAILS(npfem_model_load_lineage("/nowhere", 1125, 250), NPFEM_ERROR_IO,
        "npfem_model_load_lineage: cannot read \"/nowhere/points.csv\": no "
        "such file");
  FAILS(npfem_model_load_lineage("/nowhere", NAN, 250), NPFEM_ERROR_INPUT,
        "npfem_model_load_lineage: solid_density = nan fg/um3: allowed are "
        "finite numbers of at least 0");
  FAILS(npfem_model_load_lineage("/nowhere", 1125, -250), NPFEM_ERROR_INPUT,
        "npfem_model_load_lineage: volume_weight = -250 pN/um: allowed are "
        "finite numbers of at least 0");
  FAILS(npfem_model_get(o->model, "rest_areas", &value, 1), NPFEM_ERROR_NAME,
        "npfem_model_get: no field \"rest_areas\"; did you mean \"rest_area\"? "
        "allowed: rest_position, rest_area, "
        "solid_mass");
  FAILS(npfem_model_get(o->model, "rest_area", &value, 1), NPFEM_ERROR_ARGUMENT,
        "npfem_model_get: field \"rest_area\" needs an array of 66 numbers, "
        "found 1");
  FAILS(npfem_model_measure(o->model, "shear", &value), NPFEM_ERROR_NAME,
        "npfem_model_measure: no measure \"shear\"; allowed: rest_area, "
        "rest_volume, shear_modulus, largest_modulus");
  FAILS(npfem_model_energy_name(o->model, 5, text, 64), NPFEM_ERROR_ARGUMENT,
        "npfem_model_energy_name: energy 5 does not exist; there are 5, from 0");
}

static void misuse_fields(const struct Objects* o) {
  static double values[coordinates];
  FAILS(npfem_batch_set(o->batch, "velocty", 0, 1, values, coordinates), NPFEM_ERROR_NAME,
        "npfem_batch_set: no field \"velocty\"; did you mean \"velocity\"? "
        "allowed: position, velocity, "
        "external_force, contact_stiffness, ambient_velocity, ambient_mass, "
        "held_force, lag_velocity, lag_acceleration, elastic_force");
  FAILS(npfem_batch_set(o->batch, "velocity", 0, 1, NULL, coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_set: values is NULL");
  FAILS(npfem_batch_set(o->batch, "velocity", 0, 1, values, vertices), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_set: field \"velocity\" needs an array of 198 numbers, "
        "found 66");
  FAILS(npfem_batch_set(o->batch, "velocity", 0, 1, values, -coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_set: the length of values is -198; allowed: 0 or more");
  FAILS(npfem_batch_set(o->batch, "velocity", 0, 3, values, coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_set: cells 0 to 2 asked for; the batch has 2");
  FAILS(npfem_batch_set(o->batch, "velocity", 0x7fffffff, 1, values, coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_set: cells 2147483647 to 2147483647 asked for; the batch "
        "has 2");
  FAILS(npfem_batch_set(o->batch, "elastic_force", 0, 1, values, coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_set: field \"elastic_force\" is computed and cannot be "
        "written; loads are external_force");
  values[3 * 7 + 1] = NAN;
  FAILS(npfem_batch_set(o->batch, "position", 1, 1, values, coordinates), NPFEM_ERROR_INPUT,
        "npfem_batch_set: field \"position\": found nan at vertex 7 of cell 1; "
        "allowed are finite numbers");
  values[3 * 7 + 1] = -1;
  FAILS(npfem_batch_set(o->batch, "ambient_mass", 0, 1, values, vertices), NPFEM_ERROR_INPUT,
        "npfem_batch_set: field \"ambient_mass\": found -1 at vertex 22 of "
        "cell 0; allowed are finite numbers "
        "of at least 0");
  FAILS(npfem_batch_get(o->batch, "position", -1, 1, values, coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_get: cells -1 to -1 asked for; the batch has 2");
  FAILS(npfem_batch_get_f32(o->batch, "position", 0, 1, NULL, coordinates), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_get_f32: values is NULL");
}

static void misuse_batches(const struct Objects* o) {
  static double load[coordinates];
  const int32_t outside[2] = {0, vertices}, twice[2] = {3, 3}, pair[2] = {0, 1};
  int32_t steps = 0, status[2];
  double number = 0;
  char text[64];
  /* The rest of the message lists what this build has for this machine. */
  must_fail_like(npfem_batch_create(o->model, "cuda", 1), NPFEM_ERROR_UNAVAILABLE,
                 "npfem_batch_create: back end \"cuda\" is not in this build; this build has: cpu, reference, cpu-",
                 __LINE__);
  FAILS(npfem_batch_create(o->model, NULL, 1), NPFEM_ERROR_ARGUMENT, "npfem_batch_create: backend is NULL");
  FAILS(npfem_batch_create(o->model, "reference", -1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_create: -1 cells asked for; allowed: 0 or more");
  FAILS(npfem_batch_add(o->batch, 0x7fffffff), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_add: too many cells: a batch holds at most 2147483647");
  FAILS(npfem_batch_remove(o->batch, 2), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_remove: cells 2 to 2 asked for; the batch has 2");
  FAILS(npfem_batch_step(o->batch, -1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_step: -1 steps asked for; allowed: 0 or more");
  FAILS(npfem_batch_step(o->batch, 1), NPFEM_ERROR_ORDER,
        "npfem_batch_step: vertex 0 of cell 0 has no mass: give the material a "
        "membrane_density or solid_density, set "
        "the field \"ambient_mass\" (a surrounding fluid), or use relax for a "
        "static equilibrium");
  FAILS(npfem_batch_step_for_ms(o->batch, 1, NULL), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_step_for_ms: steps_done is NULL");
  FAILS(npfem_batch_step_for_ms(o->batch, NAN, &steps), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_step_for_ms: nan ms asked for; allowed: 0 or more");
  load[0] = 5;
  OK(npfem_batch_set(o->batch, "external_force", 1, 1, load, coordinates));
  FAILS(npfem_batch_relax(o->batch), NPFEM_ERROR_INPUT,
        "npfem_batch_relax: external forces of cell 1 add up to 5 pN along x; "
        "a static equilibrium needs forces "
        "that balance");
  FAILS(npfem_batch_add_patch(o->batch, outside, 2, 1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_add_patch: patch vertex 66 does not exist; the model has "
        "66");
  FAILS(npfem_batch_add_patch(o->batch, twice, 2, 1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_add_patch: patch vertex 3 is listed twice");
  FAILS(npfem_batch_add_patch(o->batch, pair, 1, 1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_add_patch: a patch needs at least 2 vertices");
  FAILS(npfem_batch_add_patch(o->batch, pair, 2, NAN), NPFEM_ERROR_INPUT,
        "npfem_batch_add_patch: patch stiffness nan pN/um: allowed are finite "
        "numbers above 0");
  FAILS(npfem_batch_get_status(o->batch, 1, 2, status, 2), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_get_status: 2 cells from 1 asked for; the batch has 2");
  FAILS(npfem_batch_get_status(o->batch, 0, 2, status, 1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_get_status: one number per cell needs an array of 2 "
        "numbers, found 1");
  FAILS(npfem_batch_get_residual(o->batch, 0, 1, NULL, 1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_get_residual: values is NULL");
  FAILS(npfem_batch_status_text(o->batch, -3, text, 64), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_status_text: cells -3 to -3 asked for; the batch has 2");
  FAILS(npfem_batch_measure(o->batch, "extent_w", 0, 1, &number, 1), NPFEM_ERROR_NAME,
        "npfem_batch_measure: no measure \"extent_w\"; did you mean "
        "\"extent_x\"? allowed: volume, area, extent_x, "
        "extent_y, "
        "extent_z, centre_x, centre_y, centre_z, evaluations, hessian_iterations, flops, energy, energy:<name>");
  FAILS(npfem_batch_measure(o->batch, NULL, 0, 1, &number, 1), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_measure: key is NULL");
  FAILS(npfem_batch_pack(o->batch, 0, load, 3), NPFEM_ERROR_ARGUMENT,
        "npfem_batch_pack: a packed cell needs an array of 1518 numbers, found "
        "3");
}

static void misuse_packed_cells(const struct Objects* o) {
  static double packed[1518];
  int64_t before = 0, after = 1;
  OK(npfem_batch_state_hash(o->batch, 0, 1, &before, 1));
  OK(npfem_batch_pack(o->batch, 0, packed, 1518));
  packed[0] = 1;
  packed[5] = HUGE_VAL;
  FAILS(npfem_batch_unpack(o->batch, 0, packed, 1518), NPFEM_ERROR_INPUT,
        "npfem_batch_unpack: field \"position\": found inf at vertex 1 of cell 0; allowed are finite numbers");
  OK(npfem_batch_state_hash(o->batch, 0, 1, &after, 1));
  HOLDS(before == after);
}

int main(void) {
  struct Objects o;
  o.mesh = OK(npfem_mesh_generate("rbc", 2, 0));
  o.material = OK(npfem_material_preset("rbc"));
  o.model = OK(npfem_model_create(o.mesh, o.material));
  o.batch = OK(npfem_batch_create(o.model, "reference", 2));
  misuse_library();
  misuse_handles(&o);
  misuse_parameters(&o);
  misuse_meshes(&o);
  misuse_materials_and_models(&o);
  misuse_fields(&o);
  misuse_batches(&o);
  misuse_packed_cells(&o);
  return failures == 0 ? 0 : 1;
}
