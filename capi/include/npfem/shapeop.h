/* SPDX-License-Identifier: MPL-2.0 */
/*
 * The fourteen functions of the lineage's stand-alone library (ShapeOp as extended by npFEM), with their names, order
 * of arguments and return values, over the npfem cell solver, so that a script written for that library runs
 * unchanged. New code should use npfem.h.
 *
 * Units     um, us, fg, hence pN.
 * Solver    the pointer is a number in disguise: it survives a ctypes call without `restype` (which cuts it to an int),
 *           and a wrong or deleted one is an error and not a crash. NULL means that shapeop_create() failed.
 * Errors    a function that returns nothing does nothing when its arguments are wrong. npfem_last_error() of npfem.h
 *           says what was found and what is allowed.
 * Types     with vertices and scalars:
 *           SurfaceMaterial (3; rangeMin rangeMax miu lambda kappa; rangeMin, rangeMax and kappa have no effect),
 *           Area, TriangleStrainLimiting (3; rangeMin rangeMax), TriangleARAP (3; none),
 *           Bending (4: the edge, then the vertex opposite to it in each triangle; rangeMin rangeMax),
 *           EdgeStrainLimiting (2; rangeMin rangeMax),
 *           Volume, TetrahedronStrainLimiting (4; rangeMin rangeMax), TetrahedronARAP (4; none),
 *           VolumeMaterial (4; rangeMin rangeMax miu lambda kappa; the last three have no effect).
 *           Not available, shapeop_addConstraint() answers -1: VolumeDamping, Collision, Closeness.
 * Order     create, setPoints, addConstraint and editConstraint, forces, init, solve (one time step each), getPoints,
 *           delete.
 * Better    than the lineage: shapeop_setTimeStep() and shapeop_editConstraint() after the initialisation take full
 *           effect in the next step, ids are checked, and a step that fails is reported. Nothing is printed.
 * Kept      from the lineage: the collision arguments of shapeop_solve() reach only obstacles whose normals have length
 *           2; those with unit normals always act within 1 um and with 20 pN/um.
 */
#ifndef NPFEM_SHAPEOP_H
#define NPFEM_SHAPEOP_H

#ifndef __cplusplus
#include <stdbool.h>
#endif

#include "npfem/npfem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(readability-identifier-naming): the names are the lineage's */

typedef double ShapeOpScalar;
typedef struct ShapeOpSolver ShapeOpSolver;

/* What shapeop_editConstraint() returns. */
#define SO_SUCCESS 0
#define SO_INVALID_CONSTRAINT_TYPE 1
#define SO_INVALID_ARGUMENT_LENGTH 2
#define SO_UNMATCHING_CONSTRAINT_ID 3

NPFEM_API ShapeOpSolver* shapeop_create(void);
NPFEM_API void shapeop_delete(ShapeOpSolver* solver);

/* Positions, xyzxyz..., um. They are the rest shape of the constraints added afterwards. Velocities stay. */
NPFEM_API void shapeop_setPoints(ShapeOpSolver* solver, ShapeOpScalar* points, int nb_points);
/* `nb_points` must be the number that was set; else nothing is written. */
NPFEM_API void shapeop_getPoints(ShapeOpSolver* solver, ShapeOpScalar* points, int nb_points);
/* us */
NPFEM_API void shapeop_setTimeStep(ShapeOpSolver* solver, ShapeOpScalar timestep);

/* Returns the id of the constraint; -1 for a type that is unknown or not available, a wrong number of ids, or an id
 * without a point. Until they are edited, ranges are 1, miu 35, lambda 5, kappa 0. */
NPFEM_API int shapeop_addConstraint(ShapeOpSolver* solver, const char* constraintType, int* ids, int nb_ids,
                                    ShapeOpScalar weight);
/* Returns SO_...; the constraint is changed on SO_SUCCESS only. Scalars that are not finite count as a wrong length. */
NPFEM_API int shapeop_editConstraint(ShapeOpSolver* solver, const char* constraintType, int constraint_id,
                                     const ShapeOpScalar* scalars, int nb_scl);
/* Adds points of an obstacle with their normals, which point to the side that vertices are pushed to: of length 1, or
 * of length 2 for the class that the collision arguments of shapeop_solve() apply to. */
NPFEM_API void shapeop_addObstacle(ShapeOpSolver* solver, ShapeOpScalar* points, ShapeOpScalar* normals, int nb_points);

/* Forces in pN, kept from step to step. They return the id of the force; -1 on error. Gravity is the same force on
 * every vertex. */
NPFEM_API int shapeop_addGravityForce(ShapeOpSolver* solver, ShapeOpScalar* force);
NPFEM_API int shapeop_addVertexForce(ShapeOpSolver* solver, ShapeOpScalar* force, int id);
NPFEM_API void shapeop_editVertexForce(ShapeOpSolver* solver, int force_id, ShapeOpScalar* force, int id);

/* At rest, with Calpha 0, Cbeta 0, a time step of 1 us, density 1060 and a volume weight of 1. Returns 0, or 1 when
 * nothing can be built from what was given: no closed surface of SurfaceMaterial triangles, or a value out of range. */
NPFEM_API int shapeop_init(ShapeOpSolver* solver);
/* Cbeta and timestep in us, rho in fg/um3, weight in pN/um. The modal analysis of the lineage was never available:
 * its flag has no effect. */
NPFEM_API int shapeop_initDynamic(ShapeOpSolver* solver, ShapeOpScalar Calpha, ShapeOpScalar Cbeta,
                                  ShapeOpScalar timestep, ShapeOpScalar rho, bool doModalAnalysis,
                                  bool applyGlobalVolumeConservation, ShapeOpScalar globalVolumeConservationWeight);

/* One time step. L-BFGS keeps m - 2 pairs; m = 2 is plain quasi-Newton and m < 2 stands for 15. The last two arguments
 * (um, pN/um) matter only where there are obstacles with normals of length 2. Returns 0, or 1 when the step failed and
 * the points stayed where they were. */
NPFEM_API int shapeop_solve(ShapeOpSolver* solver, int m, unsigned int max_iterations,
                            unsigned int max_line_search_loops, unsigned int max_attempts_to_solve_stagnation,
                            unsigned int convergence_window, ShapeOpScalar tol, ShapeOpScalar gamma,
                            ShapeOpScalar gamma2, ShapeOpScalar collisions_threshold, ShapeOpScalar collisions_weight);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
