// SPDX-License-Identifier: MPL-2.0
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {

LineageSettings read_lineage(const text::Table& table) {
  namespace k = keys::lineage;
  constexpr int most = 1000000;
  LineageSettings s;
  s.alpha = table.quantity(k::alpha);
  s.beta = table.quantity(k::beta);
  s.history = within(table, k::history, 0, 1000);
  s.max_iterations = within(table, k::max_iterations, 1, most);
  s.max_line_search = within(table, k::max_line_search, 1, most);
  s.attempts = within(table, k::attempts, 1, most);
  s.window = within(table, k::window, 2, 1000);
  s.tolerance = table.quantity(k::tolerance);
  s.armijo = table.quantity(k::armijo);
  s.curvature = table.quantity(k::curvature);
  s.velocity_cap = table.quantity(k::velocity_cap);
  s.velocity_cap_to = table.quantity(k::velocity_cap_to);
  s.contact_range = table.quantity(k::contact_range);
  s.contact_weight = table.quantity(k::contact_weight);
  s.contact_range_unlike = table.quantity(k::contact_range_unlike);
  s.contact_weight_unlike = table.quantity(k::contact_weight_unlike);
  return s;
}

}  // namespace npfem::flow
