// SPDX-License-Identifier: MPL-2.0
#pragma once

// One process, no MPI.

#include "communicator/communicator.h"

namespace npfem::flow {

class SerialCommunicator final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void exchange(std::span<const Outgoing> outgoing, std::vector<Incoming>& incoming) override;
  void start_messages(std::span<const Outgoing> outgoing, std::span<const Expected> expected) override;
  void finish_messages() override {}
  void sum(std::span<double>) override {}
  void sum(std::span<std::int64_t>) override {}
  void minimum(std::span<double>) override {}
  void minimum(std::span<std::int64_t>) override {}
  void maximum(std::span<double>) override {}
  void maximum(std::span<std::int64_t>) override {}
  std::uint64_t sum_hash(std::uint64_t value) override { return value; }
  std::int64_t exclusive_scan(std::int64_t) override { return 0; }
  bool any(bool value) override { return value; }
  void broadcast(Bytes&, int) override {}
  std::vector<Bytes> gather(std::span<const std::byte> bytes, int root) override;
  std::vector<Bytes> all_gather(std::span<const std::byte> bytes) override;
  void barrier() override {}
  std::unique_ptr<SharedFile> create_file(const std::filesystem::path& path) override;
  [[noreturn]] void abort(int exit_code) noexcept override;
};

}  // namespace npfem::flow
