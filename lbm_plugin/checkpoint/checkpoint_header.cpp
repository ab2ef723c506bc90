// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/checkpoint_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <limits>

#include <nlohmann/json.hpp>

#include "mix_bits.h"
#include "quantity.h"

namespace npfem::flow {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const CheckpointHeader::Marks& marks) {
  Json json = Json::object();
  for (const auto& [name, hash] : marks) json[name] = hash;
  return json;
}

CheckpointHeader::Marks marks_from(const Json& json) {
  CheckpointHeader::Marks marks;
  for (const auto& [name, hash] : json.items()) marks.emplace_back(name, hash);
  return marks;
}

/// JSON has no number for what is not finite; a failed run may hold such.
double number_from(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json to_json(const Counters& counters) {
  return {{"cell_steps", counters.cell_steps},
          {"iterations", counters.iterations},
          {"worst_residual_pN", counters.worst_residual_pN},
          {"fluid_seconds", counters.fluid_seconds},
          {"cell_seconds", counters.cell_seconds},
          {"exchange_seconds", counters.exchange_seconds},
          {"least_gap_um", counters.least_gap_um},  // null where infinite
          {"worst_volume_error", counters.worst_volume_error}};
}

Counters counters_from(const Json& json) {
  const Json& gap = json.at("least_gap_um");
  return {json.at("cell_steps"),
          json.at("iterations"),
          number_from(json.at("worst_residual_pN")),
          json.at("fluid_seconds"),
          json.at("cell_seconds"),
          json.at("exchange_seconds"),
          gap.is_null() ? std::numeric_limits<double>::infinity() : gap.get<double>(),
          number_from(json.at("worst_volume_error"))};
}

Json to_json(const std::vector<Departure>& departures) {
  Json json = Json::array();
  for (const Departure& d : departures) {
    json.push_back({{"cell_id", d.id},
                    {"type", d.type},
                    {"step", d.step},
                    {"face", static_cast<int>(d.face)},
                    {"centre", d.centre},
                    {"volume", d.volume}});
  }
  return json;
}

std::vector<Departure> departures_from(const Json& json) {
  std::vector<Departure> departures;
  for (const Json& d : json) {
    departures.push_back({d.at("cell_id"), d.at("type"), d.at("step"), static_cast<Face>(d.at("face").get<int>()),
                          d.at("centre"), d.at("volume")});
  }
  return departures;
}

const std::string* find(const CheckpointHeader::Marks& marks, const std::string& name) {
  const auto found = std::find_if(marks.begin(), marks.end(), [&](const auto& mark) { return mark.first == name; });
  return found == marks.end() ? nullptr : &found->second;
}

void append(std::string& text, const std::vector<double>& numbers) {
  for (const double number : numbers) text += std::to_string(std::bit_cast<std::uint64_t>(number)) + ' ';
}

}  // namespace

std::string to_json(const CheckpointHeader& header) {
  Json failures = Json::array();
  for (const CellFailure& f : header.failures) {
    failures.push_back({{"cell_id", f.id}, {"type", f.type}, {"step", f.step}, {"reason", f.reason}});
  }
  const Json json{{"step", header.step},
                  {"time_us", header.time_us},
                  {"wall_s", header.wall_s},
                  {"backend", header.backend},
                  {"version", header.version},
                  {"build", header.build},
                  {"scene", to_json(header.scene)},
                  {"types", to_json(header.types)},
                  {"counters", to_json(header.counters)},
                  {"failures", failures},
                  {"departures", to_json(header.departures)},
                  {"momentum_audit", header.audit}};
  return json.dump();
}

CheckpointHeader header_from_json(const std::string& text) {
  const Json json = Json::parse(text);
  CheckpointHeader header;
  header.step = json.at("step");
  header.time_us = json.at("time_us");
  header.wall_s = json.at("wall_s");
  header.backend = json.at("backend");
  header.version = json.at("version");
  header.build = json.at("build");
  header.scene = marks_from(json.at("scene"));
  header.types = marks_from(json.at("types"));
  header.counters = counters_from(json.at("counters"));
  for (const Json& f : json.at("failures")) {
    header.failures.push_back({f.at("cell_id"), f.at("type"), f.at("step"), f.at("reason")});
  }
  header.departures = departures_from(json.at("departures"));
  for (std::size_t i = 0; i < header.audit.size(); ++i) header.audit[i] = number_from(json.at("momentum_audit").at(i));
  return header;
}

std::string mark_of(const std::string& text) {
  std::uint64_t hash = text.size();
  for (const char c : text) hash = mix_bits((hash << 1 | hash >> 63) ^ mix_bits(static_cast<unsigned char>(c) + 1ULL));
  std::array<char, 24> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

std::string mark_of(const CellType& type) {
  std::string text = type.material + '\n';
  for (const std::int32_t corner : type.triangles) text += std::to_string(corner) + ' ';
  for (const char* field : {"rest_position", "rest_area", "solid_mass"}) append(text, type.model->get(field));
  for (const auto& [key, value] : type.options) text += key + ' ' + text::format_number(value) + ' ';
  return mark_of(text);
}

std::string differences(const CheckpointHeader::Marks& a, const CheckpointHeader::Marks& b) {
  std::vector<std::string> names;
  for (const auto& [name, hash] : a) {
    const std::string* other = find(b, name);
    if (other == nullptr || *other != hash) names.push_back(name);
  }
  for (const auto& [name, hash] : b) {
    if (find(a, name) == nullptr) names.push_back(name);
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "[" : ", [") + name + "]";
  return text;
}

}  // namespace npfem::flow
