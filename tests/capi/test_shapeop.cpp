// SPDX-License-Identifier: MPL-2.0
// The lineage's fourteen functions, used as its scripts use them and misused as its scripts may.
#include "npfem/shapeop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "npfem/npfem.hpp"

namespace {

using Vector = std::array<double, 3>;

std::string last_error() {
  return npfem::api::text_of([](char* b, std::int32_t n) { return npfem_last_error(b, n); });
}

/// A sphere of 66 vertices and 2.6 um radius with the three kinds of constraint of the shipped bodies.
class Sphere {
 public:
  Sphere() : solver_(shapeop_create()) {
    const auto mesh = npfem::api::Mesh::generate("sphere", 2, 5.2);
    rest_.resize(198);
    triangles_.resize(3 * 128);
    npfem_mesh_get_positions(mesh.handle(), rest_.data(), 198);
    npfem_mesh_get_triangles(mesh.handle(), triangles_.data(), 3 * 128);
    shapeop_setPoints(solver_, rest_.data(), 66);
    for (std::size_t t = 0; t < triangles_.size(); t += 3) {
      membrane_.push_back(shapeop_addConstraint(solver_, "SurfaceMaterial", &triangles_[t], 3, 27.5));
      shapeop_addConstraint(solver_, "Area", &triangles_[t], 3, 5000);
    }
  }
  Sphere(const Sphere&) = delete;
  Sphere& operator=(const Sphere&) = delete;
  ~Sphere() { shapeop_delete(solver_); }

  operator ShapeOpSolver*() const { return solver_; }
  int init(double time_step = 1) { return shapeop_initDynamic(solver_, 0, 0.01, time_step, 1125, false, true, 250); }
  int solve(int m = 7) { return shapeop_solve(solver_, m, 200, 15, 50, 5, 1e-10, 1e-4, 0.9, 1, 20); }
  std::vector<double> points() const {
    std::vector<double> xyz(198);
    shapeop_getPoints(solver_, xyz.data(), 66);
    return xyz;
  }
  const std::vector<double>& rest() const { return rest_; }
  int triangle_constraint(std::size_t t) const { return membrane_[t]; }
  std::size_t num_triangles() const { return membrane_.size(); }
  int* corner(std::size_t t) { return &triangles_[3 * t]; }

 private:
  ShapeOpSolver* solver_;
  std::vector<double> rest_;
  std::vector<std::int32_t> triangles_;
  std::vector<int> membrane_;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Mean position along one axis.
double centre(const std::vector<double>& xyz, std::size_t axis) {
  double sum = 0;
  for (std::size_t i = axis; i < xyz.size(); i += 3) sum += xyz[i];
  return sum / (static_cast<double>(xyz.size()) / 3);
}

double extent_x(const std::vector<double>& xyz) {
  double least = xyz[0], most = xyz[0];
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    least = std::min(least, xyz[i]);
    most = std::max(most, xyz[i]);
  }
  return most - least;
}

TEST(ShapeOp, ABodyWithoutForcesStaysAtRest) {
  Sphere sphere;
  ASSERT_EQ(sphere.init(), 0);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(sphere.solve(), 0);
  EXPECT_LT(largest_difference(sphere.points(), sphere.rest()), 1e-9);
}

TEST(ShapeOp, GravityMovesEveryVertexAsAFreeBody) {
  Sphere sphere;
  Vector force{0, 0, -4};
  EXPECT_EQ(shapeop_addGravityForce(sphere, force.data()), 0);
  ASSERT_EQ(shapeop_initDynamic(sphere, 0, 0, 0.5, 1125, false, true, 250), 0);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(sphere.solve(), 0);
  // Implicit Euler: n steps fall by n (n + 1) / 2 dt^2 f / m, with the mass of the enclosed volume shared equally.
  const auto mesh = npfem::api::Mesh::generate("sphere", 2, 5.2);
  const double mass = 1125 * mesh.measure("volume") / 66;
  EXPECT_NEAR(centre(sphere.points(), 2) - centre(sphere.rest(), 2), -10 * 0.25 * 4 / mass, 1e-9);
  EXPECT_NEAR(centre(sphere.points(), 0), centre(sphere.rest(), 0), 1e-12);
}

TEST(ShapeOp, AVertexForceActsOnItsVertexAndCanBeEdited) {
  Sphere sphere;
  Vector force{3, 0, 0}, none{0, 0, 0}, gravity{0, 0, 0};
  EXPECT_EQ(shapeop_addGravityForce(sphere, gravity.data()), 0);
  const int id = shapeop_addVertexForce(sphere, none.data(), 5);
  EXPECT_EQ(id, 1);
  ASSERT_EQ(sphere.init(), 0);
  EXPECT_EQ(sphere.solve(), 0);
  EXPECT_LT(largest_difference(sphere.points(), sphere.rest()), 1e-9);
  shapeop_editVertexForce(sphere, id, force.data(), 7);
  EXPECT_EQ(sphere.solve(), 0);
  const std::vector<double> moved = sphere.points();
  EXPECT_GT(moved[3 * 7] - sphere.rest()[3 * 7], 2 * (moved[3 * 5] - sphere.rest()[3 * 5]));
  EXPECT_GT(centre(moved, 0), centre(sphere.rest(), 0));
  shapeop_editVertexForce(sphere, 0, force.data(), 7);
  EXPECT_EQ(last_error(),
            "shapeop_editVertexForce: force 0 is not a vertex force; forces have the ids 0 to 2 (excluded)");
}

TEST(ShapeOp, EditingAConstraintAfterInitTakesEffect) {
  Sphere soft, stiff;
  for (Sphere* sphere : {&soft, &stiff}) {
    Vector left{-20, 0, 0}, right{20, 0, 0};
    for (int v = 0; v < 66; ++v) {
      const double x = sphere->rest()[3 * static_cast<std::size_t>(v)];
      if (std::abs(x) > 2.5) shapeop_addVertexForce(*sphere, x > 0 ? right.data() : left.data(), v);
    }
    ASSERT_EQ(sphere->init(), 0);
  }
  ASSERT_EQ(soft.solve(), 0);
  ASSERT_EQ(stiff.solve(), 0);
  ASSERT_EQ(soft.points(), stiff.points());
  const std::vector<double> hard{1, 1, 35000, 5000, 0};
  for (std::size_t t = 0; t < stiff.num_triangles(); ++t) {
    ASSERT_EQ(shapeop_editConstraint(stiff, "SurfaceMaterial", stiff.triangle_constraint(t), hard.data(), 5),
              SO_SUCCESS);
  }
  EXPECT_EQ(soft.points(), stiff.points()) << "an edit alone moves nothing";
  for (int i = 0; i < 60; ++i) {
    ASSERT_EQ(soft.solve(), 0);
    ASSERT_EQ(stiff.solve(), 0);
  }
  EXPECT_LT(extent_x(stiff.points()), extent_x(soft.points()) - 0.05);
}

TEST(ShapeOp, EditingBackAndForthChangesNoBitOfARunningBody) {
  Sphere left_alone, edited;
  Vector force{50, 10, 0};
  const std::vector<double> other{1, 1, 70, 10, 0}, same{1, 1, 35, 5, 0};
  for (Sphere* sphere : {&left_alone, &edited}) {
    shapeop_addVertexForce(*sphere, force.data(), 3);
    ASSERT_EQ(sphere->init(), 0);
  }
  for (int i = 0; i < 5; ++i) {
    for (const std::vector<double>& scalars : {other, same}) {
      shapeop_editConstraint(edited, "SurfaceMaterial", edited.triangle_constraint(0), scalars.data(), 5);
    }
    ASSERT_EQ(left_alone.solve(), 0);
    ASSERT_EQ(edited.solve(), 0);
    ASSERT_EQ(left_alone.points(), edited.points()) << "step " << i;
  }
}

TEST(ShapeOp, ChangingTheTimeStepAfterInitIsTheSameAsStartingWithIt) {
  Sphere changed, started;
  Vector force{5, 1, 0};
  for (Sphere* sphere : {&changed, &started}) shapeop_addVertexForce(*sphere, force.data(), 3);
  ASSERT_EQ(changed.init(1), 0);
  ASSERT_EQ(started.init(0.125), 0);
  shapeop_setTimeStep(changed, 0.125);
  for (int i = 0; i < 3; ++i) {
    changed.solve();
    started.solve();
  }
  EXPECT_EQ(changed.points(), started.points());
}

TEST(ShapeOp, PairsOfTheHistoryFollowM) {
  std::vector<std::vector<double>> results;
  for (const int m : {1, 15, 2, 7}) {
    Sphere sphere;
    Vector force{500, 100, 0};
    shapeop_addVertexForce(sphere, force.data(), 3);
    ASSERT_EQ(sphere.init(), 0);
    shapeop_solve(sphere, m, 20, 15, 50, 5, 0, 1e-4, 0.9, 1, 20);
    results.push_back(sphere.points());
  }
  EXPECT_EQ(results[0], results[1]) << "m < 2 stands for 15";
  EXPECT_NE(results[1], results[2]);
  EXPECT_NE(results[2], results[3]);
}

TEST(ShapeOp, SetPointsMovesTheBodyAndKeepsItsVelocity) {
  Sphere sphere;
  Vector force{0, 0, 9};
  const int id = shapeop_addVertexForce(sphere, force.data(), 0);
  ASSERT_EQ(shapeop_initDynamic(sphere, 1, 0, 1, 1125, false, true, 250), 0);  // Calpha 1: moves as a rigid body
  ASSERT_EQ(sphere.solve(), 0);
  force = {0, 0, 0};
  shapeop_editVertexForce(sphere, id, force.data(), 0);
  const double speed = centre(sphere.points(), 2) - centre(sphere.rest(), 2);
  std::vector<double> start = sphere.rest();
  shapeop_setPoints(sphere, start.data(), 66);
  EXPECT_EQ(sphere.points(), sphere.rest());
  ASSERT_EQ(sphere.solve(), 0);
  EXPECT_NEAR(centre(sphere.points(), 2) - centre(sphere.rest(), 2), speed, 1e-3 * speed);
}

/// The lowest point of a sphere of radius 2.6 after a step on an obstacle point 0.2 um below it.
double lowest_after_obstacle(double normal_length, double threshold, double weight) {
  Sphere sphere;
  Vector point{0, 0, -2.8}, normal{0, 0, normal_length};
  shapeop_addObstacle(sphere, point.data(), normal.data(), 1);
  EXPECT_EQ(sphere.init(), 0);
  EXPECT_EQ(shapeop_solve(sphere, 7, 200, 15, 50, 5, 1e-10, 1e-4, 0.9, threshold, weight), 0);
  const std::vector<double> xyz = sphere.points();
  double lowest = xyz[2];
  for (std::size_t i = 2; i < xyz.size(); i += 3) lowest = std::min(lowest, xyz[i]);
  return lowest;
}

TEST(ShapeOp, ObstaclesPushToTheSideOfTheirNormal) {
  Sphere sphere;
  Vector point{0, 0, -2.8}, normal{0, 0, 1};
  shapeop_addObstacle(sphere, point.data(), normal.data(), 1);
  ASSERT_EQ(sphere.init(), 0);
  ASSERT_EQ(sphere.solve(), 0);
  EXPECT_GT(centre(sphere.points(), 2), centre(sphere.rest(), 2) + 1e-6);

  Sphere far;
  point[2] = -4;
  shapeop_addObstacle(far, point.data(), normal.data(), 1);
  ASSERT_EQ(far.init(), 0);
  ASSERT_EQ(far.solve(), 0);
  EXPECT_LT(largest_difference(far.points(), far.rest()), 1e-9) << "further than 1 um: out of reach";
}

TEST(ShapeOp, CollisionArgumentsReachOnlyNormalsOfLengthTwo) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lowest_after_obstacle(1, 1, 20), lowest_after_obstacle(1, nan, nan))
      << "unit normals: always 1 um, 20 pN/um";
  EXPECT_EQ(lowest_after_obstacle(2, 1, 20), lowest_after_obstacle(1, nan, nan)) << "the same values, asked for";
  EXPECT_EQ(lowest_after_obstacle(1.9999999999, 1, 20), lowest_after_obstacle(2.0000000001, 1, 20));
  EXPECT_NE(lowest_after_obstacle(2, 1, 40), lowest_after_obstacle(2, 1, 20));
  EXPECT_NE(lowest_after_obstacle(2, 0.1, 20), lowest_after_obstacle(2, 1, 20));
}

TEST(ShapeOp, MissingCollisionArgumentsDoNotMatterWithoutObstacles) {
  Sphere given, missing;
  Vector force{5, 0, 0};
  for (Sphere* sphere : {&given, &missing}) {
    shapeop_addVertexForce(*sphere, force.data(), 3);
    ASSERT_EQ(sphere->init(), 0);
  }
  const double garbage = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(shapeop_solve(given, 7, 100, 15, 50, 5, 1e-6, 1e-4, 0.9, 1, 20), 0);
  EXPECT_EQ(shapeop_solve(missing, 7, 100, 15, 50, 5, 1e-6, 1e-4, 0.9, garbage, -garbage), 0);
  EXPECT_EQ(given.points(), missing.points());
}

TEST(ShapeOp, TheHandleSurvivesBeingCutToAnInt) {
  ShapeOpSolver* solver = shapeop_create();
  const auto number = reinterpret_cast<std::intptr_t>(solver);
  ASSERT_GT(number, 0);
  ASSERT_LE(number, std::numeric_limits<std::int32_t>::max());
  // ctypes without argtypes leaves the upper half of the register as it was.
  auto* dirty = reinterpret_cast<ShapeOpSolver*>(number | static_cast<std::intptr_t>(0x5a5a5a5a00000000));
  Vector point{1, 2, 3}, read{};
  shapeop_setPoints(dirty, point.data(), 1);
  shapeop_getPoints(solver, read.data(), 1);
  EXPECT_EQ(read, point);
  shapeop_delete(solver);
  EXPECT_EQ(shapeop_addGravityForce(solver, point.data()), -1);
  EXPECT_EQ(last_error(),
            "shapeop_addGravityForce: handle " + std::to_string(number) + " was released; expected a ShapeOp solver");
}

TEST(ShapeOp, TypesThatAreNotAvailableAnswerMinusOne) {
  Sphere sphere;
  int ids[4] = {0, 1, 2, 3};
  for (const char* type : {"VolumeDamping", "Collision", "Closeness", "Banding"}) {
    for (int n = 1; n <= 4; ++n) EXPECT_EQ(shapeop_addConstraint(sphere, type, ids, n, 1), -1) << type;
  }
  EXPECT_EQ(last_error(),
            "shapeop_addConstraint: constraint type \"Banding\" is not available; there are "
            "SurfaceMaterial, Area, Bending, Volume, VolumeMaterial, TriangleARAP, TetrahedronARAP, "
            "EdgeStrainLimiting, TriangleStrainLimiting, TetrahedronStrainLimiting");
}

TEST(ShapeOp, EveryTypeActsOnTheBodyThatItIsAddedTo) {
  // Two opposite tips of a sphere are pulled apart; elements between the tips and two points of the equator hold them.
  const auto stretch = [](const char* type, int num_ids, const std::vector<double>& scalars) {
    Sphere sphere;
    const auto vertex_at = [&sphere](Vector place) {
      for (int v = 0; v < 66; ++v) {
        const double* x = &sphere.rest()[3 * static_cast<std::size_t>(v)];
        if (std::hypot(x[0] - place[0], x[1] - place[1], x[2] - place[2]) < 1e-9) return v;
      }
      ADD_FAILURE() << "no such vertex";
      return 0;
    };
    int ids[4] = {vertex_at({2.6, 0, 0}), vertex_at({-2.6, 0, 0}), vertex_at({0, 2.6, 0}), vertex_at({0, 0, 2.6})};
    Vector right{100, 0, 0}, left{-100, 0, 0};
    shapeop_addVertexForce(sphere, right.data(), ids[0]);
    shapeop_addVertexForce(sphere, left.data(), ids[1]);
    if (*type) {
      const int id = shapeop_addConstraint(sphere, type, ids, num_ids, 500);
      EXPECT_GE(id, 0) << type << ": " << last_error();
      const int count = static_cast<int>(scalars.size());
      EXPECT_EQ(shapeop_editConstraint(sphere, type, id, scalars.data(), count), SO_SUCCESS) << last_error();
    }
    EXPECT_EQ(sphere.init(), 0) << type << ": " << last_error();
    for (int i = 0; i < 20; ++i) EXPECT_EQ(sphere.solve(), 0);
    return sphere.points();
  };
  const std::vector<double> alone = stretch("", 0, {});
  for (const char* type : {"TriangleARAP", "TetrahedronARAP"}) {
    EXPECT_LT(extent_x(stretch(type, type[1] == 'r' ? 3 : 4, {})), extent_x(alone) - 0.01) << type;
  }
  const struct {
    const char* type;
    int ids;
  } ranged[] = {{"EdgeStrainLimiting", 2}, {"TriangleStrainLimiting", 3}, {"TetrahedronStrainLimiting", 4}};
  for (const auto& t : ranged) {
    EXPECT_LT(extent_x(stretch(t.type, t.ids, {1, 1})), extent_x(alone) - 0.01) << t.type;
    EXPECT_EQ(stretch(t.type, t.ids, {0.01, 100}), stretch(t.type, t.ids, {0.02, 50})) << t.type << ": free in range";
  }
  EXPECT_GT(largest_difference(stretch("Volume", 4, {1, 1}), alone), 0.01) << "a volume may stretch, and thins";
  EXPECT_EQ(stretch("VolumeMaterial", 4, {1, 1, 35, 5, 0}), stretch("Volume", 4, {1, 1}));
}

TEST(ShapeOp, AnElementWithoutExtentIsRefused) {
  int ids[4] = {0, 1, 0, 1};
  for (const auto& [type, n] : {std::pair{"TetrahedronARAP", 4}, std::pair{"TriangleARAP", 3}}) {
    Sphere body;
    ASSERT_EQ(shapeop_addConstraint(body, type, ids, n, 1), 256);
    EXPECT_EQ(body.init(), 1);
    EXPECT_EQ(last_error(), std::string("shapeop_initDynamic: constraint 256 (") + type +
                                "): at rest its vertices lie on one point, line or plane; its edges, triangles and "
                                "tetrahedra need a length, an area and a volume");
  }
}

TEST(ShapeOp, WrongConstraintsAreRefused) {
  Sphere sphere;
  int ids[4] = {0, 1, 2, 66};
  const std::vector<double> scalars{1, 1, 35, 5, std::numeric_limits<double>::infinity()};
  const int area = shapeop_addConstraint(sphere, "Area", ids, 3, 5000);
  EXPECT_EQ(area, 256);
  EXPECT_EQ(shapeop_addConstraint(sphere, "Area", ids, 4, 5000), -1);
  EXPECT_EQ(last_error(), "shapeop_addConstraint: Area takes 3 ids, found 4");
  EXPECT_EQ(shapeop_addConstraint(sphere, "Bending", ids, 4, 1), -1);
  EXPECT_EQ(last_error(), "shapeop_addConstraint: vertex 66 does not exist; there are 66 points");
  EXPECT_EQ(shapeop_addConstraint(sphere, "Area", nullptr, 3, 1), -1);
  EXPECT_EQ(last_error(), "shapeop_addConstraint: ids is NULL");
  EXPECT_EQ(shapeop_addConstraint(sphere, "Area", ids, 3, -1), -1);
  EXPECT_EQ(last_error(), "shapeop_addConstraint: Area: the weight must be a finite number of at least 0");
  EXPECT_EQ(shapeop_editConstraint(sphere, "Area", area, scalars.data(), 2), SO_SUCCESS);
  EXPECT_EQ(shapeop_editConstraint(sphere, "Collision", area, scalars.data(), 2), SO_INVALID_CONSTRAINT_TYPE);
  EXPECT_EQ(shapeop_editConstraint(sphere, "Area", area, scalars.data(), 3), SO_INVALID_ARGUMENT_LENGTH);
  EXPECT_EQ(last_error(), "shapeop_editConstraint: Area takes 2 scalars, found 3");
  EXPECT_EQ(shapeop_editConstraint(sphere, "SurfaceMaterial", 0, scalars.data(), 5), SO_INVALID_ARGUMENT_LENGTH);
  EXPECT_EQ(last_error(), "shapeop_editConstraint: the scalars hold a number that is not finite");
  EXPECT_EQ(shapeop_editConstraint(sphere, "Area", 0, scalars.data(), 2), SO_UNMATCHING_CONSTRAINT_ID);
  EXPECT_EQ(last_error(), "shapeop_editConstraint: constraint 0 is of type SurfaceMaterial, not Area");
  EXPECT_EQ(shapeop_editConstraint(sphere, "Area", 257, scalars.data(), 2), SO_UNMATCHING_CONSTRAINT_ID);
  EXPECT_EQ(shapeop_editConstraint(nullptr, "Area", 0, scalars.data(), 2), SO_UNMATCHING_CONSTRAINT_ID);
}

TEST(ShapeOp, CallsInTheWrongOrderAnswerOne) {
  ShapeOpSolver* empty = shapeop_create();
  EXPECT_EQ(shapeop_init(empty), 1);
  EXPECT_EQ(last_error(), "shapeop_init: there are no points; call shapeop_setPoints first");
  EXPECT_EQ(shapeop_solve(empty, 7, 10, 5, 7, 5, 1e-5, 1e-4, 0.9, 1, 20), 1);
  EXPECT_EQ(last_error(), "shapeop_solve: call shapeop_init or shapeop_initDynamic after shapeop_setPoints");
  Vector point{0, 0, 0};
  shapeop_setPoints(empty, point.data(), 1);
  EXPECT_EQ(shapeop_init(empty), 1) << "no surface";
  shapeop_delete(empty);
  EXPECT_EQ(shapeop_init(empty), 1);
  EXPECT_EQ(shapeop_init(nullptr), 1);
  shapeop_delete(nullptr);
}

TEST(ShapeOp, ValuesOutOfRangeAnswerOneAndChangeNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Sphere sphere;
  EXPECT_EQ(shapeop_initDynamic(sphere, nan, 0, 1, 1125, false, true, 250), 1);
  EXPECT_EQ(shapeop_initDynamic(sphere, 0, -1, 1, 1125, false, true, 250), 1);
  EXPECT_EQ(shapeop_initDynamic(sphere, 0, 0, 0, 1125, false, true, 250), 1);
  EXPECT_EQ(shapeop_initDynamic(sphere, 0, 0, 1, 0, false, true, 250), 1);
  EXPECT_EQ(last_error(), "shapeop_initDynamic: the density must be above 0 and the volume weight at least 0");
  ASSERT_EQ(sphere.init(), 0);
  std::vector<double> broken = sphere.rest();
  broken[4] = nan;
  shapeop_setPoints(sphere, broken.data(), 66);
  EXPECT_EQ(last_error(), "shapeop_setPoints: the points hold a number that is not finite");
  shapeop_setTimeStep(sphere, -1);
  EXPECT_EQ(shapeop_solve(sphere, 7, 10, 5, 7, 5, nan, 1e-4, 0.9, 1, 20), 1);
  EXPECT_EQ(shapeop_solve(sphere, 7, 10, 0, 7, 5, 1e-5, 1e-4, 0.9, 1, 20), 1);
  shapeop_getPoints(sphere, broken.data(), 65);
  EXPECT_EQ(last_error(), "shapeop_getPoints: 65 points asked for; there are 66");
  EXPECT_EQ(sphere.solve(), 0);
  EXPECT_LT(largest_difference(sphere.points(), sphere.rest()), 1e-9);
}

}  // namespace
