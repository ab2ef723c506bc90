// SPDX-License-Identifier: MPL-2.0
#include "mesh/lineage_body.h"

#include <algorithm>

#include "error.h"
#include "file.h"
#include "mesh/line_reader.h"
#include "mesh/mesh_check.h"
#include "nearest.h"

namespace npfem {
namespace {

/// A row type of constraints.csv: how many vertices it joins and how many scalars it carries.
struct RowType {
  const char* name;
  std::size_t num_ids, num_scalars;
};

constexpr RowType row_types[] = {{"SurfaceMaterial", 3, 5},
                                 {"Area", 3, 2},
                                 {"Bending", 4, 2},
                                 {"Volume", 4, 2},
                                 {"VolumeMaterial", 4, 5},
                                 {"VolumeDamping", 4, 5},
                                 {"EdgeStrainLimiting", 2, 2},
                                 {"TriangleStrainLimiting", 3, 2}};

std::vector<Point> parse_points(LineReader reader) {
  std::vector<Point> points;
  while (reader.next()) {
    const auto fields = reader.fields(',');
    if (fields.size() != 3) reader.fail("a vertex is \"x,y,z\"");
    points.push_back({reader.to_double(fields[0]), reader.to_double(fields[1]), reader.to_double(fields[2])});
  }
  return points;
}

int vertex_id(const LineReader& reader, std::string_view word, std::size_t num_vertices) {
  const int id = reader.to_int(word);
  if (id < 0 || static_cast<std::size_t>(id) >= num_vertices) {
    reader.fail("vertex " + std::to_string(id) + " does not exist; points.csv has " + std::to_string(num_vertices) +
                ", numbered from 0");
  }
  return id;
}

std::vector<Triangle> parse_triangles(LineReader reader, std::size_t num_vertices) {
  std::vector<Triangle> triangles;
  while (reader.next()) {
    const auto fields = reader.fields(',');
    if (fields.size() != 3) reader.fail("a triangle is \"i,j,k\"");
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertex_id(reader, fields[i], num_vertices);
    triangles.push_back(triangle);
  }
  return triangles;
}

const RowType& row_type(const LineReader& reader, std::string_view name) {
  std::vector<std::string> known;
  for (const RowType& type : row_types) {
    if (name == type.name) return type;
    known.push_back(type.name);
  }
  reader.fail("unknown type " + quoted_word(name) + text::suggestion(name, known));
}

std::vector<std::string_view> split_blanks(std::string_view text) {
  LineReader line(text, "");
  return line.next() ? line.words() : std::vector<std::string_view>();
}

LineageConstraint parse_constraint(const LineReader& reader, std::size_t num_vertices) {
  const auto fields = reader.fields(',');
  if (fields.size() != 4) reader.fail("a row is \"Type,vertices,weight,scalars\", four parts between commas");
  const RowType& type = row_type(reader, fields[0]);
  const auto ids = split_blanks(fields[1]);
  const auto scalars = split_blanks(fields[3]);
  if (ids.size() != type.num_ids || scalars.size() != type.num_scalars) {
    reader.fail(std::string(type.name) + " needs " + std::to_string(type.num_ids) + " vertices and " +
                std::to_string(type.num_scalars) + " scalars; found " + std::to_string(ids.size()) + " and " +
                std::to_string(scalars.size()));
  }
  LineageConstraint row{type.name, {}, reader.to_single(fields[2]), {}};
  if (row.weight < 0) reader.fail("the weight is negative");
  for (const auto id : ids) row.ids.push_back(vertex_id(reader, id, num_vertices));
  for (const auto scalar : scalars) row.scalars.push_back(reader.to_single(scalar));
  std::vector<int> sorted = row.ids;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) reader.fail("the row repeats a vertex");
  return row;
}

std::vector<int> parse_flags(LineReader reader, std::size_t num_vertices) {
  std::vector<int> flags;
  while (reader.next()) {
    const int flag = reader.to_int(reader.fields(',').front());
    if (reader.fields(',').size() != 1 || (flag != 0 && flag != 1)) {
      reader.fail("a line is 1 (on the surface) or 0 (inside)");
    }
    flags.push_back(flag);
  }
  if (flags.size() != num_vertices) {
    reader.fail("the file has " + std::to_string(flags.size()) + " lines, but points.csv has " +
                std::to_string(num_vertices) + " vertices");
  }
  return flags;
}

}  // namespace

LineageBody parse_lineage_body(const LineageFiles& files, const std::string& folder) {
  LineageBody body;
  body.surface.positions = parse_points(LineReader(files.points, folder + "/points.csv"));
  const std::size_t num_vertices = body.surface.positions.size();
  body.surface.triangles =
      parse_triangles(LineReader(files.surface_connectivity, folder + "/surface_connectivity.csv"), num_vertices);
  LineReader reader(files.constraints, folder + "/constraints.csv");
  while (reader.next()) body.constraints.push_back(parse_constraint(reader, num_vertices));
  body.on_surface = parse_flags(LineReader(files.on_surface, folder + "/onSurfaceParticle.csv"), num_vertices);
  require_well_formed(body.surface, folder);
  return body;
}

LineageBody read_lineage_body(const std::string& folder) {
  const auto read = [&folder](const char* file) { return text::read_file(folder + '/' + file); };
  LineageFiles files;
  try {
    files = {read("points.csv"), read("surface_connectivity.csv"), read("constraints.csv"),
             read("onSurfaceParticle.csv")};
  } catch (const text::FileError& error) {
    throw Error(Status::io, error.what());
  }
  return parse_lineage_body(files, folder);
}

}  // namespace npfem
