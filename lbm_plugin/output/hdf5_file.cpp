// SPDX-License-Identifier: MPL-2.0
#include "output/hdf5_file.h"

#include <algorithm>

#include "file.h"

namespace npfem::flow {
namespace {

/// HDF5 prints its errors by itself unless it is told not to.
hid_t open_or_create(const std::filesystem::path& path, bool create) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return create ? H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT)
                : H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
}

/// Of a few megabytes: whole rows, or a part of one that is larger.
std::vector<hsize_t> chunk_of(std::vector<hsize_t> shape, std::size_t number_bytes) {
  constexpr std::size_t largest = 8 << 20;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    std::size_t bytes = number_bytes;
    for (const hsize_t n : shape) bytes *= std::max<hsize_t>(n, 1);
    const std::size_t pieces = (bytes + largest - 1) / largest;
    shape[d] = std::max<hsize_t>(1, shape[d] / std::max<std::size_t>(pieces, 1));
  }
  return shape;
}

}  // namespace

Hdf5Id::Hdf5Id(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
  if (id < 0) throw text::FileError("cannot write " + what);
}

Hdf5File::Hdf5File(const std::filesystem::path& path)
    : path_(path.string()),
      new_(!std::filesystem::exists(path)),
      file_(open_or_create(path, new_), H5Fclose, path_ + ": not a file of HDF5 that can be changed") {}

bool Hdf5File::has(const std::string& name) const {
  for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
    if (H5Lexists(file_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::require(herr_t status, const std::string& name) const {
  if (status < 0) throw text::FileError("cannot write " + what(name) + ": is the disk full?");
}

void Hdf5File::write_attribute(const std::string& group, const std::string& attribute, hid_t type, hid_t space,
                               const void* data) {
  if (!has(group)) {
    const Hdf5Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what(group));
    H5Pset_create_intermediate_group(links, 1);
    const Hdf5Id made(H5Gcreate2(file_, group.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, what(group));
  }
  const Hdf5Id owner(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose, what(group));
  if (H5Aexists(owner, attribute.c_str()) > 0) require(H5Adelete(owner, attribute.c_str()), attribute);
  const Hdf5Id made(H5Acreate2(owner, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                    what(attribute));
  require(H5Awrite(made, type, data), attribute);
}

void Hdf5File::set_text(const std::string& group, const std::string& attribute, const std::string& text) {
  const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose, what(attribute));
  H5Tset_size(type, text.size());
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose, what(attribute));
  write_attribute(group, attribute, type, space, text.data());
}

void Hdf5File::set_numbers(const std::string& group, const std::string& attribute, std::span<const double> numbers) {
  const hsize_t size = numbers.size();
  const Hdf5Id space(H5Screate_simple(1, &size, nullptr), H5Sclose, what(attribute));
  write_attribute(group, attribute, H5T_NATIVE_DOUBLE, space, numbers.data());
}

void Hdf5File::set_numbers(const std::string& group, const std::string& attribute,
                           std::span<const std::int64_t> numbers) {
  const hsize_t size = numbers.size();
  const Hdf5Id space(H5Screate_simple(1, &size, nullptr), H5Sclose, what(attribute));
  write_attribute(group, attribute, H5T_NATIVE_INT64, space, numbers.data());
}

void Hdf5File::set_number(const std::string& group, const std::string& attribute, std::int64_t number) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose, what(attribute));
  write_attribute(group, attribute, H5T_NATIVE_INT64, space, &number);
}

void Hdf5File::create(const std::string& name, hid_t type, std::vector<hsize_t> shape) {
  const std::vector<hsize_t> chunk = chunk_of(shape, H5Tget_size(type));
  std::vector<hsize_t> most = shape;
  shape[0] = 0;
  most[0] = H5S_UNLIMITED;
  const auto rank = static_cast<int>(shape.size());
  const Hdf5Id space(H5Screate_simple(rank, shape.data(), most.data()), H5Sclose, what(name));
  const Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what(name));
  H5Pset_chunk(properties, rank, chunk.data());
  const Hdf5Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what(name));
  H5Pset_create_intermediate_group(links, 1);
  const Hdf5Id made(H5Dcreate2(file_, name.c_str(), type, space, links, properties, H5P_DEFAULT), H5Dclose, what(name));
}

std::int64_t Hdf5File::append(const std::string& name, const Types& types, const std::vector<hsize_t>& shape,
                              const void* data) {
  if (!has(name)) create(name, types.stored, shape);
  const std::int64_t before = rows(name);
  const Hdf5Id dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, what(name));
  std::vector<hsize_t> extent = shape;
  extent[0] += static_cast<hsize_t>(before);
  require(H5Dset_extent(dataset, extent.data()), name);
  const Hdf5Id in_file(H5Dget_space(dataset), H5Sclose, what(name));
  const Hdf5Id in_memory(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, what(name));
  std::vector<hsize_t> start(shape.size(), 0);
  start[0] = static_cast<hsize_t>(before);
  require(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, shape.data(), nullptr), name);
  require(H5Dwrite(dataset, types.given, in_memory, in_file, H5P_DEFAULT, data), name);
  return before;
}

std::int64_t Hdf5File::rows(const std::string& name) const {
  const Hdf5Id dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, what(name));
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose, what(name));
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(1, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  return static_cast<std::int64_t>(extent[0]);
}

void Hdf5File::keep_rows(const std::string& name, std::int64_t rows) {
  const Hdf5Id dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, what(name));
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose, what(name));
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(1, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  extent[0] = std::min(extent[0], static_cast<hsize_t>(rows));
  require(H5Dset_extent(dataset, extent.data()), name);
}

std::vector<double> Hdf5File::numbers(const std::string& name) const {
  std::vector<double> values(static_cast<std::size_t>(rows(name)));
  const Hdf5Id dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, what(name));
  require(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
  std::vector<std::string> names;
  if (!has(group)) return names;
  const Hdf5Id owner(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose, what(group));
  H5G_info_t info{};
  require(H5Gget_info(owner, &info), group);
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    std::string name(256, '\0');
    const auto length =
        H5Lget_name_by_idx(owner, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
    name.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    names.push_back(name);
  }
  return names;
}

}  // namespace npfem::flow
