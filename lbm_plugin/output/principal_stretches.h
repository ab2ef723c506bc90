// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace npfem::flow {

/// How much a triangle of a membrane is stretched in its plane, along the two perpendicular directions in which it is
/// stretched most and least.
struct PrincipalStretches {
  double larger, smaller;
};

/// Of every triangle against the same triangle of another shape: the square roots of the eigenvalues of g0^-1 g, where
/// g = [a.a a.b; a.b b.b] is the metric of the edges a and b from the first corner, and g0 that of the other shape.
std::vector<PrincipalStretches> principal_stretches(std::span<const double> unstretched, std::span<const double> xyz,
                                                    std::span<const std::int32_t> triangles);

/// The largest of them; 1 without triangles.
double largest_stretch(std::span<const PrincipalStretches> stretches);

}  // namespace npfem::flow
