// SPDX-License-Identifier: MPL-2.0
#include <cstdlib>

#include "communicator/mpi_communicator.h"
#include "communicator/serial_communicator.h"
#include "session.h"

namespace npfem::app {
namespace {

/// MPI launchers tell their processes who they are through one of these.
bool started_by_a_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMI_RANK", "PMIX_RANK"}) {
    if (std::getenv(name)) return true;
  }
  return false;
}

}  // namespace

std::unique_ptr<flow::Communicator> make_communicator(int* argc, char*** argv) {
  if (started_by_a_launcher()) return flow::make_mpi_communicator(argc, argv);
  return std::make_unique<flow::SerialCommunicator>();
}

}  // namespace npfem::app
