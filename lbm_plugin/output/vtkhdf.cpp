// SPDX-License-Identifier: MPL-2.0
#include "output/vtkhdf.h"

#include <algorithm>
#include <array>
#include <functional>

#include "file.h"
#include "output/hdf5_file.h"

namespace npfem::flow {
namespace {

const std::string root = "VTKHDF", steps = "VTKHDF/Steps";

const Hdf5File::Types float64{H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
const Hdf5File::Types float32{H5T_IEEE_F32LE, H5T_NATIVE_FLOAT};
const Hdf5File::Types int32{H5T_STD_I32LE, H5T_NATIVE_INT32};
const Hdf5File::Types int64{H5T_STD_I64LE, H5T_NATIVE_INT64};
const Hdf5File::Types int64_from_int32{H5T_STD_I64LE, H5T_NATIVE_INT32};
const Hdf5File::Types uint8{H5T_STD_U8LE, H5T_NATIVE_UINT8};

void begin(Hdf5File& file, const std::string& type) {
  file.set_text(root, "Type", type);
  file.set_numbers(root, "Version", std::array<std::int64_t, 2>{2, 0});
  file.set_number(steps, "NSteps", 0);
}

void append_number(Hdf5File& file, const std::string& name, std::int64_t number) {
  file.append(steps + '/' + name, int64, {1}, &number);
}

/// Adds the rows of this time and notes where they begin.
void append_data(Hdf5File& file, const std::string& kind, const std::string& name, const Hdf5File::Types& types,
                 const std::vector<hsize_t>& shape, const Bytes& data) {
  append_number(file, kind + "Offsets/" + name, file.append(root + '/' + kind + '/' + name, types, shape, data.data()));
}

/// Stores the rows at the first time; all times show them.
void append_once(Hdf5File& file, const std::string& kind, const std::string& name, const Hdf5File::Types& types,
                 const std::vector<hsize_t>& shape, const Bytes& data) {
  const std::string path = root + '/' + kind + '/' + name;
  if (!file.has(path)) file.append(path, types, shape, data.data());
  append_number(file, kind + "Offsets/" + name, 0);
}

/// Notes that this time shows the last `count` rows of an array.
void show_last(Hdf5File& file, const std::string& offsets, const std::string& name, std::int64_t count) {
  append_number(file, offsets, file.rows(root + '/' + name) - count);
}

void end_step(Hdf5File& file, double time_us) {
  file.append(steps + "/Values", float64, {1}, &time_us);
  file.set_number(steps, "NSteps", file.rows(steps + "/Values"));
}

/// Cells only ever leave: as many as the last time are the same ones.
bool shows_these(const Hdf5File& file, const CellArrays& cells) {
  const std::string counts = root + "/NumberOfCells";
  return file.has(counts) && file.numbers(counts).back() == static_cast<double>(cells.triangles);
}

/// What stays the same until a cell leaves.
void store_part(Hdf5File& file, const CellArrays& cells, const std::vector<Bytes>& arrays) {
  const auto triangles = static_cast<hsize_t>(cells.triangles);
  const std::int64_t first_offset = 0;
  for (const auto& [name, number] : {std::pair{"NumberOfPoints", cells.vertices},
                                     {"NumberOfCells", cells.triangles},
                                     {"NumberOfConnectivityIds", 3 * cells.triangles}}) {
    file.append(root + '/' + name, int64, {1}, &number);
  }
  file.append(root + "/Connectivity", int64_from_int32, {3 * triangles}, arrays[cells.connectivity].data());
  file.append(root + "/Offsets", int64, {1}, &first_offset);
  file.append(root + "/Offsets", int64_from_int32, {triangles}, arrays[cells.offsets].data());
  file.append(root + "/Types", uint8, {triangles}, arrays[cells.types].data());
  file.append(root + "/CellData/cell_id", int32, {triangles}, arrays[cells.cell_id].data());
  file.append(root + "/CellData/cell_type", int32, {triangles}, arrays[cells.cell_type].data());
}

void append_step(Hdf5File& file, double time_us, const CellArrays& cells, const std::vector<Bytes>& arrays) {
  if (file.is_new()) begin(file, "UnstructuredGrid");
  if (!shows_these(file, cells)) store_part(file, cells, arrays);
  const auto vertices = static_cast<hsize_t>(cells.vertices), triangles = static_cast<hsize_t>(cells.triangles);
  append_number(file, "PointOffsets",
                file.append(root + "/Points", float64, {vertices, 3}, arrays[cells.points].data()));
  append_number(file, "NumberOfParts", 1);
  show_last(file, "PartOffsets", "NumberOfPoints", 1);
  show_last(file, "CellOffsets", "Types", cells.triangles);
  show_last(file, "ConnectivityIdOffsets", "Connectivity", 3 * cells.triangles);
  for (const std::string name : {"cell_id", "cell_type"}) {
    show_last(file, "CellDataOffsets/" + name, "CellData/" + name, cells.triangles);
  }
  append_data(file, "PointData", "velocity_um_per_us", float32, {vertices, 3}, arrays[cells.velocity]);
  append_data(file, "PointData", "force_pN", float32, {vertices, 3}, arrays[cells.force]);
  append_data(file, "CellData", "larger_stretch", float32, {triangles}, arrays[cells.larger]);
  append_data(file, "CellData", "smaller_stretch", float32, {triangles}, arrays[cells.smaller]);
  end_step(file, time_us);
}

void append_step(Hdf5File& file, double time_us, const FluidArrays& fluid, const std::vector<Bytes>& arrays) {
  const Index3& n = fluid.nodes;
  if (file.is_new()) {
    begin(file, "ImageData");
    file.set_numbers(root, "WholeExtent", std::array<std::int64_t, 6>{0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1});
    file.set_numbers(root, "Origin", std::array<double, 3>{0.5 * fluid.dx, 0.5 * fluid.dx, 0.5 * fluid.dx});
    file.set_numbers(root, "Spacing", std::array<double, 3>{fluid.dx, fluid.dx, fluid.dx});
    file.set_numbers(root, "Direction", std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  const auto x = static_cast<hsize_t>(n[0]), y = static_cast<hsize_t>(n[1]), z = static_cast<hsize_t>(n[2]);
  append_data(file, "PointData", "velocity_um_per_us", float32, {1, z, y, x, 3}, arrays[fluid.velocity]);
  append_data(file, "PointData", "pressure_Pa", float32, {1, z, y, x}, arrays[fluid.pressure]);
  append_once(file, "PointData", "flags", uint8, {1, z, y, x}, arrays[fluid.flags]);
  end_step(file, time_us);
}

void on_first_rank(Communicator& communicator, const std::function<void()>& write) {
  std::string failure;
  if (communicator.rank() == 0) {
    try {
      write();
    } catch (const text::FileError& error) {
      failure = error.what();
    }
  }
  communicator.agree(failure);
}

/// Keeps the first `count` times of an array whose rows begin at these places; times may share their rows.
void keep_times(Hdf5File& file, const std::string& name, const std::vector<double>& begin, std::int64_t count) {
  if (count >= std::ssize(begin)) return;
  const auto next = begin.begin() + count;
  const auto first_dropped = std::find_if(next, begin.end(), [&](double row) { return row > *(next - 1); });
  if (first_dropped != begin.end()) file.keep_rows(name, static_cast<std::int64_t>(*first_dropped));
}

void cut_array(Hdf5File& file, const std::string& name, const std::string& offsets, std::int64_t count) {
  keep_times(file, name, file.numbers(offsets), count);
  file.keep_rows(offsets, count);
}

void cut_parts(Hdf5File& file, std::int64_t count) {
  const std::vector<double> part = file.numbers(steps + "/PartOffsets");
  const std::vector<double> cell = file.numbers(steps + "/CellOffsets");
  std::vector<double> offset;  // one row more than triangles in each part
  for (std::size_t n = 0; n < std::min(part.size(), cell.size()); ++n) offset.push_back(part[n] + cell[n]);
  for (const char* name : {"/NumberOfPoints", "/NumberOfCells", "/NumberOfConnectivityIds"}) {
    keep_times(file, root + name, part, count);
  }
  keep_times(file, root + "/Types", cell, count);
  keep_times(file, root + "/Offsets", offset, count);
  keep_times(file, root + "/Connectivity", file.numbers(steps + "/ConnectivityIdOffsets"), count);
  cut_array(file, root + "/Points", steps + "/PointOffsets", count);
}

void cut(Hdf5File& file, std::int64_t count) {
  if (file.has(root + "/Points")) cut_parts(file, count);
  for (const std::string kind : {"PointData", "CellData"}) {
    for (const std::string& name : file.names_in(root + '/' + kind)) {
      cut_array(file, root + '/' + kind + '/' + name, steps + '/' + kind + "Offsets/" + name, count);
    }
  }
  for (const char* name : {"NumberOfParts", "PartOffsets", "CellOffsets", "ConnectivityIdOffsets", "Values"}) {
    if (file.has(steps + '/' + name)) file.keep_rows(steps + '/' + name, count);
  }
  file.set_number(steps, "NSteps", count);
}

}  // namespace

bool has_vtkhdf() {
  return true;
}

void append_cells(Communicator& communicator, const std::filesystem::path& path, double time_us,
                  const CellArrays& cells) {
  const std::vector<Bytes> arrays = cells.file.gather(communicator);
  on_first_rank(communicator, [&] {
    Hdf5File file(path);
    append_step(file, time_us, cells, arrays);
  });
}

void append_fluid(Communicator& communicator, const std::filesystem::path& path, double time_us,
                  const FluidArrays& fluid) {
  const std::vector<Bytes> arrays = fluid.file.gather(communicator);
  on_first_rank(communicator, [&] {
    Hdf5File file(path);
    append_step(file, time_us, fluid, arrays);
  });
}

bool cut_vtkhdf(const std::filesystem::path& path, double time_us) {
  if (!std::filesystem::exists(path)) return false;
  bool present = false;
  std::int64_t count = 0;
  try {
    Hdf5File file(path);
    const std::vector<double> times = file.numbers(steps + "/Values");
    count = std::upper_bound(times.begin(), times.end(), time_us) - times.begin();
    present = count > 0 && times[static_cast<std::size_t>(count) - 1] == time_us;
    if (count > 0) cut(file, count);
  } catch (const text::FileError&) {
    std::filesystem::rename(path, path.string() + ".damaged");
    return false;
  }
  if (count == 0) std::filesystem::remove(path);
  return present;
}

}  // namespace npfem::flow
