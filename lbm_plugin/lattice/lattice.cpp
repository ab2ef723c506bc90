// SPDX-License-Identifier: MPL-2.0
#include "lattice/lattice.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace npfem::flow {
namespace {

using d3q19::kDirections;
using d3q19::kVelocity;

void require_relaxation_time(double tau, const char* name) {
  if (tau > 0.5 && std::isfinite(tau)) return;
  throw std::invalid_argument(std::string("relaxation time ") + name + " = " + std::to_string(tau) +
                              "; it must exceed 1/2, where the viscosity is zero");
}

LatticeOptions checked(const LatticeOptions& options) {
  require_relaxation_time(options.tau, "tau");
  if (options.inside_tau != 0) require_relaxation_time(options.inside_tau, "inside_tau");
  if (!(options.magic > 0.0) || !std::isfinite(options.magic)) {
    throw std::invalid_argument("magic parameter " + std::to_string(options.magic) + "; it must be positive");
  }
  for (const double f : options.body_force) {
    if (!std::isfinite(f)) throw std::invalid_argument("the body force is not finite");
  }
  return options;
}

// Without its ghost part the odd departure from equilibrium is nothing: it relaxes at once, magic = (tau - 1/2) / 2.
RelaxationRates rates_at(const LatticeOptions& options, double tau) {
  switch (options.collision) {
    case Collision::bgk:
      return {tau, bgk_magic(tau)};
    case Collision::regularised:
      return {tau, 0.5 * (tau - 0.5)};
    case Collision::trt:
      break;
  }
  return {tau, options.magic};
}

// A geometry that fails on one rank fails on all.
NodeMap agreed_node_map(Communicator& communicator, const Decomposition& decomposition, const Geometry& geometry) {
  std::optional<NodeMap> map;
  std::string failure;
  try {
    map.emplace(decomposition, communicator.rank(), geometry);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  communicator.agree(failure);
  if (!communicator.any(map->fluid_nodes() > 0)) throw std::runtime_error("the geometry has no fluid node");
  return std::move(*map);
}

template <class Real>
Lattice::Numbers<Real> numbers_for(const NodeMap& nodes, bool node_force) {
  const std::size_t strips = nodes.strips();
  const std::size_t vectors = node_force ? strips * 24 : 0;
  return {AlignedArray<Real>(strips * std::size_t{kStripNumbers}), AlignedArray<Real>(vectors),
          AlignedArray<Real>(vectors)};
}

// Rows are shared out among the threads.
template <class Work>
void for_each_row(std::span<const NodeMap::Row> rows, Work work) {
  const std::ptrdiff_t count = std::ssize(rows);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t r = 0; r < count; ++r) work(rows[std::size_t(r)]);
}

}  // namespace

Lattice::Lattice(Communicator& communicator, const Decomposition& decomposition, const Geometry& geometry,
                 const LatticeOptions& options)
    : decomposition_(decomposition),
      options_(checked(options)),
      instruction_set_(options.instruction_set.value_or(best_instruction_set())),
      nodes_(agreed_node_map(communicator, decomposition, geometry)),
      links_(nodes_, geometry),
      population_exchange_(communicator, decomposition, nodes_),
      velocity_exchange_(communicator, decomposition, nodes_) {
  if (options_.precision == FluidPrecision::in_double) {
    numbers_ = numbers_for<double>(nodes_, options_.node_force);
  } else {
    numbers_ = numbers_for<float>(nodes_, options_.node_force);
  }
  if (options_.inside_tau != 0) inside_.assign(nodes_.strips(), 0);
  if (options_.node_force) {
    find_moving_nodes(geometry);
    for (int b = 0; b < int(geometry.boundaries.size()); ++b) set_velocity_of_boundary(b, 1.0);
  }
  initialise([](int, int, int) { return FluidState{}; });
}

void Lattice::find_moving_nodes(const Geometry& geometry) {
  const Index3& first = nodes_.own().begin;
  for (int iz = -kHalo; iz < nodes_.size(2) + kHalo; ++iz) {
    for (int iy = -kHalo; iy < nodes_.size(1) + kHalo; ++iy) {
      for (int ix = -kHalo; ix < nodes_.size(0) + kHalo; ++ix) {
        const NodeType type = nodes_.type(ix, iy, iz);
        const NodeNumber node = nodes_.number(ix, iy, iz);
        if (type == kFluid || node == NodeMap::kNoNode) continue;
        const Boundary& boundary = geometry.boundaries[std::size_t(type - 1)];
        if (boundary.kind != Boundary::Kind::velocity || boundary.velocity == Vec3{}) continue;
        Index3 beside{ix + first[0], iy + first[1], iz + first[2]};  // the node of the grid nearest to it
        for (int axis = 0; axis < 3; ++axis) {
          int& i = beside[std::size_t(axis)];
          i = std::clamp(decomposition_.wrap(axis, i), 0, decomposition_.nodes()[std::size_t(axis)] - 1);
        }
        const double share = boundary.profile ? boundary.profile(beside[0], beside[1], beside[2]) : 1.0;
        const Vec3& u = boundary.velocity;
        moving_nodes_.push_back({node, type - 1, {share * u[0], share * u[1], share * u[2]}});
      }
    }
  }
}

void Lattice::set_velocity_of_boundary(int boundary, double factor) {
  visit_numbers([&](auto& numbers) {
    using Real = std::remove_reference_t<decltype(*numbers.velocity.data())>;
    for (const MovingNode& moving : moving_nodes_) {
      if (moving.boundary != boundary) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        numbers.velocity.data()[3 * std::size_t(moving.node) + axis] =
            static_cast<Real>(factor * moving.velocity[axis]);
      }
    }
  });
}

void Lattice::set_boundary_factor(int boundary, double factor) {
  if (links_.factor(boundary) == factor) return;
  links_.set_factor(boundary, factor);
  set_velocity_of_boundary(boundary, factor);
}

void Lattice::initialise(const std::function<FluidState(int ix, int iy, int iz)>& state) {
  clear_force();
  const Index3& first = nodes_.own().begin;
  nodes_.for_each_fluid_node([&](int ix, int iy, int iz) {
    const FluidState node = state(first[0] + ix, first[1] + iy, first[2] + iz);
    Populations populations;
    for (int i = 0; i < kDirections; ++i) {
      populations[std::size_t(i)] = d3q19::equilibrium(i, node.density_deviation, node.velocity) -
                                    1.5 * d3q19::weight(i) * d3q19::along(i, options_.body_force);
    }
    set_populations_at(ix, iy, iz, populations);
  });
  update_velocity();
}

template <class Real>
FluidFields<Real> Lattice::fields(Numbers<Real>& numbers) const {
  const RelaxationRates rates = rates_at(options_, options_.tau);
  const RelaxationRates inside = rates_at(options_, options_.inside_tau != 0 ? options_.inside_tau : options_.tau);
  const Vec3& body = options_.body_force;
  return {numbers.populations.data(),
          numbers.force.data(),
          numbers.velocity.data(),
          inside_.empty() ? nullptr : inside_.data(),
          odd_step_,
          options_.collision == Collision::regularised,
          {rates, inside},
          {body[0], body[1], body[2]}};
}

void Lattice::update_velocity() {
  if (!options_.node_force) return;
  visit_numbers([&](auto& numbers) {
    using Real = std::remove_reference_t<decltype(*numbers.velocity.data())>;
    const FluidFields<Real> all = fields(numbers);
    const auto find_velocity = kernels<Real>(instruction_set_).find_velocity;
    for_each_row(nodes_.rows_near_neighbours(), [&](NodeMap::Row row) { find_velocity(all, row); });
    for_each_row(nodes_.rows_inside(), [&](NodeMap::Row row) { find_velocity(all, row); });
    velocity_exchange_.fill_halo(numbers.velocity.data());
  });
}

void Lattice::clear_force() {
  if (!options_.node_force) return;
  visit_numbers([&](auto& numbers) {
    using Real = std::remove_reference_t<decltype(*numbers.force.data())>;
    Real* const force = numbers.force.data();
    const std::span<const OwnStrip> strips = nodes_.own_strips();
    const std::ptrdiff_t count = std::ssize(strips);
    const Vec3& body = options_.body_force;
    const bool none = body == Vec3{};
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const OwnStrip& strip = strips[std::size_t(k)];
      Real* const begin = force + std::ptrdiff_t{strip.strip} * 24;
      std::fill_n(begin, 24, Real(0));
      if (none) continue;
      for (int l = 0; l < NodeMap::kStrip; ++l) {
        if ((strip.fluid >> l & 1U) == 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
          begin[3 * l + std::ptrdiff_t(axis)] = static_cast<Real>(body[axis]);
      }
    }
  });
}

void Lattice::step() {
  visit_numbers([&](auto& numbers) { step_with(numbers); });
}

template <class Real>
void Lattice::step_with(Numbers<Real>& numbers) {
  const FluidFields<Real> all = fields(numbers);
  links_.look_ahead(all);
  const auto collide = kernels<Real>(instruction_set_).collide;
  for_each_row(nodes_.rows_near_neighbours(), [&](NodeMap::Row row) { collide(all, row); });
  population_exchange_.start(all);
  for_each_row(nodes_.rows_inside(), [&](NodeMap::Row row) { collide(all, row); });
  population_exchange_.finish(all);
  links_.turn_back(all);
  odd_step_ = !odd_step_;
}

}  // namespace npfem::flow
