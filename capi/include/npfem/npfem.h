/* SPDX-License-Identifier: MPL-2.0 */
/*
 * npfem: deformable blood cells by the nodal projective finite element method. The C interface.
 *
 * Units     um, us, fg. Hence velocity um/us, force pN, energy pN um (1e-18 J), stress Pa, surface modulus uN/m.
 * Handles   int32, positive; 0 is none. A stale or foreign handle is an error, never a crash.
 * Returns   every function returns one int32. Negative: an error (npfem_status below), and npfem_last_error() says what
 *           was found, where and what is allowed. Functions that create an object return its handle. Functions that
 *           give text return the length of the text without its final zero: where it is not below `capacity`, the text
 *           was cut. Functions that count return the count. All else returns 0.
 * Arrays    flat, xyzxyz..., owned by the caller, read or written during the call only. `length` counts numbers (not
 *           bytes, not vertices) and must be exact.
 * Threads   meshes, materials and models may be used from any number of threads; models never change. A batch, and a
 *           mesh or material that is being edited, belong to one thread at a time. Messages are kept per thread.
 * Promise   functions and keys are added, never changed or removed, while npfem_abi_version() stays the same.
 *
 * In the order of use: mesh -> material -> model -> batch.
 */
#ifndef NPFEM_H
#define NPFEM_H

#include <stdint.h> /* NOLINT(modernize-deprecated-headers): C */

#if defined(_WIN32) && !defined(NPFEM_STATIC)
#if defined(NPFEM_BUILDING)
#define NPFEM_API __declspec(dllexport)
#else
#define NPFEM_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define NPFEM_API __attribute__((visibility("default")))
#else
#define NPFEM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- status ------------------------------------------------------------------------------------------------------ */

#define NPFEM_OK 0
#define NPFEM_ERROR_ARGUMENT (-1)      /* null pointer, wrong length, index out of range */
#define NPFEM_ERROR_HANDLE (-2)        /* never created, already released, or of another kind */
#define NPFEM_ERROR_INPUT (-3)         /* a mesh, a material or a value that physics does not allow */
#define NPFEM_ERROR_NAME (-4)          /* a key, field, preset, shape or back end that does not exist */
#define NPFEM_ERROR_ORDER (-5)         /* a call that needs another one first */
#define NPFEM_ERROR_IO (-6)            /* a file that cannot be read or written */
#define NPFEM_ERROR_UNAVAILABLE (-7)   /* a back end that this build does not have */
#define NPFEM_ERROR_MEMORY (-8)        /* out of memory */
#define NPFEM_ERROR_INTERNAL (-9)      /* a defect of the library */

/* How the last step of one cell ended. A cell at or above NPFEM_CELL_NOT_FINITE has failed: it keeps the state it had
 * before that step, and the other cells of the batch go on. */
#define NPFEM_CELL_CONVERGED 0
#define NPFEM_CELL_ITERATION_CAP 1     /* usable: residual above the tolerance, below the option residual_bound */
#define NPFEM_CELL_NOT_FINITE 2        /* infinity or NaN in the forces, velocities or energies */
#define NPFEM_CELL_NO_DESCENT 3        /* no step along the search direction lowers the objective */
#define NPFEM_CELL_NOT_CONVERGED 4     /* iteration cap with a residual above the option residual_bound */

/* Version of this interface: grows by one when something is taken away or changed, which is meant never to happen. */
NPFEM_API int32_t npfem_abi_version(void);
/* Version of the library as text, for example "0.1.0". */
NPFEM_API int32_t npfem_version(char* buffer, int32_t capacity);
/* What this build is, as JSON: version, compiler, back ends. */
NPFEM_API int32_t npfem_build_info(char* buffer, int32_t capacity);
/* Message of the last failed call of this thread; empty when there was none. */
NPFEM_API int32_t npfem_last_error(char* buffer, int32_t capacity);
/* Name of a status, for example "NPFEM_ERROR_HANDLE". */
NPFEM_API int32_t npfem_status_name(int32_t status, char* buffer, int32_t capacity);
/* Releases any object. A model stays alive inside the batches made from it. */
NPFEM_API int32_t npfem_release(int32_t handle);

/* ---- parameters by key: materials and batches ---------------------------------------------------------------------- */

/* Number of parameters of a material or a batch, and each one's name, unit, one-line description and, for numbers,
 * least, largest and default value. `kind` is 0 for a number, 1 for a word; the words allowed stand in the
 * description. */
NPFEM_API int32_t npfem_param_count(int32_t handle);
NPFEM_API int32_t npfem_param_name(int32_t handle, int32_t index, char* buffer, int32_t capacity);
NPFEM_API int32_t npfem_param_unit(int32_t handle, int32_t index, char* buffer, int32_t capacity);
NPFEM_API int32_t npfem_param_doc(int32_t handle, int32_t index, char* buffer, int32_t capacity);
NPFEM_API int32_t npfem_param_kind(int32_t handle, int32_t index);
NPFEM_API int32_t npfem_param_range(int32_t handle, int32_t index, double* least, double* largest, double* fallback);

NPFEM_API int32_t npfem_set_f64(int32_t handle, const char* key, double value);
NPFEM_API int32_t npfem_get_f64(int32_t handle, const char* key, double* value);
NPFEM_API int32_t npfem_set_text(int32_t handle, const char* key, const char* value);
NPFEM_API int32_t npfem_get_text(int32_t handle, const char* key, char* buffer, int32_t capacity);

/* ---- mesh: a closed triangulated surface, counter-clockwise seen from outside --------------------------------------- */

/* From arrays: xyz (um), 0-based triangles. Open, inconsistently oriented or degenerate surfaces are refused. */
NPFEM_API int32_t npfem_mesh_create(const double* xyz, int32_t xyz_length, const int32_t* triangles,
                                    int32_t triangles_length);
/* From a generator: "rbc" (Evans-Fung), "platelet" (oblate), "sphere" (octahedral: 66, 258, 1026, 4098 vertices at
 * level 2, 3, 4, 5) or "icosphere" (162, 642, 2562 at level 2, 3, 4). `size` is the largest diameter in um; 0: the
 * natural one of the shape (7.82 um, 3.6 um; 1 um for spheres). */
NPFEM_API int32_t npfem_mesh_generate(const char* shape, int32_t level, double size);
/* From a file: .off .obj .stl .ply, by its ending. UTF-8 path. */
NPFEM_API int32_t npfem_mesh_load(const char* path);
NPFEM_API int32_t npfem_mesh_save(int32_t mesh, const char* path);
NPFEM_API int32_t npfem_mesh_vertex_count(int32_t mesh);
NPFEM_API int32_t npfem_mesh_triangle_count(int32_t mesh);
NPFEM_API int32_t npfem_mesh_get_positions(int32_t mesh, double* xyz, int32_t length);
NPFEM_API int32_t npfem_mesh_get_triangles(int32_t mesh, int32_t* triangles, int32_t length);
/* "area" um2, "volume" um3, "reduced_volume" 1, "extent_x" "extent_y" "extent_z" um, "edge_min" "edge_mean" "edge_max"
 * um. */
NPFEM_API int32_t npfem_mesh_measure(int32_t mesh, const char* key, double* value);

/* ---- material: named parameters ------------------------------------------------------------------------------------ */

NPFEM_API int32_t npfem_material_preset_count(void);
NPFEM_API int32_t npfem_material_preset_name(int32_t index, char* buffer, int32_t capacity);
NPFEM_API int32_t npfem_material_preset(const char* name);
NPFEM_API int32_t npfem_material_load(const char* path);
NPFEM_API int32_t npfem_material_parse(const char* toml_text);
/* The material as TOML text that npfem_material_parse() reads back. */
NPFEM_API int32_t npfem_material_to_text(int32_t material, char* buffer, int32_t capacity);
/* The mesh that the material file recommends, at `level` (negative: the level of the file). */
NPFEM_API int32_t npfem_material_mesh(int32_t material, int32_t level);

/* ---- model: mesh and material, prepared; immutable ------------------------------------------------------------------ */

/* Every energy is measured against its own rest state: the metric against the stress-free shape of the material,
 * hinge angles, area and volume against the mesh. The initial shape of new cells is the mesh. */
NPFEM_API int32_t npfem_model_create(int32_t mesh, int32_t material);
/* From a body folder of the lineage: points.csv, surface_connectivity.csv, constraints.csv, onSurfaceParticle.csv.
 * `solid_density` in fg/um3, `volume_weight` in pN/um as in the lineage's globalVolumeConservationWeight. */
NPFEM_API int32_t npfem_model_load_lineage(const char* folder, double solid_density, double volume_weight);
NPFEM_API int32_t npfem_model_vertex_count(int32_t model);
NPFEM_API int32_t npfem_model_triangle_count(int32_t model);
NPFEM_API int32_t npfem_model_get_triangles(int32_t model, int32_t* triangles, int32_t length);
/* Per vertex: "rest_position" (3, um), "rest_area" (1, um2), "solid_mass" (1, fg). */
NPFEM_API int32_t npfem_model_get(int32_t model, const char* field, double* values, int32_t length);
/* "rest_area" um2, "rest_volume" um3, "largest_modulus" uN/m and "shear_modulus" uN/m (small strain). */
NPFEM_API int32_t npfem_model_measure(int32_t model, const char* key, double* value);
/* Energies this model evaluates (those of zero weight are not): count and names. */
NPFEM_API int32_t npfem_model_energy_count(int32_t model);
NPFEM_API int32_t npfem_model_energy_name(int32_t model, int32_t index, char* buffer, int32_t capacity);

/* ---- batch: cells of one model on one back end ---------------------------------------------------------------------- */

/* `backend`: "cpu", the fast one: cells in the SIMD lanes, for the best instruction set of this machine ("cpu-avx512",
 * "cpu-avx2", "cpu-baseline" ask for one); or "reference": one thread, double precision, the specification.
 * New cells have the initial shape, at rest, at the origin. */
NPFEM_API int32_t npfem_batch_create(int32_t model, const char* backend, int32_t cells);
NPFEM_API int32_t npfem_batch_cell_count(int32_t batch);
/* Appends cells; returns the index of the first new one. */
NPFEM_API int32_t npfem_batch_add(int32_t batch, int32_t cells);
/* Removes one cell; the cells after it move down by one. */
NPFEM_API int32_t npfem_batch_remove(int32_t batch, int32_t cell);

/* Fields, per vertex, of `count` cells from `first`; length = count * vertices * components.
 *   position          3  um
 *   velocity          3  um/us   writing it starts a new motion: the lag fields of the cell become zero
 *   external_force    3  pN      loads, contacts, gravity; kept until set again
 *   contact_stiffness 1  pN/um   k of a load external_force - k (x - x_n - time_step * velocity): what a stiff contact
 *                                gives way by within the step; npfem_batch_step() only
 *   ambient_velocity  3  um/us   velocity of the surrounding fluid at the vertex
 *   ambient_mass      1  fg      mass of fluid that moves with the vertex; 0 without a fluid
 *   held_force        3  pN      force that the vertex exerts on the fluid; a step replaces f_old by the new one
 *   lag_velocity      3  um/us   of BDF2 (option "integrator" = 1): (x_n - x_{n-1})/time_step - velocity
 *   lag_acceleration  3  um/us2  of BDF2: (v_n - v_{n-1})/time_step; both zero = uniform motion so far, as for a new
 *                                cell and after every step of implicit Euler or of relaxation
 *   elastic_force     3  pN      -dE/dx at the positions of the last npfem_batch_evaluate(); read only */
NPFEM_API int32_t npfem_batch_set(int32_t batch, const char* field, int32_t first, int32_t count, const double* values,
                                  int32_t length);
NPFEM_API int32_t npfem_batch_get(int32_t batch, const char* field, int32_t first, int32_t count, double* values,
                                  int32_t length);
NPFEM_API int32_t npfem_batch_get_f32(int32_t batch, const char* field, int32_t first, int32_t count, float* values,
                                      int32_t length);

/* Advances every cell by `steps` time steps of the option "time_step". A failed cell is data (see the status), not an
 * error of the call. Returns the number of failed cells. */
NPFEM_API int32_t npfem_batch_step(int32_t batch, int32_t steps);
/* Steps until about `milliseconds` of wall time have passed (at least once); writes the steps done. For live views. */
NPFEM_API int32_t npfem_batch_step_for_ms(int32_t batch, double milliseconds, int32_t* steps_done);
/* Static equilibrium under the external forces: the minimum of the energy, no inertia, no fluid. Velocities become 0.
 * Centre and orientation stay where the loads allow it. Returns the number of failed cells. */
NPFEM_API int32_t npfem_batch_relax(int32_t batch);
/* Energies and elastic forces at the present positions, no step. */
NPFEM_API int32_t npfem_batch_evaluate(int32_t batch);

/* Ties vertices together so that they move as one translating body, as a bead adhered to a membrane does; for every
 * cell of the batch. The patch keeps the shape in which it is tied; `stiffness` (pN/um) acts on departures from the
 * common displacement. Returns the patch's index.
 * npfem_batch_clear_patches() removes all. */
NPFEM_API int32_t npfem_batch_add_patch(int32_t batch, const int32_t* vertices, int32_t length, double stiffness);
NPFEM_API int32_t npfem_batch_clear_patches(int32_t batch);

/* Per cell, after a step: NPFEM_CELL_..., iterations used, largest residual force (pN), text of the status. */
NPFEM_API int32_t npfem_batch_get_status(int32_t batch, int32_t first, int32_t count, int32_t* values, int32_t length);
NPFEM_API int32_t npfem_batch_get_iterations(int32_t batch, int32_t first, int32_t count, int32_t* values,
                                             int32_t length);
NPFEM_API int32_t npfem_batch_get_residual(int32_t batch, int32_t first, int32_t count, double* values,
                                           int32_t length);
NPFEM_API int32_t npfem_batch_status_text(int32_t batch, int32_t cell, char* buffer, int32_t capacity);
/* Measures, one number per cell: "volume" um3, "area" um2, "extent_x" "extent_y" "extent_z" um, "centre_x" "centre_y"
 * "centre_z" um (mean of the vertices); after npfem_batch_evaluate() also "energy" pN um and "energy:<name>" pN um for
 * one energy of the model. Of the last step: "evaluations" of the objective (method "lineage": trials of its line
 * searches), "hessian_iterations" (those guided by the Hessian of the rest shape) and "flops", the floating-point
 * operations it took (add, multiply, divide, root: 1 each) under the options as they are now. */
NPFEM_API int32_t npfem_batch_measure(int32_t batch, const char* key, int32_t first, int32_t count, double* values,
                                      int32_t length);
/* 64-bit hash of the state (positions, velocities, held forces, lags) of each cell; equal bits, equal hash. */
NPFEM_API int32_t npfem_batch_state_hash(int32_t batch, int32_t first, int32_t count, int64_t* values, int32_t length);

/* One cell's whole state as numbers, bit for bit: for checkpoints and for moving cells between processes. */
NPFEM_API int32_t npfem_batch_pack_length(int32_t batch);
NPFEM_API int32_t npfem_batch_pack(int32_t batch, int32_t cell, double* values, int32_t length);
/* Overwrites the state of one cell with a packed one. */
NPFEM_API int32_t npfem_batch_unpack(int32_t batch, int32_t cell, const double* values, int32_t length);

/* Asks a running npfem_batch_step(), _step_for_ms() or _relax() to return after the present step; the only call allowed
 * from another thread while the batch is busy. */
NPFEM_API int32_t npfem_request_stop(int32_t batch);

#ifdef __cplusplus
}
#endif

#endif
