// SPDX-License-Identifier: MPL-2.0
// Objects by number. A handle is a slot (low 16 bits, from 1) and the number of times the slot was used before (the 15
// bits above): small, positive, and never given twice, so that a stale handle is always recognised.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "objects.h"

namespace npfem::capi {

class HandleTable {
 public:
  std::int32_t add(Object object);
  /// The object; `expected` ("a mesh") is for the message. Throws Error(bad_handle) for no, a stale or an unknown
  /// handle.
  Object find(std::int32_t handle, const char* expected) const;
  void release(std::int32_t handle);

 private:
  struct Slot {
    Object object;
    std::int32_t generation = 0;
  };
  std::size_t require_slot(std::int32_t handle, const char* expected) const;

  mutable std::mutex mutex_;
  std::vector<Slot> slots_;
  std::vector<std::size_t> free_;
};

/// The one table of the library. It is never destroyed: a host may release objects while it exits.
HandleTable& handles();

std::int32_t add_object(Object object);

[[noreturn]] void throw_other_kind(std::int32_t handle, const Object& found, const char* expected);

template <class T>
constexpr const char* kind_name();
template <>
constexpr const char* kind_name<MeshObject>() {
  return "a mesh";
}
template <>
constexpr const char* kind_name<MaterialObject>() {
  return "a material";
}
template <>
constexpr const char* kind_name<ModelObject>() {
  return "a model";
}
template <>
constexpr const char* kind_name<BatchObject>() {
  return "a batch";
}
template <>
constexpr const char* kind_name<LineageObject>() {
  return "a ShapeOp solver";
}

/// The object of kind T behind a handle. Throws Error(bad_handle).
template <class T>
std::shared_ptr<T> find_object(std::int32_t handle) {
  Object object = handles().find(handle, kind_name<T>());
  if (auto* found = std::get_if<std::shared_ptr<T>>(&object)) return std::move(*found);
  throw_other_kind(handle, object, kind_name<T>());
}

/// A changing object, held for the duration of one call.
template <class T>
class Lease {
 public:
  Lease(std::shared_ptr<Locked<T>> object, std::unique_lock<std::mutex> lock)
      : object_(std::move(object)), lock_(std::move(lock)) {}
  T& operator*() const { return object_->value; }
  T* operator->() const { return &object_->value; }

 private:
  std::shared_ptr<Locked<T>> object_;
  std::unique_lock<std::mutex> lock_;  // released before the object
};

/// A material, or the lineage's solver: another thread's call is waited for.
template <class T>
Lease<T> wait_for(std::shared_ptr<Locked<T>> object) {
  std::unique_lock lock(object->mutex);
  return {std::move(object), std::move(lock)};
}

/// A batch. Throws Error(wrong_order) while another thread uses it: its steps may take long.
Lease<Batch> use_batch(std::int32_t handle);
Lease<Batch> use_batch(std::shared_ptr<BatchObject> batch);

}  // namespace npfem::capi
