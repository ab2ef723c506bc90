// SPDX-License-Identifier: MPL-2.0
// Calls in any order with any arguments, right and wrong ones mixed: each gives a status that npfem.h knows, none is a
// defect of the library, and what a batch holds stays finite.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "npfem/npfem.hpp"
#include "npfem/shapeop.h"

namespace {

/// Draws arguments: mostly sensible ones, some odd, all from one seed.
class Draw {
 public:
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  bool rarely() { return below(10) == 0; }

  double number() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double odd[]{0, -1, 1e300, -1e300, 5e-324, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()};
    return rarely() ? odd[below(std::size(odd))] : ordinary_number();
  }
  double ordinary_number() { return static_cast<double>(below(2001)) / 100 - 10; }
  std::int32_t count(std::int32_t sensible) {
    constexpr std::int32_t odd[]{-1, 0, 1, 3, std::numeric_limits<std::int32_t>::min()};
    return rarely() ? odd[below(std::size(odd))] : sensible;
  }
  /// Mostly one of the words that belong here, sometimes one that belongs elsewhere, none, or no text at all.
  const char* word(std::initializer_list<const char*> sensible) {
    constexpr const char* odd[]{nullptr, "", "sphere", "n\xc3\xb6", "velocty", "energy:"};
    if (rarely()) return odd[below(std::size(odd))];
    return sensible.begin()[below(static_cast<int>(sensible.size()))];
  }
  const char* field() {
    return word({"position", "velocity", "external_force", "ambient_velocity", "held_force", "lag_velocity",
                 "lag_acceleration"});
  }
  /// One of the handles given out so far, or a number that is none.
  std::int32_t handle(const std::vector<std::int32_t>& known) {
    if (known.empty() || rarely()) return below(1 << 20) - 10;
    return known[static_cast<std::size_t>(below(static_cast<int>(known.size())))];
  }

 private:
  std::mt19937 engine_{20240229};
};

class Caller {
 public:
  void any_call() {
    switch (draw_.below(6)) {
      case 0:
        create();
        break;
      case 1:
        read();
        break;
      case 2:
        set_parameters();
        break;
      case 3:
        change_batch();
        break;
      case 4:
        advance_batch();
        break;
      default:
        shapeop();
        break;
    }
    if (draw_.below(40) == 0) expect(npfem_release(any()));
  }
  int succeeded() const { return succeeded_; }

 private:
  static constexpr int size = 3 * 18;  // a sphere of level 1, one cell

  std::int32_t any() { return draw_.handle(handles_); }
  std::int32_t of(const std::vector<std::int32_t>& kind) { return draw_.rarely() ? any() : draw_.handle(kind); }

  std::int32_t expect(std::int32_t result) {
    EXPECT_GE(result, NPFEM_ERROR_UNAVAILABLE)
        << npfem::api::text_of([](char* b, std::int32_t n) { return npfem_last_error(b, n); });
    if (result >= 0) ++succeeded_;
    return result;
  }
  void keep(std::int32_t created, std::vector<std::int32_t>& kind) {
    if (expect(created) <= 0) return;
    kind.push_back(created);
    handles_.push_back(created);
    if (kind.size() > 8) {
      npfem_release(kind.front());
      kind.erase(kind.begin());
    }
    if (handles_.size() > 40) handles_.erase(handles_.begin());
  }
  double* numbers() {
    if (draw_.below(30) == 0) return nullptr;
    const bool clean = draw_.below(2) == 0;  // else about every tenth number is odd
    for (double& value : numbers_) value = clean ? draw_.ordinary_number() : draw_.number();
    return numbers_.data();
  }

  void create() {
    switch (draw_.below(5)) {
      case 0:
        keep(npfem_mesh_generate(draw_.word({"sphere"}), draw_.count(1), 5), meshes_);
        break;
      case 1:
        keep(npfem_material_preset(draw_.word({"palabos-rbc", "rbc"})), materials_);
        break;
      case 2:
        keep(npfem_material_mesh(of(materials_), draw_.count(1)), meshes_);
        break;
      case 3:
        keep(npfem_model_create(of(meshes_), of(materials_)), models_);
        break;
      default:
        keep(npfem_batch_create(of(models_), draw_.word({"reference"}), draw_.count(1)), batches_);
        if (batches_.empty()) break;
        npfem_set_f64(batches_.back(), "relax_iterations", 20);  // failing to converge is fine here
        npfem_set_f64(batches_.back(), "max_iterations", 20);
    }
  }

  void read() {
    char text[40];
    double value[3];
    const std::int32_t capacity = draw_.count(static_cast<std::int32_t>(sizeof text));
    switch (draw_.below(8)) {
      case 0:
        expect(npfem_mesh_get_positions(of(meshes_), numbers(), draw_.count(size)));
        break;
      case 1:
        expect(npfem_mesh_measure(of(meshes_), draw_.word({"volume", "area", "edge_min"}), value));
        break;
      case 2:
        expect(npfem_material_to_text(of(materials_), text, capacity));
        break;
      case 3:
        expect(npfem_model_get(of(models_), draw_.word({"rest_area", "solid_mass"}), numbers(), draw_.count(18)));
        break;
      case 4:
        expect(npfem_model_energy_name(of(models_), draw_.count(0), text, capacity));
        break;
      case 5:
        expect(npfem_param_name(any(), draw_.below(20), text, capacity));
        break;
      case 6:
        expect(npfem_param_range(any(), draw_.below(20), value, value + 1, value + 2));
        break;
      default:
        expect(npfem_last_error(text, capacity));
        break;
    }
  }

  void set_parameters() {
    const bool of_batch = draw_.below(2) == 0;
    const std::int32_t owner = of(of_batch ? batches_ : materials_);
    const char* key = of_batch ? draw_.word({"time_step", "history", "tolerance", "lineage_alpha"})
                               : draw_.word({"shear_modulus", "bending_modulus", "membrane_density"});
    const char* word_key = of_batch ? draw_.word({"method"}) : draw_.word({"membrane_law", "bending_law"});
    const char* word = of_batch ? draw_.word({"default", "lineage"}) : draw_.word({"none", "lineage", "dihedral"});
    char text[40];
    double value;
    switch (draw_.below(4)) {
      case 0:
        expect(npfem_set_f64(owner, key, std::abs(draw_.number())));
        break;
      case 1:
        expect(npfem_set_text(owner, word_key, word));
        break;
      case 2:
        expect(npfem_get_f64(owner, key, &value));
        break;
      default:
        expect(npfem_get_text(owner, word_key, text, draw_.count(40)));
        break;
    }
  }

  void change_batch() {
    const std::int32_t batch = of(batches_);
    const std::int32_t patch[3] = {draw_.below(19), draw_.below(19), draw_.count(0)};
    float narrow[size];
    switch (draw_.below(9)) {
      case 0:
        expect(npfem_batch_add(batch, draw_.count(draw_.below(2))));
        break;
      case 1:
        expect(npfem_batch_remove(batch, draw_.below(4)));
        break;
      case 2:
        expect(npfem_batch_set(batch, draw_.field(), 0, draw_.count(1), numbers(), draw_.count(size)));
        break;
      case 3:
        set_ambient_mass(batch);
        break;
      case 4:
        expect(npfem_batch_get_f32(batch, draw_.field(), draw_.count(0), 1, narrow, size));
        break;
      case 5:
        expect(npfem_batch_add_patch(batch, patch, draw_.count(2), draw_.number()));
        break;
      case 6:
        expect(npfem_batch_clear_patches(batch));
        break;
      case 7:
        expect(npfem_batch_pack(batch, draw_.count(0), numbers(), draw_.count(16 * 18)));
        break;
      default:
        expect(npfem_batch_unpack(batch, draw_.count(0), numbers(), draw_.count(16 * 18)));
        break;
    }
  }

  void set_ambient_mass(std::int32_t batch) {
    std::fill(numbers_.begin(), numbers_.end(), 100.0);
    expect(npfem_batch_set(batch, "ambient_mass", 0, 1, numbers_.data(), 18));
  }

  void advance_batch() {
    const std::int32_t batch = of(batches_);
    std::int32_t words[4];
    double value[4];
    std::int64_t hash[4];
    switch (draw_.below(7)) {
      case 0:
        expect(npfem_batch_step(batch, draw_.count(1)));
        break;
      case 1:
        expect(npfem_batch_step_for_ms(batch, 0, words));
        break;
      case 2:
        expect(npfem_batch_relax(batch));
        break;
      case 3:
        expect(npfem_batch_evaluate(batch));
        break;
      case 4:
        expect(npfem_batch_get_status(batch, 0, 1, words, draw_.count(1)));
        break;
      case 5:
        expect(npfem_batch_measure(batch, draw_.word({"volume", "energy", "extent_x"}), 0, 1, value, draw_.count(1)));
        break;
      default:
        expect(npfem_batch_state_hash(batch, 0, 1, hash, draw_.count(1)));
        break;
    }
    if (npfem_batch_get(batch, "position", 0, 1, numbers_.data(), size) != NPFEM_OK) return;
    EXPECT_TRUE(std::all_of(numbers_.begin(), numbers_.begin() + size, [](double v) { return std::isfinite(v); }));
  }

  void shapeop() {
    constexpr const char* types[]{"SurfaceMaterial", "Area", "Bending", "Volume"};
    const char* type = draw_.rarely() ? nullptr : types[draw_.below(4)];
    int ids[4] = {draw_.below(19), draw_.below(19), draw_.below(19), draw_.below(19)};
    if (!solver_ || draw_.below(200) == 0) {
      shapeop_delete(solver_);
      solver_ = shapeop_create();
    }
    ShapeOpSolver* solver = draw_.below(50) ? solver_ : nullptr;
    switch (draw_.below(10)) {
      case 0:
        shapeop_setPoints(solver, numbers(), draw_.count(18));
        break;
      case 1:
        shapeop_getPoints(solver, numbers(), draw_.count(18));
        break;
      case 2:
        EXPECT_GE(shapeop_addConstraint(solver, type, ids, draw_.count(3), draw_.number()), -1);
        break;
      case 3:
        EXPECT_LE(shapeop_editConstraint(solver, type, draw_.below(9), numbers(), draw_.count(2)), 3);
        break;
      case 4:
        shapeop_addObstacle(solver, numbers(), numbers(), draw_.count(2));
        break;
      case 5:
        EXPECT_GE(shapeop_addGravityForce(solver, numbers()), -1);
        break;
      case 6:
        shapeop_editVertexForce(solver, shapeop_addVertexForce(solver, numbers(), ids[0]), numbers(), ids[1]);
        break;
      case 7:
        shapeop_setTimeStep(solver, draw_.number());
        break;
      case 8:
        EXPECT_EQ(shapeop_initDynamic(solver, 0, 0, draw_.number(), 1, false, true, 1) & ~1, 0);
        break;
      default:
        EXPECT_EQ(shapeop_solve(solver, draw_.count(7), 5, 5, 5, 5, 1e-5, 1e-4, 0.9, 1, 1) & ~1, 0);
        break;
    }
  }

  Draw draw_;
  std::vector<std::int32_t> handles_, meshes_, materials_, models_, batches_;
  std::array<double, 16 * 18> numbers_{};
  ShapeOpSolver* solver_ = nullptr;
  int succeeded_ = 0;
};

TEST(CallSequences, FiftyThousandCallsInAnyOrder) {
  Caller caller;
  for (int i = 0; i < 50000; ++i) caller.any_call();
  EXPECT_GT(caller.succeeded(), 10000);  // and a good part of them did something
}

}  // namespace
