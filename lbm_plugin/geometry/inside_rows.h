// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace npfem::flow {

/// Nodes begin <= i < end of the row (j, k) along x, unwrapped: node i stands at i + 1/2.
struct NodeRow {
  int begin, end;
  int j, k;
};

/// The nodes inside a closed surface; xyz of its vertices in node spacings. Where the surface folds over itself, those
/// that an odd number of sheets separates from the outside along the row.
///
/// A row along x goes through a triangle where, in the y-z plane, a ray from the row crosses an odd number of its
/// edges. Whether it crosses an edge depends on the edge alone, which two triangles share: however the numbers are
/// rounded, a row meets a closed surface an even number of times, and no row leaks out through an edge or a vertex.
std::vector<NodeRow> rows_inside(std::span<const double> xyz, std::span<const std::int32_t> triangles);

}  // namespace npfem::flow
