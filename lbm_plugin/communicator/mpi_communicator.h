// SPDX-License-Identifier: MPL-2.0
#pragma once

// The communicator over MPI_COMM_WORLD. This header names no MPI type: only mpi_communicator.cpp, in the library
// npfem_flow_mpi, knows MPI.

#include <memory>

#include "communicator/communicator.h"

namespace npfem::flow {

// Starts MPI and owns it: MPI ends with the communicator. At most one in the life of a process; std::logic_error
// otherwise. Ranks that outnumber the processors yield while they wait.
std::unique_ptr<Communicator> make_mpi_communicator(int* argc, char*** argv);

}  // namespace npfem::flow
