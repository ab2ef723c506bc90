// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace npfem::flow {

/// What two surfaces at distance d do to each other: a traction along the normal, in pN/um2 = Pa, that has a potential.
///   repulsion   strength (1 - d/range)^2                               below `range`, growing on behind the surface
///   attraction  -(depth/width) c 2 (e^-s - e^-2s) (1 - (s/4)^2)^2      s = (d - range)/width from 0 to 4
/// The attraction is that of Morse's potential about d = range, brought to zero smoothly at s = 4; c = 1.411 makes the
/// work of parting two surfaces exactly `depth`. Force and slope are continuous at both ends of each; at d = range the
/// force is, and it vanishes there.
struct ContactLaw {
  double range = 0;     ///< um; 0 switches the law off
  double strength = 0;  ///< Pa, at touch
  double depth = 0;     ///< uN/m = 1e-6 J/m2, of the attraction; 0: none
  double width = 0;     ///< um, of the attraction

  bool active() const { return range > 0; }
  /// No force from this distance on, um.
  double reach() const;
  /// Pa; positive pushes apart. Behind the surface (d < 0) it grows up to 4 strength at d = -range and no further.
  double traction(double distance) const;
  /// The least slope -d(traction)/dd >= 0 that bounds the stiffness of the contact from above, Pa/um.
  double slope(double distance) const;
};

}  // namespace npfem::flow
