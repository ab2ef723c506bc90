// SPDX-License-Identifier: MPL-2.0
#include "backend/backend.h"
#include "backend/reference/reference_backend.h"
#include "error.h"
#include "nearest.h"

namespace npfem {

std::vector<std::string> backend_names() {
  return {"reference"};
}

std::unique_ptr<Backend> create_backend(std::shared_ptr<const Model> model, std::string_view name) {
  if (name == "reference") return std::make_unique<ReferenceBackend>(std::move(model));
  throw Error(Status::unavailable, "back end \"" + std::string(name) + "\" is not in this build" +
                                       text::suggestion(name, backend_names(), "this build has"));
}

}  // namespace npfem
