// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>

namespace npfem::flow {

enum class Collision : std::uint8_t {
  trt,          // two relaxation times (Ginzburg, Verhaeghe & d'Humieres 2008): walls stay in place at any viscosity
  bgk,          // one relaxation time
  regularised,  // one relaxation time; only the stress part of the departure from equilibrium survives a collision
                // (Latt & Chopard 2006)
};

enum class FluidPrecision : std::uint8_t { in_double, in_float };

}  // namespace npfem::flow
