// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "coupling/coupling.h"

namespace npfem::flow {

/// The explicit immersed boundary method (Peskin, Acta Numerica 11 (2002) 479): elastic forces and contacts at x_n are
/// spread at x_n, and after the fluid has moved the vertices follow it with its new velocity at x_n. No slip and no
/// compliance: the yardstick for the implicit scheme, as long as the membrane is soft enough for it to be stable.
///
/// A vertex has no mass of its own here; a model with solid mass is refused (std::invalid_argument).
class PeskinCoupling final : public Coupling {
 public:
  PeskinCoupling(const Setup& setup, ImmersedSolid& solid, Fluid& fluid);
  CellStepReport load_fluid() override;
  CellStepReport follow_fluid() override;

 private:
  bool follow(std::size_t first, std::size_t count);
};

}  // namespace npfem::flow
