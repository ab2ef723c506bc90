// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>

#include "geometry/vec3.h"

namespace npfem::flow {

/// The rotation that brings the vertices of `shape` (about the origin, um) nearest to those of `placed` about its
/// middle: the orthogonal factor of their covariance, which solves Procrustes' problem (Schoenemann, Psychometrika 31
/// (1966) 1), by Newton's iteration (Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160). No rotation where the placed
/// body is flat or turned inside out.
Rotation rotation_between(std::span<const double> shape, std::span<const double> placed);

/// Mean of the vertices, um.
Vec3 middle_of(std::span<const double> xyz);

}  // namespace npfem::flow
