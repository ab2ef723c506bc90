// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace npfem::app {

/// From now on Ctrl-C, SIGTERM and SIGUSR1 (which mpirun passes on) ask for an orderly end; a second one kills.
void catch_interrupts();
bool interrupt_requested();

}  // namespace npfem::app
