// SPDX-License-Identifier: MPL-2.0
#include "communicator/serial_communicator.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "communicator/part_file.h"

namespace npfem::flow {
namespace {

std::string last_reason() {
  return std::generic_category().message(errno);
}

class SerialFile final : public SharedFile {
 public:
  explicit SerialFile(const std::filesystem::path& path) : path_(path) {
    file_ = std::fopen(part_of(path).c_str(), "wb");
    if (file_ == nullptr) throw std::runtime_error(write_failure(path, last_reason()));
  }
  ~SerialFile() override {
    if (file_ == nullptr) return;
    std::fclose(file_);
    discard_part(path_);
  }

  void write(std::span<const Chunk> chunks) override {
    for (const Chunk& chunk : chunks) {
      if (chunk.bytes.empty()) continue;
      if (fseeko(file_, chunk.offset, SEEK_SET) != 0 ||
          std::fwrite(chunk.bytes.data(), 1, chunk.bytes.size(), file_) != chunk.bytes.size()) {
        throw std::runtime_error(write_failure(path_, last_reason()));
      }
    }
    end_ = std::max(end_, end_of(chunks));
  }

  void publish(bool durable) override {
    if (std::fclose(std::exchange(file_, nullptr)) != 0) {
      const std::string failure = write_failure(path_, last_reason());
      discard_part(path_);
      throw std::runtime_error(failure);
    }
    if (const std::string failure = publish_part(path_, end_, durable); !failure.empty()) {
      throw std::runtime_error(failure);
    }
  }

 private:
  std::filesystem::path path_;
  std::FILE* file_;  // none once it is closed
  std::int64_t end_ = 0;
};

}  // namespace

void SerialCommunicator::exchange(std::span<const Outgoing> outgoing, std::vector<Incoming>& incoming) {
  incoming.clear();
  for (const Outgoing& message : outgoing) {
    if (message.destination != 0) throw std::invalid_argument("a message to a rank that does not exist");
    if (!message.bytes.empty()) incoming.push_back({0, Bytes(message.bytes.begin(), message.bytes.end())});
  }
}

void SerialCommunicator::start_messages(std::span<const Outgoing> outgoing, std::span<const Expected> expected) {
  if (!outgoing.empty() || !expected.empty()) throw std::invalid_argument("a message to a rank that does not exist");
}

std::vector<Bytes> SerialCommunicator::gather(std::span<const std::byte> bytes, int) {
  return all_gather(bytes);
}

std::vector<Bytes> SerialCommunicator::all_gather(std::span<const std::byte> bytes) {
  return {Bytes(bytes.begin(), bytes.end())};
}

std::unique_ptr<SharedFile> SerialCommunicator::create_file(const std::filesystem::path& path) {
  return std::make_unique<SerialFile>(path);
}

void SerialCommunicator::abort(int exit_code) noexcept {
  std::_Exit(exit_code);
}

}  // namespace npfem::flow
