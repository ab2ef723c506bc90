// SPDX-License-Identifier: MPL-2.0
// Included by one file per instruction set: the kernels compiled for it.
#pragma once

#include "backend/cpu/kernel/cells_in_lanes.h"
#include "backend/cpu/kernel/elements_in_lanes.h"
#include "backend/cpu/kernel/evaluate.h"
#include "backend/cpu/kernel/implicit_step.h"
#include "backend/cpu/kernel/lineage_step.h"

namespace npfem::NPFEM_ISA {

template <class Shape, class R, class H>
void step(const cpu::StepTask<R, H>& task) {
  Carver memory(task.workspace);
  if (task.settings->lineage) {
    LineageStep<Shape, R, H, lanes_of<R>>(task, memory).run();
  } else {
    ImplicitStep<Shape, R, H, lanes_of<R>>(task, memory).run();
  }
}

template <class R, class H>
using Cells = CellsInLanes<R, H, lanes_of<R>>;
template <class R, class H>
using Elements = ElementsInLanes<R, H, lanes_of<R>>;

/// Bytes that any step of these kernels takes from its workspace.
std::size_t workspace_bytes(int num_vertices, int history, int window) {
  const auto field = static_cast<std::size_t>(3 * num_vertices) * NPFEM_REGISTER_BYTES + 128;
  return field * static_cast<std::size_t>(24 + 2 * history) +
         static_cast<std::size_t>(window) * NPFEM_REGISTER_BYTES * 2 + 65536;
}

extern const cpu::KernelTable table;
const cpu::KernelTable table{
    .name = NPFEM_ISA_NAME,
    .double_lanes = lanes_of<double>,
    .float_lanes = lanes_of<float>,
    .workspace_bytes = &workspace_bytes,
    .step_double = &step<Cells<double, double>>,
    .step_mixed = &step<Cells<double, float>>,
    .step_float = &step<Cells<float, float>>,
    .lone_step_double = &step<Elements<double, double>>,
    .lone_step_mixed = &step<Elements<double, float>>,
    .lone_step_float = &step<Elements<float, float>>,
    .evaluate = &evaluate<Cells<double, double>>,
};

}  // namespace npfem::NPFEM_ISA
