// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <span>
#include <vector>

#include "checkpoint/checkpoint_file.h"
#include "communicator/communicator.h"
#include "coupling/cell_population.h"
#include "simulation/departures.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// Section "placed": type, centre and rotation of every cell as it was placed, in order of ids: by this a run knows its
/// cells without placing them again, and how far they have come. Collective as CheckpointWriter.
void save_placed(const std::vector<CellStart>& cells, Communicator& communicator, CheckpointWriter& file);
std::vector<CellStart> load_placed(CheckpointFile& file);

/// Section "centres": where the middle of every cell that has not left is, in order of ids, so that a run goes on with
/// cuts between the ranks that suit the cells as they are. Collective as CheckpointWriter.
void save_centres(const CellPopulation& cells, const std::vector<CellStart>& all,
                  const std::vector<Departure>& departures, CheckpointWriter& file);
/// The cells that have not left, undeformed, where they are by now. std::runtime_error where the file does not say so.
std::vector<CellStart> load_present(const std::vector<CellStart>& all, const std::vector<Departure>& departures,
                                    CheckpointFile& file);

/// Section "cells": type, outcome of the last step and packed state of every cell, in order of ids. Collective as
/// CheckpointWriter. `all`: the cells that the system began with, by id; of those that have left there is nothing.
void save_cells(const CellPopulation& cells, const std::vector<CellStart>& all,
                const std::vector<Departure>& departures, CheckpointWriter& file, Communicator& communicator);

/// Adds the saved cells to a population that has none; each comes to its owner. Collective; std::runtime_error on every
/// rank where they cannot be read or do not fit the types.
void load_cells(CellPopulation& cells, const std::vector<CellStart>& all, const std::vector<Departure>& departures,
                CheckpointFile& file, Communicator& communicator);

}  // namespace npfem::flow
