// SPDX-License-Identifier: MPL-2.0
// Reads the raw appended VTK files that the plugin writes, by the rules of the format and not by those of the writer.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

/// The value of `attribute` in the first element that contains `mark` after position `from`.
inline std::string attribute(const std::string& file, const std::string& mark, const std::string& attribute) {
  const std::size_t at = file.find(mark);
  if (at == std::string::npos) throw std::runtime_error(mark + " is not in the file");
  const std::size_t begin = file.rfind('<', at);
  const std::size_t end = file.find('>', at);
  const std::string element = file.substr(begin, end - begin);
  const std::size_t key = element.find(' ' + attribute + "=\"");
  if (key == std::string::npos) throw std::runtime_error(mark + " has no " + attribute);
  const std::size_t value = key + attribute.size() + 3;
  return element.substr(value, element.find('"', value) - value);
}

template <class T>
std::vector<T> array_of(const std::string& file, const std::string& name) {
  const std::string mark = "Name=\"" + name + "\"";
  const std::size_t data = file.find('_', file.find("<AppendedData")) + 1;
  const std::size_t at = data + std::stoull(attribute(file, mark, "offset"));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, file.data() + at, 8);
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), file.data() + at + 8, bytes);
  return values;
}
