// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact/contact_law.h"
#include "geometry/domain.h"
#include "lattice/fluid_options.h"
#include "npfem/npfem.hpp"
#include "simulation/signal.h"

namespace npfem::flow {

/// A kind of cell: one model shared by all its cells.
struct CellType {
  std::string name;  ///< for example "rbc"
  std::shared_ptr<const api::Model> model;
  std::vector<double> shape;  ///< xyz of the relaxed, unloaded cell about the origin, um
  std::vector<std::int32_t> triangles;
  std::vector<std::pair<std::string, double>> options;  ///< numbers set on every batch of this type (npfem_set_f64)
  std::string material;  ///< as text, for the record: what a checkpoint knows the type by, besides its model
  double interior_viscosity_ratio = 1;  ///< viscosity of the fluid inside over that outside
  /// Constant forces on the vertices (xyz, pN, in the frame of `shape`) that add up to zero, as of tweezers; they turn
  /// with the cell's start, not with the cell. Empty: none.
  std::vector<double> load = {};
};

/// Where one cell starts: its shape turned by `rotation` (row-major), then moved to `centre` (um), the centroid of its
/// volume.
struct CellStart {
  int type;
  Vec3 centre;
  std::array<double, 9> rotation;
  /// xyz of every vertex, um, unwrapped: a cell that starts deformed. Empty: the shape of its type, turned and moved.
  std::vector<double> positions = {};
};

enum class CouplingScheme {
  implicit,  ///< ambient mass in the cell solver's implicit step, incremental form: stable for any stiffness
  peskin,    ///< explicit forces, vertices move with the fluid: the yardstick while it is stable
  lineage,   ///< stress sampling and direct forcing as in Palabos-npFEM, for comparison
};

struct CouplingSettings {
  CouplingScheme scheme = CouplingScheme::implicit;
  int kernel_points = 4;       ///< width of the immersed-boundary kernel in nodes: 2, 3 or 4
  int steps_per_solve = 1;     ///< fluid steps per step of the cell solver (k)
  int forcing_iterations = 1;  ///< `lineage` only: of the force that makes the fluid follow the vertices
  bool lineage_steps = false;  ///< the cells are solved by the steps of Palabos-npFEM, with its options
  /// Depth of the markers under the vertices, node spacings (surface_inset.h); empty: what the kernel adds to a sphere,
  /// and none for `lineage`.
  std::optional<double> inset = {};
};

/// What acts between two types of cell, or between a type and the walls, in place of the default.
struct PairContact {
  static constexpr int wall = -1;
  int first;   ///< index into Setup::types
  int second;  ///< the same, or `wall`
  ContactLaw law;
};

/// Forces between surfaces nearer to each other than the lattice resolves; see contact/contacts.h.
struct ContactSettings {
  ContactLaw cells;                ///< between two cells
  ContactLaw walls;                ///< between a cell and a wall
  std::vector<PairContact> pairs;  ///< exceptions
};

/// Everything a coupled run needs, in um, us, fg: what a scene file is turned into.
struct Setup {
  Domain domain;
  double time_step = 0;            ///< us, of the fluid
  double density = 0;              ///< fg/um3
  double kinematic_viscosity = 0;  ///< um2/us
  Vec3 body_force{};               ///< pN/um3, drives the flow
  Signal waveform = {};            ///< of the body force, and of the velocities of plates and inlets
  double magic_parameter = 3.0 / 16.0;
  Collision collision = Collision::trt;
  FluidPrecision fluid_precision = FluidPrecision::in_double;
  bool start_developed =
      false;  ///< start from the steady flow without cells (Couette, Poiseuille) instead of from rest
  CouplingSettings coupling;
  ContactSettings contact;
  std::string backend = "cpu";  ///< of the cell solver; "cpu": the best instruction set that all ranks have
  std::vector<CellType> types;
  std::vector<CellStart> cells;  ///< the index is the cell's global id
};

}  // namespace npfem::flow
