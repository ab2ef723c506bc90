// SPDX-License-Identifier: MPL-2.0
// Batches: cells, fields, loads and steps.
#include "batch/batch.h"

#include <algorithm>
#include <string>

#include "arguments.h"
#include "error.h"
#include "guard.h"
#include "handle_table.h"
#include "npfem/npfem.h"

using namespace npfem;
using namespace npfem::capi;

int32_t npfem_batch_create(int32_t model, const char* backend, int32_t cells) {
  return guard(__func__, [&] {
    const auto shared = find_object<ModelObject>(model);
    return add_object(std::make_shared<BatchObject>(shared, text_argument(backend, "backend"), cells));
  });
}

int32_t npfem_batch_cell_count(int32_t batch) {
  return guard(__func__, [&] { return use_batch(batch)->num_cells(); });
}

int32_t npfem_batch_add(int32_t batch, int32_t cells) {
  return guard(__func__, [&] { return use_batch(batch)->add_cells(cells); });
}

int32_t npfem_batch_remove(int32_t batch, int32_t cell) {
  return guard(__func__, [&] { use_batch(batch)->remove_cell(cell); });
}

int32_t npfem_batch_set(int32_t batch, const char* field, int32_t first, int32_t count, const double* values,
                        int32_t length) {
  return guard(__func__, [&] {
    const auto cells = use_batch(batch);
    const Field which = field_by_name(text_argument(field, "field"));
    cells->write(which, first, count, array_argument(values, length, "values"));
  });
}

int32_t npfem_batch_get(int32_t batch, const char* field, int32_t first, int32_t count, double* values,
                        int32_t length) {
  return guard(__func__, [&] {
    const auto cells = use_batch(batch);
    const Field which = field_by_name(text_argument(field, "field"));
    cells->read(which, first, count, array_argument(values, length, "values"));
  });
}

int32_t npfem_batch_get_f32(int32_t batch, const char* field, int32_t first, int32_t count, float* values,
                            int32_t length) {
  return guard(__func__, [&] {
    const auto cells = use_batch(batch);
    const Field which = field_by_name(text_argument(field, "field"));
    const auto out = array_argument(values, length, "values");
    std::vector<double> wide(out.size());
    cells->read(which, first, count, wide);
    std::transform(wide.begin(), wide.end(), out.begin(), [](double v) { return static_cast<float>(v); });
  });
}

int32_t npfem_batch_step(int32_t batch, int32_t steps) {
  return guard(__func__, [&] { return use_batch(batch)->step(steps); });
}

int32_t npfem_batch_step_for_ms(int32_t batch, double milliseconds, int32_t* steps_done) {
  return guard(__func__, [&] {
    require_pointer(steps_done, "steps_done");
    return use_batch(batch)->step_for_ms(milliseconds, *steps_done);
  });
}

int32_t npfem_batch_relax(int32_t batch) {
  return guard(__func__, [&] { return use_batch(batch)->relax(); });
}

int32_t npfem_batch_evaluate(int32_t batch) {
  return guard(__func__, [&] { use_batch(batch)->evaluate(); });
}

int32_t npfem_batch_add_patch(int32_t batch, const int32_t* vertices, int32_t length, double stiffness) {
  return guard(__func__, [&] {
    const auto cells = use_batch(batch);
    cells->add_patch(array_argument(vertices, length, "vertices"), stiffness);
    return cells->num_patches() - 1;
  });
}

int32_t npfem_batch_clear_patches(int32_t batch) {
  return guard(__func__, [&] { use_batch(batch)->clear_patches(); });
}

int32_t npfem_request_stop(int32_t batch) {
  return guard(__func__, [&] { find_object<BatchObject>(batch)->value.request_stop(); });
}
