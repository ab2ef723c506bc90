// SPDX-License-Identifier: MPL-2.0
#include "mesh/stress_free.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "error.h"
#include "mesh/geometry.h"
#include "mesh/point_math.h"
#include "quantity.h"

namespace npfem {
namespace {

constexpr double pi = std::numbers::pi;

[[noreturn]] void fail(const std::string& message) {
  throw Error(Status::bad_input, "stress-free shape: " + message);
}

/// An oblate spheroid of equatorial radius 1 and polar radius c <= 1.
struct Spheroid {
  double c;

  /// Area between the equator and the height z: 2 pi times the integral of
  /// sqrt(1 + q^2 z^2), q^2 = (1 - c^2)/c^4.
  double zone_area(double z) const {
    const double q = std::sqrt(std::max(0.0, 1 - c * c)) / (c * c);
    if (q * z < 1e-6) return 2 * pi * z;
    return pi * (z * std::sqrt(1 + q * q * z * z) + std::asinh(q * z) / q);
  }
  double area() const { return 2 * zone_area(c); }
  double reduced_volume() const { return 6 * std::sqrt(pi) * (4 * pi / 3 * c) / std::pow(area(), 1.5); }
};

/// The x in [low, high] where the increasing function f takes the value
/// `target`.
template <class F>
double bisect(const F& f, double target, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Spheroid spheroid_of(double reduced_volume) {
  if (!(reduced_volume >= 0.05 && reduced_volume <= 1)) {
    fail("the reduced volume is " + text::format_number(reduced_volume) +
         "; it must lie between 0.05 (a disc) and 1 (a sphere)");
  }
  return {bisect([](double c) { return Spheroid{c}.reduced_volume(); }, reduced_volume, 1e-4, 1)};
}

/// The meridian of a cell from the pole to the equator, as (radius, height)
/// pairs, and the area that each radius encloses.
class Meridian {
 public:
  explicit Meridian(const TriangleMesh& cell) {
    std::vector<std::array<double, 2>> points;
    for (const Point& p : cell.positions) points.push_back({std::hypot(p[0], p[1]), std::abs(p[2])});
    std::sort(points.begin(), points.end());
    const double size = extents(cell)[0];
    radius_.push_back(0);
    enclosed_.push_back(0);
    double height = points.front()[1];
    for (const auto& [r, z] : points) {
      if (r - radius_.back() < 1e-9 * size) continue;
      enclosed_.push_back(enclosed_.back() + pi * (r + radius_.back()) * std::hypot(r - radius_.back(), z - height));
      radius_.push_back(r);
      height = z;
    }
    rim_area_ = 2 * pi * radius_.back() * height;  // where no vertex lies on the equator
    require_revolution(cell);
  }

  /// The part of the half surface nearer to the pole than the radius r.
  double area_fraction(double r) const {
    const auto above = std::upper_bound(radius_.begin(), radius_.end(), r);
    const double total = enclosed_.back() + rim_area_;
    if (above == radius_.end()) return enclosed_.back() / total;
    const auto i = static_cast<std::size_t>(above - radius_.begin());
    const double weight =
        (r * r - radius_[i - 1] * radius_[i - 1]) / (radius_[i] * radius_[i] - radius_[i - 1] * radius_[i - 1]);
    return (enclosed_[i - 1] + weight * (enclosed_[i] - enclosed_[i - 1])) / total;
  }

 private:
  /// Round, centred, and with vertices that lie on one curve: if not, the
  /// meridian is a zigzag and its area too large.
  void require_revolution(const TriangleMesh& cell) const {
    constexpr double tolerance = 0.01,
                     area_tolerance = 0.35;  // the latter for the octahedron itself
    const Point size = extents(cell);
    const double area = 2 * (enclosed_.back() + rim_area_);
    const bool is_round = std::abs(size[0] - size[1]) < tolerance * size[0];
    const bool is_centred = norm(volume_centroid(cell)) < tolerance * size[0];
    if (is_round && is_centred && std::abs(area / surface_area(cell) - 1) < area_tolerance) return;
    fail(
        "the cell is not a surface of revolution about z, centred at the "
        "origin and symmetric about z = 0; turn and "
        "centre it, or set stress_free_reduced_volume to 0 (its own shape)");
  }

  std::vector<double> radius_;    // um
  std::vector<double> enclosed_;  // um2
  double rim_area_ = 0;
};

}  // namespace

TriangleMesh oblate_reference(const TriangleMesh& cell, double reduced_volume) {
  const Spheroid spheroid = spheroid_of(reduced_volume);
  const Meridian meridian(cell);
  const double half_area = spheroid.zone_area(spheroid.c);
  TriangleMesh reference = cell;
  for (Point& p : reference.positions) {
    const double r = std::hypot(p[0], p[1]);
    const double from_equator = (1 - meridian.area_fraction(r)) * half_area;
    const double z = bisect([&](double h) { return spheroid.zone_area(h); }, from_equator, 0, spheroid.c);
    const double radius = std::sqrt(std::max(0.0, 1 - (z / spheroid.c) * (z / spheroid.c)));
    const double stretch = r > 0 ? radius / r : 0;
    p = {p[0] * stretch, p[1] * stretch, std::copysign(z, p[2])};
  }
  const double factor = std::sqrt(surface_area(cell) / surface_area(reference));
  for (Point& p : reference.positions) p = scaled(factor, p);
  return reference;
}

}  // namespace npfem
