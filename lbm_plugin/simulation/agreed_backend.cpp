// SPDX-License-Identifier: MPL-2.0
#include "simulation/agreed_backend.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

#include "nearest.h"
#include "npfem/npfem.hpp"

namespace npfem::flow {
namespace {

/// The best instruction set first.
std::vector<std::string> backends_here() {
  const auto info =
      api::text_of([](char* buffer, std::int32_t capacity) { return npfem_build_info(buffer, capacity); });
  return nlohmann::json::parse(info).at("backends");
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += name + '\n';
  return text;
}

std::vector<std::string> split(const Bytes& bytes) {
  std::vector<std::string> names(1);
  for (const std::byte b : bytes) {
    if (b == std::byte{'\n'}) {
      names.emplace_back();
    } else {
      names.back() += static_cast<char>(b);
    }
  }
  names.pop_back();
  return names;
}

std::vector<std::string> backends_everywhere(Communicator& communicator) {
  const std::string own = joined(backends_here());
  const std::vector<Bytes> all = communicator.all_gather(std::as_bytes(std::span(own)));
  std::vector<std::string> common = split(all.front());
  for (const Bytes& bytes : all) {
    const std::vector<std::string> names = split(bytes);
    std::erase_if(common, [&](const std::string& name) { return std::ranges::find(names, name) == names.end(); });
  }
  return common;
}

}  // namespace

std::string agreed_backend(Communicator& communicator, const std::string& wanted) {
  const std::vector<std::string> common = backends_everywhere(communicator);
  for (const std::string& name : common) {
    if (wanted == "cpu" ? name.starts_with("cpu-") : name == wanted) return name;
  }
  throw std::invalid_argument("back end \"" + wanted + "\" of the cell solver is not on every rank" +
                              text::suggestion(wanted, common, "all have"));
}

}  // namespace npfem::flow
