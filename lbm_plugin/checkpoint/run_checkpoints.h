// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "checkpoint/checkpoint_file.h"
#include "checkpoint/checkpoint_folder.h"
#include "checkpoint/checkpoint_header.h"
#include "communicator/communicator.h"
#include "scene/scene.h"
#include "simulation/simulation.h"

namespace npfem::flow {

/// The tables of the resolved scene that physics depends on, all but [run] and [output], and the content of the STL
/// files of its walls, by the keys that name them.
CheckpointHeader::Marks scene_marks(Scene& scene);
/// The types of cells of a setup.
CheckpointHeader::Marks type_marks(const Setup& setup);

/// Writes the checkpoints of a run. Calls are collective.
class RunCheckpoints {
 public:
  /// `resumed_from`: the step of the checkpoint that is there already; -1: none.
  RunCheckpoints(Communicator& communicator, const std::filesystem::path& run_folder, Scene& scene,
                 std::int64_t resumed_from = -1);

  bool due(std::int64_t step) const { return every_ > 0 && step % every_ == 0 && step != last_; }

  /// Saves the state, unless it is saved already, and then removes what is older than the number to keep. `wall_s`: of
  /// the whole run. Returns why it could not, the same on every rank; the earlier checkpoints are then still there.
  std::string save(const Simulation& simulation, double wall_s);
  /// Saves a state that cannot be continued.
  std::string save_failed(const Simulation& simulation, double wall_s);

  /// Longest time that writing has taken; before the first one an estimate at 50 MB/s.
  double seconds(const Simulation& simulation) const;

 private:
  std::string write(const std::filesystem::path& path, const Simulation& simulation, double wall_s);

  Communicator& communicator_;
  CheckpointFolder folder_;
  CheckpointHeader origin_;  // all that does not change
  std::int64_t every_;
  int keep_;
  std::int64_t last_;  // step of the last one written
  double seconds_ = 0;
};

/// What a run is continued from.
struct FoundCheckpoint {
  std::unique_ptr<CheckpointFile> file;  ///< verified
  CheckpointHeader header;
  std::vector<std::string> refused;  ///< newer ones that are damaged: file and reason
};

/// The newest checkpoint of a run that is whole. Collective; text::FileError on every rank where there is none.
FoundCheckpoint newest_checkpoint(Communicator& communicator, const std::filesystem::path& run_folder);

}  // namespace npfem::flow
