// SPDX-License-Identifier: MPL-2.0
#pragma once

// What the flow solver asks of a group of processes ("ranks"). Every call is collective unless it says otherwise: all
// ranks make it, in the same order. Calls are per phase of a time step, never per node.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace npfem::flow {

using Bytes = std::vector<std::byte>;

// Packs values behind what a message holds already.
template <class T>
void append(Bytes& message, std::span<const T> values) {
  const auto raw = std::as_bytes(values);
  message.insert(message.end(), raw.begin(), raw.end());
}

inline constexpr int kNoRank = -1;  // nobody: beyond a face of the domain that is not periodic

struct Outgoing {
  int destination = 0;
  std::span<const std::byte> bytes;
};

struct Incoming {
  int source = 0;
  Bytes bytes;
};

// A message whose length is known before it comes.
struct Expected {
  int source = 0;
  std::span<std::byte> bytes;
};

// A piece of a file, written at a byte offset from its beginning.
struct Chunk {
  std::int64_t offset = 0;
  std::span<const std::byte> bytes;
};

// A file that all ranks write together, piece by piece, under the name `path`.part until it is complete. Calls are
// collective. Where one fails, std::runtime_error is thrown on every rank with the path and the reason, and nothing of
// the name `path` has changed; a file that is not published leaves nothing behind.
class SharedFile {
 public:
  SharedFile() = default;
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  virtual ~SharedFile() = default;

  virtual void write(std::span<const Chunk> chunks) = 0;

  // The file takes the name `path`. `durable`: first waits until the disk has it, and then its name, so that the file
  // outlives a loss of power.
  virtual void publish(bool durable) = 0;
};

class Communicator {
 public:
  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;

  // Packed messages of any size, at most one per destination (one's own rank included); receivers need not know what
  // comes. `incoming` is replaced by the messages received, in order of source rank. Empty messages are not delivered.
  virtual void exchange(std::span<const Outgoing> outgoing, std::vector<Incoming>& incoming) = 0;

  // Messages between ranks that both know of them and their lengths, under way while the caller works on; one set at a
  // time. What the spans refer to must stay until finish_messages(). Called by the ranks concerned; no rank sends to
  // itself.
  virtual void start_messages(std::span<const Outgoing> outgoing, std::span<const Expected> expected) = 0;
  virtual void finish_messages() = 0;

  // Element by element over the ranks. The order of a floating-point sum is not fixed: for diagnostics only, never for
  // anything that steers the run.
  virtual void sum(std::span<double> values) = 0;
  virtual void sum(std::span<std::int64_t> values) = 0;
  virtual void minimum(std::span<double> values) = 0;
  virtual void minimum(std::span<std::int64_t> values) = 0;
  virtual void maximum(std::span<double> values) = 0;
  virtual void maximum(std::span<std::int64_t> values) = 0;

  virtual std::uint64_t sum_hash(std::uint64_t value) = 0;      // modulo 2^64: independent of order
  virtual std::int64_t exclusive_scan(std::int64_t value) = 0;  // sum over the lower ranks
  virtual bool any(bool value) = 0;                             // true on every rank if true on one
  virtual void broadcast(Bytes& bytes, int root) = 0;           // resized on the receivers
  virtual std::vector<Bytes> gather(std::span<const std::byte> bytes, int root) = 0;  // by rank; empty off the root
  virtual std::vector<Bytes> all_gather(std::span<const std::byte> bytes) = 0;        // by rank
  virtual void barrier() = 0;

  // Creates `path`.part, replacing one left by a run that died. std::runtime_error on every rank where it cannot.
  virtual std::unique_ptr<SharedFile> create_file(const std::filesystem::path& path) = 0;

  // Creates or replaces the file: each rank writes its chunks, and a reader never meets half a file. Fails as
  // SharedFile does.
  void write_file(const std::filesystem::path& path, std::span<const Chunk> chunks);

  // Ends all ranks at once; the program's way out when one rank fails alone. Not collective.
  [[noreturn]] virtual void abort(int exit_code) noexcept = 0;

  // Turns a failure met by some ranks (`failure` not empty) into a std::runtime_error on all of them, with the message
  // of the lowest such rank.
  void agree(const std::string& failure);
};

}  // namespace npfem::flow
