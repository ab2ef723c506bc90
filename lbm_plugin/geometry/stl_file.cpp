// SPDX-License-Identifier: MPL-2.0
#include "geometry/stl_file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "file.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

constexpr std::size_t binary_header = 84;    // 80 bytes of anything, then the number of triangles
constexpr std::size_t binary_triangle = 50;  // normal, three corners, two bytes of anything
constexpr double merge_share = 1e-6;         // of the extent

[[noreturn]] void fail(const std::string& name, const std::string& message) {
  throw text::InputError(std::string("\"").append(name).append("\" ").append(message));
}

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t n = 0; n < 4; ++n) value |= std::uint32_t{static_cast<unsigned char>(bytes[n])} << (8 * n);
  return value;
}

std::vector<Vec3> corners_of_binary(std::string_view bytes, const std::string& name) {
  std::vector<Vec3> corners;
  const std::size_t triangles = (bytes.size() - binary_header) / binary_triangle;
  for (std::size_t t = 0; t < triangles; ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3 corner{};
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t at = binary_header + t * binary_triangle + 12 + 12 * c + 4 * a;
        corner[a] = static_cast<double>(std::bit_cast<float>(little_endian(bytes.substr(at, 4))));
        if (!std::isfinite(corner[a])) {
          fail(name, "has a coordinate that is not a finite number, in triangle " + std::to_string(t));
        }
      }
      corners.push_back(corner);
    }
  }
  return corners;
}

/// Of text STL only the lines "vertex x y z" matter; three make a triangle.
class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  std::vector<Vec3> corners() {
    std::vector<Vec3> corners;
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
      if (word == "vertex") corners.push_back({number(), number(), number()});
      if (word == "endfacet" && corners.size() % 3 != 0) fail_here("a facet without three vertices");
    }
    if (corners.size() % 3 != 0) fail_here("the end of the file inside a facet");
    return corners;
  }

 private:
  std::string_view next_word() {
    constexpr std::string_view blanks = " \t\r\n\f\v";
    while (!rest_.empty() && blanks.find(rest_.front()) != std::string_view::npos) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
    const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(word.size());
    return word;
  }

  double number() {
    std::string_view word = next_word();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      fail_here(std::string("\"").append(word.substr(0, 40)).append("\" where a number is needed"));
    }
    return value;
  }

  [[noreturn]] void fail_here(const std::string& found) const {
    fail(name_, "line " + std::to_string(line_) + ": found " + found);
  }

  std::string_view rest_;
  const std::string& name_;
  int line_ = 1;
};

/// Gives corners at the same place the same number.
class VertexMerger {
 public:
  explicit VertexMerger(std::span<const Vec3> corners) {
    Vec3 low = corners.front(), high = low;
    for (const Vec3& p : corners) {
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], p[a]);
        high[a] = std::max(high[a], p[a]);
      }
    }
    low_ = low;
    tolerance_ = merge_share * std::max(norm(subtract(high, low)), std::numeric_limits<double>::min());
  }

  std::int32_t id_of(const Vec3& p, std::vector<Vec3>& vertices) {
    Bin bin{};  // of twice the tolerance: what is near enough lies in this bin or one beside it
    for (std::size_t a = 0; a < 3; ++a) bin[a] = static_cast<std::int64_t>((p[a] - low_[a]) / (2 * tolerance_));
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = bins_.find({bin[0] + i, bin[1] + j, bin[2] + k});
          if (found == bins_.end()) continue;
          if (norm(subtract(vertices[static_cast<std::size_t>(found->second)], p)) <= tolerance_) return found->second;
        }
      }
    }
    const auto id = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(p);
    bins_.emplace(bin, id);
    return id;
  }

 private:
  using Bin = std::array<std::int64_t, 3>;
  Vec3 low_;
  double tolerance_;
  std::map<Bin, std::int32_t> bins_;
};

}  // namespace

TriangleSurface parse_stl(std::string_view bytes, const std::string& name) {
  // a binary file may begin with "solid" too: its length tells
  const bool is_binary =
      bytes.size() >= binary_header &&
      bytes.size() == binary_header + binary_triangle * std::size_t{little_endian(bytes.substr(80, 4))};
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (!is_binary && (first == std::string_view::npos || !bytes.substr(first).starts_with("solid"))) {
    fail(name,
         "is not an STL file: it neither begins with \"solid\" nor has the length that its number of triangles "
         "needs; it may be cut short");
  }
  const std::vector<Vec3> corners = is_binary ? corners_of_binary(bytes, name) : TextReader(bytes, name).corners();
  if (corners.empty()) fail(name, "has no triangle");
  TriangleSurface surface;
  VertexMerger merger(corners);
  for (std::size_t n = 0; n < corners.size(); n += 3) {
    std::array<std::int32_t, 3> t{};
    for (std::size_t c = 0; c < 3; ++c) t[c] = merger.id_of(corners[n + c], surface.vertices);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangles.push_back(t);
  }
  return surface;
}

TriangleSurface read_stl(const std::string& path) {
  return parse_stl(text::read_file(path), path);
}

}  // namespace npfem::flow
