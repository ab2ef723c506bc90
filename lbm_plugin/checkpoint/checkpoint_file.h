// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "communicator/communicator.h"

namespace npfem::flow {

/// All numbers of a checkpoint are 64-bit words: doubles by their bits, and integers.
using Word = std::uint64_t;

/// A file of named sections of words and one JSON text, written and read by any number of ranks. What is in it depends
/// on the content alone, not on who wrote it. Native byte order (little endian; a foreign file is refused):
///
///   "NPFEMCKP"  u32 0x01020304  u32 version      16 bytes
///   section, section, ...                        words
///   text                                         JSON: {"header": ..., "sections": [{name, offset, words, checksum}]}
///   u64 offset, length, checksum of the text     24 bytes
///   "NPFEMEND"                                   8 bytes
///
/// The table stands at the end because the sections are streamed; a file that was cut short therefore has none. A
/// checksum is the sum modulo 2^64 of a 64-bit hash of every word and its place, so that each rank adds up its own.
class CheckpointWriter {
 public:
  /// Collective, as all calls; each throws std::runtime_error on every rank where the file cannot be written.
  CheckpointWriter(Communicator& communicator, const std::filesystem::path& path);

  /// Words of this rank, from word `first` of the section on.
  struct Piece {
    std::int64_t first;
    std::span<const Word> words;
  };

  void begin_section(const std::string& name);
  void write(std::span<const Piece> pieces);
  void end_section();

  /// Completes the file: only now, and once the disk has all of it, does it take its name. `header`: a JSON object.
  void publish(const std::string& header);

 private:
  struct Section {
    std::string name;
    std::int64_t offset;  // bytes
    std::int64_t words;
    std::uint64_t checksum;
  };
  Communicator& communicator_;
  std::unique_ptr<SharedFile> file_;
  std::vector<Section> sections_;
  std::int64_t end_ = 0;          // bytes, of the sections so far
  std::int64_t section_end_ = 0;  // words this rank knows of in the present section
  std::uint64_t checksum_ = 0;    // of this rank's words in the present section
};

class CheckpointFile {
 public:
  /// Opens the file and reads its text. Collective; std::runtime_error on every rank, naming the file and what is wrong
  /// with it, where it is not a whole checkpoint that this program can read.
  CheckpointFile(Communicator& communicator, const std::filesystem::path& path);

  /// Reads all sections and compares their checksums, the ranks sharing the work. Collective; std::runtime_error on
  /// every rank, naming the file and the section, where a bit has changed.
  void verify();

  const std::filesystem::path& path() const { return path_; }
  const std::string& header() const { return header_; }  ///< as given to publish()

  /// The rest is not collective; std::runtime_error where it fails.
  std::int64_t words(const std::string& section) const;
  void read(const std::string& section, std::int64_t first, std::span<Word> words);

 private:
  struct Section {
    std::string name;
    std::int64_t offset, words;
    std::uint64_t checksum;
  };
  void read_text();
  const Section& section(const std::string& name) const;
  void read_bytes(std::int64_t offset, std::span<std::byte> bytes);
  std::uint64_t checksum_of_share(const Section& section);

  Communicator& communicator_;
  std::filesystem::path path_;
  std::ifstream stream_;
  std::string header_;
  std::vector<Section> sections_;
};

}  // namespace npfem::flow
