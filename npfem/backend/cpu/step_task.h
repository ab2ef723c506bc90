// SPDX-License-Identifier: MPL-2.0
// What the back end hands to the kernels, and what it gets back: plain data only (see cell_plan.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "backend/cell_status.h"
#include "backend/cpu/cell_plan.h"

namespace npfem::cpu {

/// L of a factor N = L D L^T strictly below the diagonal, by rows for the way forward and by columns (L^T by rows) for
/// the way back; each entry is a number, or a 3 x 3 block by rows.
template <class H>
struct FactorView {
  const int* row_start = nullptr;
  const int* column = nullptr;
  const H* value = nullptr;
  const int* back_start = nullptr;
  const int* back_column = nullptr;
  const H* back_value = nullptr;
  const H* inverse_diagonal = nullptr;  ///< D^-1, a number or a block for each vertex
};

/// The energies of the whole cell couple all vertices: they enter the inverse of the rest-shape Hessian as a
/// correction of low rank (Sherman, Morrison & Woodbury),  H^-1 = S^-1 - Z C Z^T.
template <class H>
struct GlobalCorrection {
  static constexpr int max_terms = num_cell_energies;
  int num_terms = 0;
  const H* direction[max_terms] = {};   ///< columns of Z, xyzxyz...
  H weight[max_terms][max_terms] = {};  ///< C
};

/// The matrices around which a step iterates, each shared by all cells of a model.
template <class H>
struct StepMatrices {
  FactorView<H> scalar;        ///< M/dt^2 + W, one number per pair of vertices
  FactorView<H> block;         ///< M/dt^2 + Hessian at the rest shape, one 3 x 3 block per pair
  GlobalCorrection<H> global;  ///< for `block`
  bool has_block = false;
};

/// W of the lineage's damping M~ = M + dt Cbeta W, by rows with the diagonal, and the factor of M~.
template <class R>
struct LineageMatrices {
  const int* row_start = nullptr;
  const int* column = nullptr;
  const R* weight = nullptr;
  FactorView<R> damped_mass;
};

/// The numbers of a block of cells: number i of lane l at [i * stride + l]. All in double whatever the kernels use.
struct CellBlock {
  int stride = 0;
  double* position = nullptr;
  double* velocity = nullptr;
  const double* external_force = nullptr;  ///< null: zero for all cells; so also the next four
  const double* contact_stiffness = nullptr;
  const double* ambient_velocity = nullptr;
  const double* ambient_mass = nullptr;
  double* held_force = nullptr;
  double* lag_velocity = nullptr;  ///< null unless the integrator is BDF2
  double* lag_acceleration = nullptr;
  const double* tied_at = nullptr;  ///< null without patches
  const double* contact = nullptr;  ///< lineage obstacles: normal (3), offset, weight for each vertex; null: none
  CellReport* report = nullptr;     ///< by lane
};

/// Settings of a step, in numbers of the kernels' own.
struct StepSettings {
  double time_step;                  ///< us
  double lead;                       ///< us: over this a velocity becomes a displacement; dt, or 2 dt/3 for BDF2
  double past;                       ///< share of the last move in the next: 0, or 1/3 for BDF2
  double tolerance, residual_bound;  ///< pN
  int max_iterations, history, max_line_search;
  bool always_blocks;  ///< whatever the shape; else chosen for each cell
  bool looks_back;     ///< BDF2: the lags are kept for the next step
  bool leave_short;    ///< a cell above its tolerance does not move: another method takes the step
  bool lineage;
  double lineage_alpha, lineage_beta, lineage_tolerance;
  int lineage_window, lineage_attempts;
  double lineage_armijo, lineage_curvature;
};

/// One step of some of the cells of a block. R: positions and forces; H: matrices and history.
template <class R, class H>
struct StepTask {
  const CellPlan<R>* plan;
  const StepSettings* settings;
  const StepMatrices<H>* matrices;
  const LineageMatrices<R>* lineage;
  const PatchView<R>* patches;
  int num_patches;
  const double* solid_mass;  ///< per vertex, fg
  const double* rest_shape;  ///< xyzxyz..., um, about its centre
  CellBlock block;
  int first_lane;
  std::uint32_t active;  ///< bit l: lane first_lane + l takes the step
  void* workspace;       ///< KernelTable::workspace_bytes, aligned to 64
  /// Where not null, cells for which most of their pack has been waiting may leave it unmoved; their bits are set.
  std::uint32_t* left;
};

/// Energies and forces at the present positions.
template <class R>
struct EvaluateTask {
  const CellPlan<R>* plan;
  CellBlock block;
  int first_lane;
  double* elastic_force;  ///< laid out as the block
  double* energies;       ///< [energy * stride + lane]
  void* workspace;
};

/// The kernels of one instruction set.
struct KernelTable {
  const char* name;
  int double_lanes, float_lanes;
  std::size_t (*workspace_bytes)(int num_vertices, int history, int window);
  void (*step_double)(const StepTask<double, double>&);
  void (*step_mixed)(const StepTask<double, float>&);
  void (*step_float)(const StepTask<float, float>&);
  // One cell at a time, elements in the lanes.
  void (*lone_step_double)(const StepTask<double, double>&);
  void (*lone_step_mixed)(const StepTask<double, float>&);
  void (*lone_step_float)(const StepTask<float, float>&);
  void (*evaluate)(const EvaluateTask<double>&);
};

}  // namespace npfem::cpu
