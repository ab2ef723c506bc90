// SPDX-License-Identifier: MPL-2.0
#pragma once

// Capsules of two types, in contact, that the flow carries out of a tube one after the other.

#include "capsules.h"
#include "simulation/setup.h"

namespace capsules {

inline npfem::flow::Setup leaving(npfem::flow::CouplingScheme scheme, int every) {
  using npfem::flow::CouplingScheme;
  using npfem::flow::Face;
  using npfem::flow::Opening;
  npfem::flow::Setup setup = fluid(DomainKind::tube, {13, 13, 24}, 0.9);
  setup.domain.openings = {{.face = Face::z_low, .kind = Opening::Kind::velocity, .mean_velocity = 0.08},
                           {.face = Face::z_high, .kind = Opening::Kind::pressure}};
  setup.coupling = {scheme, 4, every};
  setup.contact.cells = {1.5, 2e-3};
  setup.contact.walls = {1.5, 2e-3};
  const std::string density = scheme == CouplingScheme::lineage ? "membrane_density = \"1.5 fg/um2\"\n" : "";
  setup.types = {inflated(capsule("sphere", 2, 2.2, neo_hookean(0.02) + density), 1.03),
                 capsule("icosphere", 1, 1.6, skalak(0.02, 2) + density)};
  setup.types[1].name = "other";
  place(setup, 0, {6.5, 6.2, 14.3});
  place(setup, 1, {6.6, 6.5, 18.6});
  place(setup, 1, {4.8, 6.5, 10.8});
  place(setup, 1, {8.2, 6.4, 11.2});
  return setup;
}

}  // namespace capsules
