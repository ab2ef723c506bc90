// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backend/cell_status.h"
#include "backend/solver_options.h"
#include "model/model.h"

namespace npfem {

/// What is kept for every vertex of every cell. Units in npfem.h.
enum class Field {
  position,
  velocity,
  external_force,
  contact_stiffness,
  ambient_velocity,
  ambient_mass,
  held_force,
  lag_velocity,
  lag_acceleration,
  elastic_force,
  tied_at  ///< where each vertex stood when a patch tied it; a back end's own, without a name
};

inline constexpr std::size_t num_fields = static_cast<std::size_t>(Field::tied_at) + 1;

inline int components(Field field) {
  return field == Field::ambient_mass || field == Field::contact_stiffness ? 1 : 3;
}

/// Vertices that move as one translating body.
struct Patch {
  std::vector<int> vertices;
  double stiffness;  ///< pN/um
};

/// A plane-like obstacle point of the lineage: pushes vertices to the side its normal points to.
struct LineageObstacle {
  Point target;      ///< um
  Point normal;      ///< unit
  double threshold;  ///< um: reach of the point, and stand-off along the normal
  double stand_off;  ///< um
  double weight;     ///< pN/um
};

/// The state of N cells of one model, and how it is advanced. One implementation per kind of machine; what each must
/// compute is written down by the implementation "reference".
class Backend {
 public:
  virtual ~Backend() = default;

  virtual int num_cells() const = 0;
  virtual void add_cells(int count) = 0;
  /// Removes one cell; those after it move down by one.
  virtual void remove_cell(int cell) = 0;

  /// One cell's field, flat (xyzxyz...), components(field) * vertices numbers.
  virtual void write(Field field, int cell, std::span<const double> values) = 0;
  virtual void read(Field field, int cell, std::span<double> values) const = 0;

  virtual void set_patches(std::vector<Patch> patches) = 0;
  virtual void set_obstacles(std::vector<LineageObstacle> obstacles) = 0;

  /// One implicit step of every cell.
  virtual void step(const SolverOptions& options) = 0;
  /// Static equilibrium of every cell under its external forces; returns after the present cell when `stop` is set.
  virtual void relax(const SolverOptions& options, const std::atomic<bool>& stop) = 0;
  /// Elastic forces (the field) and energies (in the order of Model::energy_names()) at the present positions.
  virtual void evaluate() = 0;

  virtual CellReport report(int cell) const = 0;
  /// Energies of the last evaluate(), pN um.
  virtual std::span<const double> energies(int cell) const = 0;
};

/// By name. Throws Error(unavailable) with the list of those this build has: there is no silent fall-back.
std::unique_ptr<Backend> create_backend(std::shared_ptr<const Model> model, std::string_view name);
std::vector<std::string> backend_names();

}  // namespace npfem
