// SPDX-License-Identifier: MPL-2.0
// The lineage's energies on its own two bodies under affine maps, to every digit that its own code prints.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

#include "backend/reference/elasticity.h"
#include "mesh/lineage_body.h"
#include "model/lineage_model.h"

namespace npfem {
namespace {

struct Row {
  double matrix[3][3];
  double surface, area, bending, volume_energy, total_area, volume;
};

const double inverse = 1 / 1.1;
const Row red_cell[] = {
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, -82.416631, 0, 0, 0, 131.866610, 91.799218},
    {{{1.05, 0, 0}, {0, 1.05, 0}, {0, 0, 1.05}}, -81.543530, 1648.332629, .213840, 312.900799, 145.382938, 106.269070},
    {{{1.1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, -81.092681, 1122.475977, .108815, 130.035173, 142.509754, 100.979140},
    {{{1.1, 0, 0}, {0, inverse, 0}, {0, 0, 1}}, -80.296627, 206.542359, .136511, 0, 132.257090, 91.799218},
    {{{1, .2, 0}, {0, 1, 0}, {0, 0, 1}}, -80.076009, 229.871310, .129164, 0, 132.293759, 91.799218}};
const Row platelet[] = {
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, -14.370720, 0, 0, 0, 22.993153, 6.803195},
    {{{1.05, 0, 0}, {0, 1.05, 0}, {0, 0, 1.05}}, -14.218481, 287.414409, 24.011902, 13.803328, 25.349951, 7.875548},
    {{{1.1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, -14.105328, 223.982637, 30.008638, 5.658173, 25.036982, 7.483514},
    {{{1.1, 0, 0}, {0, inverse, 0}, {0, 0, 1}}, -13.931935, 15.108248, 37.181370, 0, 23.034977, 6.803195},
    {{{1, .2, 0}, {0, 1, 0}, {0, 0, 1}}, -13.887021, 16.534888, 37.491850, 0, 23.039063, 6.803195}};

void compare(const std::string& body, std::span<const Row> rows) {
  const std::string folder = std::string(NPFEM_SHARED) + "/data/palabos-npfem/Case_Studies/" + body;
  if (!std::filesystem::exists(folder)) {
    std::cout << "skipped: " << folder << " is absent\n";
    GTEST_SKIP();
  }
  const Model model = build_lineage_model(read_lineage_body(folder), {1125, 250});
  for (const Row& row : rows) {
    VertexField x(model.num_vertices(), 3), gradient = VertexField::Zero(model.num_vertices(), 3), a = gradient,
                                            v = gradient;
    for (int i = 0; i < model.num_vertices(); ++i) {
      const Point& p = model.initial[static_cast<std::size_t>(i)];
      for (int k = 0; k < 3; ++k) x(i, k) = row.matrix[k][0] * p[0] + row.matrix[k][1] * p[1] + row.matrix[k][2] * p[2];
    }
    std::vector<double> energies(4);
    elastic_energy(model, x, gradient, energies);
    const double half_digit = 1e-6;  // the table has six decimals
    EXPECT_NEAR(energies[0], row.surface, half_digit);
    EXPECT_NEAR(energies[1], row.area, half_digit);
    EXPECT_NEAR(energies[2], row.bending, half_digit);
    EXPECT_NEAR(energies[3], row.volume_energy, half_digit);
    const CellSums<double> sums = surface_sums(model, x, a, v);
    EXPECT_NEAR(sums.area, row.total_area, half_digit);
    EXPECT_NEAR(sums.volume, row.volume, half_digit);
  }
}

TEST(LineageTable, RedCell) {
  compare("RBC_Surface_mesh_258SurfVer", red_cell);
}
TEST(LineageTable, Platelet) {
  compare("PLT_Larger_Surface_mesh_66SurfVer", platelet);
}

}  // namespace
}  // namespace npfem
