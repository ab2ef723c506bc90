// SPDX-License-Identifier: MPL-2.0
#include "scene/memory_need.h"

#include <gtest/gtest.h>

#include "scene/make_cells.h"
#include "scene_text.h"

namespace npfem::flow {
namespace {

Scene made(const std::string& text) {
  Scene scene = parse_scene(text, "scene.toml");
  make_types(scene);
  return scene;
}

std::string error_of(const Scene& scene, double share, double memory) {
  try {
    require_memory(scene, cell_counts(scene), share, memory);
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

Domain tube(int nodes_across, int length) {
  Domain domain;
  domain.kind = DomainKind::tube;
  domain.nodes = {nodes_across, nodes_across, length};
  domain.dx = 0.5;
  domain.tube_radius = 0.25 * (nodes_across - 4);
  return domain;
}

TEST(FluidNodes, AreCountedOrEstimated) {
  const FluidNodes box = fluid_nodes(parse_scene(shear_scene, "scene.toml").setup.domain);
  EXPECT_TRUE(box.exact);
  EXPECT_EQ(box.count, 28 * 24 * 20);
  const FluidNodes counted = fluid_nodes(tube(100, 20)), estimated = fluid_nodes(tube(100, 20000));
  EXPECT_TRUE(counted.exact);
  EXPECT_FALSE(estimated.exact) << "too many nodes to be looked at one by one";
  EXPECT_NEAR(static_cast<double>(estimated.count) / (1000.0 * static_cast<double>(counted.count)), 1, 0.01);
}

TEST(MemoryNeed, IsThatOfPopulationsForceAndVelocity) {
  const Scene scene = made(shear_scene);
  const FluidNodes nodes = fluid_nodes(scene.setup.domain);
  const MemoryNeed with_cells = memory_need(scene, nodes, {1}), without = memory_need(scene, nodes, {0});
  const double per_node = with_cells.fluid / static_cast<double>(nodes.count);
  EXPECT_GT(per_node, 25 * 8);
  EXPECT_LT(per_node, 25 * 8 * 1.3);
  EXPECT_GT(without.fluid, 19 * 8 * static_cast<double>(nodes.count));
  EXPECT_LT(without.fluid, with_cells.fluid);
  EXPECT_EQ(without.cells, 0);
  EXPECT_EQ(memory_need(scene, nodes, {7}).cells, 7 * with_cells.cells);
  EXPECT_GT(machine_memory(), 1e8);
}

TEST(MemoryNeed, TheKeyToChangeIsNamed) {
  const Scene small = made(shear_scene);
  const MemoryNeed need = memory_need(small, fluid_nodes(small.setup.domain), {1});
  EXPECT_EQ(error_of(small, 1, need.fluid + need.cells), "no error");
  EXPECT_EQ(error_of(small, 0.25, 0.26 * (need.fluid + need.cells)), "no error") << "a quarter of it is here";
  EXPECT_EQ(error_of(small, 0.25, 0.24 * (need.fluid + need.cells)).find("scene.toml:7:6: domain.dx: 28 x 24 x 20 "),
            0u)
      << error_of(small, 0.25, 0.24 * (need.fluid + need.cells));
  const Scene crowded = made(with(shear_scene, "count = 1", "count = 1000000"));
  const std::string message = error_of(crowded, 1, 1e9);
  EXPECT_EQ(message.find("scene.toml:16:1: cells[0]: 1000000 cells of 66 vertices need about "), 0u) << message;
}

}  // namespace
}  // namespace npfem::flow
