// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <initializer_list>

#include "backend/cpu/kernel/cell_fields.h"
#include "backend/cpu/kernel/epsilon.h"
#include "backend/cpu/kernel/lane_search.h"
#include "backend/cpu/kernel/quasi_newton.h"

namespace npfem::NPFEM_ISA {

/// The lineage's time step of W cells at once, or of one: iterate for iterate that of the back end "reference"
/// (lineage_step.h), which explains it.
template <class Shape, class R, class H, int W>
class LineageStep {
  using P = Pack<R, W>;
  using M = Mask<R, W>;
  using Fields = CellFields<Shape, R>;
  static constexpr int cells = Shape::cells;

 public:
  LineageStep(const cpu::StepTask<R, H>& task, Carver& memory)
      : task_(task),
        settings_(*task.settings),
        plan_(*task.plan),
        n_(plan_.num_vertices),
        length_(Shape::length(n_)),
        fields_(task.block, task.first_lane, n_, plan_.is_translation_invariant),
        search_(*task.matrices, n_, settings_.history, memory) {
    for (P** field : {&start_, &inertial_, &mass_, &here_, &there_, &gradient_, &trial_gradient_, &direction_,
                      &departure_, &area_gradient_, &volume_gradient_}) {
      *field = memory.take<P>(length_);
    }
    recent_ = memory.take<double>(settings_.lineage_window * cells);
  }

  void run() {
    prepare();
    iterate();
    finish();
  }

 private:
  void prepare() {
    if (cells == 1) {
      for (P* field : {start_, inertial_, mass_}) field[length_ - 1] = P(R(0));
    }
    const cpu::CellBlock& b = task_.block;
    const double dt = settings_.time_step;
    for (int row = 0; row < 3 * n_; ++row) {
      const double mass = task_.solid_mass[row / 3];
      const double* const external = b.external_force ? fields_.from(b.external_force, row) : nullptr;
      for (int l = 0; l < cells; ++l) {
        const double impulse = dt * mass * fields_.from(b.velocity, row)[l] + dt * dt * (external ? external[l] : 0.0);
        Fields::row(start_, row)[l] = static_cast<R>(fields_.from(b.position, row)[l] - fields_.centre[row % 3][l]);
        Fields::row(inertial_, row)[l] = static_cast<R>(impulse);
        Fields::row(mass_, row)[l] = static_cast<R>(mass / (dt * dt));
      }
    }
    Shape::solve_scalar(task_.lineage->damped_mass, n_, inertial_);
    for (int i = 0; i < length_; ++i) here_[i] = inertial_[i] = start_[i] + inertial_[i];
  }

  P evaluate(const P* x, P* gradient) {
    for (int i = 0; i < length_; ++i) departure_[i] = x[i] - inertial_[i];
    Shape::weigh(*task_.lineage, n_, departure_, gradient);
    const R damping = static_cast<R>(settings_.lineage_beta / settings_.time_step);
    P kinetic(R(0));
    for (int i = 0; i < length_; ++i) {
      gradient[i] = mass_[i] * departure_[i] + damping * gradient[i];
      kinetic += departure_[i] * gradient[i];
    }
    P energies[cpu::num_energies];
    for (P& e : energies) e = P(R(0));
    P value = R(0.5) * Shape::sum(kinetic);
    value += Shape::forces(plan_, x, gradient, area_gradient_, volume_gradient_, energies);
    if (task_.block.contact) value += contact_energy(x, gradient);
    return value;
  }

  /// Springs of the vertices beyond their obstacle's plane to its point.
  P contact_energy(const P* x, P* gradient) {
    P energy(R(0));
    for (int l = 0; l < cells; ++l) {
      R sum = 0;
      for (int v = 0; v < n_; ++v) {
        const double weight = fields_.from(task_.block.contact, 7 * v + 6)[l];
        if (!(weight > 0)) continue;
        R inside[3], along = 0;
        for (int c = 0; c < 3; ++c) {
          const double target = fields_.from(task_.block.contact, 7 * v + c)[l] - fields_.centre[c][l];
          inside[c] = Fields::row(x, 3 * v + c)[l] - static_cast<R>(target);
          along += inside[c] * static_cast<R>(fields_.from(task_.block.contact, 7 * v + 3 + c)[l]);
        }
        if (along >= 0) continue;
        for (int c = 0; c < 3; ++c) {
          Fields::row(gradient, 3 * v + c)[l] += static_cast<R>(weight) * inside[c];
          sum += R(0.5) * static_cast<R>(weight) * inside[c] * inside[c];
        }
      }
      for (int k = 0; k < W; ++k) {
        if (cells == 1 || k == l) energy.set(k, sum);
      }
    }
    return energy;
  }

  void iterate() {
    P value = evaluate(here_, gradient_);
    M running = cells_of<Shape, M>(task_.active);
    for (int l = 0; l < cells; ++l) {
      report_[l] = {};
      report_[l].tolerance = settings_.lineage_tolerance;
      recent_[l] = static_cast<double>(value[l]);
      num_recent_[l] = 1;
      failed_searches_[l] = 0;
    }
    search_.choose(M::none(), Matrix3<P>{});
    while (running.any() && settings_.max_iterations > 0) {
      search_.direction(gradient_, direction_);
      P next = value;
      const M failed = wolfe_search(running, value, next);
      search_.remember(here_, there_, gradient_, trial_gradient_, R(-2));
      swap_fields(here_, there_);
      swap_fields(gradient_, trial_gradient_);
      value = next;
      const P norm = square_root(inner<Shape>(gradient_, gradient_, length_));
      for (int l = 0; l < cells; ++l) {
        if (running[l]) judge(running, l, static_cast<double>(value[l]), static_cast<double>(norm[l]), failed[l]);
      }
    }
    value_ = value;
  }

  /// Halves the step until Armijo and curvature conditions hold; the last trial stands even where they do not. Returns
  /// the cells for which they did not.
  M wolfe_search(M running, P value, P& next) {
    const P slope = inner<Shape>(gradient_, direction_, length_);
    P step = select(running, P(R(1)), P(R(0)));
    M searching = running;
    for (int trial = 0; trial < settings_.max_line_search; ++trial) {
      if (trial > 0) step = select(searching, R(0.5) * step, step);
      for (int i = 0; i < length_; ++i) there_[i] = here_[i] + step * direction_[i];
      next = evaluate(there_, trial_gradient_);
      for (int l = 0; l < cells; ++l) report_[l].evaluations += searching[l] ? 1 : 0;
      // In single precision the fall drowns in the rounding of the objective; in double the lineage's test stands.
      const P noise = sizeof(R) == 8 ? P(R(0)) : R(16) * epsilon<R> * magnitude(value);
      const M armijo = next <= value + static_cast<R>(settings_.lineage_armijo) * step * slope + noise;
      const M curvature =
          static_cast<R>(settings_.lineage_curvature) * slope <= inner<Shape>(trial_gradient_, direction_, length_);
      searching = searching & !(armijo & curvature);
      if (!searching.any()) break;
    }
    return searching;
  }

  /// Counts the iteration of one cell and ends it on a small gradient, a small scatter, or too many failed searches.
  void judge(M& running, int l, double value, double norm, bool failed) {
    ++report_[l].iterations;
    failed_searches_[l] += failed ? 1 : 0;
    recent_[num_recent_[l] % settings_.lineage_window * cells + l] = value;
    ++num_recent_[l];
    if (norm <= settings_.lineage_tolerance || scatter_is_small(l) ||
        failed_searches_[l] >= settings_.lineage_attempts || report_[l].iterations >= settings_.max_iterations) {
      set_cell<Shape>(running, l, false);
    }
  }

  bool scatter_is_small(int l) const {
    const int window = settings_.lineage_window;
    if (num_recent_[l] < window) return false;
    double mean = 0, square = 0;
    for (int k = 0; k < window; ++k) mean += recent_[k * cells + l];
    mean /= window;
    for (int k = 0; k < window; ++k) {
      const double gap = recent_[k * cells + l] - mean;
      square += gap * gap;
    }
    return __builtin_fabs(__builtin_sqrt(square / (window - 1)) / mean) <= settings_.lineage_tolerance;
  }

  /// Removal of the share Calpha of the velocity that is not that of a rigid body, then the new state.
  void finish() {
    const cpu::CellBlock& b = task_.block;
    const double dt = settings_.time_step, alpha = settings_.lineage_alpha;
    bool takes_step[cells];
    double worst[cells] = {};
    for (int i = 0; i < 3 * n_; ++i) {
      for (int l = 0; l < cells; ++l) {
        const auto g = static_cast<double>(Fields::row(gradient_, i)[l]);
        worst[l] = larger(worst[l], g < 0 ? -g : g);
        // The direction's memory now holds velocities, um/us.
        Fields::row(direction_, i)[l] =
            static_cast<R>(static_cast<double>(Fields::row(here_, i)[l] - Fields::row(start_, i)[l]) / dt);
      }
    }
    for (int l = 0; l < cells; ++l) {
      takes_step[l] = (task_.active >> l & 1u) != 0;
      if (!takes_step[l]) continue;
      report_[l].residual = worst[l];
      const bool finite = __builtin_isfinite(static_cast<double>(value_[l])) && __builtin_isfinite(worst[l]);
      if (!finite) report_[l].status = CellStatus::not_finite;
      takes_step[l] = finite;
      b.report[task_.first_lane + l] = report_[l];
    }
    find_rigid_motion();
    for (int v = 0; v < n_; ++v) {
      for (int l = 0; l < cells; ++l) {
        if (!takes_step[l]) continue;
        const RigidMotion& m = motion_[l];
        double r[3], velocity[3];
        for (int c = 0; c < 3; ++c) {
          r[c] = static_cast<double>(Fields::row(here_, 3 * v + c)[l]) - m.centre[c];
          velocity[c] = static_cast<double>(Fields::row(direction_, 3 * v + c)[l]);
        }
        for (int c = 0; c < 3; ++c) {
          const int d = (c + 1) % 3, e = (c + 2) % 3;
          const double rigid = m.velocity[c] + m.spin[d] * r[e] - m.spin[e] * r[d];
          const double kept = velocity[c] + alpha * (rigid - velocity[c]);
          fields_.from(b.velocity, 3 * v + c)[l] = kept;
          fields_.from(b.position, 3 * v + c)[l] += dt * kept;
          if (b.lag_velocity) fields_.from(b.lag_velocity, 3 * v + c)[l] = 0;
          if (b.lag_acceleration) fields_.from(b.lag_acceleration, 3 * v + c)[l] = 0;
        }
      }
    }
  }

  struct RigidMotion {
    double centre[3], velocity[3], spin[3];
  };

  /// The rigid motion of each cell with its momentum and angular momentum.
  void find_rigid_motion() {
    double total = 0, moment[9][cells] = {}, angular[3][cells] = {}, centre[3][cells] = {}, speed[3][cells] = {};
    for (int v = 0; v < n_; ++v) {
      const double mass = task_.solid_mass[v];
      total += mass;
      for (int c = 0; c < 3; ++c) {
        for (int l = 0; l < cells; ++l) {
          centre[c][l] += mass * static_cast<double>(Fields::row(here_, 3 * v + c)[l]);
          speed[c][l] += mass * static_cast<double>(Fields::row(direction_, 3 * v + c)[l]);
        }
      }
    }
    for (int c = 0; c < 3; ++c) {
      for (int l = 0; l < cells; ++l) centre[c][l] /= total, speed[c][l] /= total;
    }
    for (int v = 0; v < n_; ++v) {
      const double mass = task_.solid_mass[v];
      double r[3][cells], u[3][cells];
      for (int c = 0; c < 3; ++c) {
        for (int l = 0; l < cells; ++l) {
          r[c][l] = static_cast<double>(Fields::row(here_, 3 * v + c)[l]) - centre[c][l];
          u[c][l] = static_cast<double>(Fields::row(direction_, 3 * v + c)[l]);
        }
      }
      for (int a = 0; a < 3; ++a) {
        const int d = (a + 1) % 3, e = (a + 2) % 3;
        for (int l = 0; l < cells; ++l) angular[a][l] += mass * (r[d][l] * u[e][l] - r[e][l] * u[d][l]);
        for (int c = 0; c < 3; ++c) {
          for (int l = 0; l < cells; ++l) moment[3 * a + c][l] += mass * r[a][l] * r[c][l];
        }
      }
    }
    for (int l = 0; l < cells; ++l) {
      double inertia[9], about[3];
      const double trace = moment[0][l] + moment[4][l] + moment[8][l];
      for (int k = 0; k < 9; ++k) inertia[k] = (k % 4 == 0 ? trace : 0.0) - moment[k][l];
      for (int c = 0; c < 3; ++c) {
        motion_[l].centre[c] = centre[c][l];
        motion_[l].velocity[c] = speed[c][l];
        about[c] = angular[c][l];
      }
      solve3(inertia, about, motion_[l].spin);
    }
  }

  /// x = m^-1 b of a 3 x 3 matrix by cofactors.
  static void solve3(const double (&m)[9], const double (&b)[3], double (&x)[3]) {
    double cofactor[9];
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        cofactor[3 * r + c] = m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
      }
    }
    const double determinant = m[0] * cofactor[0] + m[1] * cofactor[1] + m[2] * cofactor[2];
    for (int c = 0; c < 3; ++c)
      x[c] = (cofactor[c] * b[0] + cofactor[3 + c] * b[1] + cofactor[6 + c] * b[2]) / determinant;
  }

  const cpu::StepTask<R, H>& task_;
  const cpu::StepSettings& settings_;
  const cpu::CellPlan<R>& plan_;
  int n_, length_;
  Fields fields_;
  QuasiNewton<Shape, R, H, W> search_;
  P *start_, *inertial_, *mass_, *here_, *there_, *gradient_, *trial_gradient_, *direction_, *departure_,
      *area_gradient_, *volume_gradient_;
  double* recent_;
  int num_recent_[cells], failed_searches_[cells];
  P value_;
  CellReport report_[cells];
  RigidMotion motion_[cells];
};

}  // namespace npfem::NPFEM_ISA
