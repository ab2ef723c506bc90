// SPDX-License-Identifier: MPL-2.0
#include "mesh/read_mesh.h"

#include <filesystem>

#include "error.h"
#include "file.h"
#include "mesh/mesh_formats.h"

namespace npfem {
namespace {

struct Format {
  const char* extension;
  TriangleMesh (*parse)(std::string_view content, const std::string& name);
  std::string (*format)(const TriangleMesh& mesh);
};

constexpr Format formats[] = {{".off", parse_off, format_off},
                              {".obj", parse_obj, format_obj},
                              {".stl", parse_stl, format_stl},
                              {".ply", parse_ply, format_ply}};

const Format& format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const Format& format : formats) {
    if (extension == format.extension) return format;
  }
  throw Error(Status::bad_input, "mesh file \"" + path + "\": the extension must be .off, .obj, .stl or .ply");
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
  const Format& format = format_of(path);
  try {
    return format.parse(text::read_file(path), path);
  } catch (const text::FileError& error) {
    throw Error(Status::io, error.what());
  }
}

void write_mesh(const std::string& path, const TriangleMesh& mesh) {
  const Format& format = format_of(path);
  try {
    text::write_file(path, format.format(mesh));
  } catch (const text::FileError& error) {
    throw Error(Status::io, error.what());
  }
}

}  // namespace npfem
