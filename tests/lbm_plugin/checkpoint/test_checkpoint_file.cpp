// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/checkpoint_file.h"

#include <gtest/gtest.h>

#include "communicator/serial_communicator.h"
#include "scratch_folder.h"

namespace npfem::flow {
namespace {

class CheckpointFileTest : public testing::Test {
 protected:
  CheckpointFileTest() : scratch_("checkpoint_file"), path_(scratch_.path() / "a.npfem") {}

  void write() {
    CheckpointWriter writer(self_, path_);
    writer.begin_section("first");
    const std::vector<Word> low{1, 2, 3}, high{4, 5};
    const CheckpointWriter::Piece pieces[] = {{3, high}, {0, low}};
    writer.write(pieces);
    writer.end_section();
    writer.begin_section("empty");
    writer.end_section();
    writer.begin_section("last");
    const CheckpointWriter::Piece piece{0, high};
    writer.write(std::span(&piece, 1));
    writer.end_section();
    writer.publish(R"({"step": 7})");
  }

  std::string failure() {
    try {
      CheckpointFile file(self_, path_);
      file.verify();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  void replace(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }

  SerialCommunicator self_;
  ScratchFolder scratch_;
  std::filesystem::path path_;
};

TEST_F(CheckpointFileTest, ReadsBack) {
  write();
  EXPECT_EQ(failure(), "");
  CheckpointFile file(self_, path_);
  EXPECT_EQ(file.header(), R"({"step":7})");
  ASSERT_EQ(file.words("first"), 5);
  std::vector<Word> words(4);
  file.read("first", 1, words);
  EXPECT_EQ(words, (std::vector<Word>{2, 3, 4, 5}));
  EXPECT_EQ(file.words("empty"), 0);
  EXPECT_EQ(file.words("last"), 2);
  EXPECT_THROW(file.read("first", 2, words), std::runtime_error);
  EXPECT_THROW(file.words("none"), std::runtime_error);
}

TEST_F(CheckpointFileTest, IsNotThereBeforeItIsPublished) {
  {
    CheckpointWriter writer(self_, path_);
    writer.begin_section("first");
    EXPECT_TRUE(std::filesystem::exists(path_.string() + ".part"));
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_FALSE(std::filesystem::exists(path_.string() + ".part"));
}

TEST_F(CheckpointFileTest, EveryFlippedBitIsFound) {
  write();
  const std::string whole = content_of(path_);
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    std::string damaged = whole;
    damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << (byte % 8)));
    replace(damaged);
    EXPECT_NE(failure(), "") << "byte " << byte;
  }
}

TEST_F(CheckpointFileTest, EveryLengthButTheWholeIsRefused) {
  write();
  const std::string whole = content_of(path_);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    replace(whole.substr(0, length));
    EXPECT_NE(failure(), "") << length << " bytes";
  }
  replace(whole + "x");
  EXPECT_NE(failure(), "");
  replace(whole);
  EXPECT_EQ(failure(), "");
}

TEST_F(CheckpointFileTest, SaysWhatIsWrong) {
  write();
  const std::string whole = content_of(path_);
  const auto says = [&](const std::string& content) {
    replace(content);
    return failure();
  };
  const std::string name = path_.string();
  EXPECT_EQ(says("abc"), name + ": not a checkpoint, or cut short: 3 bytes");
  EXPECT_EQ(says(std::string(100, 'x')), name + ": not a checkpoint of npfem");
  EXPECT_EQ(says(whole.substr(0, whole.size() - 1)), name + ": damaged: cut short, or its end has changed");
  std::string other = whole;
  other[12] = 9;
  EXPECT_EQ(says(other), name + ": a checkpoint of format 9; this program reads format 1");
  other = whole;
  std::swap(other[8], other[11]);
  std::swap(other[9], other[10]);
  EXPECT_EQ(says(other), name + ": written on a machine with another order of bytes; resume it on such a machine");
  other = whole;
  std::swap(other[16], other[24]);  // two words change places
  EXPECT_EQ(says(other), name + ": damaged: section \"first\" has changed");
  std::filesystem::remove(path_);
  EXPECT_EQ(failure(), name + ": No such file or directory");
}

}  // namespace
}  // namespace npfem::flow
