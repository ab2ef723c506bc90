// SPDX-License-Identifier: MPL-2.0
#include "communicator/communicator.h"

#include <stdexcept>

namespace npfem::flow {

void Communicator::agree(const std::string& failure) {
  if (!any(!failure.empty())) return;
  for (const Bytes& text : all_gather(std::as_bytes(std::span(failure)))) {
    if (text.empty()) continue;
    throw std::runtime_error(std::string(reinterpret_cast<const char*>(text.data()), text.size()));
  }
}

void Communicator::write_file(const std::filesystem::path& path, std::span<const Chunk> chunks) {
  const std::unique_ptr<SharedFile> file = create_file(path);
  file->write(chunks);
  file->publish(false);
}

}  // namespace npfem::flow
