// SPDX-License-Identifier: MPL-2.0
// Helfrich's energy of a closed surface against the continuum: sphere and Evans-Fung cell.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "energies/energy_list.h"
#include "mesh/generate.h"
#include "mesh/topology.h"

namespace npfem {
namespace {

using V = Vec3<double>;
constexpr double eight_pi = 8 * std::numbers::pi;

TEST(ArcTangent, EqualsAtan2) {
  for (double angle = -3.14; angle <= 3.14; angle += 0.01) {
    for (const double length : {1e-8, 1.0, 1e6}) {
      const double c = length * std::cos(angle), s = length * std::sin(angle);
      EXPECT_NEAR(arc_tangent(s, c), std::atan2(s, c), 1e-15 * std::abs(angle) + 1e-17);
    }
    EXPECT_NEAR(arc_tangent(float(std::sin(angle)), float(std::cos(angle))), angle, 1e-6);
  }
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0);
}

TEST(Ring, LaplacianRowIsTheSlopeOfTheArea) {
  const V x[5] = {{0, 0, 0.3}, {1, 0, 0}, {0, 1.2, 0.1}, {-0.9, 0, 0}, {0.1, -1, -0.1}};
  V slope[5];
  double row[5];
  ring_area(x, 5, slope);
  ring_laplacian(x, 5, row);
  V sum{0, 0, 0};
  for (int i = 0; i < 5; ++i) sum = sum + row[i] * x[i];
  // The slope of the whole ring's area by its centre, three times that of the vertex's share, is -row x.
  EXPECT_NEAR(norm(sum + 3.0 * slope[0]), 0, 1e-14);
}

/// Energy (pN um) of a surface with uniform spontaneous curvature H0 (1/um).
template <class G>
double bending_energy(const TriangleMesh& mesh, double kappa, double h0) {
  double energy = 0;
  const auto rings = find_rings(mesh);
  for (std::size_t v = 0; v < rings.size(); ++v) {
    V x[G::max_vertices], unused[G::max_vertices];
    const auto place = [&](std::size_t i, std::size_t vertex) {
      const Point& p = mesh.positions[vertex];
      x[i] = {p[0], p[1], p[2]};
    };
    place(0, v);
    for (std::size_t i = 0; i < rings[v].size(); ++i) place(i + 1, static_cast<std::size_t>(rings[v][i]));
    const typename G::template Params<double> params{kappa, h0, 1};
    const int count = static_cast<int>(rings[v].size()) + 1;
    energy += G::energy_gradient(x, count, G::rest(x, count, params), params, unused);
  }
  return energy;
}

template <class G>
class Helfrich : public ::testing::Test {};
using Laws = ::testing::Types<JuelicherBending, CotangentBending>;
TYPED_TEST_SUITE(Helfrich, Laws);

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Point& p : mesh.positions) {
    for (double& c : p) c *= factor;
  }
  return mesh;
}

TYPED_TEST(Helfrich, SphereHasEightPiKappaAtAnySize) {
  const TriangleMesh sphere = icosahedral_sphere(3);  // 642 vertices, radius 1 um
  const double energy = bending_energy<TypeParam>(sphere, 0.3, 0);
  std::printf("%s, sphere of 642 vertices: %.4f of 8 pi kappa\n", TypeParam::name, energy / (0.3 * eight_pi));
  EXPECT_NEAR(energy, 0.3 * eight_pi, 0.01 * 0.3 * eight_pi);
  EXPECT_NEAR(bending_energy<TypeParam>(scaled(sphere, 7), 0.3, 0), energy, 1e-12);
}

TYPED_TEST(Helfrich, SphereOfItsSpontaneousCurvatureHasNone) {
  // (H - H0)^2 with H = 1/R: nothing at H0 = 1/R, four times 8 pi kappa at H0 = -1/R.
  const TriangleMesh sphere = icosahedral_sphere(3);
  EXPECT_LT(bending_energy<TypeParam>(sphere, 1, 1), 0.002 * eight_pi);
  EXPECT_NEAR(bending_energy<TypeParam>(sphere, 1, -1), 4 * eight_pi, 0.02 * 4 * eight_pi);
}

TYPED_TEST(Helfrich, EvansFungCellIsReachedByRefinement) {
  // The continuum value for this shape is 1.9287 * 8 pi kappa.
  double previous = 1;
  for (const int level : {3, 4, 5}) {
    const double share = bending_energy<TypeParam>(evans_fung_cell(level), 1, 0) / (1.9287 * eight_pi);
    std::printf("%s, level %d: %.4f of the continuum\n", TypeParam::name, level, share);
    EXPECT_LT(std::abs(share - 1), previous);
    previous = std::abs(share - 1);
  }
  EXPECT_LT(previous, 0.01);
}

TEST(Helfrich, RemembersAShape) {
  // Not uniform: H0 is that of the rest shape. Bent further, the vertex resists, with the sign of the change.
  const V cap[5] = {{0, 0, 0.3}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  using G = JuelicherBending;
  const G::Params<double> params{0.3, 0, 0};
  const auto rest = G::rest(cap, 5, params);
  V x[5], g[5];
  std::copy_n(cap, 5, x);
  EXPECT_NEAR(G::energy_gradient(x, 5, rest, params, g), 0, 1e-15);
  x[0].z = 0.4;
  EXPECT_GT(G::energy_gradient(x, 5, rest, params, g), 0);
  EXPECT_GT(g[0].z, 0) << "the centre is pulled back";
  x[0].z = -0.3;
  const double inverted = G::energy_gradient(x, 5, rest, params, g);
  EXPECT_NEAR(inverted, 4 * 2 * 0.3 * rest.curvature * rest.curvature * rest.weight.area, 1e-12) << "sees the sign";
}

}  // namespace
}  // namespace npfem
