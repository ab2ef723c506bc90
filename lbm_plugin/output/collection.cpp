// SPDX-License-Identifier: MPL-2.0
#include "output/collection.h"

#include <charconv>
#include <fstream>
#include <system_error>

#include "file.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

std::string attribute(const std::string& line, const std::string& name) {
  const std::string mark = ' ' + name + "=\"";
  const std::size_t begin = line.find(mark);
  if (begin == std::string::npos) return "";
  const std::size_t value = begin + mark.size();
  return line.substr(value, line.find('"', value) - value);
}

/// 120 of "cells_000000120.vtu"; -1 where there is no number.
std::int64_t step_of(const std::string& file) {
  std::int64_t step = -1;
  const std::size_t digits = file.rfind('_');
  if (digits != std::string::npos) std::from_chars(file.data() + digits + 1, file.data() + file.size(), step);
  return step;
}

}  // namespace

bool Collection::resume(std::int64_t step) {
  std::ifstream collection(path_);
  const std::filesystem::path folder = path_.parent_path();
  std::vector<std::filesystem::path> dropped;
  bool present = false;
  for (std::string line; std::getline(collection, line);) {
    const std::string file = attribute(line, "file");
    if (file.empty()) continue;
    if (step_of(file) > step) {
      dropped.push_back(folder / std::filesystem::path(file).filename());
    } else if (std::filesystem::exists(folder / file)) {
      entries_.push_back({attribute(line, "timestep"), file});
      present = present || step_of(file) == step;
    }
  }
  if (!dropped.empty()) write();
  for (const std::filesystem::path& file : dropped) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
  return present;
}

void Collection::add(double time_us, const std::string& file) {
  entries_.push_back({text::format_number(time_us), file});
  write();
}

void Collection::write() const {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<!-- timestep: us -->\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const Entry& entry : entries_) {
    xml += "<DataSet timestep=\"" + entry.time_us + "\" part=\"0\" file=\"" + entry.file + "\"/>\n";
  }
  text::write_file(path_.string(), xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace npfem::flow
