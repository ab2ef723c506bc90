// SPDX-License-Identifier: MPL-2.0
#include "batch/batch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "batch/measure.h"
#include "batch/state_hash.h"
#include "error.h"
#include "nearest.h"
#include "quantity.h"

namespace npfem {
namespace {

constexpr std::array<const char*, 10> field_names{
    "position",     "velocity",   "external_force", "contact_stiffness", "ambient_velocity",
    "ambient_mass", "held_force", "lag_velocity",   "lag_acceleration",  "elastic_force"};
/// What a cell carries from step to step, in the order in which it is packed.
constexpr std::array<Field, 9> state_fields{Field::position,          Field::velocity,         Field::external_force,
                                            Field::contact_stiffness, Field::ambient_velocity, Field::ambient_mass,
                                            Field::held_force,        Field::lag_velocity,     Field::lag_acceleration};

std::size_t size_of(Field field, int vertices, int cells = 1) {
  return static_cast<std::size_t>(components(field)) * static_cast<std::size_t>(vertices) *
         static_cast<std::size_t>(cells);
}

/// Numbers that a field may hold; `per_cell` of them for each cell from `first_cell`.
void require_allowed(Field field, std::span<const double> values, std::size_t per_cell, int first_cell) {
  const std::string name = field_names[static_cast<std::size_t>(field)];
  const bool may_be_negative = components(field) == 3;  // masses and stiffnesses may not
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || (!may_be_negative && values[i] < 0)) {
      const std::size_t vertex = (i % per_cell) / static_cast<std::size_t>(components(field));
      throw Error(Status::bad_input, "field \"" + name + "\": found " + text::format_number(values[i]) + " at vertex " +
                                         std::to_string(vertex) + " of cell " +
                                         std::to_string(static_cast<std::size_t>(first_cell) + i / per_cell) +
                                         "; allowed are finite " +
                                         (may_be_negative ? "numbers" : "numbers of at least 0"));
    }
  }
}

}  // namespace

Field field_by_name(std::string_view name) {
  for (std::size_t i = 0; i < field_names.size(); ++i) {
    if (name == field_names[i]) return static_cast<Field>(i);
  }
  throw Error(Status::unknown_name,
              "no field \"" + std::string(name) + "\"" +
                  text::suggestion(name, std::vector<std::string>(field_names.begin(), field_names.end())));
}

Batch::Batch(std::shared_ptr<const Model> model, std::string_view backend, int cells)
    : model_(std::move(model)), backend_(create_backend(model_, backend)) {
  add_cells(cells);
}

int Batch::add_cells(int count) {
  if (count < 0) throw Error(Status::bad_argument, std::to_string(count) + " cells asked for; allowed: 0 or more");
  const int first = num_cells();
  if (count > std::numeric_limits<int>::max() - first) {
    throw Error(Status::bad_argument, "too many cells: a batch holds at most 2147483647");
  }
  backend_->add_cells(count);
  energies_are_current_ = false;
  masses_are_positive_ = false;
  return first;
}

void Batch::remove_cell(int cell) {
  require_cells(cell, 1);
  backend_->remove_cell(cell);
}

void Batch::require_cells(int first, int count) const {
  if (first < 0 || count < 0 || first > num_cells() - count) {
    throw Error(Status::bad_argument, "cells " + std::to_string(first) + " to " +
                                          std::to_string(static_cast<long long>(first) + count - 1) +
                                          " asked for; the batch has " + std::to_string(num_cells()));
  }
}

void Batch::require_length(std::size_t found, std::size_t needed, const std::string& what) const {
  if (found != needed) {
    throw Error(Status::bad_argument,
                what + " needs an array of " + std::to_string(needed) + " numbers, found " + std::to_string(found));
  }
}

void Batch::write(Field field, int first, int count, std::span<const double> values) {
  require_cells(first, count);
  const std::string name = field_names[static_cast<std::size_t>(field)];
  if (field == Field::elastic_force) {
    throw Error(Status::bad_argument,
                "field \"elastic_force\" is computed and cannot be written; "
                "loads are external_force");
  }
  require_length(values.size(), size_of(field, model_->num_vertices(), count), "field \"" + name + "\"");
  if (field == Field::position) energies_are_current_ = false;
  if (field == Field::ambient_mass) masses_are_positive_ = false;
  const std::size_t per_cell = size_of(field, model_->num_vertices());
  require_allowed(field, values, per_cell, first);
  for (int c = 0; c < count; ++c) {
    backend_->write(field, first + c, values.subspan(per_cell * static_cast<std::size_t>(c), per_cell));
    if (field == Field::velocity) forget_past(first + c);
  }
}

void Batch::read(Field field, int first, int count, std::span<double> values) const {
  require_cells(first, count);
  require_length(values.size(), size_of(field, model_->num_vertices(), count),
                 "field \"" + std::string(field_names[static_cast<std::size_t>(field)]) + "\"");
  const std::size_t per_cell = size_of(field, model_->num_vertices());
  for (int c = 0; c < count; ++c) {
    backend_->read(field, first + c, values.subspan(per_cell * static_cast<std::size_t>(c), per_cell));
  }
}

void Batch::add_patch(std::span<const int> vertices, double stiffness) {
  if (vertices.size() < 2) throw Error(Status::bad_argument, "a patch needs at least 2 vertices");
  if (!(stiffness > 0) || !std::isfinite(stiffness)) {
    throw Error(Status::bad_input,
                "patch stiffness " + text::format_number(stiffness) + " pN/um: allowed are finite numbers above 0");
  }
  std::vector<char> seen(static_cast<std::size_t>(model_->num_vertices()), 0);
  for (const int v : vertices) {
    if (v < 0 || v >= model_->num_vertices()) {
      throw Error(Status::bad_argument, "patch vertex " + std::to_string(v) + " does not exist; the model has " +
                                            std::to_string(model_->num_vertices()));
    }
    if (seen[static_cast<std::size_t>(v)]++) {
      throw Error(Status::bad_argument, "patch vertex " + std::to_string(v) + " is listed twice");
    }
  }
  patches_.push_back({std::vector<int>(vertices.begin(), vertices.end()), stiffness});
  backend_->set_patches(patches_);
}

void Batch::clear_patches() {
  patches_.clear();
  backend_->set_patches({});
}

void Batch::forget_past(int cell) {
  const std::vector<double> zero(size_of(Field::lag_velocity, model_->num_vertices()), 0.0);
  for (const Field lag : {Field::lag_velocity, Field::lag_acceleration}) backend_->write(lag, cell, zero);
}

void Batch::require_steppable() {
  require_masses();
  if (options_.lineage && model_->is_viscous()) {
    throw Error(Status::wrong_order,
                "method \"lineage\" knows no membrane viscosity: set method = \"default\", or take a material whose "
                "membrane_shear_viscosity and membrane_dilatational_viscosity are 0");
  }
  if (options_.lineage && options_.integrator != Integrator::implicit_euler) {
    throw Error(Status::wrong_order,
                "method \"lineage\" steps by implicit Euler: set integrator = 0, or method = \"default\" for BDF2");
  }
  if (options_.integrator == Integrator::bdf2) require_no_fluid();
}

void Batch::require_no_fluid() const {
  std::vector<double> values;
  for (int c = 0; c < num_cells(); ++c) {
    for (const Field field : {Field::ambient_mass, Field::held_force}) {
      values.resize(size_of(field, model_->num_vertices()));
      backend_->read(field, c, values);
      const auto found = std::find_if(values.begin(), values.end(), [](double value) { return value != 0; });
      if (found == values.end()) continue;
      throw Error(Status::wrong_order,
                  "integrator = 1 (BDF2) is for cells without a fluid, but cell " + std::to_string(c) + " has the " +
                      field_names[static_cast<std::size_t>(field)] + " " + text::format_number(*found) +
                      "; set integrator = 0 (implicit Euler), or ambient_mass and held_force to 0");
    }
  }
}

void Batch::require_masses() {
  if (masses_are_positive_) return;
  std::vector<double> ambient(static_cast<std::size_t>(model_->num_vertices()));
  for (int c = 0; c < num_cells(); ++c) {
    backend_->read(Field::ambient_mass, c, ambient);
    for (std::size_t i = 0; i < ambient.size(); ++i) {
      if (!(ambient[i] + model_->solid_mass[i] > 0)) {
        throw Error(Status::wrong_order, "vertex " + std::to_string(i) + " of cell " + std::to_string(c) +
                                             " has no mass: give the material a membrane_density or "
                                             "solid_density, set the field "
                                             "\"ambient_mass\" (a surrounding fluid), or use relax "
                                             "for a static equilibrium");
      }
    }
  }
  masses_are_positive_ = true;
}

int Batch::num_failed() const {
  int failed = 0;
  for (int c = 0; c < num_cells(); ++c) failed += has_failed(backend_->report(c).status) ? 1 : 0;
  return failed;
}

int Batch::step(int steps) {
  if (steps < 0) throw Error(Status::bad_argument, std::to_string(steps) + " steps asked for; allowed: 0 or more");
  require_valid(options_);
  require_steppable();
  stop_.store(false, std::memory_order_relaxed);
  energies_are_current_ = false;
  for (int s = 0; s < steps && !stop_.load(std::memory_order_relaxed); ++s) {
    backend_->step(options_);
    if (const int failed = num_failed(); failed > 0) return failed;
  }
  return 0;
}

int Batch::step_for_ms(double milliseconds, int& steps_done) {
  if (!(milliseconds >= 0)) {
    throw Error(Status::bad_argument, text::format_number(milliseconds) + " ms asked for; allowed: 0 or more");
  }
  require_valid(options_);
  require_steppable();
  stop_.store(false, std::memory_order_relaxed);
  energies_are_current_ = false;
  const auto start = std::chrono::steady_clock::now();
  steps_done = 0;
  do {
    backend_->step(options_);
    ++steps_done;
    if (const int failed = num_failed(); failed > 0) return failed;
  } while (!stop_.load(std::memory_order_relaxed) &&
           std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() < milliseconds);
  return 0;
}

int Batch::relax() {
  require_valid(options_);
  for (int c = 0; c < num_cells(); ++c) require_balanced(field_of(Field::external_force, c), c);
  stop_.store(false, std::memory_order_relaxed);
  energies_are_current_ = false;
  backend_->relax(options_, stop_);
  return num_failed();
}

void Batch::evaluate() {
  backend_->evaluate();
  energies_are_current_ = true;
}

CellReport Batch::report(int cell) const {
  require_cells(cell, 1);
  return backend_->report(cell);
}

std::string Batch::status_text(int cell) const {
  const CellReport r = report(cell);
  const char* outcome = "";
  switch (r.status) {
    case CellStatus::converged:
      outcome = "converged";
      break;
    case CellStatus::iteration_cap:
      outcome = "stopped short of the tolerance, within residual_bound";
      break;
    case CellStatus::not_finite:
      outcome = "failed: forces or energies are not finite";
      break;
    case CellStatus::no_descent:
      outcome = "failed: no step lowers the objective";
      break;
    case CellStatus::not_converged:
      outcome = "failed: iteration cap with a residual above residual_bound";
      break;
  }
  return "cell " + std::to_string(cell) + " " + outcome + "; residual " + text::format_rounded(r.residual) +
         " pN, tolerance " + text::format_rounded(r.tolerance) + ", after " + std::to_string(r.iterations) +
         " iterations";
}

std::vector<double> Batch::field_of(Field field, int cell) const {
  std::vector<double> values(size_of(field, model_->num_vertices()));
  backend_->read(field, cell, values);
  return values;
}

double Batch::measure(std::string_view key, int cell) const {
  require_cells(cell, 1);
  if (key.substr(0, 6) == "energy" && !energies_are_current_) {
    throw Error(Status::wrong_order, "measure \"" + std::string(key) +
                                         "\": the cells have moved since energies were evaluated; "
                                         "evaluate first");
  }
  if (key.substr(0, 6) == "energy") return measure_energy(*model_, key, backend_->energies(cell));
  if (key == "evaluations") return backend_->report(cell).evaluations;
  if (key == "hessian_iterations") return backend_->report(cell).hessian_iterations;
  if (key == "flops") return operations_of_last_step(cell);
  return measure_shape(*model_, key, field_of(Field::position, cell));
}

double Batch::operations_of_last_step(int cell) const {
  if (!operations_) operations_ = count_operations(*model_);
  return operations_of_step(*operations_, options_, backend_->report(cell));
}

std::uint64_t Batch::state_hash(int cell) const {
  require_cells(cell, 1);
  std::uint64_t hash = 0;
  for (const Field field :
       {Field::position, Field::velocity, Field::held_force, Field::lag_velocity, Field::lag_acceleration}) {
    hash = hash_values(field_of(field, cell), hash);
  }
  return hash;
}

int Batch::pack_length() const {
  std::size_t length = 0;
  for (const Field field : state_fields) length += size_of(field, model_->num_vertices());
  return static_cast<int>(length);
}

void Batch::pack(int cell, std::span<double> values) const {
  require_cells(cell, 1);
  require_length(values.size(), static_cast<std::size_t>(pack_length()), "a packed cell");
  std::size_t offset = 0;
  for (const Field field : state_fields) {
    const std::size_t size = size_of(field, model_->num_vertices());
    backend_->read(field, cell, values.subspan(offset, size));
    offset += size;
  }
}

void Batch::unpack(int cell, std::span<const double> values) {
  require_cells(cell, 1);
  require_length(values.size(), static_cast<std::size_t>(pack_length()), "a packed cell");
  std::size_t offset = 0;
  for (const Field field : state_fields) {
    const std::size_t size = size_of(field, model_->num_vertices());
    require_allowed(field, values.subspan(offset, size), size, cell);
    offset += size;
  }
  energies_are_current_ = false;
  masses_are_positive_ = false;
  offset = 0;
  for (const Field field : state_fields) {
    const std::size_t size = size_of(field, model_->num_vertices());
    backend_->write(field, cell, values.subspan(offset, size));
    offset += size;
  }
}

}  // namespace npfem
