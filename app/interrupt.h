// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace npfem::app {

/// What the outside world asks of a run, the more urgent the larger.
enum class Request : int {
  none = 0,
  save = 1,       ///< SIGTERM and SIGUSR1: save and end, to be continued
  interrupt = 2,  ///< Ctrl-C: the user has seen enough; a second one kills
};

/// From now on these signals ask for an orderly end. mpirun passes SIGUSR1 on to its processes, not SIGTERM. Writing
/// beyond a limit on file sizes becomes an error of the call, as a full disk is.
void catch_signals();
Request request();

}  // namespace npfem::app
