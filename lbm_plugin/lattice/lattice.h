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
//   boundaries  half-way between nodes: walls, inlets and pressure faces (boundary_links.h).
//
// Populations are stored as deviations from w_i, so that a fluid nearly at rest keeps all its digits, once, in place,
// and only where there is fluid (node_map.h, kernels.h), in double or single precision. Between steps the state is the
// *streamed* populations f(t_n); the sequence of one coupled step is
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
// Every node is updated by the same arithmetic wherever it is stored and whatever the processor: the bits do not depend
// on ranks, threads or the instruction set.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "communicator/communicator.h"
#include "communicator/decomposition.h"
#include "lattice/aligned_array.h"
#include "lattice/boundary_links.h"
#include "lattice/d3q19.h"
#include "lattice/geometry.h"
#include "lattice/kernels.h"
#include "lattice/neighbour_links.h"
#include "lattice/node_map.h"

namespace npfem::flow {

struct LatticeOptions {
  double tau = 1.0;                      // relaxation time of the even part, > 1/2
  double magic = 3.0 / 16.0;             // (tau_even - 1/2)(tau_odd - 1/2), > 0
  Vec3 body_force{};                     // per node and step
  Collision collision = Collision::trt;  // bgk and regularised set magic themselves
  FluidPrecision precision = FluidPrecision::in_double;
  double inside_tau = 0;   // relaxation time of the nodes marked by set_inside(); 0: there are none
  bool node_force = true;  // nodes may hold forces of their own and know their velocity; false: the body force alone
                           // acts, which saves the memory of both
  std::optional<InstructionSet> instruction_set{};  // default: the best there is
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
  static constexpr int kHalo = NodeMap::kHalo;

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
  void add_force(int ix, int iy, int iz, double fx, double fy, double fz);
  void set_body_force(const Vec3& force) { options_.body_force = force; }  // from the next clear_force() on
  // Multiplies the velocity, or the density deviation, of a boundary of the geometry from now on.
  void set_boundary_factor(int boundary, double factor);
  // Own fluid nodes, local indices, whose relaxation time is inside_tau from now on.
  void clear_inside();
  void set_inside(int ix, int iy, int iz);
  bool is_inside(int ix, int iy, int iz) const;

  const Decomposition& decomposition() const { return decomposition_; }
  const NodeMap& nodes() const { return nodes_; }
  const LatticeOptions& options() const { return options_; }
  double viscosity() const { return lattice_viscosity(options_.tau); }
  NodeType node_type(int ix, int iy, int iz) const { return nodes_.type(ix, iy, iz); }

  // Force and velocity xyz by node number, as the immersed boundary works on them.
  template <class Real>
  struct Numbers {
    AlignedArray<Real> populations, force, velocity;
  };
  // work(Numbers<double>&) or work(Numbers<float>&)
  template <class Work>
  decltype(auto) visit_numbers(Work&& work) {
    return std::visit(std::forward<Work>(work), numbers_);
  }
  template <class Work>
  decltype(auto) visit_numbers(Work&& work) const {
    return std::visit(std::forward<Work>(work), numbers_);
  }
  InstructionSet instruction_set() const { return instruction_set_; }

  // The state at one own node, local indices: what a checkpoint keeps. Populations are deviations from the weights, in
  // the order of d3q19.h; force is what the lattice holds (see clear_force), on solid nodes what the wall bears.
  using Populations = std::array<double, d3q19::kDirections>;
  Populations populations_at(int ix, int iy, int iz) const;
  void set_populations_at(int ix, int iy, int iz, const Populations& populations);
  Vec3 force_at(int ix, int iy, int iz) const;
  void set_force_at(int ix, int iy, int iz, const Vec3& force);
  // Own and halo nodes, as of the last update_velocity(); on solid nodes that of the wall.
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
  Vec3 wall_force() const;        // force given to own solid nodes by add_force()
  double mass_deviation() const;  // sum of rho - 1
  // Momentum given to the fluid by this rank's walls in the last step. The pressure of the density 1 is left out: it
  // sums to zero over the walls of all ranks.
  const Vec3& wall_impulse() const { return links_.impulse(); }
  // The links of this rank to walls and inlets in the last step, see BoundaryLinks::for_each_returned.
  template <class Visit>
  void for_each_wall_link(Visit visit) const {
    visit_numbers([&](const auto& numbers) { links_.for_each_returned(numbers.populations.data(), odd_step_, visit); });
  }
  int boundaries() const { return links_.boundaries(); }
  double max_speed() const;  // at the last update_velocity(); infinite where a velocity is not finite
  bool is_finite() const;    // every population of this rank
  // Hash of the populations of the own fluid nodes, keyed by global node number and direction. Summed modulo 2^64 over
  // the ranks it identifies the state of the fluid, whatever the decomposition.
  std::uint64_t state_hash() const;

 private:
  // Where the population of direction i at an own node is found before the next step.
  std::ptrdiff_t place_of(int ix, int iy, int iz, int i) const;
  template <class Real>
  FluidFields<Real> fields(Numbers<Real>& numbers) const;
  template <class Real>
  void step_with(Numbers<Real>& numbers);
  void find_moving_nodes(const Geometry& geometry);
  void set_velocity_of_boundary(int boundary, double factor);
  Vec3 node_bare_momentum(int ix, int iy, int iz) const;

  Decomposition decomposition_;
  LatticeOptions options_;
  InstructionSet instruction_set_;
  NodeMap nodes_;
  BoundaryLinks links_;
  PopulationExchange population_exchange_;
  VectorExchange velocity_exchange_;
  std::variant<Numbers<double>, Numbers<float>> numbers_;
  std::vector<std::uint8_t> inside_;  // by strip, bit per node
  // Stored nodes of walls and inlets that move, with their velocity at factor 1.
  struct MovingNode {
    NodeNumber node;
    int boundary;
    Vec3 velocity;
  };
  std::vector<MovingNode> moving_nodes_;
  bool odd_step_ = false;
};

}  // namespace npfem::flow
