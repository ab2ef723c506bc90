// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/run_checkpoints.h"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "file.h"
#include "npfem/npfem.hpp"

namespace npfem::flow {
namespace {

/// "cells" of a line "[[cells.positions]]"; empty for any other line.
std::string table_in(const std::string& line) {
  if (!line.starts_with('[')) return "";
  const std::size_t begin = line.find_first_not_of('[');
  return line.substr(begin, line.find_first_of(".]", begin) - begin);
}

std::vector<std::string> shared_lines(Communicator& communicator, const std::string& text_of_first) {
  const auto raw = std::as_bytes(std::span(text_of_first));
  Bytes bytes(raw.begin(), raw.end());
  communicator.broadcast(bytes, 0);
  std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Reads the table of a file that has just been written.
void require_readable(Communicator& communicator, const std::filesystem::path& path) {
  header_from_json(CheckpointFile(communicator, path).header());
}

}  // namespace

CheckpointHeader::Marks scene_marks(Scene& scene) {
  std::istringstream stream(resolved_text(scene));
  std::vector<std::pair<std::string, std::string>> tables;
  std::string name;
  for (std::string line; std::getline(stream, line);) {
    if (const std::string found = table_in(line); !found.empty()) name = found;
    if (name.empty() || name == "run" || name == "output") continue;
    auto table = std::ranges::find(tables, name, &std::pair<std::string, std::string>::first);
    if (table == tables.end()) table = tables.insert(tables.end(), {name, ""});
    table->second += line + '\n';
  }
  for (auto& table : tables) table.second = mark_of(table.second);
  for (const auto& [key, file] : surface_files(scene)) tables.emplace_back(key, mark_of(text::read_file(file)));
  return tables;
}

CheckpointHeader::Marks type_marks(const Setup& setup) {
  CheckpointHeader::Marks marks;
  for (const CellType& type : setup.types) marks.emplace_back(type.name, mark_of(type));
  return marks;
}

RunCheckpoints::RunCheckpoints(Communicator& communicator, const std::filesystem::path& run_folder, Scene& scene,
                               std::int64_t resumed_from)
    : communicator_(communicator),
      folder_(run_folder),
      every_(scene.output.checkpoint_every),
      keep_(scene.output.checkpoint_keep),
      last_(resumed_from) {
  origin_.scene = scene_marks(scene);
  origin_.types = type_marks(scene.setup);
  origin_.version = api::text_of([](char* b, std::int32_t n) { return npfem_version(b, n); });
  origin_.build = api::text_of([](char* b, std::int32_t n) { return npfem_build_info(b, n); });
}

std::string RunCheckpoints::save(const Simulation& simulation, double wall_s) {
  const std::int64_t step = simulation.steps_done();
  if (step == last_) return "";
  const std::filesystem::path path = folder_.file(step);
  const std::string failure = write(path, simulation, wall_s);
  if (!failure.empty()) return failure;
  last_ = step;
  if (communicator_.rank() == 0) folder_.remove_old(step, keep_);
  return "";
}

std::string RunCheckpoints::save_failed(const Simulation& simulation, double wall_s) {
  return write(folder_.failed_file(simulation.steps_done()), simulation, wall_s);
}

std::string RunCheckpoints::write(const std::filesystem::path& path, const Simulation& simulation, double wall_s) {
  const auto start = std::chrono::steady_clock::now();
  try {
    communicator_.agree(communicator_.rank() == 0 ? folder_.create() : "");
    CheckpointHeader header = origin_;
    header.wall_s = wall_s;
    CheckpointWriter writer(communicator_, path);
    simulation.save(writer, header);
    writer.publish(to_json(header));
    require_readable(communicator_, path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  seconds_ = std::max(seconds_, seconds_since(start));
  return "";
}

double RunCheckpoints::seconds(const Simulation& simulation) const {
  constexpr double bytes_per_node = 200, bytes_per_cell = 50000, bytes_per_second = 50e6;
  if (seconds_ > 0) return seconds_;
  const auto& n = simulation.setup().domain.nodes;
  return (bytes_per_node * n[0] * n[1] * n[2] + bytes_per_cell * simulation.cell_count()) / bytes_per_second;
}

FoundCheckpoint newest_checkpoint(Communicator& communicator, const std::filesystem::path& run_folder) {
  const CheckpointFolder folder(run_folder);
  std::string list;
  if (communicator.rank() == 0) {
    for (const auto& entry : folder.list()) list += entry.path.string() + '\n';
  }
  FoundCheckpoint found;
  for (const std::string& path : shared_lines(communicator, list)) {
    try {
      found.file = std::make_unique<CheckpointFile>(communicator, path);
      found.file->verify();
      found.header = header_from_json(found.file->header());
      return found;
    } catch (const std::exception& error) {
      found.refused.emplace_back(error.what());
    }
  }
  std::string message = "no checkpoint to go on from in " + folder.path().string();
  for (const std::string& refusal : found.refused) message += "\n  " + refusal;
  throw text::FileError(message);
}

}  // namespace npfem::flow
