// SPDX-License-Identifier: MPL-2.0
#include "coupling/momentum_audit.h"

#include <cmath>

#include "geometry/vec3.h"

namespace npfem::flow {

void MomentumAudit::start(const Lattice& lattice) {
  impulse_ = {};
  cell_scale_ = {};
  fluid_scale_ = {};
  start_momentum_ = lattice.momentum();
  start_force_ = force_;
}

void MomentumAudit::hold(const Lattice& lattice, const Vec3& external, double magnitude) {
  const Vec3 body = scale(static_cast<double>(lattice.nodes().fluid_nodes()), lattice.options().body_force);
  force_ = add(body, external);
  body_magnitude_ = norm(body);
  cell_magnitude_ = magnitude;
}

void MomentumAudit::count_step(const Lattice& lattice) {
  const Vec3& walls = lattice.wall_impulse();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    impulse_[axis].add(walls[axis]);
    impulse_[axis].add(force_[axis]);
  }
  cell_scale_.add(cell_magnitude_);
  fluid_scale_.add(body_magnitude_ + norm(walls));
}

MomentumAudit::Record MomentumAudit::record(Communicator& communicator) const {
  Record record{impulse_[0].value(), impulse_[1].value(), impulse_[2].value(), start_momentum_[0],   start_momentum_[1],
                start_momentum_[2],  start_force_[0],     start_force_[1],     start_force_[2],      force_[0],
                force_[1],           force_[2],           cell_scale_.value(), fluid_scale_.value(), body_magnitude_,
                cell_magnitude_};
  communicator.sum(record);
  return record;
}

void MomentumAudit::restore(const Record& record) {
  *this = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    impulse_[axis].add(record[axis]);
    start_momentum_[axis] = record[3 + axis];
    start_force_[axis] = record[6 + axis];
    force_[axis] = record[9 + axis];
  }
  cell_scale_.add(record[12]);
  fluid_scale_.add(record[13]);
  body_magnitude_ = record[14];
  cell_magnitude_ = record[15];
}

double MomentumAudit::error(const Lattice& lattice, Communicator& communicator) const {
  const Vec3 momentum = lattice.momentum();
  std::array<double, 5> totals{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CompensatedSum unexplained = impulse_[axis];
    unexplained.add(0.5 * (force_[axis] - start_force_[axis]));
    unexplained.add(start_momentum_[axis]);
    unexplained.add(-momentum[axis]);
    totals[axis] = unexplained.value();
  }
  totals[3] = cell_scale_.value();
  totals[4] = fluid_scale_.value();
  communicator.sum(totals);
  const double unexplained = norm({totals[0], totals[1], totals[2]});
  const double all_forces = totals[3] > 0 ? totals[3] : totals[4];
  return all_forces > 0 ? unexplained / all_forces : unexplained;
}

}  // namespace npfem::flow
