// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "geometry/domain.h"

namespace npfem::flow {

/// An estimate of the steady flow without cells where the walls vary along it, as in lubrication theory (e.g.
/// Batchelor, An Introduction to Fluid Dynamics, 4.8): the same rate of flow (um3/us) passes every section, with the
/// profile that a long channel of that section would have. Where the section changes within less than its width the
/// true flow meets more resistance and is slower.
struct ChannelFlow {
  double widest_area = 0;     ///< um2
  double narrowest_area = 0;  ///< um2
  double resistance = 0;      ///< pressure drop (Pa) over rate of flow times dynamic viscosity, 1/um3
  double fastest = 0;         ///< largest velocity over rate of flow, 1/um2
  double steepest = 0;        ///< largest shear rate over rate of flow, 1/um3

  double rate_under(double pressure_drop, double dynamic_viscosity) const {
    return pressure_drop / (dynamic_viscosity * resistance);
  }
};

/// Along an axis; none where a section is closed.
std::optional<ChannelFlow> channel_flow(const Domain& domain, std::size_t axis);

}  // namespace npfem::flow
