// SPDX-License-Identifier: MPL-2.0
#include "mesh/generate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error.h"
#include "mesh/geometry.h"
#include "mesh/mesh_check.h"
#include "mesh/point_math.h"

namespace npfem {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Generate, HasTheKnownNumbersOfVertices) {
  const std::size_t octahedral[] = {6, 18, 66, 258, 1026, 4098}, icosahedral[] = {12, 42, 162, 642, 2562};
  for (int level = 0; level < 6; ++level) {
    EXPECT_EQ(octahedral_sphere(level).positions.size(), octahedral[level]);
    EXPECT_EQ(octahedral_sphere(level).triangles.size(), 2 * (octahedral[level] - 2));
  }
  for (int level = 0; level < 5; ++level) EXPECT_EQ(icosahedral_sphere(level).positions.size(), icosahedral[level]);
}

TEST(Generate, GivesValidSurfacesEverywhere) {
  for (const std::string& shape : mesh_shapes()) {
    for (int level = 0; level < 5; ++level) {
      EXPECT_NO_THROW(require_valid_surface(generate_mesh(shape, level), shape)) << shape << ' ' << level;
    }
  }
}

TEST(Generate, SpheresConvergeToAreaAndVolume) {
  for (const auto make : {octahedral_sphere, icosahedral_sphere}) {
    double last_error = 1;
    for (int level = 1; level < 6; ++level) {
      const TriangleMesh mesh = make(level);
      for (const Point& p : mesh.positions) EXPECT_NEAR(norm(p), 1, 1e-15);
      const double error = std::abs(surface_area(mesh) / (4 * pi) - 1);
      if (level > 2) {
        EXPECT_NEAR(last_error / error, 4, 0.2) << "second order in the edge length";
      }
      last_error = error;
    }
    EXPECT_LT(last_error, 2e-3);
    EXPECT_NEAR(signed_volume(make(5)) / (4 * pi / 3), 1, 3e-3);
  }
}

// Area, volume and thickness of the Evans-Fung cell: closed forms A = 134.09 um2, V = 94.09 um3 (validation S8).
TEST(EvansFung, HasTheKnownAreaAndVolume) {
  const TriangleMesh coarse = evans_fung_cell(3), medium = evans_fung_cell(4), fine = evans_fung_cell(6);
  EXPECT_NEAR(surface_area(coarse), 131.8666, 5e-5);
  EXPECT_NEAR(signed_volume(coarse), 91.7992, 5e-5);
  EXPECT_NEAR(reduced_volume(coarse), 0.6447, 5e-5);
  EXPECT_NEAR(surface_area(medium), 133.53, 5e-3);
  EXPECT_NEAR(signed_volume(medium), 93.51, 5e-3);
  EXPECT_NEAR(surface_area(fine), 134.09, 0.04);
  EXPECT_NEAR(signed_volume(fine), 94.09, 0.04);
}

TEST(EvansFung, HasTheKnownExtentsAndEdges) {
  const TriangleMesh mesh = evans_fung_cell(3);
  const Point size = extents(mesh);
  EXPECT_NEAR(size[0], 7.82, 1e-14);
  EXPECT_NEAR(size[1], 7.82, 1e-14);
  EXPECT_NEAR(size[2], 2.565, 1e-3);
  const EdgeLengths edges = edge_lengths(mesh);
  EXPECT_NEAR(edges.min, 0.424, 5e-4);
  EXPECT_NEAR(edges.mean, 0.805, 5e-4);
  EXPECT_NEAR(edges.max, 1.179, 5e-4);
  double centre_thickness = 0;
  for (const Point& p : mesh.positions) {
    if (p[0] == 0 && p[1] == 0) centre_thickness += std::abs(p[2]);
  }
  EXPECT_NEAR(centre_thickness, 0.207161 * 3.91, 1e-14);
}

/// Mean curvature at the pole of the discrete surface: the paraboloid z = z0 + k r^2 / 2 through the pole and its ring.
double pole_curvature(const TriangleMesh& mesh) {
  int pole = 0;
  for (int i = 0; i < static_cast<int>(mesh.positions.size()); ++i) {
    const Point& p = mesh.positions[static_cast<std::size_t>(i)];
    if (p[0] == 0 && p[1] == 0 && p[2] > 0) pole = i;
  }
  const auto neighbours = find_neighbours(mesh)[static_cast<std::size_t>(pole)];
  double curvature = 0;
  for (const int n : neighbours) {
    const Point& p = mesh.positions[static_cast<std::size_t>(n)];
    const double rise = p[2] - mesh.positions[static_cast<std::size_t>(pole)][2];
    curvature += -2 * rise / (p[0] * p[0] + p[1] * p[1]) / static_cast<double>(neighbours.size());
  }
  return curvature;  // 1/um, positive where the surface bulges outwards
}

// At the pole z = (R0/2) sqrt(1 - q) (c0 + c1 q + ...), q = (r/R0)^2: H = -(c1 - c0/2)/R0 (the dimple is hollow).
TEST(EvansFung, HasTheClosedFormCurvatureAtThePole) {
  const double exact = -(2.002558 - 0.207161 / 2) / 3.91;
  EXPECT_NEAR(exact * 3.91, -1.899, 5e-4) << "the value of validation S9";
  const auto error = [exact](int level) { return pole_curvature(evans_fung_cell(level)) / exact - 1; };
  EXPECT_LT(std::abs(error(6)), 1e-3);
  EXPECT_NEAR(error(4) / error(5), 4, 0.1) << "second order in the edge length";
  EXPECT_NEAR(error(5) / error(6), 4, 0.1);
  EXPECT_NEAR(pole_curvature(oblate_spheroid(6)) / (0.55 / (1.8 * 1.8)), 1, 1e-3) << "c/a^2 for a spheroid";
}

/// Integral of the mean curvature over the exact Evans-Fung cell, um: pi times the integral of (r dpsi - dz) along the
/// meridian, psi its tangent angle.
double exact_total_curvature() {
  const int n = 100000;
  const auto point = [](double phi) {
    const double q = std::sin(phi) * std::sin(phi);
    return std::pair(3.91 * std::sin(phi), 3.91 / 2 * std::cos(phi) * (0.207161 + 2.002558 * q - 1.122762 * q * q));
  };
  double total = 0, last_psi = 0;
  for (int i = 0; i < n; ++i) {
    const auto [r0, z0] = point(pi / 2 * i / n);
    const auto [r1, z1] = point(pi / 2 * (i + 1) / n);
    const double psi = std::atan2(z0 - z1, r1 - r0);
    total += r0 * (psi - last_psi) - (z1 - z0);
    last_psi = psi;
  }
  return 2 * pi * (total + 3.91 * (pi / 2 - last_psi));  // both halves
}

// Integral of the mean curvature of a polyhedron: half the sum of edge length times dihedral angle (Steiner).
TEST(EvansFung, HasTheTotalCurvatureOfTheClosedForm) {
  const auto total = [](const TriangleMesh& mesh) {
    double sum_over_edges = 0;
    for (const Hinge& h : find_hinges(mesh)) {
      const Point edge =
          difference(mesh.positions[static_cast<std::size_t>(h.b)], mesh.positions[static_cast<std::size_t>(h.a)]);
      sum_over_edges += norm(edge) * dihedral_angle(mesh, h) / 2;
    }
    return sum_over_edges;
  };
  EXPECT_NEAR(total(octahedral_sphere(5)) / (4 * pi), 1, 1e-3);
  EXPECT_NEAR(total(evans_fung_cell(5)) / exact_total_curvature(), 1, 2e-3);
}

// A = 2 pi a^2 [1 + (1 - e^2) atanh(e)/e], e^2 = 1 - c^2/a^2; V = (4/3) pi a^2 c.
TEST(Spheroid, HasTheClosedFormAreaAndVolume) {
  const TriangleMesh mesh = oblate_spheroid(6);
  const double a = 1.8, c = 0.55, e = std::sqrt(1 - c * c / (a * a));
  EXPECT_NEAR(surface_area(mesh) / (2 * pi * a * a * (1 + (1 - e * e) * std::atanh(e) / e)), 1, 5e-4);
  EXPECT_NEAR(signed_volume(mesh) / (4 * pi / 3 * a * a * c), 1, 1e-3);
}

TEST(Spheroid, DefaultIsThePlateletOfTheLineage) {
  const TriangleMesh mesh = generate_mesh("platelet", 2);
  EXPECT_NEAR(surface_area(mesh), 22.9932, 5e-5);
  EXPECT_NEAR(signed_volume(mesh), 6.80319, 5e-6);
  EXPECT_NEAR(extents(mesh)[2], 1.1, 1e-14);
}

TEST(Generate, DiameterScalesTheShape) {
  for (const std::string& shape : mesh_shapes()) {
    const TriangleMesh natural = generate_mesh(shape, 2), doubled = generate_mesh(shape, 2, 20);
    // The icosahedral mesh has no vertex on the axes: its sphere has the diameter, not its box.
    if (shape != "icosphere") {
      EXPECT_NEAR(extents(doubled)[0], 20, 1e-13);
    }
    EXPECT_NEAR(reduced_volume(doubled), reduced_volume(natural), 1e-13);
  }
  EXPECT_NEAR(norm(generate_mesh("icosphere", 2, 20).positions[0]), 10, 1e-13);
}

std::string message_of(std::string_view shape, int level, double diameter) {
  try {
    generate_mesh(shape, level, diameter);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Generate, SaysWhatIsAllowed) {
  EXPECT_EQ(message_of("plateet", 2, 0),
            "unknown mesh shape \"plateet\"; did you mean \"platelet\"? allowed: rbc, platelet, sphere, icosphere");
  EXPECT_NE(message_of("rbc", -1, 0).find("level -1 is outside 0 to 8"), std::string::npos);
  EXPECT_NE(message_of("rbc", 9, 0).find("level 9"), std::string::npos);
  EXPECT_NE(message_of("rbc", 3, -1), "");
  EXPECT_NE(message_of("rbc", 3, std::nan("")), "");
  EXPECT_NE(message_of("rbc", 3, INFINITY), "");
}

}  // namespace
}  // namespace npfem
