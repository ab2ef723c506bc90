// SPDX-License-Identifier: MPL-2.0
// The lineage's functions. Their errors follow the lineage's return rules; the message is npfem's.
#include "npfem/shapeop.h"

#include "arguments.h"
#include "guard.h"
#include "handle_table.h"

namespace npfem::capi {
namespace {

constexpr int failed = 1;  // init, solve
constexpr int no_id = -1;  // add functions

/// A handle in the shape of a pointer; only its low 32 bits count, for callers that took it for an int.
ShapeOpSolver* as_pointer(std::int32_t handle) {
  return reinterpret_cast<ShapeOpSolver*>(static_cast<std::intptr_t>(handle));  // NOLINT(performance-no-int-to-ptr)
}
std::int32_t as_handle(const ShapeOpSolver* solver) {
  return static_cast<std::int32_t>(reinterpret_cast<std::intptr_t>(solver));
}

Lease<LineageSolver> use(const ShapeOpSolver* solver) {
  return wait_for(find_object<LineageObject>(as_handle(solver)));
}

/// Three numbers for each of `points` points.
template <class T>
std::span<T> coordinates(T* values, int points, const char* name) {
  require_array(values, points, name);
  return {values, 3 * static_cast<std::size_t>(points)};
}

Point force_argument(const double* force) {
  require_pointer(force, "force");
  return {force[0], force[1], force[2]};
}

int initialise(const char* function, const ShapeOpSolver* solver, const LineageSolver::Dynamics& dynamics) noexcept {
  return guard(function, [&] { use(solver)->initialise(dynamics); }) == NPFEM_OK ? 0 : failed;
}

}  // namespace
}  // namespace npfem::capi

using namespace npfem::capi;

ShapeOpSolver* shapeop_create(void) {
  const std::int32_t handle = guard(__func__, [] { return add_object(std::make_shared<LineageObject>()); });
  return handle > 0 ? as_pointer(handle) : nullptr;
}

void shapeop_delete(ShapeOpSolver* solver) {
  guard(__func__, [&] {
    find_object<LineageObject>(as_handle(solver));
    handles().release(as_handle(solver));
  });
}

void shapeop_setPoints(ShapeOpSolver* solver, ShapeOpScalar* points, int nb_points) {
  guard(__func__, [&] { use(solver)->set_points(coordinates(points, nb_points, "points")); });
}

void shapeop_getPoints(ShapeOpSolver* solver, ShapeOpScalar* points, int nb_points) {
  guard(__func__, [&] { use(solver)->get_points(coordinates(points, nb_points, "points")); });
}

void shapeop_setTimeStep(ShapeOpSolver* solver, ShapeOpScalar timestep) {
  guard(__func__, [&] { use(solver)->set_time_step(timestep); });
}

int shapeop_addConstraint(ShapeOpSolver* solver, const char* constraintType, int* ids, int nb_ids,
                          ShapeOpScalar weight) {
  const std::int32_t id = guard(__func__, [&] {
    const std::string type(text_argument(constraintType, "constraintType"));
    return use(solver)->add_constraint(type, array_argument(ids, nb_ids, "ids"), weight);
  });
  return id >= 0 ? id : no_id;
}

int shapeop_editConstraint(ShapeOpSolver* solver, const char* constraintType, int constraint_id,
                           const ShapeOpScalar* scalars, int nb_scl) {
  const std::int32_t status = guard(__func__, [&] {
    const std::string type(text_argument(constraintType, "constraintType"));
    use(solver)->edit_constraint(type, constraint_id, array_argument(scalars, nb_scl, "scalars"));
  });
  switch (status) {
    case NPFEM_OK:
      return SO_SUCCESS;
    case NPFEM_ERROR_NAME:
      return SO_INVALID_CONSTRAINT_TYPE;
    case NPFEM_ERROR_HANDLE:
      return SO_UNMATCHING_CONSTRAINT_ID;
    default:
      return SO_INVALID_ARGUMENT_LENGTH;
  }
}

void shapeop_addObstacle(ShapeOpSolver* solver, ShapeOpScalar* points, ShapeOpScalar* normals, int nb_points) {
  guard(__func__, [&] {
    use(solver)->add_obstacle(coordinates(points, nb_points, "points"), coordinates(normals, nb_points, "normals"));
  });
}

int shapeop_addGravityForce(ShapeOpSolver* solver, ShapeOpScalar* force) {
  const std::int32_t id = guard(__func__, [&] { return use(solver)->add_gravity_force(force_argument(force)); });
  return id >= 0 ? id : no_id;
}

int shapeop_addVertexForce(ShapeOpSolver* solver, ShapeOpScalar* force, int id) {
  const std::int32_t added = guard(__func__, [&] { return use(solver)->add_vertex_force(force_argument(force), id); });
  return added >= 0 ? added : no_id;
}

void shapeop_editVertexForce(ShapeOpSolver* solver, int force_id, ShapeOpScalar* force, int id) {
  guard(__func__, [&] { use(solver)->edit_vertex_force(force_id, force_argument(force), id); });
}

int shapeop_init(ShapeOpSolver* solver) {
  return initialise(__func__, solver, {});
}

int shapeop_initDynamic(ShapeOpSolver* solver, ShapeOpScalar Calpha, ShapeOpScalar Cbeta, ShapeOpScalar timestep,
                        ShapeOpScalar rho, bool /*doModalAnalysis*/, bool applyGlobalVolumeConservation,
                        ShapeOpScalar globalVolumeConservationWeight) {
  const double volume_weight = applyGlobalVolumeConservation ? globalVolumeConservationWeight : 0;
  return initialise(__func__, solver, {Calpha, Cbeta, timestep, rho, volume_weight});
}

int shapeop_solve(ShapeOpSolver* solver, int m, unsigned int max_iterations, unsigned int max_line_search_loops,
                  unsigned int max_attempts_to_solve_stagnation, unsigned int convergence_window, ShapeOpScalar tol,
                  ShapeOpScalar gamma, ShapeOpScalar gamma2, ShapeOpScalar collisions_threshold,
                  ShapeOpScalar collisions_weight) {
  const auto status = guard(__func__, [&] {
    use(solver)->step({m, static_cast<double>(max_iterations), static_cast<double>(max_line_search_loops),
                       static_cast<double>(max_attempts_to_solve_stagnation), static_cast<double>(convergence_window),
                       tol, gamma, gamma2, collisions_threshold, collisions_weight});
  });
  return status == NPFEM_OK ? 0 : failed;
}
