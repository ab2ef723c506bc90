// SPDX-License-Identifier: MPL-2.0
#pragma once

// The inner loops of the fluid and the immersed boundary, compiled once per instruction set and chosen at run time. No
// multiply and add are fused: all instruction sets give the same bits.
//
// Streaming in place (Lehmann 2022, "esoteric pull", Computation 10, 92). One copy of the populations is kept.
// Directions come in pairs (i, i+1), i odd, c_i being the one with its first component positive. For each pair a node
// has two places, and the populations that reach it lie
//   f_i       at the node itself,
//   f_i+1     at the neighbour x + c_i,
// the one in the first and the other in the second place in even steps, and the reverse in odd ones. After collision
//   f_i       is stored at the neighbour x + c_i, where f_i+1 was,
//   f_i+1     is stored at the node itself, where f_i was,
// which is where the nodes that they move to look for them in the next step. Each place is read and written by one node
// only, so that nodes may be updated in any order and by any number of threads. The kernels work on strips (node_map.h)
// and own whole rows of places: strips of one row must be updated by one thread at a time.

#include <cstddef>
#include <cstdint>
#include <span>

#include "lattice/d3q19.h"
#include "lattice/fluid_options.h"
#include "lattice/node_map.h"

namespace npfem::flow {

inline constexpr std::ptrdiff_t kStripNumbers = 8 * d3q19::kDirections;  // populations of one strip

// Number of place `place` (0: rest, i: direction i) of a node among the populations.
constexpr std::ptrdiff_t population_index(NodeNumber node, int place) {
  return std::ptrdiff_t{node / 8} * kStripNumbers + place * 8 + node % 8;
}

// The places of the pair (i, i+1), i odd, before step number `step`: that of f_i at the node, of f_i+1 at x + c_i.
constexpr int near_place(int i, bool odd_step) {
  return odd_step ? i : i + 1;
}
constexpr int far_place(int i, bool odd_step) {
  return odd_step ? i + 1 : i;
}

// The same as distances from the index of the near place in even steps.
constexpr std::ptrdiff_t near_shift(bool odd_step) {
  return odd_step ? -8 : 0;
}
constexpr std::ptrdiff_t far_shift(bool odd_step) {
  return odd_step ? 0 : -8;
}

// Relaxation of the even and the odd part of the populations, and Guo's factors in front of the force.
struct RelaxationRates {
  double even;        // 1 / tau
  double odd;         // 1 / tau_odd, (tau - 1/2)(tau_odd - 1/2) = magic
  double even_force;  // 1 - even / 2
  double odd_force;

  RelaxationRates(double tau, double magic)
      : even(1.0 / tau),
        odd(1.0 / (0.5 + magic / (tau - 0.5))),
        even_force(1.0 - 0.5 * even),
        odd_force(1.0 - 0.5 * odd) {}
};

// What the kernels of the fluid work on. Populations by strip, place and node; force and velocity xyz by node.
template <class Real>
struct FluidFields {
  Real* populations;
  Real* force;                 // none: the body force alone acts
  Real* velocity;              // none where nothing asks for it
  const std::uint8_t* inside;  // by strip, bit per node: has the second set of rates; none: all have the first
  bool odd_step;
  bool regularised;
  RelaxationRates rates[2];
  double body_force[3];
};

template <class Real>
struct Kernels {
  // Collides and streams.
  void (*collide)(const FluidFields<Real>& fields, std::span<const FluidStrip> strips);
  // Velocity with half of the force, at own fluid nodes.
  void (*find_velocity)(const FluidFields<Real>& fields, std::span<const FluidStrip> strips);
};

enum class InstructionSet : std::uint8_t { baseline, avx2, avx512 };

// The best that this processor has and this program was built for.
InstructionSet best_instruction_set();

template <class Real>
const Kernels<Real>& kernels(InstructionSet instruction_set);

}  // namespace npfem::flow
