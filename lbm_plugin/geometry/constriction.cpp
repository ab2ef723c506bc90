// SPDX-License-Identifier: MPL-2.0
#include "geometry/constriction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace npfem::flow {
namespace {

constexpr int samples = 48;        // of the narrowed wall
constexpr double far_share = 0.5;  // of the throat: farther from the wall than this a bound will do

}  // namespace

Constriction::Constriction(const Shape& shape)
    : shape_(shape), steepest_((shape.wide - shape.narrow) * std::numbers::pi / shape.length) {
  for (int n = 0; n <= samples; ++n) {
    const double s = shape.length * (static_cast<double>(n) / samples - 0.5);
    wall_.push_back({s, height(s)});
  }
}

double Constriction::height(double s) const {
  if (std::abs(s) >= 0.5 * shape_.length) return shape_.wide;
  const double bump = 0.5 * (1 + std::cos(2 * std::numbers::pi * s / shape_.length));
  return shape_.wide - (shape_.wide - shape_.narrow) * bump;
}

double Constriction::slope(double s) const {
  if (std::abs(s) >= 0.5 * shape_.length) return 0;
  return steepest_ * std::sin(2 * std::numbers::pi * s / shape_.length);
}

double Constriction::curvature(double s) const {
  if (std::abs(s) >= 0.5 * shape_.length) return 0;
  const double wave = 2 * std::numbers::pi / shape_.length;
  return steepest_ * wave * std::cos(wave * s);
}

/// The point of the wall nearest to (s, h): the nearest sample, then Newton's method along the wall, with the second
/// derivative of half the squared distance, or what is surely positive of it.
Constriction::Foot Constriction::foot_of(double s, double h) const {
  const auto squared = [&](const Foot& f) { return (f.s - s) * (f.s - s) + (f.h - h) * (f.h - h); };
  Foot best{s, height(s)};  // straight across
  for (const Foot& f : wall_) {
    if (squared(f) < squared(best)) best = f;
  }
  for (int step = 0; step < 20; ++step) {
    const double m = slope(best.s);
    const double second = 1 + m * m + curvature(best.s) * (best.h - h);
    double move = ((s - best.s) + m * (h - best.h)) / (second > 0 ? second : 1 + m * m);
    Foot next{best.s + move, height(best.s + move)};
    while (squared(next) > squared(best) && std::abs(move) > 1e-12 * shape_.length) {
      move *= 0.5;
      next = {best.s + move, height(best.s + move)};
    }
    if (squared(next) >= squared(best)) break;
    best = next;
  }
  return best;
}

WallDistance Constriction::distance(const Vec3& position) const {
  const Vec3 from_throat = subtract(position, shape_.centre);
  const auto along = static_cast<std::size_t>(shape_.along);
  const double s = from_throat[along];
  Vec3 outward = from_throat;  // from the axis or the middle plane
  outward[along] = 0;
  if (!shape_.round) outward = {0, outward[1], 0};
  const double h = norm(outward);
  // in the middle every direction leads to the wall; one is taken
  outward = h > 0 ? scale(1 / h, outward) : shape_.round ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const double room = height(s) - h;
  const double bound = room / std::sqrt(1 + steepest_ * steepest_);
  Vec3 normal = scale(-1, outward);
  if (bound > far_share * shape_.narrow) return {bound, normal};
  const Foot foot = foot_of(s, h);
  const double distance = std::hypot(foot.s - s, foot.h - h);
  // from the slope at the foot, so that the normal is right on the wall too
  const double m = slope(foot.s);
  normal = scale(-1 / std::sqrt(1 + m * m), outward);
  normal[along] = m / std::sqrt(1 + m * m);
  return {room < 0 ? -distance : distance, normal};
}

}  // namespace npfem::flow
