// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <initializer_list>

#include "backend/cpu/kernel/cell_fields.h"
#include "backend/cpu/kernel/epsilon.h"
#include "backend/cpu/kernel/lane_search.h"
#include "backend/cpu/kernel/quasi_newton.h"
#include "backend/cpu/kernel/shape_match.h"

namespace npfem::NPFEM_ISA {

/// One implicit step of W cells at once, or of one: the algorithm of the back end "reference" (time_step.h,
/// minimise.cpp, objective.cpp), which says what each formula means. All cells iterate together; one that has converged
/// or failed stands still until the others are done, and nothing a cell does is felt by its neighbours.
template <class Shape, class R, class H, int W>
class ImplicitStep {
  using P = Pack<R, W>;
  using M = Mask<R, W>;
  using Fields = CellFields<Shape, R>;
  static constexpr int cells = Shape::cells;

 public:
  ImplicitStep(const cpu::StepTask<R, H>& task, Carver& memory)
      : task_(task),
        settings_(*task.settings),
        plan_(*task.plan),
        n_(plan_.num_vertices),
        length_(Shape::length(n_)),
        fields_(task.block, task.first_lane, n_, plan_.is_translation_invariant),
        search_(*task.matrices, n_, settings_.history, memory) {
    for (P** field : {&start_, &inertia_, &drift_, &force_, &tied_, &last_move_, &here_, &there_, &gradient_,
                      &trial_gradient_, &direction_, &position_, &area_gradient_, &volume_gradient_}) {
      *field = memory.take<P>(length_);
    }
  }

  void run() {
    prepare();
    choose_matrix();
    minimise();
    bool moves[cells] = {};
    for (int l = 0; l < cells; ++l) {
      const bool takes_part = (task_.active >> l & 1u) != 0 && !left_[l];
      if (takes_part) task_.block.report[task_.first_lane + l] = report_[l];
      const bool is_left = settings_.leave_short && report_[l].status == CellStatus::iteration_cap;
      moves[l] = takes_part && !has_failed(report_[l].status) && !is_left;
    }
    finish(moves);
  }

 private:
  void prepare() {
    if (cells == 1) {  // the tails of the fields
      for (P* field : {start_, inertia_, drift_, force_, tied_, here_, there_, direction_})
        field[length_ - 1] = P(R(0));
    }
    const cpu::CellBlock& b = task_.block;
    const double per_square = 1 / (settings_.lead * settings_.lead);
    for (int i = 0; i < n_; ++i) {
      double fluid_mass[cells] = {}, per_mass[cells], stiffness[cells] = {};
      const double solid = task_.solid_mass[i];
      if (b.ambient_mass) {
        const double* const mass = fields_.from(b.ambient_mass, i);
        for (int l = 0; l < cells; ++l) fluid_mass[l] = mass[l];
      }
      // Lanes without a cell may have no mass.
      for (int l = 0; l < cells; ++l) per_mass[l] = 1 / larger(solid + fluid_mass[l], 1e-300);
      if (b.contact_stiffness) {
        const double* const k = fields_.from(b.contact_stiffness, i);
        for (int l = 0; l < cells; ++l) stiffness[l] = k[l];
      }
      for (int c = 0; c < 3; ++c) {
        prepare_row(3 * i + c, per_square, fluid_mass, per_mass);
        if (b.contact_stiffness) meet_contacts(3 * i + c, stiffness);
      }
    }
  }

  /// The springs of the contacts, at rest at x_n + dt v_n. A vertex without contact keeps its bits.
  void meet_contacts(int row, const double* stiffness) {
    const double* const v = fields_.from(task_.block.velocity, row);
    for (int l = 0; l < cells; ++l) {
      const auto inertia = static_cast<double>(Fields::row(inertia_, row)[l]) + stiffness[l];
      const auto drift = static_cast<double>(Fields::row(drift_, row)[l]);
      const double met = drift + stiffness[l] / inertia * (settings_.time_step * v[l] - drift);
      Fields::row(inertia_, row)[l] = static_cast<R>(inertia);
      Fields::row(drift_, row)[l] = static_cast<R>(stiffness[l] > 0 ? met : drift);
      Fields::row(here_, row)[l] = Fields::row(drift_, row)[l];
    }
  }

  void prepare_row(int row, double per_square, const double* fluid_mass, const double* per_mass) {
    const double dt = settings_.time_step, past = settings_.past;
    const cpu::CellBlock& b = task_.block;
    const double solid = task_.solid_mass[row / 3];
    const double* const x = fields_.from(b.position, row);
    const double* const v = fields_.from(b.velocity, row);
    double drift[cells], force[cells] = {};
    for (int l = 0; l < cells; ++l) drift[l] = solid * v[l];
    if (past > 0) {
      const double* const acceleration = fields_.from(b.lag_acceleration, row);
      for (int l = 0; l < cells; ++l) drift[l] += solid * past * dt * acceleration[l];
    }
    if (b.ambient_velocity) {
      const double* const u = fields_.from(b.ambient_velocity, row);
      for (int l = 0; l < cells; ++l) drift[l] += fluid_mass[l] * u[l];
    }
    for (int l = 0; l < cells; ++l) drift[l] *= settings_.lead * per_mass[l];
    if (past > 0) {
      double last[cells];
      last_move(row, last);
      for (int l = 0; l < cells; ++l) {
        drift[l] += past * last[l];
        if (plan_.is_viscous) Fields::row(last_move_, row)[l] = static_cast<R>(last[l]);
      }
    } else if (plan_.is_viscous) {
      for (int l = 0; l < cells; ++l) Fields::row(last_move_, row)[l] = 0;
    }
    if (b.external_force) {
      const double* const external = fields_.from(b.external_force, row);
      for (int l = 0; l < cells; ++l) force[l] += external[l];
    }
    if (b.held_force) {
      const double* const held = fields_.from(b.held_force, row);
      for (int l = 0; l < cells; ++l) force[l] -= held[l];
    }
    const double* const centre = fields_.centre[row % 3];
    for (int l = 0; l < cells; ++l) {
      Fields::row(start_, row)[l] = static_cast<R>(x[l] - centre[l]);
      Fields::row(inertia_, row)[l] = static_cast<R>((solid + fluid_mass[l]) * per_square);
      Fields::row(drift_, row)[l] = static_cast<R>(drift[l]);
      Fields::row(here_, row)[l] = static_cast<R>(drift[l]);
      Fields::row(force_, row)[l] = static_cast<R>(force[l]);
    }
    if (b.tied_at) {
      const double* const tied = fields_.from(b.tied_at, row);
      for (int l = 0; l < cells; ++l) Fields::row(tied_, row)[l] = static_cast<R>(x[l] - tied[l]);
    }
  }

  /// x_n - x_{n-1}, um.
  void last_move(int row, double (&move)[cells]) const {
    const double* const v = fields_.from(task_.block.velocity, row);
    const double* const lag = fields_.from(task_.block.lag_velocity, row);
    for (int l = 0; l < cells; ++l) move[l] = settings_.time_step * (v[l] + lag[l]);
  }

  /// The Hessian of the rest shape is the better guide where the cell still resembles that shape, whichever way it is
  /// turned; far from it the scalar matrix is cheaper and no worse (docs/solver.md).
  void choose_matrix() {
    Matrix3<P> rotation{};
    M blocks = M::none();
    if (task_.matrices->has_block) {
      const ShapeMatch<P> match = match_shape<Shape, R>(start_, task_.rest_shape, n_);
      rotation = match.rotation;
      blocks = match.not_orthogonal < P(R(1e-4));
      if (!settings_.always_blocks) blocks = blocks & (match.strain_square < P(R(largest_strain_square)));
    }
    search_.choose(blocks, rotation);
  }

  /// Phi at displacements d; writes its gradient and the sum of the magnitudes of its parts.
  P evaluate(const P* d, P* gradient, P& scale) {
    P kinetic(R(0)), work(R(0));
    for (int i = 0; i < length_; ++i) {
      const P from_drift = d[i] - drift_[i], pull = inertia_[i] * from_drift;
      kinetic += pull * from_drift;
      work += force_[i] * d[i];
      gradient[i] = pull - force_[i];
      position_[i] = start_[i] + d[i];
    }
    kinetic = R(0.5) * Shape::sum(kinetic);
    work = Shape::sum(work);
    P energies[cpu::num_energies];
    for (P& e : energies) e = P(R(0));
    const P elastic = Shape::forces(plan_, position_, gradient, area_gradient_, volume_gradient_, energies);
    P dissipated(R(0)), held(R(0));
    if (plan_.is_viscous) {
      const R per_lead = static_cast<R>(1 / settings_.lead);
      dissipated =
          Shape::viscous_forces(plan_, {plan_.viscosity.shear * per_lead, plan_.viscosity.dilatational * per_lead},
                                static_cast<R>(settings_.past), start_, last_move_, d, gradient);
    }
    for (int p = 0; p < task_.num_patches; ++p) held += patch_energy(task_.patches[p], d, gradient);
    scale = kinetic + magnitude(work) + magnitude(elastic) + dissipated + held;
    return kinetic - work + elastic + dissipated + held;
  }

  /// Springs from the vertices of a patch to where its mean displacement would bring them.
  P patch_energy(const cpu::PatchView<R>& patch, const P* d, P* gradient) {
    P energy(R(0));
    for (int c = 0; c < 3; ++c) {
      R mean[cells] = {}, square[cells] = {};
      for (int k = 0; k < patch.count; ++k) {
        const int row = 3 * patch.vertices[k] + c;
        for (int l = 0; l < cells; ++l) mean[l] += Fields::row(tied_, row)[l] + Fields::row(d, row)[l];
      }
      for (int l = 0; l < cells; ++l) mean[l] /= static_cast<R>(patch.count);
      for (int k = 0; k < patch.count; ++k) {
        const int row = 3 * patch.vertices[k] + c;
        for (int l = 0; l < cells; ++l) {
          const R departure = Fields::row(tied_, row)[l] + Fields::row(d, row)[l] - mean[l];
          Fields::row(gradient, row)[l] += patch.stiffness * departure;
          square[l] += departure * departure;
        }
      }
      for (int l = 0; l < W; ++l) energy.set(l, energy[l] + R(0.5) * patch.stiffness * square[cells == 1 ? 0 : l]);
    }
    return energy;
  }

  P residual(const P* gradient) const {
    P most(R(0));
    for (int i = 0; i < length_; ++i) most = larger(most, magnitude(gradient[i]));
    return Shape::largest(most);
  }

  P slope_along_direction(const P* gradient) const { return inner<Shape>(gradient, direction_, length_); }

  /// What rounding allows, or the tolerance asked for where that is more.
  P tolerance() const {
    P drift(R(0)), reach(R(0)), inertia(R(0));
    for (int i = 0; i < length_; ++i) {
      drift = larger(drift, magnitude(drift_[i]));
      reach = larger(reach, magnitude(start_[i]));
      inertia = larger(inertia, inertia_[i]);
    }
    // In single precision positions are about the cell's centre and rounding is not in the worst place everywhere.
    const R ulps = sizeof(R) == 8 ? R(32) : R(2);
    const P motion = Shape::largest(inertia) + plan_.viscous_diagonal * static_cast<R>(1 / settings_.lead);
    const P attainable =
        ulps * epsilon<R> * (motion * Shape::largest(drift) + plan_.stiffest_diagonal * Shape::largest(reach));
    return larger(P(static_cast<R>(settings_.tolerance)), attainable);
  }

  void minimise() {
    P scale, value = evaluate(here_, gradient_, scale);
    const P limit = tolerance();
    P worst = residual(gradient_);
    M running = cells_of<Shape, M>(task_.active);
    for (int l = 0; l < cells; ++l) {
      report_[l] = {};
      report_[l].evaluations = 1;
      report_[l].tolerance = static_cast<double>(limit[l]);
    }
    stop(running, !(is_finite(value) & is_finite(worst)), CellStatus::not_finite, worst);
    stop(running, worst <= limit, CellStatus::converged, worst);
    M remembers = M::none();
    worst_before_ = worst;
    while (running.any()) {
      stop_at_cap(running, worst);
      if (!running.any()) break;
      for (int l = 0; l < cells; ++l) {
        report_[l].iterations += running[l] ? 1 : 0;
        report_[l].hessian_iterations += running[l] && search_.uses_blocks(l) ? 1 : 0;
      }
      search_.direction(gradient_, direction_);
      P slope = slope_along_direction(gradient_);
      const M uphill = running & !(slope < P(R(0)));
      if (uphill.any()) {
        search_.forget(uphill);
        search_.direction(gradient_, direction_);
        slope = slope_along_direction(gradient_);
      }
      P next_value = value, next_scale = scale;
      const M failed = line_search(running, slope, value, scale, next_value, next_scale);
      if (failed.any()) {
        // A cell with a memory tries again without it; one without has nowhere to go.
        keep(failed);
        next_value = select(failed, value, next_value);
        next_scale = select(failed, scale, next_scale);
        search_.forget(failed);
        stop_failed(running, failed & !remembers, worst);
      }
      search_.remember(here_, there_, gradient_, trial_gradient_, R(1e-12));
      remembers = (remembers | running) & !failed;
      swap_fields(here_, there_);
      swap_fields(gradient_, trial_gradient_);
      value = next_value, scale = next_scale;
      worst = residual(gradient_);
      stop(running, worst <= limit, CellStatus::converged, worst);
      leave_poor_guides(running, worst);
      if (task_.left && is_waste(running.count())) {
        for (int l = 0; l < cells; ++l) {
          left_[l] = running[l];
          *task_.left |= running[l] ? 1u << l : 0u;
        }
        return;
      }
    }
  }

  /// Whether the cells still iterating are so few, and have been for so long, that starting them again among others
  /// costs less than letting the whole pack wait for them.
  bool is_waste(int running) {
    ++rounds_;
    if (running == 0 || 4 * running > cells) return false;
    if (few_since_ == 0) few_since_ = rounds_;
    return rounds_ - few_since_ >= 1 + few_since_ / 3;
  }

  /// A Hessian that still has not brought a cell's residual down after a few iterations is no better there than the
  /// scalar matrix, which costs less and bounds the curvature from above.
  void leave_poor_guides(M running, P worst) {
    M leaving = M::none();
    for (int l = 0; l < W; ++l) {
      const int cell = cells == 1 ? 0 : l;
      if (!running[l] || report_[cell].iterations % trial_iterations != 0 || !search_.uses_blocks(l)) continue;
      if (worst[l] > worth_keeping * worst_before_[l]) leaving.set(l, true);
      worst_before_.set(l, worst[l]);
    }
    if (leaving.any()) search_.fall_back(leaving);
  }

  /// Moves every running cell along its direction until its objective has fallen enough, or its change drowns in
  /// rounding and the slope has become flatter (Hager & Zhang 2005). Returns the cells for which no trial did.
  M line_search(M running, P slope, P value, P scale, P& next_value, P& next_scale) {
    P step = select(running, P(R(1)), P(R(0)));
    M searching = running;
    for (int trial = 0; trial < settings_.max_line_search; ++trial) {
      for (int i = 0; i < length_; ++i) there_[i] = here_[i] + step * direction_[i];
      next_value = evaluate(there_, trial_gradient_, next_scale);
      for (int l = 0; l < cells; ++l) report_[l].evaluations += searching[l] ? 1 : 0;
      const P change = next_value - value;
      const M finite = is_finite(next_value) & is_finite(residual(trial_gradient_));
      const P noise = R(64) * epsilon<R> * larger(scale, next_scale);
      const M fallen = change <= R(1e-4) * step * slope;
      M accepted = finite & fallen;
      if ((searching & !accepted).any()) {
        const M flatter = magnitude(slope_along_direction(trial_gradient_)) <= R(0.9) * magnitude(slope);
        // A force that is no gradient has no hill to go down: the slope alone decides.
        const M unclear = plan_.has_potential ? magnitude(change) <= noise : M::all();
        accepted = accepted | (finite & unclear & flatter);
      }
      searching = searching & !accepted;
      if (!searching.any()) break;
      // Minimum of the parabola through value, slope and the new value.
      const P parabola = R(-0.5) * slope * step * step / (change - step * slope);
      const P shorter = select(finite, clamp(parabola, R(0.1) * step, R(0.5) * step), R(0.1) * step);
      step = select(searching, shorter, step);
    }
    return searching;
  }

  /// Puts the given cells back to where they are.
  void keep(M lanes) {
    for (int i = 0; i < length_; ++i) {
      there_[i] = select(lanes, here_[i], there_[i]);
      trial_gradient_[i] = select(lanes, gradient_[i], trial_gradient_[i]);
    }
  }

  void stop(M& running, M these, CellStatus status, P worst) {
    const M stopping = running & these;
    for (int l = 0; l < cells; ++l) {
      if (!stopping[l]) continue;
      report_[l].status = status;
      report_[l].residual = static_cast<double>(worst[l]);
    }
    running = running & !these;
  }
  void stop_at_cap(M& running, P worst) {
    for (int l = 0; l < cells; ++l) {
      if (!running[l] || report_[l].iterations < settings_.max_iterations) continue;
      stop_lane(running, l, worst, CellStatus::not_converged);
    }
  }
  void stop_failed(M& running, M lanes, P worst) {
    for (int l = 0; l < cells; ++l) {
      if (running[l] && lanes[l]) stop_lane(running, l, worst, CellStatus::no_descent);
    }
  }
  void stop_lane(M& running, int l, P worst, CellStatus otherwise) {
    const auto left = static_cast<double>(worst[l]);
    report_[l].status = left <= settings_.residual_bound ? CellStatus::iteration_cap : otherwise;
    report_[l].residual = left;
    set_cell<Shape>(running, l, false);
  }

  /// The rigid translation that makes momentum exact, then the new state of the cells that move.
  void finish(const bool (&moves)[cells]) {
    double shift[3][cells] = {}, inertia[cells] = {};
    for (int i = 0; i < n_; ++i) {
      for (int c = 0; c < 3; ++c) {
        const R* const g = Fields::row(gradient_, 3 * i + c);
        for (int l = 0; l < cells; ++l) shift[c][l] += static_cast<double>(g[l]);
      }
      const R* const m = Fields::row(inertia_, 3 * i);
      for (int l = 0; l < cells; ++l) inertia[l] += static_cast<double>(m[l]);
    }
    for (int c = 0; c < 3; ++c) {
      for (int l = 0; l < cells; ++l)
        shift[c][l] = inertia[l] > 0 && plan_.is_translation_invariant ? shift[c][l] / inertia[l] : 0.0;
    }
    for (int row = 0; row < 3 * n_; ++row) finish_row(row, shift[row % 3], moves);
  }

  void finish_row(int row, const double (&shift)[cells], const bool (&moves)[cells]) {
    const cpu::CellBlock& b = task_.block;
    const double dt = settings_.time_step, per_lead = 1 / settings_.lead;
    const R* const here = Fields::row(here_, row);
    double* const x = fields_.from(b.position, row);
    double* const v = fields_.from(b.velocity, row);
    double move[cells], velocity[cells];
    for (int l = 0; l < cells; ++l) velocity[l] = move[l] = static_cast<double>(here[l]) - shift[l];
    if (settings_.past > 0) {
      double last[cells];
      last_move(row, last);
      for (int l = 0; l < cells; ++l) velocity[l] -= settings_.past * last[l];
    }
    for (int l = 0; l < cells; ++l) velocity[l] *= per_lead;
    if (b.lag_velocity) {
      double* const lag = fields_.from(b.lag_velocity, row);
      double* const acceleration = fields_.from(b.lag_acceleration, row);
      for (int l = 0; l < cells; ++l) {
        if (!moves[l]) continue;
        lag[l] = settings_.looks_back ? move[l] / dt - velocity[l] : 0.0;
        acceleration[l] = settings_.looks_back ? (velocity[l] - v[l]) / dt : 0.0;
      }
    }
    if (b.held_force && b.ambient_mass) {
      double* const held = fields_.from(b.held_force, row);
      const double* const mass = fields_.from(b.ambient_mass, row / 3);
      const double* const u = b.ambient_velocity ? fields_.from(b.ambient_velocity, row) : nullptr;
      for (int l = 0; l < cells; ++l) {
        const double gain = mass[l] * (velocity[l] - (u ? u[l] : 0.0)) / dt;
        held[l] += moves[l] ? gain : 0.0;
      }
    }
    for (int l = 0; l < cells; ++l) {
      x[l] += moves[l] ? move[l] : 0.0;
      v[l] = moves[l] ? velocity[l] : v[l];
    }
  }

  static constexpr double largest_strain_square = 0.5;
  static constexpr int trial_iterations = 6;
  static constexpr R worth_keeping = R(0.1);

  const cpu::StepTask<R, H>& task_;
  const cpu::StepSettings& settings_;
  const cpu::CellPlan<R>& plan_;
  int n_, length_;
  Fields fields_;
  QuasiNewton<Shape, R, H, W> search_;
  P *start_, *inertia_, *drift_, *force_, *tied_, *last_move_, *here_, *there_, *gradient_, *trial_gradient_,
      *direction_, *position_, *area_gradient_, *volume_gradient_;
  P worst_before_;  // at the last judgement of the matrix, pN
  int rounds_ = 0, few_since_ = 0;
  bool left_[cells] = {};
  CellReport report_[cells];
};

}  // namespace npfem::NPFEM_ISA
