// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>
#include <string>

#include "geometry/vec3.h"
#include "import/lineage_xml.h"

namespace npfem::flow {

/// One kind of body of a lineage file.
struct LineageBodyParameters {
  std::string case_study;      ///< folder below Case_Studies
  double density = 0;          ///< fg/um3
  double alpha = 0, beta = 0;  ///< Calpha; Cbeta, us
  double volume_weight = 0;    ///< pN/um; 0 where the volume is not kept
};

/// What a parameter file of the lineage says, in um, us, fg.
struct LineageParameters {
  enum class Flow { shear, tube, plates };
  Flow flow;
  LineageBodyParameters rbc, platelet;
  std::string output_folder, position_file, wall_file, checkpoint_folder;
  bool with_bodies, packing, restart, write_cells, write_centres;
  bool all_cells_written;  ///< its dump ratios are all 0 or 1
  double haematocrit;      ///< share of the box; packing only
  double rbc_per_platelet;
  Vec3 size;  ///< whole numbers of dx
  bool size_is_rounded;
  double dx;
  double tau, time_step;                            ///< one of them is given, the other 0
  double centre_velocity;                           ///< um/us
  double shear_rate;                                ///< 1/us
  double viscosity, density;                        ///< kinematic; of the fluid
  double duration;                                  ///< us
  int output_every, checkpoint_every, solve_every;  ///< fluid steps
  int rbc_count, platelet_count;                    ///< of a restart
  int forcing_iterations;                           ///< inamuro_iT
  struct Contact {
    double range;   ///< um
    double weight;  ///< pN/um
  };
  Contact like, unlike;  ///< between cells of one type or a cell and a wall; between red cell and platelet
  struct Solver {
    int history, max_iterations, max_line_search, attempts, window;
    double tolerance, armijo, curvature;
  } solver;

  /// Relaxation time in steps, whichever of the two was given.
  double relaxation_time() const { return tau > 0 ? tau : 0.5 + 3 * viscosity * time_step / (dx * dx); }
  double step() const { return time_step > 0 ? time_step : (tau - 0.5) / 3 * dx * dx / viscosity; }  ///< us
};

/// The nearest whole number of spacings dx, um, without the last bits of the product.
double whole_spacings(double length, double dx);

/// Throws text::InputError with file, line and key.
LineageParameters read_lineage_parameters(const LineageXml& xml);

}  // namespace npfem::flow
