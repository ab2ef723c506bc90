// SPDX-License-Identifier: MPL-2.0
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {

std::vector<std::pair<std::string, double>> read_lineage(const text::Table& table) {
  namespace k = keys::lineage;
  constexpr int most = 1000000;
  return {{"lineage_alpha", table.quantity(k::alpha)},
          {"lineage_beta", table.quantity(k::beta)},
          {"history", within(table, k::history, 0, 1000)},
          {"max_iterations", within(table, k::max_iterations, 1, most)},
          {"max_line_search", within(table, k::max_line_search, 1, 1000)},
          {"lineage_attempts", within(table, k::attempts, 1, most)},
          {"lineage_window", within(table, k::window, 2, 1000)},
          {"lineage_tolerance", table.quantity(k::tolerance)},
          {"lineage_armijo", table.quantity(k::armijo)},
          {"lineage_curvature", table.quantity(k::curvature)}};
}

}  // namespace npfem::flow
