// SPDX-License-Identifier: MPL-2.0
#include "lineage_solver.h"

#include <algorithm>
#include <cmath>

#include "error.h"

namespace npfem::capi {
namespace {

/// Obstacles with unit normals act with the lineage's default arguments, whatever is given to a step.
constexpr double unit_normal_threshold = 1, unit_normal_weight = 20;  // um, pN/um

/// Normals of length 1 and 2 stand for two classes; half-way between them, rounding cannot mix the two up.
constexpr double class_boundary = 1.5;

void require_finite(std::span<const double> values, const char* what) {
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    throw Error(Status::bad_input, std::string(what) + " hold a number that is not finite");
  }
}

/// What the scalars are until they are edited: those of the red cell that the lineage ships.
std::vector<double> default_scalars(const std::string& type) {
  std::vector<double> scalars{1, 1, 35, 5, 0};
  scalars.resize(static_cast<std::size_t>(lineage_arity(type).scalars));
  return scalars;
}

void require_available(const std::string& type) {
  if (lineage_arity(type).ids == 0) {
    throw Error(Status::unknown_name,
                "constraint type \"" + type + "\" is not available; there are " + lineage_types());
  }
}

}  // namespace

void LineageSolver::require_vertex(int vertex) const {
  if (vertex < 0 || static_cast<std::size_t>(vertex) >= points_.size()) {
    throw Error(Status::bad_argument, "vertex " + std::to_string(vertex) + " does not exist; there are " +
                                          std::to_string(points_.size()) + " points");
  }
}

void LineageSolver::set_points(std::span<const double> xyz) {
  require_finite(xyz, "the points");
  std::vector<Point> points;
  for (std::size_t i = 0; i < xyz.size(); i += 3) points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  if (points.size() != points_.size()) cell_.reset();  // another body: it must be initialised
  points_ = std::move(points);
  if (cell_) write_points(*cell_);
}

void LineageSolver::get_points(std::span<double> xyz) const {
  if (xyz.size() != 3 * points_.size()) {
    throw Error(Status::bad_argument,
                std::to_string(xyz.size() / 3) + " points asked for; there are " + std::to_string(points_.size()));
  }
  std::copy_n(points_.empty() ? nullptr : points_.front().data(), xyz.size(), xyz.begin());
}

void LineageSolver::set_time_step(double time_step_us) {
  SolverOptions options;
  set_option(options, "time_step", time_step_us);  // throws out of range
  dynamics_.time_step = time_step_us;
  if (cell_) cell_->options().time_step = time_step_us;
}

int LineageSolver::add_constraint(const std::string& type, std::span<const int> ids, double weight) {
  require_available(type);
  const int needed = lineage_arity(type).ids;
  if (ids.size() != static_cast<std::size_t>(needed)) {
    throw Error(Status::bad_argument,
                type + " takes " + std::to_string(needed) + " ids, found " + std::to_string(ids.size()));
  }
  if (!std::isfinite(weight) || weight < 0) {
    throw Error(Status::bad_input, type + ": the weight must be a finite number of at least 0");
  }
  LineageElement element{{type, {ids.begin(), ids.end()}, weight, default_scalars(type)}, {}};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    require_vertex(ids[i]);
    element.rest[i] = points_[static_cast<std::size_t>(ids[i])];
  }
  elements_.push_back(std::move(element));
  elements_changed_ = true;
  return static_cast<int>(elements_.size()) - 1;
}

void LineageSolver::edit_constraint(const std::string& type, int id, std::span<const double> scalars) {
  require_available(type);
  const int needed = lineage_arity(type).scalars;
  if (scalars.size() != static_cast<std::size_t>(needed)) {
    throw Error(Status::bad_argument,
                type + " takes " + std::to_string(needed) + " scalars, found " + std::to_string(scalars.size()));
  }
  require_finite(scalars, "the scalars");
  if (id < 0 || static_cast<std::size_t>(id) >= elements_.size()) {
    throw Error(Status::bad_handle,
                "constraint " + std::to_string(id) + " does not exist; there are " + std::to_string(elements_.size()));
  }
  LineageConstraint& constraint = elements_[static_cast<std::size_t>(id)].constraint;
  if (constraint.type != type) {
    throw Error(Status::bad_handle,
                "constraint " + std::to_string(id) + " is of type " + constraint.type + ", not " + type);
  }
  if (std::equal(scalars.begin(), scalars.end(), constraint.scalars.begin())) return;
  constraint.scalars.assign(scalars.begin(), scalars.end());
  elements_changed_ = true;
}

void LineageSolver::add_obstacle(std::span<const double> points, std::span<const double> normals) {
  require_finite(points, "the obstacle's points");
  require_finite(normals, "the obstacle's normals");
  std::vector<ObstaclePoint> added;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    Point normal{normals[i], normals[i + 1], normals[i + 2]};
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (!(length > 0)) {
      throw Error(Status::bad_input, "the normal of obstacle point " + std::to_string(i / 3) + " is zero");
    }
    for (double& component : normal) component /= length;
    added.push_back({{points[i], points[i + 1], points[i + 2]}, normal, length > class_boundary});
  }
  obstacles_.insert(obstacles_.end(), added.begin(), added.end());
}

int LineageSolver::add_gravity_force(const Point& force) {
  require_finite(force, "the components of the force");
  forces_.push_back({force, all_vertices});
  return static_cast<int>(forces_.size()) - 1;
}

int LineageSolver::add_vertex_force(const Point& force, int vertex) {
  require_finite(force, "the components of the force");
  require_vertex(vertex);
  forces_.push_back({force, vertex});
  return static_cast<int>(forces_.size()) - 1;
}

void LineageSolver::edit_vertex_force(int force_id, const Point& force, int vertex) {
  require_finite(force, "the components of the force");
  require_vertex(vertex);
  const auto index = static_cast<std::size_t>(force_id);
  if (force_id < 0 || index >= forces_.size() || forces_[index].vertex == all_vertices) {
    throw Error(Status::bad_argument, "force " + std::to_string(force_id) +
                                          " is not a vertex force; forces have the "
                                          "ids 0 to " +
                                          std::to_string(forces_.size()) + " (excluded)");
  }
  forces_[index] = {force, vertex};
}

std::unique_ptr<Batch> LineageSolver::build(const Dynamics& dynamics, const std::vector<Point>& rest) const {
  auto model =
      std::make_shared<const Model>(build_lineage_model(rest, elements_, {dynamics.density, dynamics.volume_weight}));
  auto cell = std::make_unique<Batch>(std::move(model), "cpu", 1);
  SolverOptions& options = cell->options();
  options.lineage = true;
  options.lone_cells = 1;  // a CAD host moves one cell and waits for it
  set_option(options, "time_step", dynamics.time_step);
  set_option(options, "lineage_alpha", dynamics.alpha);
  set_option(options, "lineage_beta", dynamics.beta);
  return cell;
}

void LineageSolver::initialise(const Dynamics& dynamics) {
  const double range[]{dynamics.density, dynamics.volume_weight};
  require_finite(range, "density and volume weight");
  if (points_.empty()) throw Error(Status::wrong_order, "there are no points; call shapeop_setPoints first");
  if (!(dynamics.density > 0) || dynamics.volume_weight < 0) {
    throw Error(Status::bad_input, "the density must be above 0 and the volume weight at least 0");
  }
  cell_ = build(dynamics, points_);
  dynamics_ = dynamics;
  initial_ = points_;
  elements_changed_ = false;
}

/// The cell anew from the edited constraints, in the state that it is in.
void LineageSolver::rebuild() {
  std::unique_ptr<Batch> rebuilt = build(dynamics_, initial_);
  std::vector<double> velocity(3 * points_.size());
  cell_->read(Field::velocity, 0, 1, velocity);
  rebuilt->write(Field::velocity, 0, 1, velocity);
  write_points(*rebuilt);
  cell_ = std::move(rebuilt);
  elements_changed_ = false;
}

void LineageSolver::write_points(Batch& batch) const {
  batch.write(Field::position, 0, 1, {points_.front().data(), 3 * points_.size()});
}

std::vector<LineageObstacle> LineageSolver::obstacles(const StepSettings& settings) const {
  std::vector<LineageObstacle> planes;
  for (const ObstaclePoint& o : obstacles_) {
    const double reach = o.uses_step_settings ? settings.collision_threshold : unit_normal_threshold;
    const double weight = o.uses_step_settings ? settings.collision_weight : unit_normal_weight;
    if (!std::isfinite(reach) || !std::isfinite(weight) || reach < 0 || weight < 0) {
      throw Error(Status::bad_input, "collision threshold and weight must be finite numbers of at least 0");
    }
    planes.push_back({o.position, o.normal, reach, reach, weight});
  }
  return planes;
}

std::vector<double> LineageSolver::external_force() const {
  std::vector<double> sum(3 * points_.size(), 0.0);
  for (const Force& force : forces_) {
    const bool all = force.vertex == all_vertices;
    const std::size_t begin = all ? 0 : static_cast<std::size_t>(force.vertex);
    const std::size_t end = all ? points_.size() : begin + 1;
    if (end > points_.size()) {
      throw Error(Status::wrong_order, "a force acts on vertex " + std::to_string(begin) + "; there are " +
                                           std::to_string(points_.size()) + " points");
    }
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < 3; ++k) sum[3 * i + k] += force.value[k];
    }
  }
  return sum;
}

void LineageSolver::step(const StepSettings& settings) {
  if (!cell_) throw Error(Status::wrong_order, "call shapeop_init or shapeop_initDynamic after shapeop_setPoints");
  if (elements_changed_) rebuild();
  SolverOptions options = cell_->options();
  set_option(options, "history", settings.m < 2 ? 13 : settings.m - 2);
  set_option(options, "max_iterations", settings.max_iterations);
  set_option(options, "max_line_search", settings.max_line_search);
  set_option(options, "lineage_attempts", settings.attempts);
  set_option(options, "lineage_window", settings.window);
  set_option(options, "lineage_tolerance", settings.tolerance);
  set_option(options, "lineage_armijo", settings.armijo);
  set_option(options, "lineage_curvature", settings.curvature);
  cell_->set_obstacles(obstacles(settings));
  cell_->write(Field::external_force, 0, 1, external_force());
  cell_->options() = options;
  if (cell_->step(1) > 0) throw Error(Status::bad_input, cell_->status_text(0));
  cell_->read(Field::position, 0, 1, {points_.front().data(), 3 * points_.size()});
}

}  // namespace npfem::capi
