// SPDX-License-Identifier: MPL-2.0
#include "placement/cells_file.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>

#include "file.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

constexpr std::string_view title = "npfem cells 1\n";
constexpr std::string_view end = "end\n";
constexpr std::uint64_t most_numbers = std::uint64_t{1} << 40;  // far beyond any memory, far from overflow

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

template <std::unsigned_integral Bits>
void append_little_endian(std::string& bytes, Bits value) {
  for (std::size_t n = 0; n < sizeof value; ++n) bytes += static_cast<char>((value >> (8 * n)) & 0xff);
}

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t n = 0; n < 8; ++n) value |= std::uint64_t{static_cast<unsigned char>(bytes[n])} << (8 * n);
  return value;
}

std::string hex(std::uint64_t value) {
  char text[16];
  char* last = std::to_chars(text, text + sizeof text, value, 16).ptr;
  const std::string digits(text, last);
  return std::string(16 - digits.size(), '0') + digits;
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  std::vector<StoredCells> read() {
    if (!rest_.starts_with(title)) fail("is not a cells file: its first line is not \"npfem cells 1\"");
    require_intact();
    rest_.remove_prefix(title.size());
    while (!rest_.starts_with(end)) read_type();
    rest_.remove_prefix(end.size());
    std::uint64_t numbers = 0;
    for (const std::uint64_t its : numbers_) numbers += its;
    if (rest_.size() != 8 * numbers) {
      fail("holds " + std::to_string(rest_.size()) + " bytes of positions where its header needs " +
           std::to_string(8 * numbers));
    }
    for (std::size_t type = 0; type < types_.size(); ++type) read_positions(types_[type], numbers_[type]);
    return std::move(types_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw text::InputError("\"" + name_ + "\" " + message); }

  /// Takes off the checksum at the end.
  void require_intact() {
    const std::string_view content = rest_.substr(0, rest_.size() - 8);
    if (rest_.size() < title.size() + 8 || hash_of(content) != little_endian(rest_.substr(content.size()))) {
      fail("is damaged: its checksum does not fit its content; it was cut short or changed");
    }
    rest_ = content;
  }

  std::uint64_t take_number(std::string_view& line, std::string_view label, int base) const {
    const std::size_t at = line.rfind(label);
    std::uint64_t value = 0;
    if (at == std::string_view::npos) fail_at(line);
    const std::string_view digits = line.substr(at + label.size());
    const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (error != std::errc() || last != digits.data() + digits.size()) fail_at(line);
    line = line.substr(0, at);
    return value;
  }

  [[noreturn]] void fail_at(std::string_view line) const {
    fail("has the header line \"" + std::string(line) +
         "\"; \"type NAME count N vertices N mesh_hash HEX\" is expected");
  }

  void read_type() {
    const std::size_t length = rest_.find('\n');
    if (length == std::string_view::npos) fail("has no line \"end\" after its types");
    const std::string_view whole = rest_.substr(0, length);
    rest_.remove_prefix(length + 1);
    std::string_view line = whole;  // read from its end, since a name may hold blanks
    StoredCells type;
    type.mesh_hash = take_number(line, " mesh_hash ", 16);
    const std::uint64_t vertices = take_number(line, " vertices ", 10);
    const std::uint64_t count = take_number(line, " count ", 10);
    if (!line.starts_with("type ") || vertices == 0 || vertices > 1000000 || count > 100000000) fail_at(whole);
    type.name = line.substr(5);
    type.vertices = static_cast<int>(vertices);
    numbers_.push_back(3 * vertices * count);
    types_.push_back(std::move(type));
    if (numbers_.back() > most_numbers || types_.size() > 1000) fail_at(whole);
  }

  void read_positions(StoredCells& type, std::uint64_t numbers) {
    type.positions.reserve(numbers);
    for (std::uint64_t n = 0; n < numbers; ++n) {
      const double value = std::bit_cast<double>(little_endian(rest_));
      if (!std::isfinite(value)) fail("holds a position that is not a finite number, among the cells " + type.name);
      type.positions.push_back(value);
      rest_.remove_prefix(8);
    }
  }

  std::string_view rest_;
  const std::string& name_;
  std::vector<StoredCells> types_;
  std::vector<std::uint64_t> numbers_;  // of coordinates, by type
};

}  // namespace

std::uint64_t hash_of_mesh(std::span<const std::int32_t> triangles) {
  std::string bytes;
  for (const std::int32_t id : triangles) append_little_endian(bytes, static_cast<std::uint32_t>(id));
  return hash_of(bytes);
}

std::string to_cells_file(std::span<const StoredCells> types) {
  std::string bytes(title);
  for (const StoredCells& type : types) {
    bytes += "type " + type.name + " count " + std::to_string(type.count()) + " vertices " +
             std::to_string(type.vertices) + " mesh_hash " + hex(type.mesh_hash) + "\n";
  }
  bytes += end;
  for (const StoredCells& type : types) {
    for (const double value : type.positions) append_little_endian(bytes, std::bit_cast<std::uint64_t>(value));
  }
  append_little_endian(bytes, hash_of(bytes));
  return bytes;
}

std::vector<StoredCells> parse_cells_file(std::string_view bytes, const std::string& name) {
  return Reader(bytes, name).read();
}

void write_cells_file(const std::string& path, std::span<const StoredCells> types) {
  text::write_file(path, to_cells_file(types));
}

std::vector<StoredCells> read_cells_file(const std::string& path) {
  return parse_cells_file(text::read_file(path), path);
}

}  // namespace npfem::flow
