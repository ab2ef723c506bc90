// SPDX-License-Identifier: MPL-2.0
// npfem mesh: makes the surface of a cell, or checks one.
#include <cstdio>

#include "quantity.h"
#include "session.h"

namespace npfem::app {
namespace {

struct MeshOptions {
  std::string shape, file, output, size;
  int level = 3;
};

void print_measures(const api::Mesh& mesh) {
  std::printf("%d vertices, %d triangles\n", mesh.vertices(), mesh.triangles());
  std::printf("area %.6g um2, volume %.6g um3, reduced volume %.4f\n", mesh.measure("area"), mesh.measure("volume"),
              mesh.measure("reduced_volume"));
  std::printf("extents %.4g x %.4g x %.4g um, edges %.3g to %.3g um, mean %.3g um\n", mesh.measure("extent_x"),
              mesh.measure("extent_y"), mesh.measure("extent_z"), mesh.measure("edge_min"), mesh.measure("edge_max"),
              mesh.measure("edge_mean"));
}

int check(const MeshOptions& options) {
  if (options.file.empty()) throw text::InputError("mesh check needs a file: npfem mesh check FILE");
  const api::Mesh mesh = api::Mesh::load(options.file);
  print_measures(mesh);
  std::puts("closed, consistently oriented, no degenerate triangle");
  return done;
}

int make(const MeshOptions& options) {
  if (!options.file.empty()) throw text::InputError("only \"mesh check\" takes a file here; to write one, add -o FILE");
  const double size = options.size.empty() ? 0 : text::parse_quantity(options.size, text::Dimension::length());
  if (!options.size.empty() && !(size > 0)) throw text::InputError("--size " + options.size + " must be above 0");
  const api::Mesh mesh = api::Mesh::generate(options.shape, options.level, size);
  if (!options.output.empty()) mesh.save(options.output);
  print_measures(mesh);
  return done;
}

}  // namespace

Action add_mesh(CLI::App& program) {
  const auto options = std::make_shared<MeshOptions>();
  CLI::App* command = program.add_subcommand("mesh", "make the surface of a cell, or check one: mesh check FILE");
  command->add_option("shape", options->shape, "rbc, platelet, sphere or icosphere; or the word check")->required();
  command->add_option("file", options->file, "the file to check");
  command->add_option("--level", options->level, "refinement: 2, 3, 4 give 66, 258, 1026 vertices")
      ->capture_default_str();
  command->add_option("--size", options->size, "largest diameter, like \"7.82 um\"; default: the natural one");
  command->add_option("-o,--output", options->output, "file to write (.off .obj .stl .ply)");
  return [options](Session& session) {
    if (!session.first()) return static_cast<int>(done);
    return options->shape == "check" ? check(*options) : make(*options);
  };
}

}  // namespace npfem::app
