// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <stdexcept>
#include <string>

/// A scene with one red cell in a shear box, to be varied by the tests.
inline const std::string shear_scene = R"(schema_version = 1
title = "test"

[domain]
kind = "shear_box"
size = ["14 um", "12 um", "10 um"]
dx = "0.5 um"

[fluid]
dynamic_viscosity = "1.2 mPa s"
time_step = "0.1 us"

[flow]
shear_rate = "1000 1/s"

[[cells]]
name = "rbc"
material = "rbc"
level = 2
count = 1

[run]
steps = 10
)";

/// `text` with its first `old` replaced.
inline std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("\"" + old + "\" is not in the text");
  return text.replace(at, old.size(), replacement);
}
