// SPDX-License-Identifier: MPL-2.0
// What a batch tells about each of its cells, and cells as packed numbers.
#include <bit>
#include <string>

#include "arguments.h"
#include "batch/batch.h"
#include "error.h"
#include "guard.h"
#include "handle_table.h"
#include "npfem/npfem.h"

namespace npfem::capi {
namespace {

struct CellRange {
  std::int32_t first, count;
};

/// values[i] = of(batch, first + i), once the range and the array are found to be right.
template <class T, class Getter>
void for_each_cell(std::int32_t handle, CellRange range, T* values, std::int32_t length, Getter&& of) {
  const auto batch = use_batch(handle);
  const auto out = array_argument(values, length, "values");
  const auto [first, count] = range;
  if (first < 0 || count < 0 || first > batch->num_cells() - count) {
    throw Error(Status::bad_argument, std::to_string(count) + " cells from " + std::to_string(first) +
                                          " asked for; the batch has " + std::to_string(batch->num_cells()));
  }
  require_length(length, static_cast<std::size_t>(count), "one number per cell");
  for (std::int32_t i = 0; i < count; ++i) out[static_cast<std::size_t>(i)] = of(*batch, first + i);
}

}  // namespace
}  // namespace npfem::capi

using namespace npfem;
using namespace npfem::capi;

int32_t npfem_batch_get_status(int32_t batch, int32_t first, int32_t count, int32_t* values, int32_t length) {
  return guard(__func__, [&] {
    for_each_cell(batch, {first, count}, values, length,
                  [](const Batch& b, int cell) { return static_cast<int32_t>(b.report(cell).status); });
  });
}

int32_t npfem_batch_get_iterations(int32_t batch, int32_t first, int32_t count, int32_t* values, int32_t length) {
  return guard(__func__, [&] {
    for_each_cell(batch, {first, count}, values, length,
                  [](const Batch& b, int cell) { return b.report(cell).iterations; });
  });
}

int32_t npfem_batch_get_residual(int32_t batch, int32_t first, int32_t count, double* values, int32_t length) {
  return guard(__func__, [&] {
    for_each_cell(batch, {first, count}, values, length,
                  [](const Batch& b, int cell) { return b.report(cell).residual; });
  });
}

int32_t npfem_batch_status_text(int32_t batch, int32_t cell, char* buffer, int32_t capacity) {
  return guard(__func__, [&] { return text_out(use_batch(batch)->status_text(cell), buffer, capacity); });
}

int32_t npfem_batch_measure(int32_t batch, const char* key, int32_t first, int32_t count, double* values,
                            int32_t length) {
  return guard(__func__, [&] {
    const auto name = text_argument(key, "key");
    for_each_cell(batch, {first, count}, values, length,
                  [&](const Batch& b, int cell) { return b.measure(name, cell); });
  });
}

int32_t npfem_batch_state_hash(int32_t batch, int32_t first, int32_t count, int64_t* values, int32_t length) {
  return guard(__func__, [&] {
    for_each_cell(batch, {first, count}, values, length,
                  [](const Batch& b, int cell) { return std::bit_cast<int64_t>(b.state_hash(cell)); });
  });
}

int32_t npfem_batch_pack_length(int32_t batch) {
  return guard(__func__, [&] { return use_batch(batch)->pack_length(); });
}

int32_t npfem_batch_pack(int32_t batch, int32_t cell, double* values, int32_t length) {
  return guard(__func__, [&] { use_batch(batch)->pack(cell, array_argument(values, length, "values")); });
}

int32_t npfem_batch_unpack(int32_t batch, int32_t cell, const double* values, int32_t length) {
  return guard(__func__, [&] { use_batch(batch)->unpack(cell, array_argument(values, length, "values")); });
}
