// SPDX-License-Identifier: MPL-2.0
#include "backend/backend.h"
#include "backend/cpu/cpu_backend.h"
#include "backend/cpu/dispatch.h"
#include "backend/reference/reference_backend.h"
#include "error.h"
#include "nearest.h"

namespace npfem {

std::vector<std::string> backend_names() {
  std::vector<std::string> names{"cpu", "reference"};
  for (const std::string& set : cpu::instruction_sets()) names.push_back("cpu-" + set);
  return names;
}

std::unique_ptr<Backend> create_backend(std::shared_ptr<const Model> model, std::string_view name) {
  if (name == "reference") return std::make_unique<ReferenceBackend>(std::move(model));
  const std::string set = name == "cpu"                 ? cpu::instruction_sets().front()
                          : name.substr(0, 4) == "cpu-" ? std::string(name.substr(4))
                                                        : "";
  if (const cpu::KernelTable* kernels = cpu::kernels(set))
    return std::make_unique<cpu::CpuBackend>(std::move(model), *kernels);
  throw Error(Status::unavailable, "back end \"" + std::string(name) + "\" is not in this build" +
                                       text::suggestion(name, backend_names(), "this build has"));
}

}  // namespace npfem
