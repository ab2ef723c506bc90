// SPDX-License-Identifier: MPL-2.0
#pragma once

// The D3Q19 velocity set (Qian, d'Humieres & Lallemand 1992): rest, 6 faces, 12 edges. In lattice units the speed of
// sound is 1/sqrt(3). Directions come in opposite pairs (1,2), (3,4), ... (17,18).

#include <array>
#include <cstddef>

namespace npfem::flow {

using Vec3 = std::array<double, 3>;

namespace d3q19 {

inline constexpr int kDirections = 19;

inline constexpr std::array<std::array<int, 3>, kDirections> kVelocity = {{
    {0, 0, 0},                                       //
    {1, 0, 0},  {-1, 0, 0}, {0, 1, 0}, {0, -1, 0},   //
    {0, 0, 1},  {0, 0, -1}, {1, 1, 0}, {-1, -1, 0},  //
    {1, -1, 0}, {-1, 1, 0}, {1, 0, 1}, {-1, 0, -1},  //
    {1, 0, -1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, -1},  //
    {0, 1, -1}, {0, -1, 1},                          //
}};

constexpr int opposite(int i) {
  return i == 0 ? 0 : (i % 2 == 1 ? i + 1 : i - 1);
}

constexpr double weight(int i) {
  return i == 0 ? 1.0 / 3.0 : (i <= 6 ? 1.0 / 18.0 : 1.0 / 36.0);
}

constexpr double along(int i, const Vec3& v) {  // c_i . v
  const auto& c = kVelocity[std::size_t(i)];
  return c[0] * v[0] + c[1] * v[1] + c[2] * v[2];
}

// Equilibrium of He & Luo (1997) for a nearly incompressible fluid (rho0 = 1 in front of the velocity terms), as a
// deviation from the weight: w_i [drho + 3 c.u + 9/2 (c.u)^2 - 3/2 u.u].
constexpr double equilibrium(int i, double density_deviation, const Vec3& u) {
  const double cu = along(i, u);
  const double uu = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
  return weight(i) * (density_deviation + 3.0 * cu + 4.5 * cu * cu - 1.5 * uu);
}

}  // namespace d3q19
}  // namespace npfem::flow
