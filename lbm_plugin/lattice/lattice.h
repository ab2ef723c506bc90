// SPDX-License-Identifier: MPL-2.0
#pragma once

// The fluid: a lattice Boltzmann solver on the D3Q19 lattice, in lattice units (node spacing, time step and density
// are 1; kinematic viscosity (tau - 1/2) / 3).
//
//   collision   two relaxation times (Ginzburg, Verhaeghe & d'Humieres 2008): tau for the even part of the populations,
//               which sets the viscosity, and 1/2 + magic / (tau - 1/2) for the odd part. magic = 3/16 puts a plane
//               wall exactly half-way between nodes in Poiseuille flow at any tau. Equal times are BGK: bgk_magic(tau);
//   force       Guo, Zheng & Shi (2002), velocity u = j + F/2;
//   equilibrium He & Luo (1997), density 1 in front of the velocity;
//   walls       half-way bounce-back, moving walls after Ladd (1994): a population that meets the wall returns with
//               6 w_i (c_i . u_wall) subtracted.
//
// Populations are stored as deviations from w_i, so that a fluid nearly at rest keeps all its digits. Between steps the
// state is the *streamed* populations f(t_n); the sequence of one coupled step is
//   update_velocity();   u = j + F/2 with the force F held since the last step, on own and halo nodes
//   clear_force();       F = body force
//   add_force(...);      whatever else acts, on own nodes
//   step();              collide with F, stream, bounce: t_n -> t_n + 1; may be repeated with the same F
//
// Momentum. With j(t) the sum of c_i f_i over all fluid nodes and F the sum of the force used in the step,
//   j(t+1) - j(t) = F + W,
// W being the impulse of the walls, wall_impulse(): collision adds F (the two halves of Guo's scheme together),
// streaming moves, bouncing changes c_i f_i into c_-i f_-i. The physical momentum P = j + F/2 holds half of the force
// of the step just done, hence
//   P(t+1) - P(t) = W + F + (F - F_before) / 2.
//
// Every node is updated by the same arithmetic wherever it is stored: the bits do not depend on ranks or threads.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "communicator/halo.h"
#include "communicator/local_grid.h"
#include "lattice/aligned_buffer.h"
#include "lattice/d3q19.h"
#include "lattice/geometry.h"
#include "lattice/node_map.h"

namespace npfem::flow {

struct LatticeOptions {
  double tau = 1.0;           // relaxation time of the even part, > 1/2
  double magic = 3.0 / 16.0;  // (tau_even - 1/2)(tau_odd - 1/2), > 0
  Vec3 body_force{};          // per node and step
};

constexpr double bgk_magic(double tau) {
  return (tau - 0.5) * (tau - 0.5);
}
constexpr double lattice_viscosity(double tau) {
  return (tau - 0.5) / 3.0;
}

struct FluidState {
  double density_deviation = 0.0;  // rho - 1 = 3 p
  Vec3 velocity{};
};

// xx, yy, zz, xy, xz, yz
using SymmetricTensor = std::array<double, 6>;

class Lattice {
 public:
  // Layers of velocity known around the own box: what the widest immersed-boundary kernel reaches.
  static constexpr int kHalo = 2;

  // Starts at rest. Collective. std::invalid_argument for options that make no sense, std::runtime_error on all ranks
  // for such a geometry.
  Lattice(Communicator& communicator, const Decomposition& decomposition, const Geometry& geometry,
          const LatticeOptions& options);

  // Sets the populations to equilibrium at the state given by global node index, and the held force to the body force.
  // The populations carry j = u - F/2, so that update_velocity() finds the velocity asked for.
  void initialise(const std::function<FluidState(int ix, int iy, int iz)>& state);

  void update_velocity();
  void clear_force();
  void step();

  // Local indices of own nodes. Force on a solid node is borne by the wall; see wall_force().
  void add_force(int ix, int iy, int iz, double fx, double fy, double fz) {
    const std::ptrdiff_t n = grid_.index(ix, iy, iz);
    force(0)[n] += fx;
    force(1)[n] += fy;
    force(2)[n] += fz;
  }
  void set_body_force(const Vec3& force) { options_.body_force = force; }  // from the next clear_force() on

  const Decomposition& decomposition() const { return decomposition_; }
  const LocalGrid& grid() const { return grid_; }
  const NodeMap& nodes() const { return nodes_; }
  const LatticeOptions& options() const { return options_; }
  double viscosity() const { return lattice_viscosity(options_.tau); }
  NodeType node_type(int ix, int iy, int iz) const { return nodes_.type(grid_.index(ix, iy, iz)); }

  // Fields over grid(), one component: velocity on own and halo nodes (on solid nodes that of the wall), force and
  // populations on own nodes.
  const double* velocity(int axis) const { return velocity_.data() + axis * stride_; }
  const double* force(int axis) const { return force_.data() + axis * stride_; }
  double* force(int axis) { return force_.data() + axis * stride_; }
  const double* population(int i) const { return populations_.data() + i * stride_; }
  double* population(int i) { return populations_.data() + i * stride_; }

  // The state at one own node, local indices: what a checkpoint keeps. Populations are deviations from the weights;
  // force is what the lattice holds (see clear_force), on solid nodes what the wall bears.
  using Populations = std::array<double, d3q19::kDirections>;
  Populations populations_at(int ix, int iy, int iz) const;
  void set_populations_at(int ix, int iy, int iz, const Populations& populations);
  Vec3 force_at(int ix, int iy, int iz) const;
  void set_force_at(int ix, int iy, int iz, const Vec3& force);
  // Own and halo nodes, as of the last update_velocity().
  Vec3 velocity_at(int ix, int iy, int iz) const;

  // At one own fluid node, local indices. Velocity and strain rate count half of the held force, as update_velocity().
  double density_deviation(int ix, int iy, int iz) const;
  Vec3 node_velocity(int ix, int iy, int iz) const;
  // (grad u + grad u^T)/2 from the populations, second order, without differences between nodes.
  SymmetricTensor strain_rate(int ix, int iy, int iz) const;

  // Sums over the own fluid nodes of this rank, compensated; the caller adds up the ranks.
  Vec3 bare_momentum() const;     // j
  Vec3 momentum() const;          // P = j + F/2, between step() and clear_force()
  Vec3 fluid_force() const;       // F on fluid nodes
  Vec3 wall_force() const;        // force given to solid nodes by add_force()
  double mass_deviation() const;  // sum of rho - 1
  // Momentum given to the fluid by this rank's walls in the last step. The pressure of the density 1 is left out: it
  // sums to zero over the walls of all ranks.
  const Vec3& wall_impulse() const { return wall_impulse_; }
  double max_speed() const;  // at the last update_velocity(); infinite where a velocity is not finite
  // Hash of the populations of the own fluid nodes, keyed by global node number and direction. Summed modulo 2^64 over
  // the ranks it identifies the state of the fluid, whatever the decomposition.
  std::uint64_t state_hash() const;

 private:
  void collide_and_push();
  void bounce();
  Vec3 node_bare_momentum(std::ptrdiff_t n) const;

  Communicator& communicator_;
  Decomposition decomposition_;
  LatticeOptions options_;
  LocalGrid grid_;
  NodeMap nodes_;
  std::vector<std::array<double, d3q19::kDirections>> wall_term_;  // 6 w_i c_i . u_wall, by wall
  std::ptrdiff_t stride_;
  AlignedBuffer populations_, next_populations_, force_, velocity_;
  HaloExchange population_exchange_, velocity_exchange_;
  std::vector<Vec3> plane_impulse_;  // of the walls, by plane of constant z: added up in that order
  Vec3 wall_impulse_{};
};

}  // namespace npfem::flow
