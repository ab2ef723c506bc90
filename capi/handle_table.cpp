// SPDX-License-Identifier: MPL-2.0
#include "handle_table.h"

#include "error.h"

namespace npfem::capi {
namespace {

constexpr int slot_bits = 16;
constexpr std::size_t max_slots = (1u << slot_bits) - 1;
constexpr std::int32_t max_generation = (1 << (31 - slot_bits)) - 1;

std::string name_of(const Object& object) {
  return std::visit(
      [](const auto& held) -> std::string {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, std::monostate>) {
          return "no object";
        } else {
          return kind_name<typename Held::element_type>();
        }
      },
      object);
}

}  // namespace

std::int32_t HandleTable::add(Object object) {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) {
    if (slots_.size() == max_slots) {
      throw Error(Status::out_of_memory, "no handle left: " + std::to_string(max_slots) +
                                             " objects are alive; release those no longer needed");
    }
    slots_.emplace_back();
    free_.push_back(slots_.size() - 1);
  }
  const std::size_t slot = free_.back();
  free_.pop_back();
  slots_[slot].object = std::move(object);
  return (slots_[slot].generation << slot_bits) | static_cast<std::int32_t>(slot + 1);
}

std::size_t HandleTable::require_slot(std::int32_t handle, const char* expected) const {
  const std::string found = "handle " + std::to_string(handle);
  const std::string wanted = "; expected " + std::string(expected);
  if (handle <= 0) throw Error(Status::bad_handle, found + " is no object" + wanted);
  const std::size_t slot = static_cast<std::size_t>(handle) & max_slots;
  const std::int32_t generation = handle >> slot_bits;
  if (slot == 0 || slot > slots_.size() || generation > slots_[slot - 1].generation) {
    throw Error(Status::bad_handle, found + " was never created" + wanted);
  }
  const Slot& entry = slots_[slot - 1];
  if (generation < entry.generation) throw Error(Status::bad_handle, found + " was released" + wanted);
  if (entry.object.index() == 0) throw Error(Status::bad_handle, found + " was never created" + wanted);
  return slot - 1;
}

Object HandleTable::find(std::int32_t handle, const char* expected) const {
  const std::lock_guard lock(mutex_);
  return slots_[require_slot(handle, expected)].object;
}

void HandleTable::release(std::int32_t handle) {
  Object released;  // destroyed after the lock: a batch takes its time
  const std::lock_guard lock(mutex_);
  Slot& slot = slots_[require_slot(handle, "an object")];
  const bool reusable = slot.generation < max_generation;
  if (reusable) free_.push_back(static_cast<std::size_t>(&slot - slots_.data()));
  released = std::exchange(slot.object, Object{});
  ++slot.generation;
}

HandleTable& handles() {
  static HandleTable& table = *new HandleTable;
  return table;
}

std::int32_t add_object(Object object) {
  return handles().add(std::move(object));
}

void throw_other_kind(std::int32_t handle, const Object& found, const char* expected) {
  throw Error(Status::bad_handle,
              "handle " + std::to_string(handle) + " is " + name_of(found) + "; expected " + expected);
}

Lease<Batch> use_batch(std::shared_ptr<BatchObject> batch) {
  std::unique_lock lock(batch->mutex, std::try_to_lock);
  if (!lock) {
    throw Error(Status::wrong_order,
                "the batch is in use by another thread; until that call returns only npfem_request_stop is allowed");
  }
  return {std::move(batch), std::move(lock)};
}

Lease<Batch> use_batch(std::int32_t handle) {
  return use_batch(find_object<BatchObject>(handle));
}

}  // namespace npfem::capi
