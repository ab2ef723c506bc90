// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <vector>

#include "backend/cell_status.h"
#include "backend/reference/vertex_field.h"

namespace npfem {

/// Everything that one cell is at one time. Units: um, us, fg, pN.
struct CellState {
  VertexField position, velocity, external_force, ambient_velocity, held_force, elastic_force;
  VertexField lag_velocity;      ///< (x_n - x_{n-1})/dt - v_n
  VertexField lag_acceleration;  ///< (v_n - v_{n-1})/dt
  VertexField tied_at;           ///< where each vertex stood when a patch tied it
  Eigen::VectorXd ambient_mass;
  Eigen::VectorXd contact_stiffness;
  std::vector<double> energies;  ///< of the last evaluation, pN um
  CellReport report;

  /// The cell counts as having moved uniformly so far.
  void forget_past() {
    lag_velocity.setZero();
    lag_acceleration.setZero();
  }
};

}  // namespace npfem
