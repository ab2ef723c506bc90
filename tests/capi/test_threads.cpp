// SPDX-License-Identifier: MPL-2.0
// Threads: objects are shared as npfem.h promises, and what is not allowed is refused. Meant for the thread sanitizer.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "npfem/npfem.hpp"

namespace {

using namespace npfem::api;

constexpr int num_threads = 4;

template <class Work>
void in_threads(Work&& work) {
  std::vector<std::thread> threads;
  for (int t = 0; t < num_threads; ++t) threads.emplace_back([&work, t] { work(t); });
  for (std::thread& thread : threads) thread.join();
}

Material heavy_membrane() {
  Material material = Material::preset("rbc");
  material.set("membrane_density", 10);
  return material;
}

TEST(Threads, OwnBatchesOfOneModelGiveTheSameBits) {
  const Material material = heavy_membrane();
  const Model model(material.mesh(2), material);
  std::vector<std::int64_t> hashes(num_threads);
  in_threads([&](int t) {
    Batch batch(model, "reference", 1);
    std::vector<double> velocity(198, 0.0);
    velocity[0] = 0.1;
    batch.write("velocity", 0, 1, velocity);
    batch.step(3);
    hashes[static_cast<std::size_t>(t)] = batch.state_hash()[0];
  });
  for (const std::int64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

TEST(Threads, ObjectsAreCreatedAndReleasedAtOnce) {
  in_threads([](int t) {
    for (int i = 0; i < 50; ++i) {
      const Mesh mesh = Mesh::generate("sphere", 1, 1.0 + t);
      EXPECT_NEAR(mesh.measure("extent_x"), 1.0 + t, 1e-12);
    }
  });
}

TEST(Threads, OneMaterialServesAllAndAReleasedObjectOutlivesItsCalls) {
  const Material material = heavy_membrane();
  const std::int32_t mesh = npfem_material_mesh(material.handle(), 2);
  ASSERT_GT(mesh, 0);
  in_threads([&](int t) {
    if (t == 0) {
      EXPECT_EQ(npfem_release(mesh), NPFEM_OK);  // perhaps while the others build from it
      return;
    }
    const std::int32_t model = npfem_model_create(mesh, material.handle());
    if (model > 0) {
      EXPECT_EQ(npfem_model_vertex_count(model), 66);
      EXPECT_EQ(npfem_release(model), NPFEM_OK);
    } else {
      EXPECT_EQ(model, NPFEM_ERROR_HANDLE);
    }
  });
}

TEST(Threads, MessagesBelongToTheirThread) {
  in_threads([](int t) {
    for (int i = 0; i < 200; ++i) {
      EXPECT_EQ(npfem_mesh_vertex_count(-1 - t), NPFEM_ERROR_HANDLE);
      EXPECT_EQ(text_of([](char* b, std::int32_t n) { return npfem_last_error(b, n); }),
                "npfem_mesh_vertex_count: handle " + std::to_string(-1 - t) + " is no object; expected a mesh");
    }
  });
}

TEST(Threads, ABusyBatchRefusesASecondThreadAndCanBeStopped) {
  const Material material = heavy_membrane();
  Batch batch(Model(material.mesh(2), material), "reference", 1);
  batch.set("tolerance", 1e-9);
  std::vector<double> velocity(198);
  for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = i % 7 == 0 ? 1.0 : -0.2;
  batch.write("velocity", 0, 1, velocity);
  std::atomic<bool> running{true};
  std::thread stepping([&] {
    std::int32_t result = NPFEM_ERROR_ORDER;  // while the other thread is in
    while (result == NPFEM_ERROR_ORDER) result = npfem_batch_step(batch.handle(), 1000000000);
    EXPECT_EQ(result, 0);  // it returned because it was asked to
    running = false;
  });
  std::int32_t refused = NPFEM_OK;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (refused == NPFEM_OK && running && std::chrono::steady_clock::now() < deadline)
    refused = npfem_batch_evaluate(batch.handle());
  EXPECT_EQ(refused, NPFEM_ERROR_ORDER);
  EXPECT_EQ(text_of([](char* b, std::int32_t n) { return npfem_last_error(b, n); }),
            "npfem_batch_evaluate: the batch is in use by another thread; until that call returns only "
            "npfem_request_stop is allowed");
  while (running) EXPECT_EQ(npfem_request_stop(batch.handle()), NPFEM_OK);
  stepping.join();
  EXPECT_EQ(npfem_batch_evaluate(batch.handle()), NPFEM_OK);
}

}  // namespace
