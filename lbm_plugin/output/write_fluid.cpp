// SPDX-License-Identifier: MPL-2.0
#include "output/write_fluid.h"

#include <vector>

#include "output/vtk_file.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

/// The nodes of this rank along one line in x.
struct Row {
  std::vector<float> velocity, pressure;
  std::vector<std::uint8_t> flags;
};

Row read_row(const Lattice& lattice, const Units& units, int iy, int iz) {
  Row row;
  for (int ix = 0; ix < lattice.nodes().size(0); ++ix) {
    const NodeType type = lattice.node_type(ix, iy, iz);
    Vec3 velocity{};
    double pressure = 0;
    if (type == kFluid) {
      velocity = lattice.node_velocity(ix, iy, iz);
      pressure = lattice.density_deviation(ix, iy, iz) / 3;  // the speed of sound is 1/sqrt(3)
    }
    for (const double u : velocity) row.velocity.push_back(static_cast<float>(u * units.velocity()));
    row.pressure.push_back(static_cast<float>(pressure * units.pressure()));
    row.flags.push_back(type);
  }
  return row;
}

std::string three(double value) {
  const std::string number = text::format_number(value);
  return number + ' ' + number + ' ' + number;
}

}  // namespace

void write_fluid(Communicator& communicator, const std::filesystem::path& path, double time_us, const Lattice& lattice,
                 const Units& units) {
  using Type = VtkFile::Type;
  const Decomposition& grid = lattice.decomposition();
  const Index3 nodes = grid.nodes();
  const std::int64_t count = std::int64_t{nodes[0]} * nodes[1] * nodes[2];

  VtkFile file;
  const std::size_t velocity = file.declare("velocity_um_per_us", Type::float32, 3, 3 * count);
  const std::size_t pressure = file.declare("pressure_Pa", Type::float32, 1, count);
  const std::size_t flags = file.declare("flags", Type::uint8, 1, count);
  const Box& own = lattice.nodes().own();
  for (int iz = 0; iz < own.size(2); ++iz) {
    for (int iy = 0; iy < own.size(1); ++iy) {
      const Row row = read_row(lattice, units, iy, iz);
      const std::int64_t first = grid.global_id(own.begin[0], own.begin[1] + iy, own.begin[2] + iz);
      file.put(velocity, 3 * first, std::span<const float>(row.velocity));
      file.put(pressure, first, std::span<const float>(row.pressure));
      file.put(flags, first, std::span<const std::uint8_t>(row.flags));
    }
  }

  std::string extent;
  for (const int n : nodes) extent += (extent.empty() ? "0 " : " 0 ") + std::to_string(n - 1);
  const std::string body = "<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + three(0.5 * units.dx) +
                           "\" Spacing=\"" + three(units.dx) + "\">\n" + time_element(time_us) + "<Piece Extent=\"" +
                           extent + "\">\n<PointData>\n" + file.element(velocity) + file.element(pressure) +
                           file.element(flags) + "</PointData>\n</Piece>\n</ImageData>\n";
  file.write(communicator, path, "ImageData", body);
}

}  // namespace npfem::flow
