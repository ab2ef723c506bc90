// SPDX-License-Identifier: MPL-2.0
#include "placement/pack_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "communicator/serial_communicator.h"
#include "contact/minimum_gap.h"
#include "contact/surface_crossing.h"
#include "geometry/cell_shape.h"
#include "npfem/npfem.hpp"

namespace npfem::flow {
namespace {

CellType type_of(const std::string& preset, int level) {
  const auto material = api::Material::preset(preset);
  CellType type;
  type.name = preset;
  type.model = std::make_shared<const api::Model>(material.mesh(level), material);
  api::Batch cell(*type.model, "cpu", 1);
  cell.relax();
  type.shape.resize(3 * static_cast<std::size_t>(type.model->vertices()));
  cell.read("position", 0, 1, type.shape);
  type.triangles = type.model->triangles();
  const Vec3 centre = shape_of(type.shape, type.triangles).centre;
  for (std::size_t i = 0; i < type.shape.size(); ++i) type.shape[i] -= centre[i % 3];
  return type;
}

Domain domain_of(DomainKind kind, const std::array<int, 3>& nodes) {
  Domain domain;
  domain.kind = kind;
  domain.nodes = nodes;
  domain.dx = 0.5;
  domain.tube_radius = 0.25 * nodes[0];
  return domain;
}

/// Checks a packing by means of its own: no gap below 0, no crossing, no cell beyond a wall, none with a wrong volume.
void expect_packed(const Domain& domain, std::span<const CellType> types, const PackRequest& request,
                   const PackedCells& packed) {
  ASSERT_FALSE(packed.interrupted);
  std::vector<CellSurface> surfaces;
  std::vector<int> counts(types.size());
  for (const CellStart& cell : packed.cells) {
    surfaces.push_back({static_cast<int>(surfaces.size()), cell.type, cell.positions});
    ++counts[static_cast<std::size_t>(cell.type)];
    const CellType& type = types[static_cast<std::size_t>(cell.type)];
    const double rest = enclosed_volume(type.shape, type.triangles);
    EXPECT_NEAR(enclosed_volume(cell.positions, type.triangles), rest, 0.01 * rest);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_GE(cell.centre[axis], 0);
      EXPECT_LE(cell.centre[axis], domain.size()[axis]);
    }
  }
  EXPECT_EQ(counts, request.counts);
  SerialCommunicator alone;
  EXPECT_GT(smallest_cell_gap(domain, types, alone, surfaces), 0);
  EXPECT_GT(smallest_wall_gap(domain, alone, surfaces), 0);
  EXPECT_EQ(count_crossings(domain, types, alone, surfaces), 0);
  EXPECT_GT(packed.overlap_before, 0.5) << "the cells did not overlap at first: the test is weak";
  EXPECT_GT(packed.least_gap, 0);
}

TEST(PackCells, FillsAPeriodicBoxToAThird) {
  const std::vector<CellType> types{type_of("rbc", 2), type_of("platelet", 1)};
  const Domain domain = domain_of(DomainKind::periodic_box, {36, 36, 36});
  PackRequest request;
  const double cell = enclosed_volume(types[0].shape, types[0].triangles);
  request.counts = {static_cast<int>(std::lround(0.35 * domain.fluid_volume() / cell)), 5};
  const PackedCells packed = pack_cells(domain, types, request);
  expect_packed(domain, types, request, packed);
  EXPECT_NEAR(packed.volume / domain.fluid_volume(), 0.35, 0.02);
  const PackedCells again = pack_cells(domain, types, request);
  ASSERT_EQ(again.cells.size(), packed.cells.size());
  for (std::size_t n = 0; n < again.cells.size(); ++n) EXPECT_EQ(again.cells[n].positions, packed.cells[n].positions);
}

TEST(PackCells, KeepsCellsBetweenWalls) {
  const std::vector<CellType> types{type_of("rbc", 2)};
  PackRequest request;
  request.seed = 3;
  for (const DomainKind kind : {DomainKind::plates, DomainKind::tube}) {
    const Domain domain = domain_of(kind, {36, 36, 40});
    request.counts = {static_cast<int>(std::lround(0.3 * domain.fluid_volume() / 94))};
    expect_packed(domain, types, request, pack_cells(domain, types, request));
  }
}

TEST(PackCells, SettlesDeformableCellsWhereRigidOnesJam) {
  const std::vector<CellType> types{type_of("rbc", 2)};
  const Domain domain = domain_of(DomainKind::periodic_box, {30, 30, 30});
  PackRequest request;
  request.counts = {23};  // 58 %
  const PackedCells packed = pack_cells(domain, types, request);
  expect_packed(domain, types, request, packed);
  EXPECT_GT(packed.soft_steps, 1);
}

// Two rims that cross edge through edge, no vertex inside either, are no overlap to contacts between vertices and
// triangles: only their own noise parts them.
TEST(PackCells, HandsNoRimsThatCrossToTheSoftCells) {
  const std::vector<CellType> types{type_of("rbc", 2)};
  const Domain domain = domain_of(DomainKind::shear_box, {120, 120, 120});
  PackRequest request;
  request.counts = {800};  // 35 %
  request.seed = 5;
  const PackedCells packed = pack_cells(domain, types, request);
  expect_packed(domain, types, request, packed);
  EXPECT_LE(packed.soft_steps, 5);
}

/// Two discs, one micrometre apart, through each other, and one far away, which stays where it is.
TEST(PackCells, PartsCellsThatStartThroughEachOther) {
  const std::vector<CellType> types{type_of("rbc", 2)};
  const Domain domain = domain_of(DomainKind::periodic_box, {40, 40, 40});
  const Rotation turned = rotation_about_xyz({0.4, -0.9, 1.3});
  PackRequest request;
  request.counts = {3};
  for (const Vec3& centre : {Vec3{5, 5, 5}, Vec3{6, 5, 5.2}, Vec3{15, 15, 15}}) {
    CellStart& cell = request.start.emplace_back(CellStart{0, centre, turned, {}});
    for (std::size_t i = 0; i < types[0].shape.size(); i += 3) {
      const Vec3 x = add(centre, rotate(turned, {types[0].shape[i], types[0].shape[i + 1], types[0].shape[i + 2]}));
      cell.positions.insert(cell.positions.end(), x.begin(), x.end());
    }
  }
  const PackedCells packed = pack_cells(domain, types, request);
  expect_packed(domain, types, request, packed);
  const auto alone =
      std::find_if(packed.cells.begin(), packed.cells.end(), [](const CellStart& cell) { return cell.centre[0] > 12; });
  ASSERT_NE(alone, packed.cells.end());
  for (std::size_t i = 0; i < alone->positions.size(); ++i) {
    EXPECT_NEAR(alone->positions[i], request.start[2].positions[i], 1e-3);
  }
}

TEST(PackCells, SaysHowFarItGotWhereThereIsNoRoom) {
  const std::vector<CellType> types{type_of("rbc", 2)};
  const Domain domain = domain_of(DomainKind::periodic_box, {24, 24, 24});
  PackRequest request;
  request.counts = {17};  // 84 %
  try {
    pack_cells(domain, types, request);
    FAIL();
  } catch (const PlacementError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("no room for 17 cells (haematocrit 0.8"), std::string::npos) << message;
    EXPECT_NE(message.find("it has reached haematocrit 0."), std::string::npos) << message;
  }
}

TEST(PackCells, RefusesACellLargerThanTheDomain) {
  const std::vector<CellType> types{type_of("rbc", 2)};
  PackRequest request;
  request.counts = {1};
  try {
    pack_cells(domain_of(DomainKind::periodic_box, {40, 14, 14}), types, request);
    FAIL();
  } catch (const PlacementError& error) {
    EXPECT_NE(std::string(error.what()).find("is larger than the domain (20 x 7 x 7 um)"), std::string::npos)
        << error.what();
  }
}

TEST(PackCells, StopsWhenAskedTo) {
  const std::vector<CellType> types{type_of("rbc", 2)};
  PackRequest request;
  request.counts = {20};
  request.goes_on = [](const PackProgress& at) { return at.steps < 3; };
  const PackedCells packed = pack_cells(domain_of(DomainKind::periodic_box, {36, 36, 36}), types, request);
  EXPECT_TRUE(packed.interrupted);
  EXPECT_TRUE(packed.cells.empty());
  EXPECT_EQ(packed.rigid_steps, 3);
}

}  // namespace
}  // namespace npfem::flow
