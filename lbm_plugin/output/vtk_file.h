// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "communicator/communicator.h"

namespace npfem::flow {

/// Arrays that all ranks fill together: each is declared with its length over all ranks, and every rank puts its values
/// where they belong. They become a VTK XML file with the arrays appended as raw bytes (little endian, lengths as
/// UInt64), or are gathered on one rank for a writer that knows no ranks. What comes out depends on the values alone,
/// not on who held them.
class VtkFile {
 public:
  enum class Type { float32, float64, int32, uint8 };

  /// `values` counts numbers (not tuples) over all ranks. Same order on every rank. Returns the array's number.
  std::size_t declare(const std::string& name, Type type, int components, std::int64_t values);
  /// The <DataArray .../> element of a declared array, once all are declared.
  std::string element(std::size_t array) const;

  /// Values of this rank, from number `first` of the array on. T must be of the declared type.
  template <class T>
  void put(std::size_t array, std::int64_t first, std::span<const T> values) {
    put_bytes(arrays_[array].offset + length_bytes + first * static_cast<std::int64_t>(sizeof(T)),
              std::as_bytes(values));
  }

  /// `body` stands between the opening of the file and the appended data. Collective; throws as write_file does.
  void write(Communicator& communicator, const std::filesystem::path& path, const std::string& kind,
             const std::string& body) const;

  /// On rank 0 the bytes of every array, by its number; nothing on the others. Collective.
  std::vector<Bytes> gather(Communicator& communicator) const;

 private:
  static constexpr std::int64_t length_bytes = 8;
  struct Array {
    std::string name;
    Type type;
    int components;
    std::int64_t bytes;
    std::int64_t offset;  // of its length, in the appended data
  };
  struct Piece {
    std::int64_t offset;
    std::size_t begin, length;  // in bytes_
  };
  void put_bytes(std::int64_t offset, std::span<const std::byte> bytes);

  std::vector<Array> arrays_;
  std::int64_t appended_bytes_ = 0;
  std::vector<std::byte> bytes_;
  std::vector<Piece> pieces_;
};

/// The <FieldData> element that tells ParaView the time of the file, us.
std::string time_element(double time_us);

}  // namespace npfem::flow
