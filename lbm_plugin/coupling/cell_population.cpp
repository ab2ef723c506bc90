// SPDX-License-Identifier: MPL-2.0
#include "coupling/cell_population.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "geometry/vec3.h"
#include "immersed_boundary/stencil.h"
#include "lattice/compensated_sum.h"
#include "mix_bits.h"

namespace npfem::flow {
namespace {

// What comes before the state of a migrating cell.
struct CellTag {
  int id;
  int type;
  CellOutcome outcome;
};

void require_shape(const CellType& type) {
  const auto numbers = 3 * static_cast<std::size_t>(type.model->vertices());
  if (type.shape.size() == numbers) return;
  throw std::invalid_argument("cells \"" + type.name + "\": the shape has " + std::to_string(type.shape.size()) +
                              " coordinates, its model needs " + std::to_string(numbers));
}

}  // namespace

std::vector<double> start_positions(const CellStart& start, const CellType& type) {
  if (!start.positions.empty()) return start.positions;
  std::vector<double> positions = type.shape;
  for (std::size_t v = 0; v < positions.size() / 3; ++v) {
    const Vec3 turned = rotate(start.rotation, vector_at(positions, v));
    set_vector(positions, v, add(start.centre, turned));
  }
  return positions;
}

CellPopulation::CellPopulation(const Setup& setup, Communicator& communicator, const Decomposition& decomposition,
                               double delta, Begin begin)
    : setup_(setup), communicator_(communicator), decomposition_(decomposition) {
  create_batches(delta);
  if (begin == Begin::empty) return;
  for (std::size_t i = 0; i < setup.cells.size(); ++i) place(setup.cells[i], static_cast<int>(i));
  sort_cells();
}

void CellPopulation::create_batches(double delta) {
  for (const CellType& type : setup_.types) {
    require_shape(type);
    Kind created{api::Batch(*type.model, setup_.backend, 0),
                 static_cast<std::size_t>(type.model->vertices()),
                 {},
                 {},
                 type.model->get("solid_mass"),
                 {}};
    created.batch.set("time_step", delta);
    if (setup_.coupling.lineage_steps) created.batch.set("method", "lineage");
    for (const auto& [key, value] : type.options) created.batch.set(key, value);
    for (const double mass : created.solid_mass) has_solid_mass_ = has_solid_mass_ || mass > 0;
    kinds_.push_back(std::move(created));
  }
}

void CellPopulation::place(const CellStart& start, int id) {
  if (start.type < 0 || start.type >= static_cast<int>(kinds_.size())) {
    throw std::invalid_argument("cell " + std::to_string(id) + " is of type " + std::to_string(start.type) +
                                "; there are " + std::to_string(kinds_.size()) + " types, counted from 0");
  }
  const std::vector<double> positions = start_positions(start, setup_.types[static_cast<std::size_t>(start.type)]);
  if (positions.size() != 3 * vertices_of(start.type)) {
    throw std::invalid_argument("cell " + std::to_string(id) + " starts with " + std::to_string(positions.size()) +
                                " coordinates, its model needs " + std::to_string(3 * vertices_of(start.type)));
  }
  if (owner_of(positions) != communicator_.rank()) return;
  add(start.type, id, {});
  Kind& its = kind(start.type);
  its.batch.write("position", static_cast<int>(its.ids.size()) - 1, 1, positions);
}

/// Appends a cell to the batch of its type; its state is still to be written.
void CellPopulation::add(int type, int id, const CellOutcome& outcome) {
  sorted_ = false;
  Kind& its = kind(type);
  const int slot = its.batch.add(1);
  its.ids.push_back(id);
  its.outcomes.push_back(outcome);
  if (!its.ambient_mass.empty()) its.batch.write("ambient_mass", slot, 1, its.ambient_mass);
}

std::size_t CellPopulation::pack_length(int type) const {
  return static_cast<std::size_t>(api::check(npfem_batch_pack_length(kind(type).batch.handle())));
}

void CellPopulation::add_packed(int type, int id, const CellOutcome& outcome, std::span<const double> state) {
  add(type, id, outcome);
  Kind& its = kind(type);
  its.batch.unpack(static_cast<int>(its.ids.size()) - 1, state);
}

void CellPopulation::sort_cells() {
  sorted_ = true;
  cells_.clear();
  for (std::size_t type = 0; type < kinds_.size(); ++type) {
    const auto& ids = kinds_[type].ids;
    for (std::size_t slot = 0; slot < ids.size(); ++slot) {
      cells_.push_back({ids[slot], static_cast<int>(type), static_cast<int>(slot), 0});
    }
  }
  std::sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) { return a.id < b.id; });
  vertices_.clear();
  for (Cell& cell : cells_) {
    cell.first_vertex = vertices_.size();
    for (std::size_t v = 0; v < vertices_of(cell.type); ++v) vertices_.push_back({cell.id, static_cast<int>(v)});
  }
}

/// Moves the cells after it one slot down.
void CellPopulation::remove_slot(int type, int slot) {
  sorted_ = false;
  Kind& its = kind(type);
  its.batch.remove(slot);
  its.ids.erase(its.ids.begin() + slot);
  its.outcomes.erase(its.outcomes.begin() + slot);
}

void CellPopulation::remove(int type, int id) {
  const std::vector<int>& ids = kind(type).ids;
  remove_slot(type, static_cast<int>(std::find(ids.begin(), ids.end(), id) - ids.begin()));
  sort_cells();
}

int CellPopulation::owner_of(std::span<const double> positions) const {
  Vec3 sum{};
  const std::size_t vertices = positions.size() / 3;
  for (std::size_t i = 0; i < positions.size(); ++i) sum[i % 3] += positions[i];
  const Vec3 centroid = scale(1.0 / (static_cast<double>(vertices) * setup_.domain.dx), sum);
  const Index3 node = node_in_grid(decomposition_, centroid);
  return decomposition_.owner_of(node[0], node[1], node[2]);
}

void CellPopulation::migrate() {
  const std::vector<Bytes> messages = pack_leaving();
  std::vector<Outgoing> outgoing;
  for (std::size_t rank = 0; rank < messages.size(); ++rank) {
    if (!messages[rank].empty()) outgoing.push_back({static_cast<int>(rank), messages[rank]});
  }
  std::vector<Incoming> incoming;
  communicator_.exchange(outgoing, incoming);
  for (const Incoming& message : incoming) unpack_arriving(message.bytes);
  if (!sorted_) sort_cells();
}

std::vector<Bytes> CellPopulation::pack_leaving() {
  std::vector<Bytes> messages(static_cast<std::size_t>(communicator_.size()));
  std::vector<double> positions;
  for (std::size_t type = 0; type < kinds_.size(); ++type) {
    Kind& its = kinds_[type];
    positions.resize(3 * its.vertices);
    // From the last slot down: removing a cell moves those after it.
    for (int slot = static_cast<int>(its.ids.size()) - 1; slot >= 0; --slot) {
      its.batch.read("position", slot, 1, positions);
      const int owner = owner_of(positions);
      if (owner == communicator_.rank()) continue;
      const auto s = static_cast<std::size_t>(slot);
      const CellTag tag{its.ids[s], static_cast<int>(type), its.outcomes[s]};
      Bytes& message = messages[static_cast<std::size_t>(owner)];
      append(message, std::span(&tag, 1));
      append<double>(message, its.batch.pack(slot));
      remove_slot(static_cast<int>(type), slot);
    }
  }
  return messages;
}

void CellPopulation::unpack_arriving(const Bytes& message) {
  std::vector<double> state;
  for (std::size_t at = 0; at < message.size();) {
    CellTag tag;
    std::memcpy(&tag, message.data() + at, sizeof tag);
    at += sizeof tag;
    state.resize(pack_length(tag.type));
    std::memcpy(state.data(), message.data() + at, state.size() * sizeof(double));
    at += state.size() * sizeof(double);
    add_packed(tag.type, tag.id, tag.outcome, state);
  }
}

void CellPopulation::carry_fluid(const MassOfAreas& mass) {
  for (std::size_t type = 0; type < kinds_.size(); ++type) {
    Kind& its = kinds_[type];
    its.ambient_mass = mass(setup_.types[type].model->get("rest_area"));
    for (int slot = 0; slot < static_cast<int>(its.ids.size()); ++slot) {
      its.batch.write("ambient_mass", slot, 1, its.ambient_mass);
    }
  }
}

void CellPopulation::read(const char* field, std::vector<double>& values) const {
  values.resize(3 * vertices_.size());
  const bool takes_loads = std::string_view(field) == "elastic_force";
  for (const Cell& cell : cells_) {
    const auto part = std::span(values).subspan(3 * cell.first_vertex, 3 * vertices_of(cell.type));
    kind(cell.type).batch.read(field, cell.slot, 1, part);
    if (takes_loads) add_load(cell, part);
  }
}

/// The load of the cell's type, turned as the cell was when it started.
void CellPopulation::add_load(const Cell& cell, std::span<double> forces) const {
  const std::vector<double>& load = setup_.types[static_cast<std::size_t>(cell.type)].load;
  const Rotation& start = setup_.cells[static_cast<std::size_t>(cell.id)].rotation;
  for (std::size_t i = 0; i < load.size(); i += 3) {
    const Vec3 turned = rotate(start, {load[i], load[i + 1], load[i + 2]});
    for (std::size_t axis = 0; axis < 3; ++axis) forces[i + axis] += turned[axis];
  }
}

void CellPopulation::write(const char* field, std::span<const double> values) {
  if (vertices_.empty()) return;
  const std::size_t components = values.size() / vertices_.size();
  const bool takes_loads = std::string_view(field) == "external_force";
  std::vector<double> with_load;
  for (const Cell& cell : cells_) {
    auto part = values.subspan(components * cell.first_vertex, components * vertices_of(cell.type));
    if (takes_loads && !setup_.types[static_cast<std::size_t>(cell.type)].load.empty()) {
      with_load.assign(part.begin(), part.end());
      add_load(cell, with_load);
      part = with_load;
    }
    kind(cell.type).batch.write(field, cell.slot, 1, part);
  }
}

void CellPopulation::evaluate() {
  for (Kind& its : kinds_) {
    if (!its.ids.empty()) its.batch.evaluate();
  }
}

CellStepReport CellPopulation::step() {
  CellStepReport report;
  for (std::size_t type = 0; type < kinds_.size(); ++type) {
    Kind& its = kinds_[type];
    if (its.ids.empty()) continue;
    its.batch.step();
    const std::vector<std::int32_t> status = its.batch.status();
    const std::vector<std::int32_t> iterations = its.batch.iterations();
    const std::vector<double> residual = its.batch.residual();
    for (std::size_t slot = 0; slot < its.ids.size(); ++slot) {
      ++report.cell_steps;
      report.iterations += iterations[slot];
      report.worst_residual = std::max(report.worst_residual, residual[slot]);
      its.outcomes[slot] = {status[slot], iterations[slot], residual[slot]};
      if (status[slot] >= NPFEM_CELL_NOT_FINITE) {
        report.failures.push_back(
            {its.ids[slot], static_cast<int>(type), its.batch.status_text(static_cast<int>(slot))});
      }
    }
  }
  return report;
}

Vec3 CellPopulation::solid_momentum() const {
  if (!has_solid_mass_) return {};
  std::array<CompensatedSum, 3> sum;
  std::vector<double> velocity;
  read("velocity", velocity);
  for (const Cell& cell : cells_) {
    const auto& masses = kind(cell.type).solid_mass;
    for (std::size_t v = 0; v < masses.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sum[axis].add(masses[v] * velocity[3 * (cell.first_vertex + v) + axis]);
      }
    }
  }
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

std::uint64_t CellPopulation::state_hash() const {
  std::uint64_t sum = 0;
  for (const Kind& its : kinds_) {
    if (its.ids.empty()) continue;
    const std::vector<std::int64_t> hashes = its.batch.state_hash();
    for (std::size_t slot = 0; slot < its.ids.size(); ++slot) {
      const std::uint64_t key = mix_bits(static_cast<std::uint64_t>(its.ids[slot]) + 1);
      sum += mix_bits(key ^ static_cast<std::uint64_t>(hashes[slot]));
    }
  }
  return sum;
}

}  // namespace npfem::flow
