// SPDX-License-Identifier: MPL-2.0
#include "file.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace npfem::text {
namespace {

TEST(File, ComesBackByteForByte) {
  const std::string path = ::testing::TempDir() + "npfem_test_file.bin";
  const std::string bytes("a\r\nb\0c\xff", 7);
  write_file(path, bytes);
  EXPECT_EQ(read_file(path), bytes);
  write_file(path, "");
  EXPECT_EQ(read_file(path), "");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  std::filesystem::remove(path);
}

TEST(File, SaysWhyItCannotBeUsed) {
  const auto message_of = [](auto&& action) -> std::string {
    try {
      action();
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of([] { read_file("/nowhere/a.toml"); }), "cannot read \"/nowhere/a.toml\": no such file");
  EXPECT_EQ(message_of([] { read_file("/tmp"); }), "cannot read \"/tmp\": not a regular file");
  EXPECT_EQ(message_of([] { read_file("/dev/zero"); }), "cannot read \"/dev/zero\": not a regular file");
  EXPECT_EQ(message_of([] { write_file("/nowhere/a", "x"); }),
            "cannot write \"/nowhere/a\": No such file or directory");
}

TEST(File, AFailedWriteLeavesTheOldOne) {
  const std::string folder = ::testing::TempDir() + "npfem_test_folder";
  std::filesystem::create_directories(folder + "/inside");
  EXPECT_THROW(write_file(folder, "x"), FileError) << "a folder cannot be replaced by a file";
  EXPECT_TRUE(std::filesystem::exists(folder + "/inside"));
  EXPECT_FALSE(std::filesystem::exists(folder + ".part"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace npfem::text
