// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "coupling/immersed_solid.h"
#include "simulation/setup.h"

namespace npfem::flow {

/// How the last step of a cell ended.
struct CellOutcome {
  int status = 0;  ///< NPFEM_CELL_...
  int iterations = 0;
  double residual = 0;  ///< pN
};

/// xyz of every vertex of a cell where it starts, um.
std::vector<double> start_positions(const CellStart& start, const CellType& type);

/// The cells one rank owns: those whose centroid (mean of the vertices) lies in its block. One batch of the cell solver
/// per type; to the rest of the coupling the vertices are flat arrays in order of (global cell id, vertex), whatever
/// the order in the batches.
class CellPopulation final : public ImmersedSolid {
 public:
  struct Cell {
    int id;                    ///< global
    int type;                  ///< index into Setup::types
    int slot;                  ///< index in the batch of its type
    std::size_t first_vertex;  ///< in the flat arrays
  };

  /// Places the cells of the setup, undeformed, at rest; each rank takes its own. `delta`: time step of the cell
  /// solver, us. `setup` must outlive the population. std::invalid_argument where a cell names a type that is not there
  /// or its shape does not fit its model.
  CellPopulation(const Setup& setup, Communicator& communicator, const Decomposition& decomposition, double delta)
      : CellPopulation(setup, communicator, decomposition, delta, Begin::placed) {}

  /// The same without cells, which are then added in the states of an earlier run.
  static CellPopulation without_cells(const Setup& setup, Communicator& communicator,
                                      const Decomposition& decomposition, double delta) {
    return {setup, communicator, decomposition, delta, Begin::empty};
  }

  /// Hands every cell that has left this rank's block to the rank it has entered. Collective. Without effect on the
  /// results: a cell's state moves bit for bit.
  void migrate();

  /// Takes a cell of this rank out for good.
  void remove(int type, int id);

  std::span<const Cell> cells() const { return cells_; }
  std::span<const VertexId> vertices() const override { return vertices_; }
  const api::Batch& batch(int type) const { return kind(type).batch; }
  std::size_t vertices_of(int type) const { return kind(type).vertices; }

  /// One cell's whole state as numbers, bit for bit: pack_length() of them.
  std::size_t pack_length(int type) const;
  std::vector<double> pack(const Cell& cell) const { return kind(cell.type).batch.pack(cell.slot); }
  /// Adds a cell in a packed state, wherever it is; migrate() then brings it to its owner.
  void add_packed(int type, int id, const CellOutcome& outcome, std::span<const double> state);

  const CellOutcome& outcome(const Cell& cell) const {
    return kind(cell.type).outcomes[static_cast<std::size_t>(cell.slot)];
  }

  /// Any field of the cell solver (see npfem_batch_set): to be read, one of three numbers per own vertex; to be
  /// written, of as many as are given. The constant load of a type is added to external_force as it is written, and to
  /// elastic_force as it is read: it has a potential like the elastic energy.
  void read(const char* field, std::vector<double>& values) const override;
  void write(const char* field, std::span<const double> values) override;

  void carry_fluid(const MassOfAreas& mass) override;
  void evaluate() override;
  CellStepReport step() override;
  Vec3 solid_momentum() const override;
  bool has_solid_mass() const override { return has_solid_mass_; }

  /// Hash of the states of the own cells keyed by global id; summed over the ranks modulo 2^64 it knows no layout.
  std::uint64_t state_hash() const;

 private:
  enum class Begin { placed, empty };
  CellPopulation(const Setup& setup, Communicator& communicator, const Decomposition& decomposition, double delta,
                 Begin begin);
  void create_batches(double delta);
  void place(const CellStart& start, int id);
  void add(int type, int id, const CellOutcome& outcome);
  void remove_slot(int type, int slot);
  void sort_cells();
  void add_load(const Cell& cell, std::span<double> forces) const;
  int owner_of(std::span<const double> positions) const;
  std::vector<Bytes> pack_leaving();
  void unpack_arriving(const Bytes& message);

  // One kind of cell on this rank.
  struct Kind {
    api::Batch batch;
    std::size_t vertices = 0;
    std::vector<int> ids;               // global id by slot
    std::vector<CellOutcome> outcomes;  // by slot
    std::vector<double> solid_mass;     // by vertex, fg
    std::vector<double> ambient_mass;   // by vertex, fg; empty: none
  };
  Kind& kind(int type) { return kinds_[static_cast<std::size_t>(type)]; }
  const Kind& kind(int type) const { return kinds_[static_cast<std::size_t>(type)]; }

  const Setup& setup_;
  Communicator& communicator_;
  Decomposition decomposition_;
  bool has_solid_mass_ = false;
  bool sorted_ = false;      // cells_ and vertices_ are those of kinds_
  std::vector<Kind> kinds_;  // by type
  std::vector<Cell> cells_;
  std::vector<VertexId> vertices_;
};

}  // namespace npfem::flow
