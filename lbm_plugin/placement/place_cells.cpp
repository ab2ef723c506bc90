// SPDX-License-Identifier: MPL-2.0
#include "placement/place_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "placement/random.h"

namespace npfem::flow {
namespace {

constexpr int insertion_trials = 2000;  // places tried for one cell before insertion counts as jammed
constexpr double start_sizes[] = {0.6, 0.45, 0.3, 0.2, 0.1};
constexpr double growth = 1.04;  // lead that a cell may have over the smallest one
constexpr int patience = 600;    // sweeps in which the smallest cell must have grown by a thousandth
constexpr int halvings = 6;      // moves from the largest down to 1/64 of it

std::string fixed_text(double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string describe(const Clash& clash, std::span<const CellType> types, const Packing& packing) {
  switch (clash.with) {
    case Clash::With::wall:
      return "outside the walls or across one";
    case Clash::With::own_image:
      return "overlapping its own periodic image: the box is too small for it";
    case Clash::With::cell: {
      const auto other = static_cast<std::size_t>(clash.cell);
      return "overlapping cell " + std::to_string(clash.cell) + " (" +
             types[static_cast<std::size_t>(packing.cells()[other].type)].name + ")";
    }
    case Clash::With::nothing:
      break;
  }
  return "";
}

class Placer {
 public:
  Placer(const Domain& domain, std::span<const CellType> types, const PlacementRequest& request)
      : domain_(domain),
        types_(types),
        request_(request),
        // a table needs some band to hold signs even where no gap is asked for
        packing_(domain, types, std::max(request.gap, 0.05)),
        random_(request.seed) {}

  Placement run() {
    put_given_cells();
    Placement result;
    if (!insert_all(1.0)) {
      result.grown = true;
      start_small();
      result.sweeps = grow();
    }
    for (const RigidCell& cell : packing_.cells()) result.cells.push_back({cell.type, cell.centre, cell.rotation});
    return result;
  }

 private:
  void put_given_cells() {
    for (const CellStart& start : request_.given) {
      const RigidCell cell{start.type, start.centre, start.rotation, 1.0, true};
      if (const Clash clash = packing_.clash(cell, -1, 0.0)) {
        char place[128];
        std::snprintf(place, sizeof place, "(%.6g, %.6g, %.6g) um", start.centre[0], start.centre[1], start.centre[2]);
        throw PlacementError("cell " + std::to_string(packing_.cells().size()) + " (" +
                                 types_[static_cast<std::size_t>(start.type)].name + ") at " + place + " is " +
                                 describe(clash, types_, packing_) + "; move it, or take it out of the list",
                             static_cast<int>(packing_.cells().size()));
      }
      packing_.cells().push_back(cell);
    }
  }

  /// Largest types first: the small ones find room between them.
  std::vector<int> types_by_size() const {
    std::vector<int> order(types_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return packing_.radius_of(a) > packing_.radius_of(b); });
    return order;
  }

  bool insert_all(double size) {
    packing_.cells().resize(request_.given.size());
    for (const int type : types_by_size()) {
      for (int n = 0; n < request_.counts[static_cast<std::size_t>(type)]; ++n) {
        if (!insert_one(type, size)) return false;
      }
    }
    // cells of one type have neighbouring numbers, in the order of the types
    std::stable_sort(packing_.cells().begin() + static_cast<std::ptrdiff_t>(request_.given.size()),
                     packing_.cells().end(), [](const RigidCell& a, const RigidCell& b) { return a.type < b.type; });
    return true;
  }

  bool insert_one(int type, double size) {
    for (int trial = 0; trial < insertion_trials; ++trial) {
      const Vec3 box = domain_.size();
      const Vec3 centre{random_.uniform(0, box[0]), random_.uniform(0, box[1]), random_.uniform(0, box[2])};
      const RigidCell cell{type, centre, random_.rotation(), size, false};
      if (!packing_.clash(cell, -1, request_.gap)) {
        packing_.cells().push_back(cell);
        return true;
      }
    }
    return false;
  }

  void start_small() {
    for (const double size : start_sizes) {
      if (insert_all(size)) return;
    }
    give_up();
  }

  /// Sweeps until every cell has its full size. No cell gets far ahead of the smallest one, so that the last to grow
  /// do not find the room taken.
  int grow() {
    double size_at_last_progress = smallest();
    int last_progress = 0;
    for (int sweep = 1;; ++sweep) {
      const double limit = std::min(1.0, smallest() * growth);
      for (std::size_t n = request_.given.size(); n < packing_.cells().size(); ++n) {
        try_move(n);
        try_turn(n);
        try_growth(n, limit);
      }
      if (smallest() >= 1.0) return sweep;
      if (smallest() > size_at_last_progress * 1.001) {
        size_at_last_progress = smallest();
        last_progress = sweep;
      }
      if (sweep - last_progress > patience) give_up();
    }
  }

  double smallest() const {
    double size = 1;
    for (const RigidCell& cell : packing_.cells()) size = std::min(size, cell.size);
    return size;
  }

  /// Moves of every size from the largest down by halves, so that none has to be tuned to the density.
  double random_fraction() { return std::ldexp(random_.uniform(), -static_cast<int>(random_.uniform() * halvings)); }

  void accept_if_free(std::size_t n, const RigidCell& candidate) {
    if (!packing_.clash(candidate, static_cast<int>(n), request_.gap)) packing_.cells()[n] = candidate;
  }

  void try_move(std::size_t n) {
    RigidCell cell = packing_.cells()[n];
    const double step = packing_.radius_of(cell.type) * random_fraction();
    cell.centre = add(cell.centre, scale(step, random_.direction()));
    const std::array<bool, 3> periodic = domain_.periodic();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double period = domain_.size()[axis];
      if (periodic[axis]) cell.centre[axis] -= period * std::floor(cell.centre[axis] / period);
    }
    accept_if_free(n, cell);
  }

  void try_turn(std::size_t n) {
    RigidCell cell = packing_.cells()[n];
    const double angle = std::numbers::pi * random_fraction();
    cell.rotation = compose(rotation_about(random_.direction(), angle), cell.rotation);
    accept_if_free(n, cell);
  }

  void try_growth(std::size_t n, double limit) {
    RigidCell cell = packing_.cells()[n];
    if (cell.size >= limit) return;
    // half of the tries go all the way, the others part of it
    cell.size = random_.uniform() < 0.5 ? limit : random_.uniform(cell.size, limit);
    accept_if_free(n, cell);
  }

  [[noreturn]] void give_up() const {
    double asked = 0;
    double reached = 0;
    int full = 0;
    for (std::size_t type = 0; type < types_.size(); ++type) {
      asked += request_.counts[type] * packing_.volume_of(static_cast<int>(type));
    }
    for (std::size_t n = 0; n < packing_.cells().size(); ++n) {
      const RigidCell& cell = packing_.cells()[n];
      if (cell.fixed) asked += packing_.volume_of(cell.type);
      reached += packing_.volume_of(cell.type) * cell.size * cell.size * cell.size;
      full += cell.size >= 1.0 ? 1 : 0;
    }
    const int wanted =
        std::accumulate(request_.counts.begin(), request_.counts.end(), 0) + static_cast<int>(request_.given.size());
    const double volume = domain_.fluid_volume();
    throw PlacementError(
        "no room for " + std::to_string(wanted) + " cells (haematocrit " + fixed_text(asked / volume, "%.3f") +
        "): random placement stopped at haematocrit " + fixed_text(reached / volume, "%.3f") + " with " +
        std::to_string(full) + " cells at full size; lower the haematocrit or placement.gap (now " +
        fixed_text(request_.gap, "%.3g") + " um), take a larger domain, or pack deformable cells first (npfem pack)");
  }

  Domain domain_;
  std::span<const CellType> types_;
  const PlacementRequest& request_;
  Packing packing_;
  Random random_;
};

}  // namespace

Placement place_cells(const Domain& domain, std::span<const CellType> types, const PlacementRequest& request) {
  return Placer(domain, types, request).run();
}

}  // namespace npfem::flow
