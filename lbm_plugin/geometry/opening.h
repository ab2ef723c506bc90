// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "geometry/vec3.h"

namespace npfem::flow {

/// The faces of the box, in the order of their numbers.
enum class Face : std::uint8_t { x_low, x_high, y_low, y_high, z_low, z_high };

constexpr std::size_t axis_of(Face face) {
  return static_cast<std::size_t>(face) / 2;
}
constexpr bool is_high(Face face) {
  return static_cast<int>(face) % 2 == 1;
}
/// "x-", "x+", ...
inline std::string name_of(Face face) {
  return std::string(1, "xyz"[axis_of(face)]) + (is_high(face) ? "+" : "-");
}
/// Unit vector into the box.
inline Vec3 inward(Face face) {
  Vec3 normal{};
  normal[axis_of(face)] = is_high(face) ? -1.0 : 1.0;
  return normal;
}

/// A face of the box that blood flows in or out through, over as much of it as the walls leave open.
struct Opening {
  enum class Kind {
    velocity,  ///< the velocity there is given
    pressure,  ///< the pressure there is given; the fluid passes as it likes
  };
  enum class Profile {
    developed,  ///< of the steady flow along a channel of the section's shape: parabolic in a tube and between plates
    plug,       ///< the same everywhere
  };
  Face face = Face::x_low;
  Kind kind = Kind::pressure;
  double mean_velocity = 0;  ///< um/us, into the box positive, over the fluid nodes of the face
  Profile profile = Profile::developed;
  double pressure = 0;  ///< Pa
};

}  // namespace npfem::flow
