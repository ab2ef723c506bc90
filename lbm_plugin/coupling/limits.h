// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/setup.h"

namespace npfem::flow {

enum class Verdict {
  good,      ///< below the stricter bound: the error is a fraction of a percent
  fair,      ///< usable; not where volume must be kept to a fraction of a percent
  exceeded,  ///< the run is stable or not, but its answer is not to be trusted
  unknown,   ///< nothing can be said before the run
};

/// A number that says how far a setup is from where its method stops being accurate.
struct Limit {
  std::string name;     ///< for example "kappa_shear rbc"
  std::string meaning;  ///< what it is and what goes wrong when it is large
  double value;         ///< not a number where it is unknown
  double strict_bound;  ///< good up to here
  double bound;         ///< fair up to here
  Verdict verdict;
  std::string advice;  ///< a sentence on what this value means here and, where it is too large, what to change
};

/// The limits of time step and resolution, all without dimension:
///   tau                relaxation time in steps; the lattice is accurate in steady flow at any tau
///   tau_inside         the same inside cells whose fluid has a viscosity of its own
///   Ma                 fastest imposed flow over the lattice's speed of sound
///   gdot T             T = (tau - 1/2) dt: in time the lattice is a Maxwell fluid that forgets over T
///   kappa = delta^2 G / (rho ell a^2)   compliance of the implicit coupling with modulus G, once for the shear modulus
///                      and once for the largest; relative error in volume and deformation about kappa
///   spacing            distance of neighbouring vertices over half the width of the kernel: red cells in a tube
///                      let 0.3, 1.5 and 7 % more through at 0.77, 1.0 and 1.5 than on a mesh twice as fine
///   contact            viscous stress of the imposed flow over the pressure of contacts at touch: blood in a tube
///                      of 20 um pressed vertices 0.28 um into other cells at 0.14
///   3 G_s / (rho (dx/dt)^2 a)           compression of the lattice fluid inside a cell by its own tension
/// a is the radius of the sphere of the cell's rest area. `speed` (um/us) and `shear_rate` (1/us) are those of the flow
/// the scene imposes, where they are known.
std::vector<Limit> accuracy_limits(const Setup& setup, std::optional<double> speed, std::optional<double> shear_rate);

std::string verdict_name(Verdict verdict);  ///< "good", "fair", "exceeded", "unknown"

}  // namespace npfem::flow
