// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace npfem::app::bench {

/// Bytes per second, read and written, of a loop that changes every number of a long array in place: the traffic of a
/// lattice that streams in place, without its arithmetic. The best of several runs.
double in_place_bandwidth(int threads);

}  // namespace npfem::app::bench
