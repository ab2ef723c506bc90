// SPDX-License-Identifier: MPL-2.0
#include "communicator/serial_communicator.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "scratch_folder.h"

namespace npfem::flow {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::string failure_of(Communicator& communicator, const std::filesystem::path& path) {
  const Chunk chunk{0, bytes_of("text")};
  try {
    communicator.write_file(path, std::span(&chunk, 1));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "written";
}

TEST(SerialCommunicator, DeliversToItself) {
  SerialCommunicator communicator;
  const Outgoing message{0, bytes_of("hello")};
  std::vector<Incoming> incoming(3);
  communicator.exchange(std::span(&message, 1), incoming);
  ASSERT_EQ(incoming.size(), 1U);
  EXPECT_EQ(incoming[0].source, 0);
  EXPECT_EQ(incoming[0].bytes.size(), 5U);

  communicator.start_messages({}, {});
  communicator.finish_messages();
  const Outgoing stray{1, bytes_of("hello")};
  EXPECT_THROW(communicator.start_messages(std::span(&stray, 1), {}), std::invalid_argument);
  EXPECT_THROW(communicator.exchange(std::span(&stray, 1), incoming), std::invalid_argument);
}

TEST(SerialCommunicator, WritesAndReplacesFiles) {
  const ScratchFolder folder("serial_write");
  SerialCommunicator communicator;
  const std::filesystem::path path = folder.path() / "file.bin";
  const std::vector<Chunk> chunks{{6, bytes_of("world")}, {0, bytes_of("hello ")}};
  communicator.write_file(path, chunks);
  EXPECT_EQ(content_of(path), "hello world");
  const Chunk shorter{0, bytes_of("bye")};
  communicator.write_file(path, std::span(&shorter, 1));
  EXPECT_EQ(content_of(path), "bye");
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
}

TEST(SerialCommunicator, LeavesNothingOfARunThatDied) {
  const ScratchFolder folder("serial_stale");
  SerialCommunicator communicator;
  const std::filesystem::path path = folder.path() / "file.bin";
  std::ofstream(path.string() + ".part") << "a long beginning of another file";
  EXPECT_EQ(failure_of(communicator, path), "written");
  EXPECT_EQ(content_of(path), "text");
}

TEST(SerialCommunicator, SaysWhyAFileCannotBeWritten) {
  const ScratchFolder folder("serial_fail");
  SerialCommunicator communicator;
  const std::filesystem::path nowhere = folder.path() / "missing" / "file.bin";
  EXPECT_EQ(failure_of(communicator, nowhere), "cannot write " + nowhere.string() + ": No such file or directory");

  const std::filesystem::path occupied = folder.path() / "folder";
  std::filesystem::create_directory(occupied);
  EXPECT_EQ(failure_of(communicator, occupied), "cannot write " + occupied.string() + ": Is a directory");
  EXPECT_FALSE(std::filesystem::exists(occupied.string() + ".part"));
}

TEST(SerialCommunicator, AFullDiskLeavesTheOldFile) {
  const ScratchFolder folder("serial_full");
  SerialCommunicator communicator;
  const std::filesystem::path path = folder.path() / "file.bin";
  ASSERT_EQ(failure_of(communicator, path), "written");
  std::filesystem::create_symlink("/dev/full", path.string() + ".part");
  EXPECT_EQ(failure_of(communicator, path), "cannot write " + path.string() + ": No space left on device");
  EXPECT_EQ(content_of(path), "text");
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(path.string() + ".part")));
}

}  // namespace
}  // namespace npfem::flow
