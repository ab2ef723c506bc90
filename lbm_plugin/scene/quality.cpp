// SPDX-License-Identifier: MPL-2.0
#include "scene/quality.h"

#include <array>

#include "scene/scene_keys.h"

namespace npfem::flow {
namespace {

/// Values of one quality, as they are written in a scene.
struct Quality {
  const char* name;
  const char* dx;
  const char* tau;
  const char* kernel;
  const char* cell_every;
  const char* precision;
};

constexpr std::array qualities{
    Quality{"fast", "0.5 um", "4", "3", "2", "float"},
    Quality{"balanced", "0.5 um", "2", "3", "2", "double"},
    Quality{"accurate", "0.25 um", "2", "4", "2", "double"},
};

}  // namespace

void apply_quality(text::Document& document) {
  const text::Table root = document.root();
  if (!root.has(keys::quality)) return;
  const std::string name = root.choice(keys::quality);
  const auto set_where_missing = [&document](const char* table, const text::Key& key, const char* value) {
    if (!document.root().table(table).has(key)) document.set(std::string(table) + "." + std::string(key.name), value);
  };
  for (const Quality& quality : qualities) {
    if (name != quality.name) continue;
    set_where_missing("domain", keys::dx, quality.dx);
    if (!document.root().table("fluid").has(keys::time_step)) set_where_missing("fluid", keys::tau, quality.tau);
    set_where_missing("fluid", keys::fluid_precision, quality.precision);
    set_where_missing("coupling", keys::kernel, quality.kernel);
    set_where_missing("coupling", keys::cell_every, quality.cell_every);
  }
}

}  // namespace npfem::flow
