// SPDX-License-Identifier: MPL-2.0
#include "scene/memory_need.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "quantity.h"
#include "scene/read_parts.h"

namespace npfem::flow {
namespace {

double box_nodes(const Domain& domain) {
  return static_cast<double>(domain.nodes[0]) * domain.nodes[1] * domain.nodes[2];
}

std::string gigabytes(double bytes) {
  return text::format_number(rounded(bytes * 1e-9)) + " GB";
}

/// Bytes of the cells of one type: its vertices' fields, the solver's vectors and history, what contacts and the
/// immersed boundary keep. Measured: 200 red cells of 258 vertices take 44 MB.
double bytes_of(const CellType& type, int count) {
  constexpr double bytes_per_vertex = 8.0 * 105;
  return bytes_per_vertex * type.model->vertices() * count;
}

/// Populations of a fluid node, and with cells force and velocity; strips of eight nodes are stored whole.
double bytes_per_fluid_node(const Setup& setup, bool cells) {
  constexpr double stored_per_fluid_node = 1.15;
  const double number = setup.fluid_precision == FluidPrecision::in_float ? 4 : 8;
  return stored_per_fluid_node * number * (cells ? 19 + 6 : 19);
}

}  // namespace

FluidNodes fluid_nodes(const Domain& domain) {
  constexpr double most_to_count = 2e7;
  if (domain.kind != DomainKind::tube && domain.solids.empty()) {
    return {static_cast<std::int64_t>(domain.nodes[0]) * domain.nodes[1] * domain.nodes[2], true};
  }
  if (box_nodes(domain) > most_to_count) {
    return {std::llround(domain.fluid_volume() / std::pow(domain.dx, 3)), false};
  }
  std::int64_t fluid = 0;
  for (int k = 0; k < domain.nodes[2]; ++k) {
    for (int j = 0; j < domain.nodes[1]; ++j) {
      for (int i = 0; i < domain.nodes[0]; ++i) fluid += domain.node_kind({i, j, k}) == 0 ? 1 : 0;
    }
  }
  return {fluid, true};
}

double surface_memory(const Domain& domain) {
  return sizeof(float) * box_nodes(domain);
}

MemoryNeed memory_need(const Scene& scene, const FluidNodes& nodes, const std::vector<int>& cell_counts) {
  constexpr double bytes_of_mark = 1.5;  // of every node of the box: what it is, and where its strip is stored
  MemoryNeed need;
  for (std::size_t type = 0; type < cell_counts.size(); ++type) {
    need.cells += bytes_of(scene.setup.types[type], cell_counts[type]);
  }
  need.fluid = bytes_of_mark * box_nodes(scene.setup.domain) +
               bytes_per_fluid_node(scene.setup, need.cells > 0) * static_cast<double>(nodes.count);
  return need;
}

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void require_memory(const Scene& scene, const std::vector<int>& cell_counts, double share, double memory) {
  const FluidNodes nodes = fluid_nodes(scene.setup.domain);
  const MemoryNeed need = memory_need(scene, nodes, cell_counts);
  if (share * (need.fluid + need.cells) <= memory) return;
  const std::string too_much = "about " + gigabytes(need.fluid) + " for the fluid and " + gigabytes(need.cells) +
                               " for the cells, " + gigabytes(share * (need.fluid + need.cells)) +
                               " of it on this machine, which has " + gigabytes(memory) + ": take ";
  if (need.fluid >= need.cells) {
    const auto& n = scene.setup.domain.nodes;
    scene.document.root().table("domain").fail(
        "dx", std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) + " nodes need " +
                  too_much + "a larger dx, a smaller domain, or more machines (npfem plan says what a scene needs)");
  }
  std::size_t largest = 0;
  for (std::size_t type = 1; type < cell_counts.size(); ++type) {
    const auto its_bytes = [&](std::size_t t) { return bytes_of(scene.setup.types[t], cell_counts[t]); };
    if (its_bytes(type) > its_bytes(largest)) largest = type;
  }
  scene.requests[largest].table.fail(std::to_string(cell_counts[largest]) + " cells of " +
                                     std::to_string(scene.setup.types[largest].model->vertices()) + " vertices need " +
                                     too_much +
                                     "fewer cells, a coarser mesh, or more machines (npfem plan says what a scene "
                                     "needs)");
}

}  // namespace npfem::flow
