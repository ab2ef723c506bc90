// SPDX-License-Identifier: MPL-2.0
#include "communicator/halo.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace npfem::flow {

FaceComponents all_components(int count) {
  std::vector<int> all(std::size_t(count), 0);
  std::iota(all.begin(), all.end(), 0);
  return {{{all, all}, {all, all}, {all, all}}};
}

HaloExchange::HaloExchange(Communicator& communicator, const Decomposition& decomposition, const LocalGrid& grid,
                           int width, FaceComponents components)
    : communicator_(communicator), grid_(grid), width_(width), components_(std::move(components)), neighbour_{} {
  if (width < 1 || width > grid.halo()) throw std::invalid_argument("a halo exchange wider than the halo");
  const int rank = communicator.rank();
  std::size_t largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    neighbour_[std::size_t(axis)] = {decomposition.neighbour(rank, axis, -1), decomposition.neighbour(rank, axis, +1)};
    const Slab face = slab(axis, 0, width);
    const std::size_t count = std::max(this->components(axis, low).size(), this->components(axis, high).size());
    largest = std::max(largest, count * std::size_t(face.rows()) * std::size_t(face.row_length()));
  }
  send_.resize(largest);
  receive_.resize(largest);
}

void HaloExchange::fill_halo(double* field) {
  for (int axis = 0; axis < 3; ++axis) exchange_axis(field, axis, Direction::fill);
}

void HaloExchange::return_halo(double* field) {
  for (int axis = 2; axis >= 0; --axis) exchange_axis(field, axis, Direction::give_back);
}

// Both directions move the halo of the axes before this one along with the own nodes: filled already in the one case,
// to be passed on in the other. This is what brings edges and corners to their place.
HaloExchange::Slab HaloExchange::slab(int axis, int first_layer, int layers) const {
  Slab slab{};
  for (int other = 0; other < 3; ++other) {
    const auto a = std::size_t(other);
    const int margin = other < axis ? width_ : 0;
    slab.begin[a] = other == axis ? first_layer : -margin;
    slab.end[a] = other == axis ? first_layer + layers : grid_.size(other) + margin;
  }
  return slab;
}

void HaloExchange::exchange_axis(double* field, int axis, Direction direction) {
  const bool uncut_periodic = neighbour_[std::size_t(axis)][low] == communicator_.rank();
  for (const Side side : {low, high}) {
    if (uncut_periodic) {
      copy_around(field, axis, side, direction);
    } else {
      swap_with_neighbours(field, axis, side, direction);
    }
  }
}

namespace {

// Row by row: body(index of the first node of the row).
template <class Body>
void for_each_row(const LocalGrid& grid, const Index3& begin, const Index3& end, Body body) {
  for (int iz = begin[2]; iz < end[2]; ++iz) {
    for (int iy = begin[1]; iy < end[1]; ++iy) body(grid.index(begin[0], iy, iz));
  }
}

}  // namespace

// Data leave through one face and come in again through the other. A halo wider than the box repeats it.
void HaloExchange::copy_around(double* field, int axis, Side side, Direction direction) const {
  const int n = grid_.size(axis);
  const std::array<std::ptrdiff_t, 3> step{1, grid_.row(), grid_.plane()};
  const bool filling = direction == Direction::fill;
  const bool low_halo = (side == high) == filling;  // filling, what leaves through the high face fills the low halo
  for (int layer = 0; layer < width_; ++layer) {
    const int halo_layer = low_halo ? -1 - layer : n + layer;
    const int own_layer = ((halo_layer % n) + n) % n;
    const Slab from = slab(axis, filling ? own_layer : halo_layer, 1);
    const std::ptrdiff_t shift = (filling ? halo_layer - own_layer : own_layer - halo_layer) * step[std::size_t(axis)];
    for (const int component : components(axis, side)) {
      double* values = field + component * grid_.component_stride();
      for_each_row(grid_, from.begin, from.end, [&](std::ptrdiff_t first) {
        std::copy_n(values + first, from.row_length(), values + first + shift);
      });
    }
  }
}

// Everybody sends through one face and receives through the opposite one.
void HaloExchange::swap_with_neighbours(double* field, int axis, Side side, Direction direction) {
  const int n = grid_.size(axis);
  const bool filling = direction == Direction::fill;
  const int first_sent = side == low ? (filling ? 0 : -width_) : (filling ? n - width_ : n);
  const int first_received = side == low ? (filling ? n : n - width_) : (filling ? -width_ : 0);
  const Slab sent = slab(axis, first_sent, width_);
  const Slab received = slab(axis, first_received, width_);
  const std::vector<int>& moving = components(axis, side);
  const std::size_t count =
      moving.size() * static_cast<std::size_t>(sent.rows()) * static_cast<std::size_t>(sent.row_length());

  double* packed = send_.data();
  for (const int component : moving) {
    const double* values = field + component * grid_.component_stride();
    for_each_row(grid_, sent.begin, sent.end,
                 [&](std::ptrdiff_t first) { packed = std::copy_n(values + first, sent.row_length(), packed); });
  }
  const int destination = neighbour_[std::size_t(axis)][side];
  const int source = neighbour_[std::size_t(axis)][side == low ? high : low];
  communicator_.send_receive(destination, std::span(send_.data(), count), source, std::span(receive_.data(), count));
  if (source == kNoRank) return;
  const double* arrived = receive_.data();
  for (const int component : moving) {
    double* values = field + component * grid_.component_stride();
    for_each_row(grid_, received.begin, received.end, [&](std::ptrdiff_t first) {
      std::copy_n(arrived, received.row_length(), values + first);
      arrived += received.row_length();
    });
  }
}

}  // namespace npfem::flow
