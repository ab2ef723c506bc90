// SPDX-License-Identifier: MPL-2.0
#pragma once

// Capsules of two types across faces, edges and corners of any split of the box, under tension and in contact; in the
// periodic box the body force carries them through several blocks.

#include "capsules.h"
#include "simulation/setup.h"

namespace capsules {

inline npfem::flow::Setup crowd(npfem::flow::DomainKind kind, npfem::flow::CouplingScheme scheme, int every) {
  using npfem::flow::DomainKind;
  using npfem::flow::Vec3;
  npfem::flow::Setup setup = fluid(kind, {17, 13, 15}, 0.9);
  setup.domain.plate_speed = 0.24;
  setup.domain.tube_radius = 6.4;
  setup.body_force = kind == DomainKind::periodic_box ? Vec3{9e-4, 7e-4, 1e-3} : Vec3{2e-4, 0, 3e-4};
  setup.start_developed = kind != DomainKind::tube;
  setup.coupling = {scheme, 4, every};
  setup.contact.cells = {1.5, 2e-3};
  setup.contact.walls = {1.5, 2e-3};
  setup.types = {inflated(capsule("sphere", 2, 2.6, neo_hookean(0.02)), 1.03),
                 capsule("icosphere", 1, 1.8, skalak(0.02, 2))};
  place(setup, 0, {8.4, 9.2, 7.4});
  place(setup, 0, {8.6, 3.8, 7.6});
  place(setup, 1, {8.1, 6.4, 0.3});
  place(setup, 1, {8.5, 6.6, 11.4});
  if (kind != DomainKind::tube) place(setup, 0, {0.1, 6.5, 3.9});
  return setup;
}

}  // namespace capsules
