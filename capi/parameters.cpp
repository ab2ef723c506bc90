// SPDX-License-Identifier: MPL-2.0
// Parameters by key, of materials and of batches.
#include <string>

#include "arguments.h"
#include "error.h"
#include "guard.h"
#include "handle_table.h"
#include "npfem/npfem.h"
#include "parameter_table.h"

namespace npfem::capi {
namespace {

constexpr const char* expected = "a material or a batch";

/// Calls on_material(Material&) or on_batch(Batch&) for what the handle stands for.
template <class OnMaterial, class OnBatch>
auto with_owner(std::int32_t handle, OnMaterial&& on_material, OnBatch&& on_batch) {
  Object object = handles().find(handle, expected);
  if (auto* material = std::get_if<std::shared_ptr<MaterialObject>>(&object)) {
    return on_material(*wait_for(std::move(*material)));
  }
  if (auto* batch = std::get_if<std::shared_ptr<BatchObject>>(&object)) {
    return on_batch(*use_batch(std::move(*batch)));
  }
  throw_other_kind(handle, object, expected);
}

const std::vector<Parameter>& parameters_of(std::int32_t handle) {
  const Object object = handles().find(handle, expected);
  if (std::holds_alternative<std::shared_ptr<MaterialObject>>(object)) return material_parameters();
  if (std::holds_alternative<std::shared_ptr<BatchObject>>(object)) return batch_parameters();
  throw_other_kind(handle, object, expected);
}

const Parameter& parameter(std::int32_t handle, std::int32_t index) {
  const std::vector<Parameter>& all = parameters_of(handle);
  return all[require_index(index, all.size(), "parameter")];
}

}  // namespace
}  // namespace npfem::capi

using namespace npfem;
using namespace npfem::capi;

int32_t npfem_param_count(int32_t handle) {
  return guard(__func__, [&] { return as_count(parameters_of(handle).size()); });
}

int32_t npfem_param_name(int32_t handle, int32_t index, char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(parameter(handle, index).key, buffer, capacity); });
}

int32_t npfem_param_unit(int32_t handle, int32_t index, char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(parameter(handle, index).unit, buffer, capacity); });
}

int32_t npfem_param_doc(int32_t handle, int32_t index, char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(parameter(handle, index).doc, buffer, capacity); });
}

int32_t npfem_param_kind(int32_t handle, int32_t index) {
  return guard(__func__, [&] { return static_cast<int32_t>(parameter(handle, index).kind); });
}

int32_t npfem_param_range(int32_t handle, int32_t index, double* least, double* largest, double* fallback) {
  return guard(__func__, [&] {
    const Parameter& p = parameter(handle, index);
    require_parameter(parameters_of(handle), p.key, ParameterKind::number);
    require_pointer(least, "least");
    require_pointer(largest, "largest");
    require_pointer(fallback, "fallback");
    *least = p.least;
    *largest = p.largest;
    *fallback = p.fallback;
  });
}

int32_t npfem_set_f64(int32_t handle, const char* key, double value) {
  return guard(__func__, [&] {
    require_parameter(parameters_of(handle), text_argument(key, "key"), ParameterKind::number);
    with_owner(
        handle, [&](Material& material) { material.set(key, value); },
        [&](Batch& batch) { set_option(batch.options(), key, value); });
  });
}

int32_t npfem_get_f64(int32_t handle, const char* key, double* value) {
  return guard(__func__, [&] {
    require_parameter(parameters_of(handle), text_argument(key, "key"), ParameterKind::number);
    require_pointer(value, "value");
    *value = with_owner(
        handle, [&](const Material& material) { return material.get(key); },
        [&](const Batch& batch) { return get_option(batch.options(), key); });
  });
}

int32_t npfem_set_text(int32_t handle, const char* key, const char* value) {
  return guard(__func__, [&] {
    require_parameter(parameters_of(handle), text_argument(key, "key"), ParameterKind::word);
    require_pointer(value, "value");
    with_owner(
        handle, [&](Material& material) { material.set_text(key, value); },
        [&](Batch& batch) { set_option_word(batch.options(), value); });
  });
}

int32_t npfem_get_text(int32_t handle, const char* key, char* buffer, int32_t capacity) {
  return guard(__func__, [&] {
    require_parameter(parameters_of(handle), text_argument(key, "key"), ParameterKind::word);
    const std::string word = with_owner(
        handle, [&](const Material& material) { return std::string(material.get_text(key)); },
        [&](const Batch& batch) { return get_option_word(batch.options()); });
    return text_out(word, buffer, capacity);
  });
}
