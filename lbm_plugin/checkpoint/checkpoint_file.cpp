// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/checkpoint_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "mix_bits.h"

namespace npfem::flow {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t word_bytes = 8;
constexpr std::int64_t largest_text = std::int64_t{1} << 30;
constexpr std::int64_t words_at_once = std::int64_t{1} << 20;

struct Prefix {
  std::array<char, 8> magic{'N', 'P', 'F', 'E', 'M', 'C', 'K', 'P'};
  std::uint32_t byte_order = 0x01020304;
  std::uint32_t version = 1;
};

struct Footer {
  std::uint64_t offset = 0, length = 0, checksum = 0;  // of the text
  std::array<char, 8> magic{'N', 'P', 'F', 'E', 'M', 'E', 'N', 'D'};
};

static_assert(sizeof(Prefix) == 16 && sizeof(Footer) == 32);

std::uint64_t checksum_of(std::span<const Word> words, std::int64_t first) {
  std::uint64_t sum = 0;
  auto place = static_cast<std::uint64_t>(first);
  for (const Word word : words) sum += mix_bits(word + mix_bits(++place));
  return sum;
}

std::uint64_t checksum_of(const std::string& text) {
  std::vector<Word> letters;
  for (const char c : text) letters.push_back(static_cast<unsigned char>(c));
  return checksum_of(letters, 0);
}

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

}  // namespace

CheckpointWriter::CheckpointWriter(Communicator& communicator, const std::filesystem::path& path)
    : communicator_(communicator), file_(communicator.create_file(path)), end_(sizeof(Prefix)) {
  const Prefix prefix;
  const Chunk chunk{0, bytes_of(prefix)};
  file_->write(std::span(&chunk, communicator.rank() == 0 ? 1 : 0));
}

void CheckpointWriter::begin_section(const std::string& name) {
  sections_.push_back({name, end_, 0, 0});
  section_end_ = 0;
  checksum_ = 0;
}

void CheckpointWriter::write(std::span<const Piece> pieces) {
  std::vector<Chunk> chunks;
  for (const Piece& piece : pieces) {
    chunks.push_back({end_ + word_bytes * piece.first, std::as_bytes(piece.words)});
    checksum_ += checksum_of(piece.words, piece.first);
    section_end_ = std::max(section_end_, piece.first + std::ssize(piece.words));
  }
  file_->write(chunks);
}

void CheckpointWriter::end_section() {
  communicator_.maximum(std::span(&section_end_, 1));
  sections_.back().words = section_end_;
  sections_.back().checksum = communicator_.sum_hash(checksum_);
  end_ += word_bytes * section_end_;
}

void CheckpointWriter::publish(const std::string& header) {
  Json sections = Json::array();
  for (const Section& s : sections_) {
    sections.push_back({{"name", s.name}, {"offset", s.offset}, {"words", s.words}, {"checksum", s.checksum}});
  }
  const std::string text = Json{{"header", Json::parse(header)}, {"sections", sections}}.dump(1) + "\n";
  const Footer footer{static_cast<std::uint64_t>(end_), text.size(), checksum_of(text)};
  const std::array<Chunk, 2> chunks{Chunk{end_, std::as_bytes(std::span(text))},
                                    Chunk{end_ + std::ssize(text), bytes_of(footer)}};
  file_->write(std::span(chunks).first(communicator_.rank() == 0 ? 2 : 0));
  file_->publish(true);
}

CheckpointFile::CheckpointFile(Communicator& communicator, const std::filesystem::path& path)
    : communicator_(communicator), path_(path) {
  std::string failure;
  try {
    read_text();
  } catch (const std::exception& error) {
    failure = path.string() + ": " + error.what();
  }
  communicator.agree(failure);
}

void CheckpointFile::read_text() {
  stream_.open(path_, std::ios::binary);
  if (!stream_) throw std::runtime_error(std::generic_category().message(errno));
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  constexpr std::int64_t least = sizeof(Prefix) + sizeof(Footer);
  if (size < least) throw std::runtime_error("not a checkpoint, or cut short: " + std::to_string(size) + " bytes");
  Prefix prefix;
  read_bytes(0, std::as_writable_bytes(std::span(&prefix, 1)));
  const Prefix expected;
  if (prefix.magic != expected.magic) throw std::runtime_error("not a checkpoint of npfem");
  if (prefix.byte_order != expected.byte_order) {
    throw std::runtime_error("written on a machine with another order of bytes; resume it on such a machine");
  }
  if (prefix.version != expected.version) {
    throw std::runtime_error("a checkpoint of format " + std::to_string(prefix.version) +
                             "; this program reads format " + std::to_string(expected.version));
  }
  Footer footer;
  read_bytes(size - static_cast<std::int64_t>(sizeof footer), std::as_writable_bytes(std::span(&footer, 1)));
  const auto text_end = static_cast<std::uint64_t>(size) - sizeof footer;
  if (footer.magic != Footer{}.magic || footer.length > largest_text || footer.offset > text_end ||
      footer.length != text_end - footer.offset) {
    throw std::runtime_error("damaged: cut short, or its end has changed");
  }
  std::string text(footer.length, '\0');
  read_bytes(static_cast<std::int64_t>(footer.offset), std::as_writable_bytes(std::span(text)));
  if (checksum_of(text) != footer.checksum) throw std::runtime_error("damaged: its header has changed");
  const Json json = Json::parse(text);
  header_ = json.at("header").dump();
  for (const Json& s : json.at("sections")) {
    sections_.push_back({s.at("name"), s.at("offset"), s.at("words"), s.at("checksum")});
  }
}

void CheckpointFile::verify() {
  std::string failure;
  for (const Section& s : sections_) {
    std::uint64_t sum = 0;
    try {
      sum = checksum_of_share(s);
    } catch (const std::exception& error) {
      failure = path_.string() + ": " + error.what();
    }
    if (communicator_.sum_hash(sum) != s.checksum && failure.empty()) {
      failure = path_.string() + ": damaged: section \"" + s.name + "\" has changed";
    }
  }
  communicator_.agree(failure);
}

std::uint64_t CheckpointFile::checksum_of_share(const Section& s) {
  const std::int64_t begin = s.words * communicator_.rank() / communicator_.size();
  const std::int64_t end = s.words * (communicator_.rank() + 1) / communicator_.size();
  std::vector<Word> words;
  std::uint64_t sum = 0;
  for (std::int64_t first = begin; first < end; first += words_at_once) {
    words.resize(static_cast<std::size_t>(std::min(words_at_once, end - first)));
    read(s.name, first, words);
    sum += checksum_of(words, first);
  }
  return sum;
}

const CheckpointFile::Section& CheckpointFile::section(const std::string& name) const {
  for (const Section& s : sections_) {
    if (s.name == name) return s;
  }
  throw std::runtime_error(path_.string() + ": has no section \"" + name + "\"");
}

std::int64_t CheckpointFile::words(const std::string& name) const {
  return section(name).words;
}

void CheckpointFile::read(const std::string& name, std::int64_t first, std::span<Word> words) {
  const Section& s = section(name);
  if (first < 0 || first > s.words - std::ssize(words)) {
    throw std::runtime_error(path_.string() + ": section \"" + name + "\" is shorter than it should be");
  }
  read_bytes(s.offset + word_bytes * first, std::as_writable_bytes(words));
}

void CheckpointFile::read_bytes(std::int64_t offset, std::span<std::byte> bytes) {
  stream_.clear();
  stream_.seekg(offset);
  stream_.read(reinterpret_cast<char*>(bytes.data()), std::ssize(bytes));
  if (!stream_)
    throw std::runtime_error("cut short: " + std::to_string(stream_.gcount()) + " of " + std::to_string(bytes.size()) +
                             " bytes at " + std::to_string(offset));
}

}  // namespace npfem::flow
