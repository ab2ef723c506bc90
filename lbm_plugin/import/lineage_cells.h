// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/vec3.h"

namespace npfem::flow {

/// A line of a placing file (.pos) of the lineage.
struct LineagePlacing {
  int type;      ///< 0 red cell, 1 platelet
  Vec3 centre;   ///< um
  Vec3 degrees;  ///< about the fixed axes x, then y, then z
};

/// text::InputError with name:line where a line is not "type,x,y,z,rx,ry,rz".
std::vector<LineagePlacing> parse_placings(std::string_view text, const std::string& name);

/// A checkpoint folder of the lineage: one file of vertex positions for each body, either a start set
/// (body_ID_<id>.csv) or of a running simulation (body_ID_<id>_iT_<12 digits>.csv beside velocities vels_...), of which
/// the newest complete set counts.
class LineageCheckpoint {
 public:
  /// text::InputError where the folder holds no complete set of that many bodies.
  LineageCheckpoint(const std::filesystem::path& folder, int bodies);

  /// Step of the fluid it was written after; -1 of a start set.
  std::int64_t iteration() const { return iteration_; }
  /// xyz of the vertices of a body, um. text::InputError, with file and line, where they are not as many as needed.
  std::vector<double> positions(int body, int vertices) const;

 private:
  std::filesystem::path file_of(int body) const;

  std::filesystem::path folder_;
  std::int64_t iteration_ = -1;
};

}  // namespace npfem::flow
