// SPDX-License-Identifier: MPL-2.0
#include "lattice/boundary_links.h"

#include "lattice/compensated_sum.h"

namespace npfem::flow {
namespace {

using d3q19::kVelocity;
using VectorSum = std::array<CompensatedSum, 3>;

Vec3 value_of(const VectorSum& sum) {
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

/// The two places of a pair, from the near one of even steps.
constexpr std::ptrdiff_t near_shift(bool odd_step) {
  return odd_step ? -8 : 0;
}
constexpr std::ptrdiff_t far_shift(bool odd_step) {
  return odd_step ? 0 : -8;
}

/// What a pressure face sends back beside the reversed population, without the part of the given density.
double passing_term(int direction, const Vec3& u) {
  const double cu = d3q19::along(direction, u);
  return d3q19::weight(direction) * (9.0 * cu * cu - 3.0 * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]));
}

/// Velocity of a node after collision, u = j - F/2 with the momentum j of what has left it.
template <class Real>
Vec3 velocity_after(const FluidFields<Real>& fields, NodeNumber node, const std::array<NodeNumber, 9>& far_nodes) {
  Vec3 velocity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double force = fields.force == nullptr
                             ? fields.body_force[axis]
                             : static_cast<double>(fields.force[3 * std::ptrdiff_t{node} + std::ptrdiff_t(axis)]);
    velocity[axis] = -0.5 * force;
  }
  for (std::size_t p = 0; p < 9; ++p) {
    const int i = static_cast<int>(2 * p + 1);
    const double up = fields.populations[population_index(far_nodes[p], far_place(i, fields.odd_step))];
    const double down = fields.populations[population_index(node, near_place(i, fields.odd_step))];
    for (std::size_t axis = 0; axis < 3; ++axis) velocity[axis] += kVelocity[2 * p + 1][axis] * (up - down);
  }
  return velocity;
}

}  // namespace

BoundaryLinks::BoundaryLinks(const NodeMap& nodes, const Geometry& geometry)
    : factors_(geometry.boundaries.size(), 1.0), impulses_(geometry.boundaries.size()) {
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
  plane_impulses_.resize(static_cast<std::size_t>(nodes.size(2)) * factors_.size());
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
    const Index3& first = nodes.own().begin;
    const double share =
        boundary.profile ? boundary.profile(beyond[0] + first[0], beyond[1] + first[1], beyond[2] + first[2]) : 1.0;
    link.term = 6.0 * d3q19::weight(direction) * d3q19::along(direction, boundary.velocity) * share;
    links_.push_back(link);
    return;
  }
  link.term = 2.0 * d3q19::weight(direction) * boundary.density_deviation;
  PressureLink& open = pressure_links_.emplace_back(PressureLink{link, number(node), {}});
  for (std::size_t p = 0; p < 9; ++p) open.far_nodes[p] = number(beside(static_cast<int>(2 * p + 1)));
}

template <class Real>
void BoundaryLinks::turn_back_plane(const FluidFields<Real>& fields, std::size_t plane) {
  Real* const populations = fields.populations;
  const std::array<std::ptrdiff_t, 2> leaving = {near_shift(fields.odd_step), far_shift(fields.odd_step)};
  std::vector<VectorSum> impulse(factors_.size());
  const auto book = [&](const Link& link, double exchanged) {
    const auto& c = kVelocity[static_cast<std::size_t>(link.direction)];
    VectorSum& sum = impulse[static_cast<std::size_t>(link.boundary)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (c[axis] != 0) sum[axis].add(-c[axis] * exchanged);
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
    const double given = link.term * factors_[static_cast<std::size_t>(link.boundary)];
    const Vec3 u = velocity_after(fields, open.node, open.far_nodes);
    const auto back = static_cast<Real>(given + passing_term(link.direction, u) - gone);
    populations[link.near_even + leaving[1 - up]] = back;
    book(link, double{gone} + double{back});
  }
  for (std::size_t b = 0; b < impulse.size(); ++b) {
    plane_impulses_[plane * factors_.size() + b] = value_of(impulse[b]);
  }
}

template <class Real>
void BoundaryLinks::turn_back(const FluidFields<Real>& fields) {
  const std::size_t planes = planes_.size() - 1;
#pragma omp parallel for schedule(static)
  for (std::size_t plane = 0; plane < planes; ++plane) turn_back_plane(fields, plane);
  VectorSum all;
  for (std::size_t b = 0; b < factors_.size(); ++b) {
    VectorSum total;
    for (std::size_t plane = 0; plane < planes; ++plane) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        total[axis].add(plane_impulses_[plane * factors_.size() + b][axis]);
        all[axis].add(plane_impulses_[plane * factors_.size() + b][axis]);
      }
    }
    impulses_[b] = value_of(total);
  }
  impulse_ = value_of(all);
}

template void BoundaryLinks::turn_back(const FluidFields<double>&);
template void BoundaryLinks::turn_back(const FluidFields<float>&);

}  // namespace npfem::flow
