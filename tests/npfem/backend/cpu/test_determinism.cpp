// SPDX-License-Identifier: MPL-2.0
// A cell's bits are its own: they depend on neither the threads, nor the other cells, nor its place among them.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "cpu_cells.h"

namespace npfem {
namespace {

using testing::cpu_settings;
using testing::CpuSetting;
using testing::get;

constexpr int num_kinds = 7;
constexpr int steps = 5;

/// Makes the cell the one of number `who`: every seventh has the same lot, each with numbers of its own.
void prepare(Batch& batch, int cell, int who, bool with_fluid) {
  const auto seed = static_cast<unsigned>(who);
  auto x = get(batch, Field::position, cell);
  const auto move_on = [&] { testing::set_in_motion(batch, cell, seed, 0.003 * (1 + who % 4)); };
  switch (who % num_kinds) {
    case 0:  // at rest: converged before the first iteration
      break;
    case 1:  // stretched
      for (std::size_t i = 0; i < x.size(); i += 3) x[i] *= 1 + 0.002 * (who + 1), x[i + 1] += 40;
      batch.write(Field::position, cell, 1, x);
      break;
    case 2:
      move_on();
      break;
    case 3:
      testing::load(batch, cell, seed, 1);
      break;
    case 4:  // with the mass of a fluid, of two sizes
      if (with_fluid) testing::immerse(batch, cell, 0.002 * who, who % 2 == 0 ? 1 : 3);
      move_on();
      break;
    case 5:  // far beyond what can be solved
      batch.write(Field::velocity, cell, 1, testing::shear(x, 1e200));
      break;
    default:  // turned into another direction
      for (std::size_t i = 0; i < x.size(); i += 3) {
        const auto p = testing::moved({x[i], x[i + 1], x[i + 2]}, {1, 2, -1}, 0.3 * who, {});
        x[i] = p.x, x[i + 1] = p.y, x[i + 2] = p.z;
      }
      batch.write(Field::position, cell, 1, x);
      move_on();
  }
}

enum class Method { implicit_euler, bdf2, lineage };

struct Population {
  CpuSetting setting;
  Method method = Method::implicit_euler;
  int threads = 1;
  int newton_iterations = 4;
  std::shared_ptr<const Model> model = testing::cell_of(method == Method::lineage ? "palabos-rbc" : "rbc");

  std::unique_ptr<Batch> batch_of(const std::vector<int>& who) const {
    auto batch = std::make_unique<Batch>(model, setting.back_end(), static_cast<int>(who.size()));
    setting.apply(batch->options());
    batch->options().threads = threads;
    batch->options().integrator = method == Method::bdf2 ? Integrator::bdf2 : Integrator::implicit_euler;
    batch->options().lineage = method == Method::lineage;
    batch->options().lineage_alpha = 0.9;
    batch->options().lineage_beta = 0.01;
    batch->options().max_iterations = 12;  // some end at it
    batch->options().newton_iterations = newton_iterations;
    for (std::size_t c = 0; c < who.size(); ++c) add(*batch, static_cast<int>(c), who[c]);
    return batch;
  }
  void add(Batch& batch, int cell, int who) const { prepare(batch, cell, who, method == Method::implicit_euler); }
  /// Hash of every cell after `steps` steps, those that fail included.
  std::vector<std::uint64_t> hashes(const std::vector<int>& who) const {
    const auto batch = batch_of(who);
    for (int s = 0; s < steps; ++s) batch->step(1);
    std::vector<std::uint64_t> result;
    for (int c = 0; c < batch->num_cells(); ++c) result.push_back(batch->state_hash(c));
    return result;
  }
};

std::vector<int> first_cells(int count) {
  std::vector<int> who(static_cast<std::size_t>(count));
  std::iota(who.begin(), who.end(), 0);
  return who;
}

class CpuDeterminism : public ::testing::TestWithParam<CpuSetting> {
 protected:
  /// Cells that fill several blocks, the last not wholly.
  static std::vector<int> several_blocks() {
    return first_cells(2 * cpu::kernels(GetParam().instruction_set)->float_lanes + 5);
  }
};
INSTANTIATE_TEST_SUITE_P(Settings, CpuDeterminism, ::testing::ValuesIn(cpu_settings()), [](const auto& setting) {
  std::string name = setting.param.name();
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST_P(CpuDeterminism, CellsOfEveryLot) {
  const auto batch = Population{GetParam()}.batch_of(first_cells(num_kinds));
  EXPECT_EQ(batch->step(1), 1) << "one cell of seven is to fail";
  const auto rest = Population{GetParam()}.batch_of({0});
  for (int c = 1; c < num_kinds; ++c) EXPECT_NE(batch->state_hash(c), rest->state_hash(0)) << c;
  EXPECT_TRUE(has_failed(batch->report(5).status));
}

TEST_P(CpuDeterminism, AnyNumberOfThreads) {
  // Blocks for sixteen threads without Newton's method; a few with it, which gives a cell to each thread.
  const auto blocks_of_16 = first_cells(16 * cpu::kernels(GetParam().instruction_set)->float_lanes - 3);
  for (const auto& [who, newton_iterations] : {std::pair{blocks_of_16, 0}, {several_blocks(), 4}}) {
    Population cells{GetParam()};
    cells.newton_iterations = newton_iterations;
    const auto alone = cells.hashes(who);
    for (const int threads : {2, 4, 8, 16}) {
      cells.threads = threads;
      EXPECT_EQ(cells.hashes(who), alone) << threads << " threads";
    }
  }
}

TEST_P(CpuDeterminism, AnyOrderAndAnyNumberOfCells) {
  for (const Method method : {Method::implicit_euler, Method::bdf2, Method::lineage}) {
    const Population cells{GetParam(), method};
    std::vector<int> who = several_blocks();
    const auto expected = cells.hashes(who);
    std::mt19937 random(1);
    for (const std::size_t count : {who.size(), who.size() - 9, std::size_t{3}, std::size_t{1}}) {
      std::shuffle(who.begin(), who.end(), random);
      who.resize(count);
      const auto found = cells.hashes(who);
      for (std::size_t c = 0; c < who.size(); ++c)
        EXPECT_EQ(found[c], expected[static_cast<std::size_t>(who[c])])
            << "cell " << who[c] << " at " << c << " of " << count << ", method " << static_cast<int>(method);
    }
  }
}

TEST_P(CpuDeterminism, CellsComeAndGo) {
  const Population cells{GetParam()};
  std::vector<int> who = several_blocks();
  const auto expected = cells.hashes(who);
  std::vector<int> done(who.size(), 0);
  const auto batch = cells.batch_of(who);
  const auto end_of = [&](std::size_t place) {
    EXPECT_EQ(batch->state_hash(static_cast<int>(place)), expected[static_cast<std::size_t>(who[place])]) << who[place];
  };
  for (int s = 0; s < 2 * steps; ++s) {
    batch->step(1);
    for (std::size_t c = 0; c < who.size(); ++c) {
      if (++done[c] == steps) end_of(c);
    }
    const std::size_t leaving = 3 * static_cast<std::size_t>(s) % who.size();
    batch->remove_cell(static_cast<int>(leaving));
    who.erase(who.begin() + static_cast<std::ptrdiff_t>(leaving));
    done.erase(done.begin() + static_cast<std::ptrdiff_t>(leaving));
    if (s >= steps) continue;
    for (const int more : {2 * s + 1, 2 * s + 2}) {
      const int cell = batch->add_cells(1);
      cells.add(*batch, cell, more);
      who.push_back(more);
      done.push_back(0);
    }
  }
}

TEST_P(CpuDeterminism, APackedCellMovesToAnotherBatch) {
  const Population cells{GetParam()};
  const std::vector<int> who = several_blocks();
  const auto expected = cells.hashes(who);
  const auto from = cells.batch_of(who), to = cells.batch_of({3, 1});
  for (int s = 0; s < 2; ++s) from->step(1);
  std::vector<double> packed(static_cast<std::size_t>(from->pack_length()));
  const int moving[] = {2, 4, 6, 11};
  for (const int cell : moving) {
    from->pack(cell, packed);
    to->unpack(to->add_cells(1), packed);
  }
  for (int s = 2; s < steps; ++s) to->step(1);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(to->state_hash(2 + k), expected[static_cast<std::size_t>(moving[k])]);
}

}  // namespace
}  // namespace npfem
