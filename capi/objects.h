// SPDX-License-Identifier: MPL-2.0
// What a handle stands for.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <variant>

#include "batch/batch.h"
#include "lineage_solver.h"
#include "material/material.h"
#include "mesh/triangle_mesh.h"
#include "model/model.h"

namespace npfem::capi {

/// An object that changes, and the lock that gives it to one thread at a time.
template <class T>
struct Locked {
  template <class... Arguments>
  explicit Locked(Arguments&&... arguments) : value(std::forward<Arguments>(arguments)...) {}
  T value;
  std::mutex mutex;
};

using MeshObject = const TriangleMesh;
using MaterialObject = Locked<Material>;
using ModelObject = const Model;
using BatchObject = Locked<Batch>;
using LineageObject = Locked<LineageSolver>;

/// Shared, so that an object released by one thread lives until the calls that use it have returned.
using Object = std::variant<std::monostate, std::shared_ptr<MeshObject>, std::shared_ptr<MaterialObject>,
                            std::shared_ptr<ModelObject>, std::shared_ptr<BatchObject>, std::shared_ptr<LineageObject>>;

}  // namespace npfem::capi
