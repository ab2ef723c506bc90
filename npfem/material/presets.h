// SPDX-License-Identifier: MPL-2.0
// The files of materials/, put into the library by embed_presets.cmake.
#pragma once

#include <span>

namespace npfem {

struct PresetText {
  const char* name;  ///< "rbc"
  const char* toml;  ///< the whole file
};

std::span<const PresetText> preset_texts();

}  // namespace npfem
