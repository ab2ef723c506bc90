// SPDX-License-Identifier: MPL-2.0
#include "output/fluid_arrays.h"

#include <vector>

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

}  // namespace

FluidArrays fluid_arrays(const Lattice& lattice, const Units& units) {
  using Type = VtkFile::Type;
  const Decomposition& grid = lattice.decomposition();
  FluidArrays a;
  a.nodes = grid.nodes();
  a.dx = units.dx;
  const std::int64_t count = std::int64_t{a.nodes[0]} * a.nodes[1] * a.nodes[2];
  a.velocity = a.file.declare("velocity_um_per_us", Type::float32, 3, 3 * count);
  a.pressure = a.file.declare("pressure_Pa", Type::float32, 1, count);
  a.flags = a.file.declare("flags", Type::uint8, 1, count);
  const Box& own = lattice.nodes().own();
  for (int iz = 0; iz < own.size(2); ++iz) {
    for (int iy = 0; iy < own.size(1); ++iy) {
      const Row row = read_row(lattice, units, iy, iz);
      const std::int64_t first = grid.global_id(own.begin[0], own.begin[1] + iy, own.begin[2] + iz);
      a.file.put(a.velocity, 3 * first, std::span<const float>(row.velocity));
      a.file.put(a.pressure, first, std::span<const float>(row.pressure));
      a.file.put(a.flags, first, std::span<const std::uint8_t>(row.flags));
    }
  }
  return a;
}

}  // namespace npfem::flow
