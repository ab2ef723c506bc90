// SPDX-License-Identifier: MPL-2.0
#include "output/cell_table.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/cell_shape.h"
#include "output/principal_stretches.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

constexpr const char* header =
    "step,time_us,cell_id,type,centre_x_um,centre_y_um,centre_z_um,velocity_x_um_per_us,velocity_y_um_per_us,"
    "velocity_z_um_per_us,volume_um3,area_um2,long_semi_axis_um,middle_semi_axis_um,short_semi_axis_um,"
    "taylor_deformation,normal_x,normal_y,normal_z,inclination_deg,largest_stretch,status,iterations,residual_pN\n";

constexpr std::size_t measures = 17;  // from centre_x to largest_stretch

/// One line, as it travels to rank 0.
struct Row {
  int id, type;
  std::array<double, measures> numbers;
  int status, iterations;
  double residual;
};

Row row_of(const CellState& cell, const Setup& setup) {
  const CellType& type = setup.types[static_cast<std::size_t>(cell.type)];
  const CellShape shape = shape_of(cell.position, type.triangles);
  Vec3 velocity{};
  const auto vertices = static_cast<double>(cell.velocity.size() / 3);
  for (std::size_t n = 0; n < cell.velocity.size(); ++n) velocity[n % 3] += cell.velocity[n] / vertices;
  return {cell.id,
          cell.type,
          {shape.centre[0], shape.centre[1], shape.centre[2], velocity[0], velocity[1], velocity[2], cell.volume,
           cell.area, shape.semi_axes[0], shape.semi_axes[1], shape.semi_axes[2], shape.deformation, shape.normal[0],
           shape.normal[1], shape.normal[2], shape.inclination * 180 / std::numbers::pi,
           largest_stretch(principal_stretches(type.shape, cell.position, type.triangles))},
          cell.status,
          cell.iterations,
          cell.residual};
}

std::vector<Row> gather_rows(Communicator& communicator, const std::vector<Row>& own) {
  std::vector<Row> all;
  for (const Bytes& bytes : communicator.gather(std::as_bytes(std::span(own)), 0)) {
    const std::size_t begin = all.size();
    all.resize(begin + bytes.size() / sizeof(Row));
    if (!bytes.empty()) std::memcpy(all.data() + begin, bytes.data(), bytes.size());
  }
  std::sort(all.begin(), all.end(), [](const Row& a, const Row& b) { return a.id < b.id; });
  return all;
}

}  // namespace

CellTable::CellTable(Communicator& communicator, std::filesystem::path path, const Setup& setup,
                     std::optional<std::int64_t> resumed_at)
    : communicator_(communicator), setup_(setup), file_(communicator, std::move(path), header, resumed_at) {}

void CellTable::append(std::int64_t step, double time_us, std::span<const CellState> local_cells) {
  std::vector<Row> own;
  for (const CellState& cell : local_cells) own.push_back(row_of(cell, setup_));
  std::string lines;
  for (const Row& row : gather_rows(communicator_, own)) {
    std::string line = std::to_string(step) + ',' + text::format_number(time_us) + ',' + std::to_string(row.id) + ',' +
                       setup_.types[static_cast<std::size_t>(row.type)].name;
    for (const double number : row.numbers) line += ',' + text::format_number(number);
    line += ',' + std::to_string(row.status) + ',' + std::to_string(row.iterations) + ',' +
            text::format_number(row.residual);
    lines += line + '\n';
  }
  file_.append(lines);
}

}  // namespace npfem::flow
