// SPDX-License-Identifier: MPL-2.0
#include "scene/read_parts.h"
#include "scene/scene_keys.h"

namespace npfem::flow {

using text::Table;

namespace {

Signal read_points(const Table& table, double period) {
  refuse(table, {&keys::amplitude, &keys::mean, &keys::phase}, "\"times\" is given too; give only one of them");
  const std::vector<double> times = table.quantities(keys::times);
  const std::vector<double> factors = table.quantities(keys::factors);
  if (times.size() < 2) table.fail("times", "at least two are needed");
  if (factors.size() != times.size()) {
    table.fail("factors", "found " + std::to_string(factors.size()) + " for " + std::to_string(times.size()) +
                              " times; as many are needed");
  }
  std::vector<Signal::Point> points;
  for (std::size_t n = 0; n < times.size(); ++n) {
    if (n > 0 && times[n] <= times[n - 1]) table.fail("times", "must ascend; the period closes after the last");
    if (times[n] >= period) {
      table.fail("times", text::format_quantity(times[n], "us") + " is not below the period of " +
                              text::format_quantity(period, "us"));
    }
    points.push_back({times[n], factors[n]});
  }
  return Signal::table(std::move(points), period);
}

}  // namespace

Signal read_waveform(const Table& table) {
  const double period = table.quantity(keys::period);
  if (table.has(keys::times)) return read_points(table, period);
  refuse(table, {&keys::factors}, "needs \"times\" beside it");
  if (!table.has(keys::amplitude)) table.fail("one of \"amplitude\" or \"times\" is needed");
  const double mean = table.has(keys::mean) ? table.quantity(keys::mean) : 1;
  const double phase = table.has(keys::phase) ? table.quantity(keys::phase) : 0;
  return Signal::sine(mean, table.quantity(keys::amplitude), period, phase);
}

}  // namespace npfem::flow
