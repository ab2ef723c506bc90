// SPDX-License-Identifier: MPL-2.0
#include "geometry/section_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace npfem::flow {
namespace {

/// The section as a graph: the fluid neighbours of each fluid node, and how many walls it has.
class Section {
 public:
  Section(const std::vector<bool>& fluid, const std::array<int, 2>& counts, const std::array<bool, 2>& periodic)
      : neighbours_(fluid.size()), walls_(fluid.size(), 0) {
    for (int v = 0; v < counts[1]; ++v) {
      for (int u = 0; u < counts[0]; ++u) {
        const auto node = static_cast<std::size_t>(u + counts[0] * v);
        if (!fluid[node]) continue;
        nodes_.push_back(node);
        for (const auto& [du, dv] : {std::array{-1, 0}, std::array{1, 0}, std::array{0, -1}, std::array{0, 1}}) {
          std::array<int, 2> at{u + du, v + dv};
          bool inside = true;
          for (std::size_t a = 0; a < 2; ++a) {
            if (periodic[a]) at[a] = (at[a] + counts[a]) % counts[a];
            inside = inside && at[a] >= 0 && at[a] < counts[a];
          }
          const auto beside = static_cast<std::size_t>(at[0] + counts[0] * at[1]);
          if (inside && fluid[beside]) {
            neighbours_[node].push_back(beside);
          } else {
            ++walls_[node];
          }
        }
      }
    }
  }
  const std::vector<std::size_t>& nodes() const { return nodes_; }
  int walls(std::size_t node) const { return walls_[node]; }
  const std::vector<std::size_t>& neighbours(std::size_t node) const { return neighbours_[node]; }

  /// Minus the Laplacian; beyond a wall the velocity is mirrored with its sign changed.
  void apply(const std::vector<double>& w, std::vector<double>& out) const {
    for (const std::size_t node : nodes_) {
      double sum = 2.0 * walls_[node] * w[node];
      for (const std::size_t beside : neighbours_[node]) sum += w[node] - w[beside];
      out[node] = sum;
    }
  }

 private:
  std::vector<std::vector<std::size_t>> neighbours_;
  std::vector<int> walls_;
  std::vector<std::size_t> nodes_;
};

double product(const Section& section, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (const std::size_t node : section.nodes()) sum += a[node] * b[node];
  return sum;
}

/// Largest of the slopes to neighbours and to walls, which stand half a spacing away.
double steepest_of(const Section& section, const std::vector<double>& profile) {
  double steepest = 0;
  for (const std::size_t node : section.nodes()) {
    if (section.walls(node) > 0) steepest = std::max(steepest, 2 * profile[node]);
    for (const std::size_t beside : section.neighbours(node)) {
      steepest = std::max(steepest, std::abs(profile[node] - profile[beside]));
    }
  }
  return steepest;
}

}  // namespace

SectionFlow section_flow(const std::vector<bool>& fluid, const std::array<int, 2>& counts,
                         const std::array<bool, 2>& periodic) {
  const Section section(fluid, counts, periodic);
  std::vector<double> w(fluid.size(), 0.0), residual(fluid.size(), 0.0), image(fluid.size(), 0.0);
  bool has_walls = false;
  for (const std::size_t node : section.nodes()) {
    // the quarter per wall makes up for the mirrored value: a parabola then solves it exactly
    residual[node] = 1.0 - 0.25 * section.walls(node);
    has_walls = has_walls || section.walls(node) > 0;
  }
  const std::size_t nodes = section.nodes().size();
  if (!has_walls) {
    for (const std::size_t node : section.nodes()) w[node] = 1;
    return {std::move(w), nodes, std::numeric_limits<double>::infinity(), 0};
  }
  // conjugate gradients
  std::vector<double> direction = residual;
  double square = product(section, residual, residual);
  const double enough = 1e-24 * square;
  for (std::size_t n = 0; n < 4 * nodes && square > enough; ++n) {
    section.apply(direction, image);
    const double step = square / product(section, direction, image);
    for (const std::size_t node : section.nodes()) {
      w[node] += step * direction[node];
      residual[node] -= step * image[node];
    }
    const double next = product(section, residual, residual);
    for (const std::size_t node : section.nodes()) direction[node] = residual[node] + next / square * direction[node];
    square = next;
  }
  double mean = 0;
  for (const std::size_t node : section.nodes()) mean += w[node] / static_cast<double>(nodes);
  for (const std::size_t node : section.nodes()) w[node] /= mean;
  const double steepest = steepest_of(section, w);
  return {std::move(w), nodes, mean, steepest};
}

}  // namespace npfem::flow
