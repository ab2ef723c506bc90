// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "checkpoint/checkpoint_file.h"
#include "communicator/communicator.h"
#include "lattice/lattice.h"

namespace npfem::flow {

/// Section "fluid": global id, populations and held force of every fluid node, in order of ids. The ranks pass their
/// nodes on so that each writes whole stretches of the file, a few megabytes at a time; nobody holds all of it.
/// Collective; std::runtime_error on every rank where the file cannot be written.
void save_fluid(const Lattice& lattice, Communicator& communicator, CheckpointWriter& file);

/// Puts the lattice into the saved state; its geometry must be the one of the checkpoint. Collective;
/// std::runtime_error on every rank where it is not.
void load_fluid(Lattice& lattice, Communicator& communicator, CheckpointFile& file);

}  // namespace npfem::flow
