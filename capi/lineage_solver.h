// SPDX-License-Identifier: MPL-2.0
// The solver object of the lineage's C interface: it gathers points, constraints, forces and obstacles, and steps one
// cell in lineage mode. Functions throw npfem::Error and leave the solver as it was.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "backend/backend.h"
#include "batch/batch.h"
#include "model/lineage_model.h"

namespace npfem::capi {

class LineageSolver {
 public:
  void set_points(std::span<const double> xyz);
  void get_points(std::span<double> xyz) const;
  void set_time_step(double time_step_us);

  /// The element rests in the present points. Returns its id.
  int add_constraint(const std::string& type, std::span<const int> ids, double weight);
  /// Throws Error(unknown_name) for the type, Error(bad_handle) for an id that is not of this type.
  void edit_constraint(const std::string& type, int id, std::span<const double> scalars);

  void add_obstacle(std::span<const double> points, std::span<const double> normals);
  int add_gravity_force(const Point& force);
  int add_vertex_force(const Point& force, int vertex);
  void edit_vertex_force(int force_id, const Point& force, int vertex);

  struct Dynamics {
    double alpha = 0, beta = 0;  ///< Calpha; Cbeta, us
    double time_step = 1;        ///< us
    double density = 1060;       ///< fg/um3
    double volume_weight = 1;    ///< pN/um; 0: no volume conservation
  };
  /// Builds the cell from points and constraints; it starts at rest.
  void initialise(const Dynamics& dynamics);

  struct StepSettings {
    int m;                                                     ///< L-BFGS pairs plus two
    double max_iterations, max_line_search, attempts, window;  ///< whole numbers
    double tolerance, armijo, curvature;
    double collision_threshold, collision_weight;  ///< um, pN/um; of obstacles with normals of length 2
  };
  void step(const StepSettings& settings);

 private:
  /// A force on one vertex, or on every one.
  struct Force {
    Point value;  ///< pN
    int vertex;   ///< all_vertices for gravity
  };
  struct ObstaclePoint {
    Point position, normal;   ///< um; unit
    bool uses_step_settings;  ///< threshold and weight are those of the step
  };
  static constexpr int all_vertices = -1;

  void require_vertex(int vertex) const;
  std::unique_ptr<Batch> build(const Dynamics& dynamics, const std::vector<Point>& rest) const;
  void rebuild();
  void write_points(Batch& batch) const;
  std::vector<LineageObstacle> obstacles(const StepSettings& settings) const;
  std::vector<double> external_force() const;

  std::vector<Point> points_;
  std::vector<LineageElement> elements_;
  std::vector<Force> forces_;
  std::vector<ObstaclePoint> obstacles_;
  Dynamics dynamics_;
  std::vector<Point> initial_;  ///< points at the initialisation: they fix the volume to conserve
  std::unique_ptr<Batch> cell_;
  bool elements_changed_ = false;  ///< since the cell was built
};

}  // namespace npfem::capi
