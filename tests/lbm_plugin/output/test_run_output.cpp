// SPDX-License-Identifier: MPL-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "file.h"
#include "output/collection.h"
#include "output/run_output.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

void put(const std::filesystem::path& path) {
  std::ofstream(path) << "x";
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const ScratchFolder scratch("output_made");
  prepare_output_folder(scratch.path() / "a/b", false);
  EXPECT_TRUE(std::filesystem::is_directory(scratch.path() / "a/b"));
  prepare_output_folder(scratch.path() / "a/b", false);  // an empty one is fine
}

TEST(OutputFolder, KeepsWhatIsInIt) {
  const ScratchFolder scratch("output_kept");
  put(scratch.path() / "notes.txt");
  EXPECT_THROW(prepare_output_folder(scratch.path(), false), text::FileError);
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "notes.txt"));
}

TEST(OutputFolder, OverwriteRemovesOnlyTheFilesOfARun) {
  const ScratchFolder scratch("output_overwrite");
  for (const char* file : {"cells_000000010.vtu", "fluid_000000010.vti", "cells.pvd", "cells.csv", "summary.json",
                           "scene.toml", "cells_000000020.vtu.part"}) {
    put(scratch.path() / file);
  }
  for (const char* file : {"notes.txt", "cells_best.vtu", "preview.png", "cells_000000010.vtu.bak"}) {
    put(scratch.path() / file);
  }
  prepare_output_folder(scratch.path(), true);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "cells_000000010.vtu"));
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "scene.toml"));
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "cells_000000020.vtu.part"));
  for (const char* file : {"notes.txt", "cells_best.vtu", "preview.png", "cells_000000010.vtu.bak"}) {
    EXPECT_TRUE(std::filesystem::exists(scratch.path() / file)) << file;
  }
}

TEST(OutputFolder, TheLockOfTheRunThatPreparesItIsLeftAlone) {
  const ScratchFolder scratch("output_lock");
  put(scratch.path() / lock_file_name);
  prepare_output_folder(scratch.path(), false);
  put(scratch.path() / "cells.pvd");
  prepare_output_folder(scratch.path(), true);
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / lock_file_name));
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "cells.pvd"));
}

TEST(OutputFolder, MustBeAFolder) {
  const ScratchFolder scratch("output_file");
  put(scratch.path() / "file");
  EXPECT_THROW(prepare_output_folder(scratch.path() / "file", true), text::FileError);
  EXPECT_THROW(prepare_output_folder(scratch.path() / "file/below", true), text::FileError);
}

TEST(Collection, IsValidAfterEveryStep) {
  const ScratchFolder scratch("collection");
  Collection collection(scratch.path() / "cells.pvd");
  collection.add(0, "cells_0.vtu");
  const std::string first = content_of(scratch.path() / "cells.pvd");
  EXPECT_NE(first.find("<DataSet timestep=\"0\" part=\"0\" file=\"cells_0.vtu\"/>"), std::string::npos);
  EXPECT_TRUE(first.ends_with("</VTKFile>\n"));
  collection.add(0.5, "cells_5.vtu");
  const std::string second = content_of(scratch.path() / "cells.pvd");
  EXPECT_NE(second.find("<DataSet timestep=\"0.5\" part=\"0\" file=\"cells_5.vtu\"/>"), std::string::npos);
  EXPECT_TRUE(second.ends_with("</VTKFile>\n"));
}

}  // namespace
}  // namespace npfem::flow
