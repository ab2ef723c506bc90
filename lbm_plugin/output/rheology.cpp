// SPDX-License-Identifier: MPL-2.0
#include "output/rheology.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <numbers>

#include "geometry/cell_shape.h"
#include "geometry/vec3.h"
#include "output/cell_free_layer.h"
#include "output/fixed_point_sum.h"
#include "quantity.h"
#include "simulation/start.h"

namespace npfem::flow {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// One cell, as it travels to rank 0.
struct CellFlow {
  int id, type;
  double volume;
  Vec3 velocity;  // mean of the vertices, um/us
  Vec3 moved;     // centre since the placement, um
};

/// Along which the walls extend, um2.
double wall_area(const Domain& domain) {
  const Vec3 size = domain.size();
  return domain.kind == DomainKind::tube ? 2 * std::numbers::pi * domain.tube_radius * size[2] : 2 * size[0] * size[2];
}

struct MeanVelocity {
  double found = 0, plain = 0;  // um/us: as it is, and of the steady flow without cells at the same nodes
};

MeanVelocity mean_velocity(const Simulation& simulation, Communicator& communicator) {
  const Lattice& lattice = simulation.lattice();
  const Units& units = simulation.units();
  const std::size_t axis = simulation.setup().domain.flow_axis();
  const Index3& first = lattice.nodes().own().begin;
  FixedPointSum found, plain;
  for (int iz = 0; iz < lattice.nodes().size(2); ++iz) {
    for (int iy = 0; iy < lattice.nodes().size(1); ++iy) {
      for (int ix = 0; ix < lattice.nodes().size(0); ++ix) {
        if (lattice.node_type(ix, iy, iz) != kFluid) continue;
        const Vec3 position = scale(units.dx, {first[0] + ix + 0.5, first[1] + iy + 0.5, first[2] + iz + 0.5});
        found.add(lattice.node_velocity(ix, iy, iz)[axis]);
        plain.add(developed_velocity(simulation.setup(), position)[axis] / units.velocity());
      }
    }
  }
  std::int64_t nodes = lattice.nodes().fluid_nodes();
  communicator.sum(std::span(&nodes, 1));
  const double factor = units.velocity() / static_cast<double>(nodes);
  return {found.total(communicator) * factor, plain.total(communicator) * factor};
}

/// Shear stress on the walls, positive where the fluid drags a wall at rest along or a plate drags the fluid, Pa.
double wall_stress(const Simulation& simulation, Communicator& communicator) {
  const Domain& domain = simulation.setup().domain;
  const std::vector<Vec3> forces = wall_forces(simulation.lattice(), communicator);
  const std::size_t axis = domain.flow_axis();
  // boundaries as in Domain::node_kind: 0 at rest, 1 the lower plate, 2 the upper one
  const double force = domain.kind == DomainKind::shear_box ? forces[2][axis] - forces[1][axis] : -forces[0][axis];
  return force * simulation.units().force() / wall_area(domain);
}

std::vector<CellFlow> gather(const Setup& setup, std::span<const CellState> local_cells, Communicator& communicator) {
  std::vector<CellFlow> own;
  for (const CellState& cell : local_cells) {
    const auto vertices = static_cast<double>(cell.velocity.size() / 3);
    CellFlow flow{cell.id, cell.type, cell.volume, {}, {}};
    for (std::size_t n = 0; n < cell.velocity.size(); ++n) flow.velocity[n % 3] += cell.velocity[n] / vertices;
    const CellShape shape = shape_of(cell.position, setup.types[static_cast<std::size_t>(cell.type)].triangles);
    flow.moved = subtract(shape.centre, setup.cells[static_cast<std::size_t>(cell.id)].centre);
    own.push_back(flow);
  }
  std::vector<CellFlow> all;
  for (const Bytes& bytes : communicator.gather(std::as_bytes(std::span(own)), 0)) {
    const std::size_t begin = all.size();
    all.resize(begin + bytes.size() / sizeof(CellFlow));
    if (!bytes.empty()) std::memcpy(all.data() + begin, bytes.data(), bytes.size());
  }
  std::sort(all.begin(), all.end(), [](const CellFlow& a, const CellFlow& b) { return a.id < b.id; });
  return all;
}

/// On rank 0, which has all cells.
void count_cells(const Setup& setup, const std::vector<CellFlow>& cells, Rheology& rheology) {
  const std::size_t axis = setup.domain.flow_axis();
  double volume = 0, carried = 0;  // um3, um4/us
  std::vector<int> counts(setup.types.size());
  rheology.displacement.assign(setup.types.size(), Vec3{});
  for (const CellFlow& cell : cells) {
    const auto type = static_cast<std::size_t>(cell.type);
    volume += cell.volume;
    carried += cell.volume * cell.velocity[axis];
    ++counts[type];
    for (std::size_t a = 0; a < 3; ++a) rheology.displacement[type][a] += cell.moved[a] * cell.moved[a];
  }
  for (std::size_t type = 0; type < counts.size(); ++type) {
    rheology.displacement[type] = scale(counts[type] > 0 ? 1.0 / counts[type] : unknown, rheology.displacement[type]);
  }
  rheology.haematocrit = volume / setup.domain.fluid_volume();
  const bool flows_through = setup.domain.kind != DomainKind::shear_box && rheology.mean_velocity != 0;
  rheology.discharge_haematocrit =
      flows_through ? carried / (setup.domain.fluid_volume() * rheology.mean_velocity) : unknown;
}

/// Of the whole system; what concerns cells on rank 0 only.
Rheology measure(const Simulation& simulation, std::span<const CellState> local_cells, Communicator& communicator) {
  const Setup& setup = simulation.setup();
  const Domain& domain = setup.domain;
  const MeanVelocity velocity = mean_velocity(simulation, communicator);
  Rheology r;
  r.mean_velocity = velocity.found;
  r.flow_rate = velocity.found * domain.fluid_volume() / domain.size()[domain.flow_axis()];
  r.wall_stress = domain.is_plain_channel() ? wall_stress(simulation, communicator) : unknown;
  const double viscosity = setup.density * setup.kinematic_viscosity;
  const double rate = domain.plate_speed / domain.size()[1];
  const bool comparable = domain.is_plain_channel() && setup.waveform.is_constant();
  const double ratio = !comparable                            ? unknown
                       : domain.kind == DomainKind::shear_box ? r.wall_stress / (viscosity * rate)
                                                              : velocity.plain / velocity.found;
  r.relative_viscosity = std::isfinite(ratio) && ratio != 0 ? ratio : unknown;
  r.cell_free_layer = cell_free_layer(domain, local_cells, communicator);
  const Counters counters = simulation.counters();
  r.least_gap = counters.least_gap_um;
  r.worst_volume_error = counters.worst_volume_error;
  count_cells(setup, gather(setup, local_cells, communicator), r);
  return r;
}

std::string header_for(const Setup& setup) {
  std::string header =
      "step,time_us,wall_stress_Pa,apparent_viscosity_mPa_s,relative_viscosity,mean_velocity_um_per_us,"
      "flow_rate_um3_per_us,haematocrit,discharge_haematocrit,cell_free_layer_um,least_gap_um,worst_volume_error";
  for (const CellType& type : setup.types) {
    for (const char* axis : {"x", "y", "z"}) header += ",msd_" + type.name + "_" + axis + "_um2";
  }
  return header + '\n';
}

std::string line_of(const Simulation& simulation, const Rheology& r) {
  const Setup& setup = simulation.setup();
  const double milli_pascal_seconds = setup.density * setup.kinematic_viscosity / 1000;
  std::string line = std::to_string(simulation.steps_done());
  const auto put = [&](double value) { line += ',' + (std::isfinite(value) ? text::format_number(value) : ""); };
  for (const double value : {simulation.time_us(), r.wall_stress, r.relative_viscosity * milli_pascal_seconds,
                             r.relative_viscosity, r.mean_velocity, r.flow_rate, r.haematocrit, r.discharge_haematocrit,
                             r.cell_free_layer, r.least_gap, r.worst_volume_error}) {
    put(value);
  }
  for (const Vec3& displacement : r.displacement) {
    for (const double square : displacement) put(square);
  }
  return line + '\n';
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

double number_in(const std::string& field) {
  return field.empty() ? unknown : text::parse_quantity(field, text::Dimension::none());
}

}  // namespace

RheologyTable::RheologyTable(Communicator& communicator, const std::filesystem::path& path, const Setup& setup,
                             std::optional<std::int64_t> resumed_at)
    : communicator_(communicator), file_(communicator, path, header_for(setup), resumed_at) {}

void RheologyTable::append(const Simulation& simulation, std::span<const CellState> local_cells) {
  const Rheology rheology = measure(simulation, local_cells, communicator_);
  file_.append(communicator_.rank() == 0 ? line_of(simulation, rheology) : "");
}

std::vector<std::pair<std::string, double>> rheology_means(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return {};
  const std::vector<std::string> names = split(line);
  std::vector<std::vector<double>> rows;
  while (std::getline(file, line)) {
    std::vector<double> row;
    for (const std::string& field : split(line)) row.push_back(number_in(field));
    if (row.size() == names.size()) rows.push_back(row);
  }
  if (rows.empty()) return {};
  const double from = 0.5 * rows.back()[1];
  std::erase_if(rows, [&](const auto& row) { return row[1] < from; });
  std::vector<std::pair<std::string, double>> means{{"from_us", rows.front()[1]}};
  for (std::size_t column = 2; column < names.size(); ++column) {
    double sum = 0;
    for (const auto& row : rows) sum += row[column] / static_cast<double>(rows.size());
    const bool is_so_far =
        names[column].starts_with("msd_") || names[column].starts_with("least_") || names[column].starts_with("worst_");
    means.emplace_back(names[column], is_so_far ? rows.back()[column] : sum);
  }
  return means;
}

}  // namespace npfem::flow
