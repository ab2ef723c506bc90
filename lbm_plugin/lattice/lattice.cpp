// SPDX-License-Identifier: MPL-2.0
#include "lattice/lattice.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "lattice/collide.h"
#include "lattice/compensated_sum.h"

namespace npfem::flow {
namespace {

using d3q19::kDirections;
using d3q19::kVelocity;

LatticeOptions checked(const LatticeOptions& options) {
  if (!(options.tau > 0.5) || !std::isfinite(options.tau)) {
    throw std::invalid_argument("relaxation time tau = " + std::to_string(options.tau) +
                                "; it must exceed 1/2, where the viscosity is zero");
  }
  if (!(options.magic > 0.0) || !std::isfinite(options.magic)) {
    throw std::invalid_argument("magic parameter " + std::to_string(options.magic) + "; it must be positive");
  }
  for (const double f : options.body_force) {
    if (!std::isfinite(f)) throw std::invalid_argument("the body force is not finite");
  }
  return options;
}

// A geometry that fails on one rank fails on all.
NodeMap agreed_node_map(Communicator& communicator, const Decomposition& decomposition, const LocalGrid& grid,
                        const Geometry& geometry) {
  std::optional<NodeMap> map;
  std::string failure;
  try {
    map.emplace(decomposition, grid, geometry);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  communicator.agree(failure);
  if (!communicator.any(map->fluid_nodes() > 0)) throw std::runtime_error("the geometry has no fluid node");
  return std::move(*map);
}

// Through a face leave the populations that move towards it.
FaceComponents leaving_populations() {
  FaceComponents components;
  for (int i = 1; i < kDirections; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int c = kVelocity[std::size_t(i)][axis];
      if (c != 0) components[axis][c < 0 ? 0 : 1].push_back(i);
    }
  }
  return components;
}

std::vector<std::array<double, kDirections>> wall_terms(const std::vector<Boundary>& boundaries) {
  std::vector<std::array<double, kDirections>> terms;
  for (const Boundary& boundary : boundaries) {
    auto& term = terms.emplace_back();
    for (int i = 0; i < kDirections; ++i) {
      term[std::size_t(i)] = 6.0 * d3q19::weight(i) * d3q19::along(i, boundary.velocity);
    }
  }
  return terms;
}

}  // namespace

Lattice::Lattice(Communicator& communicator, const Decomposition& decomposition, const Geometry& geometry,
                 const LatticeOptions& options)
    : communicator_(communicator),
      decomposition_(decomposition),
      options_(checked(options)),
      grid_(decomposition.box(communicator.rank()), kHalo),
      nodes_(agreed_node_map(communicator, decomposition, grid_, geometry)),
      wall_term_(wall_terms(geometry.boundaries)),
      stride_(grid_.component_stride()),
      populations_(std::size_t(kDirections * stride_)),
      next_populations_(std::size_t(kDirections * stride_)),
      force_(std::size_t(3 * stride_)),
      velocity_(std::size_t(3 * stride_)),
      population_exchange_(communicator, decomposition, grid_, 1, leaving_populations()),
      velocity_exchange_(communicator, decomposition, grid_, kHalo, all_components(3)),
      plane_impulse_(std::size_t(grid_.size(2))) {
  for (std::ptrdiff_t n = 0; n < grid_.nodes(); ++n) {
    const NodeType type = nodes_.type(n);
    if (type == kFluid) continue;
    for (int axis = 0; axis < 3; ++axis) {
      velocity_.data()[axis * stride_ + n] = geometry.boundaries[std::size_t(type - 1)].velocity[std::size_t(axis)];
    }
  }
  initialise([](int, int, int) { return FluidState{}; });
}

void Lattice::initialise(const std::function<FluidState(int ix, int iy, int iz)>& state) {
  clear_force();
  const Index3& first = grid_.own().begin;
  for (int iz = 0; iz < grid_.size(2); ++iz) {
    for (const FluidRun& run : nodes_.runs(iz)) {
      for (int k = 0; k < run.length; ++k) {
        const FluidState node = state(first[0] + run.ix + k, first[1] + run.iy, first[2] + run.iz);
        for (int i = 0; i < kDirections; ++i) {
          population(i)[run.first + k] = d3q19::equilibrium(i, node.density_deviation, node.velocity) -
                                         1.5 * d3q19::weight(i) * d3q19::along(i, options_.body_force);
        }
      }
    }
  }
  wall_impulse_ = {};
  update_velocity();
}

void Lattice::update_velocity() {
#pragma omp parallel for schedule(static)
  for (int iz = 0; iz < grid_.size(2); ++iz) {
    for (const FluidRun& run : nodes_.runs(iz)) {
      const double* f = populations_.data();
      const double* force = force_.data();
      double* u = velocity_.data();
      const std::ptrdiff_t stride = stride_;
#pragma omp simd
      for (std::ptrdiff_t n = run.first; n < run.first + run.length; ++n) {
        const Vec3 j = load_pairs(f + n, stride).momentum();
        u[n] = j[0] + 0.5 * force[n];
        u[n + stride] = j[1] + 0.5 * force[n + stride];
        u[n + 2 * stride] = j[2] + 0.5 * force[n + 2 * stride];
      }
    }
  }
  velocity_exchange_.fill_halo(velocity_.data());
}

void Lattice::clear_force() {
  for (int axis = 0; axis < 3; ++axis) {
    const double body_force = options_.body_force[std::size_t(axis)];
    double* component = force(axis);
#pragma omp parallel for schedule(static)
    for (int iz = 0; iz < grid_.size(2); ++iz) {
      for (int iy = 0; iy < grid_.size(1); ++iy) {
        std::fill_n(component + grid_.index(0, iy, iz), grid_.size(0), 0.0);
      }
      for (const FluidRun& run : nodes_.runs(iz)) std::fill_n(component + run.first, run.length, body_force);
    }
  }
}

void Lattice::step() {
  collide_and_push();
  population_exchange_.return_halo(next_populations_.data());
  bounce();
  populations_.swap(next_populations_);
}

void Lattice::collide_and_push() {
  const RelaxationRates rates(options_.tau, options_.magic);
  CollisionFields fields{populations_.data(), next_populations_.data(), force_.data(), stride_, {}};
  for (std::size_t i = 0; i < kDirections; ++i) fields.moves[i] = grid_.offset(kVelocity[i]);
#pragma omp parallel for schedule(static)
  for (int iz = 0; iz < grid_.size(2); ++iz) {
    for (const FluidRun& run : nodes_.runs(iz)) collide_and_push_row(rates, fields, run.first, run.length);
  }
}

// A population that has been pushed into a solid node turns round and is back where it started: f_-i(x) = f_i(x + c_i)
// less the moving-wall term. The fluid loses c_i f_i and gains c_-i f_-i, together -c_i (f_i + f_-i).
void Lattice::bounce() {
  double* next = next_populations_.data();
#pragma omp parallel for schedule(static)
  for (int iz = 0; iz < grid_.size(2); ++iz) {
    std::array<CompensatedSum, 3> impulse;
    for (const WallLink& link : nodes_.links(iz)) {
      const int i = link.direction;
      const auto& c = kVelocity[std::size_t(i)];
      const double outgoing = next[i * stride_ + link.fluid + grid_.offset(c)];
      const double returning = outgoing - wall_term_[std::size_t(link.wall)][std::size_t(i)];
      next[d3q19::opposite(i) * stride_ + link.fluid] = returning;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (c[axis] != 0) impulse[axis].add(-c[axis] * (outgoing + returning));
      }
    }
    plane_impulse_[std::size_t(iz)] = {impulse[0].value(), impulse[1].value(), impulse[2].value()};
  }
  std::array<CompensatedSum, 3> total;
  for (const Vec3& plane : plane_impulse_) {
    for (std::size_t axis = 0; axis < 3; ++axis) total[axis].add(plane[axis]);
  }
  wall_impulse_ = {total[0].value(), total[1].value(), total[2].value()};
}

}  // namespace npfem::flow
