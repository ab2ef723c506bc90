// SPDX-License-Identifier: MPL-2.0
#include "output/vtk_file.h"

#include <algorithm>
#include <array>
#include <bit>

#include "quantity.h"

namespace npfem::flow {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they stand in memory");

struct TypeInfo {
  const char* name;
  std::int64_t size;
};

TypeInfo info(VtkFile::Type type) {
  switch (type) {
    case VtkFile::Type::float32:
      return {"Float32", 4};
    case VtkFile::Type::float64:
      return {"Float64", 8};
    case VtkFile::Type::int32:
      return {"Int32", 4};
    case VtkFile::Type::uint8:
      return {"UInt8", 1};
  }
  return {"", 0};
}

}  // namespace

std::size_t VtkFile::declare(const std::string& name, Type type, int components, std::int64_t values) {
  arrays_.push_back({name, type, components, values * info(type).size, appended_bytes_});
  appended_bytes_ += length_bytes + arrays_.back().bytes;
  return arrays_.size() - 1;
}

std::string VtkFile::element(std::size_t array) const {
  const Array& a = arrays_[array];
  const std::string components =
      a.components == 1 ? "" : " NumberOfComponents=\"" + std::to_string(a.components) + "\"";
  return std::string("<DataArray type=\"") + info(a.type).name + "\" Name=\"" + a.name + "\"" + components +
         " format=\"appended\" offset=\"" + std::to_string(a.offset) + "\"/>\n";
}

void VtkFile::put_bytes(std::int64_t offset, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  // what follows its predecessor directly is written in one piece with it
  if (!pieces_.empty() && pieces_.back().offset + static_cast<std::int64_t>(pieces_.back().length) == offset) {
    pieces_.back().length += bytes.size();
  } else {
    pieces_.push_back({offset, bytes_.size(), bytes.size()});
  }
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

void VtkFile::write(Communicator& communicator, const std::filesystem::path& path, const std::string& kind,
                    const std::string& body) const {
  const std::string head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind +
                           "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n" + body +
                           "<AppendedData encoding=\"raw\">\n_";
  const std::string tail = "\n</AppendedData>\n</VTKFile>\n";
  const auto start = static_cast<std::int64_t>(head.size());

  std::vector<Chunk> chunks;
  if (communicator.rank() == 0) {
    chunks.push_back({0, std::as_bytes(std::span(head))});
    for (const Array& array : arrays_) {
      chunks.push_back({start + array.offset, std::as_bytes(std::span(&array.bytes, 1))});
    }
    chunks.push_back({start + appended_bytes_, std::as_bytes(std::span(tail))});
  }
  for (const Piece& piece : pieces_) {
    chunks.push_back({start + piece.offset, std::span(bytes_).subspan(piece.begin, piece.length)});
  }
  std::sort(chunks.begin(), chunks.end(), [](const Chunk& a, const Chunk& b) { return a.offset < b.offset; });
  communicator.write_file(path, chunks);
}

std::vector<Bytes> VtkFile::gather(Communicator& communicator) const {
  Bytes message;  // offset, length and bytes of each piece
  for (const Piece& piece : pieces_) {
    const std::array<std::int64_t, 2> place{piece.offset, static_cast<std::int64_t>(piece.length)};
    const auto head = std::as_bytes(std::span(place));
    message.insert(message.end(), head.begin(), head.end());
    const auto body = std::span(bytes_).subspan(piece.begin, piece.length);
    message.insert(message.end(), body.begin(), body.end());
  }
  const std::vector<Bytes> messages = communicator.gather(message, 0);
  if (communicator.rank() != 0) return {};
  Bytes whole(static_cast<std::size_t>(appended_bytes_));
  for (const Bytes& received : messages) {
    for (std::size_t at = 0; at < received.size();) {
      std::array<std::int64_t, 2> place;
      std::memcpy(place.data(), received.data() + at, sizeof place);
      at += sizeof place;
      std::memcpy(whole.data() + place[0], received.data() + at, static_cast<std::size_t>(place[1]));
      at += static_cast<std::size_t>(place[1]);
    }
  }
  std::vector<Bytes> arrays;
  for (const Array& array : arrays_) {
    const auto begin = whole.begin() + array.offset + length_bytes;
    arrays.emplace_back(begin, begin + array.bytes);
  }
  return arrays;
}

std::string time_element(double time_us) {
  return "<FieldData>\n<!-- us -->\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
         "format=\"ascii\">" +
         text::format_number(time_us) + "</DataArray>\n</FieldData>\n";
}

}  // namespace npfem::flow
