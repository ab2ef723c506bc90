// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/checkpoint_folder.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace npfem::flow {
namespace {

std::vector<std::int64_t> steps_in(const CheckpointFolder& folder) {
  std::vector<std::int64_t> steps;
  for (const auto& entry : folder.list()) steps.push_back(entry.step);
  return steps;
}

void put(const std::filesystem::path& path) {
  std::ofstream(path) << "x";
}

TEST(CheckpointFolder, ListsTheNewestFirst) {
  const ScratchFolder scratch("checkpoint_folder");
  const CheckpointFolder folder(scratch.path());
  EXPECT_TRUE(folder.list().empty());
  EXPECT_EQ(folder.create(), "");
  for (const std::int64_t step : {20, 1000000000, 5}) put(folder.file(step));
  EXPECT_EQ(folder.file(20).filename(), "checkpoint_000000000020.npfem");
  put(folder.failed_file(30));
  put(folder.path() / "checkpoint_000000000040.npfem.part");
  put(folder.path() / "checkpoint_x.npfem");
  put(folder.path() / "checkpoint_.npfem");
  EXPECT_EQ(steps_in(folder), (std::vector<std::int64_t>{1000000000, 20, 5}));
}

TEST(CheckpointFolder, KeepsTheNewestUpToThePresent) {
  const ScratchFolder scratch("checkpoint_keep");
  const CheckpointFolder folder(scratch.path());
  EXPECT_EQ(folder.create(), "");
  for (const std::int64_t step : {10, 20, 30, 40}) put(folder.file(step));
  put(folder.path() / "checkpoint_000000000025.npfem.part");
  put(folder.path() / "mine.part");
  folder.remove_old(30, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "checkpoint_000000000025.npfem.part"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "mine.part"));
  EXPECT_EQ(steps_in(folder), (std::vector<std::int64_t>{40, 30, 20}));
}

TEST(CheckpointFolder, KnowsItsFiles) {
  EXPECT_TRUE(CheckpointFolder::is_ours("checkpoint_000000000020.npfem"));
  EXPECT_TRUE(CheckpointFolder::is_ours("checkpoint_000000000020.npfem.part"));
  EXPECT_TRUE(CheckpointFolder::is_ours("failed_000000000020.npfem"));
  EXPECT_FALSE(CheckpointFolder::is_ours("checkpoint_best.npfem"));
  EXPECT_FALSE(CheckpointFolder::is_ours("notes.txt"));
}

}  // namespace
}  // namespace npfem::flow
