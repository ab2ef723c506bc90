// SPDX-License-Identifier: MPL-2.0
#include "communicator/serial_communicator.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "communicator/part_file.h"

namespace npfem::flow {
namespace {

// Returns errno of the first call that fails, 0 on success.
int write_chunks(const std::filesystem::path& part, std::span<const Chunk> chunks) {
  std::FILE* file = std::fopen(part.c_str(), "r+b");
  if (file == nullptr) return errno;
  int failure = 0;
  for (const Chunk& chunk : chunks) {
    if (chunk.bytes.empty()) continue;
    const bool written = fseeko(file, chunk.offset, SEEK_SET) == 0 &&
                         std::fwrite(chunk.bytes.data(), 1, chunk.bytes.size(), file) == chunk.bytes.size();
    if (!written && failure == 0) failure = errno;
  }
  if (std::fclose(file) != 0 && failure == 0) failure = errno;
  return failure;
}

std::int64_t end_of(std::span<const Chunk> chunks) {
  std::int64_t end = 0;
  for (const Chunk& chunk : chunks) {
    if (!chunk.bytes.empty()) end = std::max(end, chunk.offset + std::ssize(chunk.bytes));
  }
  return end;
}

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

void SerialCommunicator::write_file(const std::filesystem::path& path, std::span<const Chunk> chunks) {
  agree(create_part(path));
  if (const int failure = write_chunks(part_of(path), chunks); failure != 0) {
    discard_part(path);
    agree(write_failure(path, std::generic_category().message(failure)));
  }
  agree(publish_part(path, end_of(chunks)));
}

void SerialCommunicator::abort(int exit_code) noexcept {
  std::_Exit(exit_code);
}

}  // namespace npfem::flow
