// SPDX-License-Identifier: MPL-2.0
// Contacts together with the cell solver: cells that are pressed together stay apart, cells that overlap come apart.
#include <gtest/gtest.h>

#include <memory>

#include "capsules.h"
#include "communicator/serial_communicator.h"
#include "contact/contacts.h"
#include "contact/minimum_gap.h"
#include "contact/surface_crossing.h"

namespace npfem::flow {
namespace {

/// Two red cells face to face on the z axis in a wide box, moved by the cell solver against the drag of a fluid at
/// rest.
class Pair {
 public:
  explicit Pair(double distance) {
    setup_.domain.nodes = {80, 80, 80};
    setup_.domain.dx = 0.5;
    setup_.contact.cells = {0.4, 20, 0, 0};
    const auto material = api::Material::preset("rbc");
    CellType type;
    type.model = std::make_shared<const api::Model>(material.mesh(3), material);
    type.triangles = type.model->triangles();
    api::Batch relaxed(*type.model, "cpu", 1);
    relaxed.relax();
    vertices_ = static_cast<std::size_t>(type.model->vertices());
    type.shape.resize(3 * vertices_);
    relaxed.read("position", 0, 1, type.shape);
    setup_.types = {type};
    batch_ = api::Batch(*type.model, "cpu", 2);
    batch_.set("time_step", 1);
    batch_.write("ambient_mass", 0, 2, std::vector<double>(2 * vertices_, 10.0));
    for (int id = 0; id < 2; ++id) {
      capsules::place(setup_, 0, {20, 20, 10 + id * distance});
      // Turned, so that no vertex meets its own image in a mirror.
      const Rotation turn = rotation_about({0, 0, 1}, 0.4 * id);
      for (std::size_t v = 0; v < vertices_; ++v) {
        all_.held.push_back(static_cast<int>(all_.id.size()));
        all_.id.push_back({id, static_cast<int>(v)});
        const Vec3 turned = rotate(turn, {type.shape[3 * v], type.shape[3 * v + 1], type.shape[3 * v + 2]});
        const Vec3 at = add(setup_.cells.back().centre, turned);
        all_.position.insert(all_.position.end(), at.begin(), at.end());
      }
    }
    batch_.write("position", 0, 2, all_.position);
  }

  /// One step under the contacts and a force (pN) that pushes each cell towards the other.
  void step(double load) {
    Contacts contacts(setup_);
    std::vector<ContactLoad> loads(all_.id.size());
    contacts.evaluate(all_, loads);
    std::vector<double> force(3 * loads.size()), stiffness(loads.size());
    for (std::size_t v = 0; v < loads.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) force[3 * v + axis] = force_of(loads[v].force[axis]);
      force[3 * v + 2] += (v < vertices_ ? 1 : -1) * load / static_cast<double>(vertices_);
      stiffness[v] = stiffness_of(loads[v].stiffness);
    }
    const std::vector<double> still(force.size(), 0.0);
    batch_.write("external_force", 0, 2, force);
    batch_.write("contact_stiffness", 0, 2, stiffness);
    batch_.write("velocity", 0, 2, still);
    batch_.write("held_force", 0, 2, still);
    EXPECT_EQ(batch_.step(), 0);
    batch_.read("position", 0, 2, all_.position);
  }

  std::vector<CellSurface> surfaces() const {
    const auto middle = all_.position.begin() + static_cast<std::ptrdiff_t>(3 * vertices_);
    return {{0, 0, {all_.position.begin(), middle}}, {1, 0, {middle, all_.position.end()}}};
  }
  double gap() const {
    SerialCommunicator alone;
    return smallest_cell_gap(setup_.domain, setup_.types, alone, surfaces());
  }
  std::int64_t crossings() const {
    SerialCommunicator alone;
    return count_crossings(setup_.domain, setup_.types, alone, surfaces());
  }

 private:
  flow::Setup setup_;
  api::Batch batch_;
  std::size_t vertices_ = 0;
  ContactVertices all_;
};

TEST(PressedCells, StayApart) {
  Pair pair(2.9);
  for (int i = 0; i < 80; ++i) {
    pair.step(150);
    if (i % 10 < 9) continue;
    EXPECT_GT(pair.gap(), 0) << "in step " << i;
  }
  const double gap = pair.gap();
  EXPECT_LT(gap, 0.3) << "they touch";
  pair.step(150);
  EXPECT_NEAR(pair.gap(), gap, 2e-3) << "the contact bears the load";
  EXPECT_EQ(pair.crossings(), 0);
}

TEST(PressedCells, ThatOverlapComeApart) {
  Pair pair(2.05);
  double gap = pair.gap();
  EXPECT_LT(gap, -0.15);
  EXPECT_GT(pair.crossings(), 0);
  for (int i = 0; i < 100 && gap < 0.15; ++i) {
    pair.step(0);
    EXPECT_GT(pair.gap(), gap - 1e-3) << "in step " << i;
    gap = pair.gap();
  }
  EXPECT_GE(gap, 0.15);
  EXPECT_EQ(pair.crossings(), 0);
}

}  // namespace
}  // namespace npfem::flow
