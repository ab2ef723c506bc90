// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "coupling/momentum_audit.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// What a checkpoint says in words: where the run stands, and what it must be continued with to give the same bits.
struct CheckpointHeader {
  // what it was made from
  using Marks = std::vector<std::pair<std::string, std::string>>;  // name, hash
  Marks scene;          ///< what scene_marks() says: tables that physics depends on, surfaces
  Marks types;          ///< of cells: mesh and material
  std::string backend;  ///< of the cell solver, with its instruction set: "cpu-avx2"
  std::string version;  ///< of the program
  std::string build;    ///< compiler and the rest

  // where the run stands
  std::int64_t step = 0;
  double time_us = 0;
  double wall_s = 0;  ///< of all jobs of this run so far
  Counters counters;  ///< of the whole system
  std::vector<CellFailure> failures;
  std::vector<Departure> departures;
  MomentumAudit::Record audit{};
};

/// As a JSON object, and back; std::exception where something is missing.
std::string to_json(const CheckpointHeader& header);
CheckpointHeader header_from_json(const std::string& json);

/// 16 hexadecimal digits that stand for a text.
std::string mark_of(const std::string& text);

/// What a type of cell is known by: connectivity, rest state and masses of its model, its material and its options.
std::string mark_of(const CellType& type);

/// Says which of the marks differ, "[fluid], [coupling]"; empty where none does.
std::string differences(const CheckpointHeader::Marks& a, const CheckpointHeader::Marks& b);

}  // namespace npfem::flow
