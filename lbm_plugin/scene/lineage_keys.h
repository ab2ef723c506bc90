// SPDX-License-Identifier: MPL-2.0
// Keys of a scene file: the settings of Palabos-npFEM.
#pragma once

#include "key.h"

namespace npfem::flow::keys {

using text::Dimension;
using text::Key;
using text::Kind;
using text::Range;

// [lineage]
namespace lineage {
inline constexpr Key alpha{.name = "alpha",
                           .range = Range::fraction,
                           .fallback = "0.9",
                           .doc = "`Calpha`: share of the non-rigid velocity taken away in each step of the cells."};
inline constexpr Key beta{.name = "beta",
                          .dimension = Dimension::time(),
                          .range = Range::non_negative,
                          .fallback = "0.01 us",
                          .doc = "`Cbeta`: damping proportional to stiffness."};
inline constexpr Key history{.name = "history",
                             .kind = Kind::integer,
                             .range = Range::non_negative,
                             .fallback = "5",
                             .doc = "Pairs of the search history: `m` - 2."};
inline constexpr Key max_iterations{
    .name = "max_iterations", .kind = Kind::integer, .range = Range::positive, .fallback = "30"};
inline constexpr Key max_line_search{
    .name = "max_line_search", .kind = Kind::integer, .range = Range::positive, .fallback = "5"};
inline constexpr Key attempts{.name = "attempts",
                              .kind = Kind::integer,
                              .range = Range::positive,
                              .fallback = "7",
                              .doc = "Failed line searches allowed in a step."};
inline constexpr Key window{.name = "window",
                            .kind = Kind::integer,
                            .range = Range::positive,
                            .fallback = "5",
                            .doc = "Objective values whose scatter is compared with `tolerance`."};
inline constexpr Key tolerance{.name = "tolerance", .range = Range::positive, .fallback = "1e-5"};
inline constexpr Key armijo{.name = "armijo", .range = Range::positive, .fallback = "1e-4", .doc = "`gamma`."};
inline constexpr Key curvature{.name = "curvature", .range = Range::positive, .fallback = "0.9", .doc = "`gamma2`."};
}  // namespace lineage

}  // namespace npfem::flow::keys
