// SPDX-License-Identifier: MPL-2.0
#pragma once

// A short run that touches everything the fluid solver does: random start, body force, forces that change, walls that
// move, a box that no rank count divides.

#include <string>
#include <vector>

#include "communicator/communicator.h"
#include "flows.h"

namespace flows {

struct InvarianceCase {
  std::string name;
  Index3 nodes;
  std::array<bool, 3> periodic;
  Geometry geometry;
};

inline std::vector<InvarianceCase> invariance_cases() {
  return {{"periodic", {13, 11, 17}, {true, true, true}, periodic()},
          {"plates", {13, 11, 17}, {true, false, true}, plates(1, 11, {-0.02, 0.0, 0.01}, {0.03, 0.0, 0.0})},
          {"tube", {19, 13, 13}, {true, false, false}, tube(13, 6.2)}};
}

inline std::uint64_t hash_after_run(npfem::flow::Communicator& communicator, const InvarianceCase& run, int steps) {
  const npfem::flow::Decomposition split(run.nodes, run.periodic, communicator.size());
  npfem::flow::Lattice lattice(communicator, split, run.geometry, {0.7, 3.0 / 16.0, {1e-5, 0.0, -2e-5}});
  lattice.initialise([&](int ix, int iy, int iz) {
    const auto id = split.global_id(ix, iy, iz);
    return npfem::flow::FluidState{1e-3 * random_value(id, -1), random_vector(id, -2, 0.02)};
  });
  for (int step = 0; step < steps; ++step) {
    lattice.update_velocity();
    lattice.clear_force();
    add_random_force(lattice, step, 1e-4);
    lattice.step();
  }
  return communicator.sum_hash(lattice.state_hash());
}

}  // namespace flows
