// SPDX-License-Identifier: MPL-2.0
#include "backend/reference/lineage_step.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <deque>

#include "backend/reference/elasticity.h"
#include "backend/reference/lbfgs.h"
#include "backend/reference/lineage_contacts.h"

namespace npfem {
namespace {

/// A vertex and the plane it must not cross in this step.
struct Contact {
  int vertex;
  Eigen::RowVector3d target;  ///< point of the plane
  Eigen::RowVector3d normal;
  double weight;
};

/// For each vertex the nearest obstacle point, if it is within its threshold.
std::vector<Contact> find_contacts(std::span<const LineageObstacle> obstacles, const VertexField& position) {
  std::vector<Contact> contacts;
  for (int i = 0; i < position.rows(); ++i) {
    const auto [nearest, distance] = nearest_obstacle(obstacles, {position(i, 0), position(i, 1), position(i, 2)});
    if (nearest && distance <= nearest->threshold) {
      const Eigen::RowVector3d normal(nearest->normal[0], nearest->normal[1], nearest->normal[2]);
      const Eigen::RowVector3d point(nearest->target[0], nearest->target[1], nearest->target[2]);
      contacts.push_back({i, point + nearest->stand_off * normal, normal, nearest->weight});
    }
  }
  return contacts;
}

/// Objective of the lineage: 1/2 |x - y|^2 in M~/dt^2, plus energies, plus contacts.
class LineageObjective {
 public:
  LineageObjective(const Model& model, double dt, double beta, const VertexField& inertial,
                   std::vector<Contact> contacts)
      : model_(model), inertial_(inertial), contacts_(std::move(contacts)) {
    const auto mass = model.solid_masses();
    damped_mass_ = dt * beta * model.weight;
    damped_mass_ += Eigen::SparseMatrix<double>(mass.asDiagonal());
    damped_mass_ *= 1 / (dt * dt);
  }

  double operator()(const VertexField& x, VertexField& gradient) const {
    ++evaluations_;
    const VertexField departure = x - inertial_;
    gradient = damped_mass_ * departure;
    double value = 0.5 * inner(departure, gradient);
    value += elastic_energy(model_, x, gradient);
    for (const Contact& c : contacts_) {
      const Eigen::RowVector3d inside = x.row(c.vertex) - c.target;
      if (inside.dot(c.normal) >= 0) continue;
      gradient.row(c.vertex) += c.weight * inside;
      value += 0.5 * c.weight * inside.squaredNorm();
    }
    return value;
  }
  int evaluations() const { return evaluations_; }

 private:
  const Model& model_;
  const VertexField& inertial_;
  std::vector<Contact> contacts_;
  Eigen::SparseMatrix<double> damped_mass_;
  mutable int evaluations_ = 0;
};

/// Sample standard deviation over mean of the values, once there are `window` of them.
bool scatter_is_small(const std::deque<double>& values, int window, double tolerance) {
  if (static_cast<int>(values.size()) < window) return false;
  double mean = 0, square = 0;
  for (const double v : values) mean += v;
  mean /= static_cast<double>(values.size());
  for (const double v : values) square += (v - mean) * (v - mean);
  const double deviation = std::sqrt(square / static_cast<double>(values.size() - 1));
  return std::abs(deviation / mean) <= tolerance;
}

/// Shrinks the step until Armijo and curvature conditions hold; the last trial stands even where they do not. Returns
/// whether they held.
bool wolfe_search(const LineageObjective& objective, const SolverOptions& options, const VertexField& direction,
                  VertexField& x, VertexField& gradient, double& value) {
  const VertexField from = x;
  const double from_value = value, slope = inner(gradient, direction);
  double step = 1;
  for (int trial = 0; trial < options.max_line_search; ++trial, step *= 0.5) {
    x = from + step * direction;
    value = objective(x, gradient);
    if (value <= from_value + options.lineage_armijo * step * slope &&
        inner(gradient, direction) >= options.lineage_curvature * slope) {
      return true;
    }
  }
  return false;
}

/// v <- v + Calpha (v_rigid - v), v_rigid the motion of a rigid body with the same momentum and angular momentum.
void remove_deformation_rate(const Model& model, double alpha, const VertexField& x, VertexField& v) {
  const auto n = static_cast<Eigen::Index>(model.num_vertices());
  const auto mass = model.solid_masses();
  const Eigen::RowVector3d centre = mass.transpose() * x / mass.sum();
  const Eigen::RowVector3d mean_velocity = mass.transpose() * v / mass.sum();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d r = (x.row(i) - centre).transpose();
    spin += mass(i) * r.cross(v.row(i).transpose());
    inertia += mass(i) * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  const Eigen::Vector3d rotation = inertia.inverse() * spin;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d r = (x.row(i) - centre).transpose();
    const Eigen::RowVector3d rigid = mean_velocity + rotation.cross(r).transpose();
    v.row(i) += alpha * (rigid - v.row(i));
  }
}

}  // namespace

void lineage_step(const Model& model, const LineageFactors& factors, std::span<const LineageObstacle> obstacles,
                  const SolverOptions& options, CellState& cell) {
  const double dt = options.time_step;
  const auto n = static_cast<Eigen::Index>(model.num_vertices());
  const auto mass = model.solid_masses();
  const Eigen::RowVector3d centre = cell.position.colwise().mean();
  const VertexField start = cell.position.rowwise() - centre;

  std::vector<Contact> contacts = find_contacts(obstacles, cell.position);
  for (Contact& contact : contacts) contact.target -= centre;

  const VertexField impulse = dt * (mass.asDiagonal() * cell.velocity) + dt * dt * cell.external_force;
  const VertexField inertial = start + factors.damped_mass.solve(impulse);
  const LineageObjective objective(model, dt, options.lineage_beta, inertial, std::move(contacts));

  VertexField x = inertial, gradient(n, 3);
  double value = objective(x, gradient);
  std::deque<double> recent{value};
  Lbfgs memory(options.history);
  CellReport report;
  report.tolerance = options.lineage_tolerance;
  int failed_searches = 0;
  while (report.iterations < options.max_iterations) {
    ++report.iterations;
    const VertexField from = x, from_gradient = gradient;
    const VertexField direction = memory.direction(gradient, factors.step);
    if (!wolfe_search(objective, options, direction, x, gradient, value)) ++failed_searches;
    memory.push(x - from, gradient - from_gradient);
    recent.push_back(value);
    if (static_cast<int>(recent.size()) > options.lineage_window) recent.pop_front();
    if (gradient.norm() <= options.lineage_tolerance) break;
    if (scatter_is_small(recent, options.lineage_window, options.lineage_tolerance)) break;
    if (failed_searches >= options.lineage_attempts) break;
  }
  report.evaluations = objective.evaluations() - 1;  // trials of the line searches
  report.residual = gradient.cwiseAbs().maxCoeff();
  if (!x.allFinite() || !std::isfinite(value)) {
    report.status = CellStatus::not_finite;
    cell.report = report;
    return;
  }
  cell.report = report;
  VertexField velocity = (x - start) / dt;
  remove_deformation_rate(model, options.lineage_alpha, x, velocity);
  cell.velocity = velocity;
  cell.position += dt * velocity;
  cell.forget_past();
}

}  // namespace npfem
