// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace npfem::flow {

/// Closes an HDF5 object.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  /// text::FileError, naming `what`, where the call that made it has failed.
  Hdf5Id(hid_t id, Close close, const std::string& what);
  Hdf5Id(const Hdf5Id&) = delete;
  Hdf5Id& operator=(const Hdf5Id&) = delete;
  ~Hdf5Id() { close_(id_); }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// An HDF5 file that is filled step by step. Names are paths in it, "Steps/Values"; groups are made on the way. Every
/// call throws text::FileError, naming file and object, where it fails.
class Hdf5File {
 public:
  /// Opens the file for change, or creates it.
  explicit Hdf5File(const std::filesystem::path& path);

  bool is_new() const { return new_; }
  bool has(const std::string& name) const;

  void set_text(const std::string& group, const std::string& attribute, const std::string& text);
  void set_numbers(const std::string& group, const std::string& attribute, std::span<const double> numbers);
  void set_numbers(const std::string& group, const std::string& attribute, std::span<const std::int64_t> numbers);
  void set_number(const std::string& group, const std::string& attribute, std::int64_t number);

  /// What an array is stored as; it may be given as something else.
  struct Types {
    hid_t stored, given;
  };

  /// Adds rows behind those that are there; shape[0] of them. Returns how many there were.
  std::int64_t append(const std::string& name, const Types& types, const std::vector<hsize_t>& shape, const void* data);
  std::int64_t rows(const std::string& name) const;
  void keep_rows(const std::string& name, std::int64_t rows);
  std::vector<double> numbers(const std::string& name) const;
  std::vector<std::string> names_in(const std::string& group) const;

 private:
  std::string what(const std::string& name) const { return path_ + ": " + name; }
  void require(herr_t status, const std::string& name) const;
  void write_attribute(const std::string& group, const std::string& attribute, hid_t type, hid_t space,
                       const void* data);
  void create(const std::string& name, hid_t type, std::vector<hsize_t> shape);

  std::string path_;
  bool new_;
  Hdf5Id file_;
};

}  // namespace npfem::flow
