// SPDX-License-Identifier: MPL-2.0
// A lineage body folder driven through shapeop.h, as a script of the lineage does it.
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "npfem/shapeop.h"

/// Folder of shared data: the environment variable NPFEM_SHARED, or where the build was told it is.
inline std::filesystem::path shared_data() {
  const char* folder = std::getenv("NPFEM_SHARED");
  return std::filesystem::path(folder ? folder : NPFEM_SHARED) / "data" / "palabos-npfem";
}

/// The numbers of a CSV file, row by row; lines that start with # are skipped.
inline std::vector<std::vector<double>> read_rows(const std::filesystem::path& file) {
  std::vector<std::vector<double>> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
  }
  return rows;
}

struct LineageRow {
  std::string type;
  std::vector<int> ids;
  double weight = 0;
  std::vector<double> scalars;
};

/// The rows of constraints.csv: type, ids between blanks, weight, scalars between blanks.
inline std::vector<LineageRow> read_constraints(const std::filesystem::path& file) {
  std::vector<LineageRow> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::array<std::string, 4> text;
    for (std::string& field : text) std::getline(fields, field, ',');
    LineageRow row{text[0], {}, std::stod(text[2]), {}};
    std::istringstream ids(text[1]), scalars(text[3]);
    for (int id; ids >> id;) row.ids.push_back(id);
    for (double scalar; scalars >> scalar;) row.scalars.push_back(scalar);
    rows.push_back(row);
  }
  return rows;
}

/// Points as one flat array.
inline std::vector<double> read_points(const std::filesystem::path& file) {
  std::vector<double> xyz;
  for (const auto& row : read_rows(file)) xyz.insert(xyz.end(), row.begin(), row.end());
  return xyz;
}

/// Sets points and constraints of a body; returns whether every constraint was taken.
inline bool load_body(ShapeOpSolver* solver, const std::filesystem::path& folder) {
  std::vector<double> xyz = read_points(folder / "points.csv");
  shapeop_setPoints(solver, xyz.data(), static_cast<int>(xyz.size() / 3));
  for (LineageRow& row : read_constraints(folder / "constraints.csv")) {
    const int id =
        shapeop_addConstraint(solver, row.type.c_str(), row.ids.data(), static_cast<int>(row.ids.size()), row.weight);
    if (id < 0) return false;
    if (shapeop_editConstraint(solver, row.type.c_str(), id, row.scalars.data(),
                               static_cast<int>(row.scalars.size())) != SO_SUCCESS) {
      return false;
    }
  }
  return true;
}
