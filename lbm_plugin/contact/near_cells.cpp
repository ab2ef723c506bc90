// SPDX-License-Identifier: MPL-2.0
#include "contact/near_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace npfem::flow {
namespace {

Vec3 middle_of(const Bounds& box) {
  return scale(0.5, add(box.low, box.high));
}

/// Around the cells of one rank, each moved by whole periods to where it is nearest to the first one.
Bounds bounds_of_all(const Domain& domain, std::span<const CellSurface> cells) {
  Bounds all;
  if (cells.empty()) return all;
  const Vec3 first = middle_of(bounds_of(cells[0]));
  for (const CellSurface& cell : cells) {
    const Bounds box = bounds_of(cell);
    Vec3 shift{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double period = domain.size()[axis];
      if (domain.periodic()[axis]) shift[axis] = period * std::round((first[axis] - middle_of(box)[axis]) / period);
    }
    all.include(box.moved(shift));
  }
  return all;
}

/// Whether some periodic image of one box comes within reach of the other.
bool is_near(const Domain& domain, const Bounds& a, const Bounds& b, double reach) {
  if (!(a.low[0] <= a.high[0])) return false;  // around nothing
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double least = a.low[axis] - b.high[axis] - reach, most = a.high[axis] - b.low[axis] + reach;
    const double period = domain.size()[axis];
    const bool near =
        domain.periodic()[axis] ? std::ceil(least / period) <= std::floor(most / period) : least <= 0 && most >= 0;
    if (!near) return false;
  }
  return true;
}

void pack(const CellSurface& cell, Bytes& message) {
  const std::array<int, 2> tag{cell.id, cell.type};
  append<int>(message, tag);
  append<double>(message, cell.positions);
}

void unpack(const Bytes& message, std::span<const CellType> types, std::vector<CellSurface>& cells) {
  for (std::size_t at = 0; at < message.size();) {
    std::array<int, 2> tag;
    std::memcpy(tag.data(), message.data() + at, sizeof tag);
    at += sizeof tag;
    CellSurface& cell = cells.emplace_back(CellSurface{tag[0], tag[1], {}});
    cell.positions.resize(types[static_cast<std::size_t>(cell.type)].shape.size());
    const std::size_t length = cell.positions.size() * sizeof(double);
    std::memcpy(cell.positions.data(), message.data() + at, length);
    at += length;
  }
}

std::vector<Bounds> bounds_of_ranks(const Domain& domain, Communicator& communicator,
                                    std::span<const CellSurface> own) {
  const Bounds mine = bounds_of_all(domain, own);
  std::vector<Bounds> ranks;
  for (const Bytes& bytes : communicator.all_gather(std::as_bytes(std::span(&mine, 1)))) {
    std::memcpy(&ranks.emplace_back(), bytes.data(), sizeof mine);
  }
  return ranks;
}

}  // namespace

Bounds bounds_of(const CellSurface& cell) {
  Bounds bounds;
  const std::vector<double>& x = cell.positions;
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) bounds.include(Vec3{x[i], x[i + 1], x[i + 2]});
  return bounds;
}

Surroundings surroundings(const Domain& domain, std::span<const CellType> types, Communicator& communicator,
                          std::span<const CellSurface> own, double reach) {
  std::vector<Bounds> boxes;
  for (const CellSurface& cell : own) boxes.push_back(bounds_of(cell));
  const std::vector<Bounds> ranks = bounds_of_ranks(domain, communicator, own);
  std::vector<Bytes> messages(ranks.size());
  for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
    if (static_cast<int>(rank) == communicator.rank()) continue;
    for (std::size_t n = 0; n < own.size(); ++n) {
      if (is_near(domain, ranks[rank], boxes[n], reach)) pack(own[n], messages[rank]);
    }
  }
  std::vector<Outgoing> outgoing;
  for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
    if (!messages[rank].empty()) outgoing.push_back({static_cast<int>(rank), messages[rank]});
  }
  std::vector<Incoming> incoming;
  communicator.exchange(outgoing, incoming);

  std::vector<CellSurface> cells(own.begin(), own.end());
  for (const Incoming& message : incoming) unpack(message.bytes, types, cells);
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return cells[a].id < cells[b].id; });
  Surroundings found;
  for (const std::size_t n : order) {
    found.cells.push_back(std::move(cells[n]));
    found.is_own.push_back(n < own.size());
  }
  return found;
}

}  // namespace npfem::flow
