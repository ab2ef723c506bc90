// SPDX-License-Identifier: MPL-2.0
#include "lattice/boundary_links.h"

#include <cmath>

#include "lattice/compensated_sum.h"

namespace npfem::flow {
namespace {

using d3q19::kVelocity;
using VectorSum = std::array<CompensatedSum, 3>;

Vec3 value_of(const VectorSum& sum) {
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

/// A node as a pressure face sees it.
struct NodeState {
  std::array<double, 9> even;  // f_i + f_i+1, by pairs
  double density_deviation;
  Vec3 velocity;
};

template <class Real>
NodeState state_of(const FluidFields<Real>& fields, NodeNumber node, const std::array<NodeNumber, 9>& far_nodes) {
  NodeState state{{}, double{fields.populations[population_index(node, 0)]}, {}};
  for (std::size_t p = 0; p < 9; ++p) {
    const int i = static_cast<int>(2 * p + 1);
    const double up = fields.populations[population_index(node, near_place(i, fields.odd_step))];
    const double down = fields.populations[population_index(far_nodes[p], far_place(i, fields.odd_step))];
    state.even[p] = up + down;
    state.density_deviation += up + down;
    for (std::size_t axis = 0; axis < 3; ++axis) state.velocity[axis] += kVelocity[2 * p + 1][axis] * (up - down);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double force = fields.force == nullptr
                             ? fields.body_force[axis]
                             : static_cast<double>(fields.force[3 * std::ptrdiff_t{node} + std::ptrdiff_t(axis)]);
    state.velocity[axis] += 0.5 * force;
  }
  return state;
}

/// Even part of the equilibrium.
double even_equilibrium(int direction, double density_deviation, const Vec3& u) {
  const double cu = d3q19::along(direction, u);
  const double uu = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
  return d3q19::weight(direction) * (density_deviation + 4.5 * cu * cu - 1.5 * uu);
}

/// What each link of a node beside an inlet lets in, relative to the inlet's velocity. A node at the edge of the inlet
/// has fewer links to it than others; they let in the more, so that the node gets its share.
double share_of_node(const NodeMap& nodes, const Boundary& inlet, NodeType type, const Index3& node) {
  const Vec3& u = inlet.velocity;
  const double speed = std::hypot(u[0], u[1], u[2]);
  if (speed == 0) return 0;
  double weight = 0;
  for (int i = 1; i < d3q19::kDirections; ++i) {
    const auto& c = kVelocity[static_cast<std::size_t>(i)];
    if (nodes.type(node[0] + c[0], node[1] + c[1], node[2] + c[2]) != type) continue;
    weight += 6.0 * d3q19::weight(i) * std::abs(d3q19::along(i, u)) / speed;
  }
  const Index3& first = nodes.own().begin;
  return inlet.profile(node[0] + first[0], node[1] + first[1], node[2] + first[2]) / weight;
}

}  // namespace

BoundaryLinks::BoundaryLinks(const NodeMap& nodes, const Geometry& geometry)
    : factors_(geometry.boundaries.size(), 1.0) {
  for (int iz = 0; iz < nodes.size(2); ++iz) {
    planes_.push_back({links_.size(), pressure_links_.size()});
    for (int iy = 0; iy < nodes.size(1); ++iy) {
      for (int ix = 0; ix < nodes.size(0); ++ix) {
        if (nodes.type(ix, iy, iz) != kFluid) continue;
        for (int i = 1; i < d3q19::kDirections; ++i) add_link(nodes, geometry, {ix, iy, iz}, i);
      }
    }
  }
  planes_.push_back({links_.size(), pressure_links_.size()});
  plane_impulses_.resize(static_cast<std::size_t>(nodes.size(2)));
}

void BoundaryLinks::add_link(const NodeMap& nodes, const Geometry& geometry, const Index3& node, int direction) {
  const auto beside = [&](int i) {
    const auto& c = kVelocity[static_cast<std::size_t>(i)];
    return Index3{node[0] + c[0], node[1] + c[1], node[2] + c[2]};
  };
  const auto number = [&](const Index3& n) { return nodes.number(n[0], n[1], n[2]); };
  const Index3 beyond = beside(direction);
  const NodeType type = nodes.type(beyond[0], beyond[1], beyond[2]);
  if (type == kFluid) return;
  const Boundary& boundary = geometry.boundaries[static_cast<std::size_t>(type - 1)];
  const bool up = direction % 2 == 1;
  Link link{population_index(number(up ? beyond : node), up ? direction + 1 : direction), direction, type - 1, 0};
  if (boundary.kind == Boundary::Kind::velocity) {
    const double share = boundary.profile ? share_of_node(nodes, boundary, type, node) : 1.0;
    link.term = 6.0 * d3q19::weight(direction) * d3q19::along(direction, boundary.velocity) * share;
    links_.push_back(link);
    return;
  }
  link.term = boundary.density_deviation;
  PressureLink& open = pressure_links_.emplace_back(PressureLink{link, number(node), {}, 0});
  for (std::size_t p = 0; p < 9; ++p) open.far_nodes[p] = number(beside(static_cast<int>(2 * p + 1)));
}

template <class Real>
void BoundaryLinks::look_ahead(const FluidFields<Real>& fields) {
  for (PressureLink& open : pressure_links_) {
    const int i = open.link.direction;
    const double given = open.link.term * factors_[static_cast<std::size_t>(open.link.boundary)];
    const NodeState node = state_of(fields, open.node, open.far_nodes);
    const double departure = 0.5 * node.even[static_cast<std::size_t>((i - 1) / 2)] -
                             even_equilibrium(i, node.density_deviation, node.velocity);
    open.added = 2.0 * even_equilibrium(i, given, node.velocity) + (2.0 - fields.rates[0].even) * departure;
  }
}

template <class Real>
void BoundaryLinks::turn_back_plane(const FluidFields<Real>& fields, std::size_t plane) {
  Real* const populations = fields.populations;
  const std::array<std::ptrdiff_t, 2> leaving = {near_shift(fields.odd_step), far_shift(fields.odd_step)};
  VectorSum impulse;
  const auto book = [&](const Link& link, double exchanged) {
    const auto& c = kVelocity[static_cast<std::size_t>(link.direction)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (c[axis] != 0) impulse[axis].add(-c[axis] * exchanged);
    }
  };
  for (std::size_t l = planes_[plane].first_link; l < planes_[plane + 1].first_link; ++l) {
    const Link& link = links_[l];
    const std::size_t up = link.direction % 2 == 1 ? 1 : 0;
    const Real gone = populations[link.near_even + leaving[up]];
    const auto back = static_cast<Real>(gone - link.term * factors_[static_cast<std::size_t>(link.boundary)]);
    populations[link.near_even + leaving[1 - up]] = back;
    book(link, double{gone} + double{back});
  }
  for (std::size_t l = planes_[plane].first_pressure_link; l < planes_[plane + 1].first_pressure_link; ++l) {
    const PressureLink& open = pressure_links_[l];
    const Link& link = open.link;
    const std::size_t up = link.direction % 2 == 1 ? 1 : 0;
    const Real gone = populations[link.near_even + leaving[up]];
    const auto back = static_cast<Real>(open.added - gone);
    populations[link.near_even + leaving[1 - up]] = back;
    book(link, double{gone} + double{back});
  }
  plane_impulses_[plane] = value_of(impulse);
}

template <class Real>
void BoundaryLinks::turn_back(const FluidFields<Real>& fields) {
  const std::size_t planes = planes_.size() - 1;
#pragma omp parallel for schedule(static)
  for (std::size_t plane = 0; plane < planes; ++plane) turn_back_plane(fields, plane);
  VectorSum all;
  for (const Vec3& plane : plane_impulses_) {
    for (std::size_t axis = 0; axis < 3; ++axis) all[axis].add(plane[axis]);
  }
  impulse_ = value_of(all);
}

template void BoundaryLinks::look_ahead(const FluidFields<double>&);
template void BoundaryLinks::look_ahead(const FluidFields<float>&);
template void BoundaryLinks::turn_back(const FluidFields<double>&);
template void BoundaryLinks::turn_back(const FluidFields<float>&);

}  // namespace npfem::flow
