// SPDX-License-Identifier: MPL-2.0
#include "communicator/mpi_communicator.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "mpi_environment.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A message whose length and content depend on both ends; some pairs exchange nothing.
std::string message(int from, int to) {
  return std::string(std::size_t((3 * from + 5 * to) % 4 * 1000), char('a' + from + 4 * to));
}

// A folder that all ranks know, owned by rank 0.
class SharedFolder {
 public:
  explicit SharedFolder(const std::string& name) {
    if (world().rank() == 0) owner_.emplace(name);
    const std::string own = owner_ ? owner_->path().string() : "";
    const auto characters = std::as_bytes(std::span(own));
    Bytes bytes(characters.begin(), characters.end());
    world().broadcast(bytes, 0);
    path_ = text_of(bytes);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  ~SharedFolder() { world().barrier(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::optional<ScratchFolder> owner_;
  std::filesystem::path path_;
};

std::string failure_of(const std::filesystem::path& path, std::span<const Chunk> chunks) {
  try {
    world().write_file(path, chunks);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "written";
}

TEST(MpiCommunicator, ExchangesMessagesOfAnySize) {
  const int ranks = world().size();
  std::vector<std::string> texts;
  for (int to = 0; to < ranks; ++to) texts.push_back(message(world().rank(), to));
  std::vector<Outgoing> outgoing;
  for (int to = ranks - 1; to >= 0; --to) outgoing.push_back({to, std::as_bytes(std::span(texts[std::size_t(to)]))});
  std::vector<Incoming> incoming;
  for (int repeat = 0; repeat < 3; ++repeat) {
    world().exchange(outgoing, incoming);
    std::size_t next = 0;
    for (int from = 0; from < ranks; ++from) {
      const std::string expected = message(from, world().rank());
      if (expected.empty()) continue;
      ASSERT_LT(next, incoming.size());
      EXPECT_EQ(incoming[next].source, from);
      EXPECT_EQ(text_of(incoming[next].bytes), expected);
      ++next;
    }
    EXPECT_EQ(next, incoming.size());
  }
}

TEST(MpiCommunicator, MessagesAreUnderWayWhileTheCallerWorks) {
  const int rank = world().rank();
  const int ranks = world().size();
  const std::vector<double> sent(1000, rank);
  std::vector<std::vector<double>> received(std::size_t(ranks), std::vector<double>(1000, -1.0));
  std::vector<Outgoing> outgoing;
  std::vector<Expected> expected;
  for (int other = 0; other < ranks; ++other) {
    if (other == rank) continue;
    outgoing.push_back({other, std::as_bytes(std::span(sent))});
    expected.push_back({other, std::as_writable_bytes(std::span(received[std::size_t(other)]))});
  }
  for (int repeat = 0; repeat < 3; ++repeat) {
    world().start_messages(outgoing, expected);
    world().finish_messages();
    for (int other = 0; other < ranks; ++other) {
      if (other == rank) continue;
      EXPECT_EQ(received[std::size_t(other)], std::vector<double>(1000, other));
    }
  }
}

TEST(MpiCommunicator, Reduces) {
  const int rank = world().rank();
  const int ranks = world().size();
  std::array<double, 2> sums{1.0, double(rank)};
  world().sum(sums);
  EXPECT_EQ(sums[0], ranks);
  EXPECT_EQ(sums[1], ranks * (ranks - 1) / 2);
  std::array<std::int64_t, 1> low{rank + 5}, high{rank + 5};
  world().minimum(low);
  world().maximum(high);
  EXPECT_EQ(low[0], 5);
  EXPECT_EQ(high[0], ranks + 4);
  EXPECT_EQ(world().exclusive_scan(rank + 1), rank * (rank + 1) / 2);
  EXPECT_TRUE(world().any(rank == ranks - 1));
  EXPECT_FALSE(world().any(false));
  const std::uint64_t most = ~std::uint64_t{0};
  EXPECT_EQ(world().sum_hash(most), std::uint64_t{0} - std::uint64_t(ranks));  // modulo 2^64
}

TEST(MpiCommunicator, GathersByRank) {
  const std::string own = std::string("rank ") + std::to_string(world().rank());
  const auto bytes = std::as_bytes(std::span(own));
  const int last = world().size() - 1;
  const std::vector<Bytes> everywhere = world().all_gather(bytes);
  const std::vector<Bytes> at_root = world().gather(bytes, last);
  ASSERT_EQ(everywhere.size(), std::size_t(world().size()));
  ASSERT_EQ(at_root.size(), world().rank() == last ? everywhere.size() : 0U);
  for (std::size_t r = 0; r < everywhere.size(); ++r) EXPECT_EQ(text_of(everywhere[r]), "rank " + std::to_string(r));
  for (std::size_t r = 0; r < at_root.size(); ++r) EXPECT_EQ(text_of(at_root[r]), "rank " + std::to_string(r));
}

TEST(MpiCommunicator, AFailureOfOneIsAFailureOfAll) {
  EXPECT_NO_THROW(world().agree(""));
  const bool fails = world().rank() == world().size() - 1;
  try {
    world().agree(fails ? "the last rank is out of paper" : "");
    ADD_FAILURE() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the last rank is out of paper");
  }
}

TEST(MpiCommunicator, IsTheOnlyOne) {
  EXPECT_THROW(make_mpi_communicator(nullptr, nullptr), std::logic_error);
}

TEST(MpiCommunicator, WritesOneFileTogether) {
  const SharedFolder folder("mpi_write");
  const std::filesystem::path path = folder.path() / "file.bin";
  // Rank r writes letters r, r + ranks, r + 2 ranks...; a rank with more chunks than others must not hang.
  const std::string alphabet = "abcdefghijklmnopqrstuvwxyz";
  std::vector<Chunk> chunks;
  for (std::size_t i = std::size_t(world().rank()); i < alphabet.size(); i += std::size_t(world().size())) {
    chunks.push_back({std::int64_t(i), std::as_bytes(std::span(alphabet).subspan(i, 1))});
  }
  if (world().rank() == 0) std::ofstream(path.string() + ".part") << "a long beginning left by a run that died";
  world().barrier();
  for (int repeat = 0; repeat < 2; ++repeat) {
    ASSERT_EQ(failure_of(path, chunks), "written");
    EXPECT_EQ(content_of(path), alphabet);
    EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
    world().barrier();
  }
  const bool first = world().rank() == 0;
  ASSERT_EQ(failure_of(path, std::span(chunks).first(first ? 1 : 0)), "written");
  EXPECT_EQ(content_of(path), "a");  // a longer file of the same name is replaced, not overwritten in part
}

TEST(MpiCommunicator, AnUnwritablePathIsAnErrorOnAllRanks) {
  const SharedFolder folder("mpi_fail");
  const Chunk chunk{4 * world().rank(), std::as_bytes(std::span("text", 4))};
  const std::span chunks(&chunk, 1);
  const std::filesystem::path nowhere = folder.path() / "missing" / "file.bin";
  EXPECT_EQ(failure_of(nowhere, chunks), "cannot write " + nowhere.string() + ": No such file or directory");

  const std::filesystem::path occupied = folder.path() / "folder";
  if (world().rank() == 0) std::filesystem::create_directory(occupied);
  world().barrier();
  EXPECT_EQ(failure_of(occupied, chunks), "cannot write " + occupied.string() + ": Is a directory");
  EXPECT_FALSE(std::filesystem::exists(occupied.string() + ".part"));
}

TEST(MpiCommunicator, AFullDiskLeavesTheOldFile) {
  const SharedFolder folder("mpi_full");
  const std::filesystem::path path = folder.path() / "file.bin";
  const Chunk chunk{4 * world().rank(), std::as_bytes(std::span("text", 4))};
  ASSERT_EQ(failure_of(path, std::span(&chunk, 1)), "written");
  world().barrier();
  if (world().rank() == 0) std::filesystem::create_symlink("/dev/full", path.string() + ".part");
  world().barrier();
  const std::string failure = failure_of(path, std::span(&chunk, 1));
  EXPECT_TRUE(failure.starts_with("cannot write " + path.string() + ": ")) << failure;
  EXPECT_EQ(content_of(path).size(), 4U * std::size_t(world().size()));
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(path.string() + ".part")));
}

}  // namespace
}  // namespace npfem::flow
