// SPDX-License-Identifier: MPL-2.0
#include "communicator/mpi_communicator.h"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "communicator/part_file.h"

namespace npfem::flow {
namespace {

constexpr int kExchangeTag = 1;  // and the next
constexpr int kMessageTag = 3;
constexpr std::size_t kLargestWrite = std::size_t{1} << 30;  // one MPI call counts in int

int count_of(std::size_t size) {
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::length_error("a message of " + std::to_string(size) +
                            " items; MPI sends at most 2147483647: use more ranks");
  }
  return static_cast<int>(size);
}

// A waiting rank spins by default, and starves the rank it waits for where they share a processor.
void yield_when_oversubscribed() {
  const char* local_ranks = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  if (local_ranks == nullptr) return;
  if (std::strtoul(local_ranks, nullptr, 10) > std::thread::hardware_concurrency()) {
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  }
}

class MpiSession {
 public:
  MpiSession(int* argc, char*** argv) {
    int started = 0;
    MPI_Initialized(&started);
    if (started != 0) throw std::logic_error("MPI is started once in a process, and it has been");
    yield_when_oversubscribed();
    int provided = 0;
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
  }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession() { MPI_Finalize(); }
};

std::string mpi_message(int error) {
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(error, text.data(), &length);
  return {text.data(), static_cast<std::size_t>(length)};
}

template <class T>
void reduce(std::span<T> values, MPI_Datatype type, MPI_Op operation) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), count_of(values.size()), type, operation, MPI_COMM_WORLD);
}

// What is left of a rank's chunks, handed out in pieces that one MPI call can write.
class ChunkQueue {
 public:
  explicit ChunkQueue(std::span<const Chunk> chunks) : chunks_(chunks) {}

  Chunk next() {
    while (!chunks_.empty() && done_ == chunks_.front().bytes.size()) {
      chunks_ = chunks_.subspan(1);
      done_ = 0;
    }
    if (chunks_.empty()) return {};
    const Chunk& chunk = chunks_.front();
    const std::size_t size = std::min(kLargestWrite, chunk.bytes.size() - done_);
    const Chunk piece{chunk.offset + static_cast<std::int64_t>(done_), chunk.bytes.subspan(done_, size)};
    done_ += size;
    return piece;
  }

 private:
  std::span<const Chunk> chunks_;
  std::size_t done_ = 0;
};

class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator(int* argc, char*** argv) : session_(argc, argv) {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void exchange(std::span<const Outgoing> outgoing, std::vector<Incoming>& incoming) override;
  void start_messages(std::span<const Outgoing> outgoing, std::span<const Expected> expected) override;
  void finish_messages() override;

  void sum(std::span<double> values) override { reduce(values, MPI_DOUBLE, MPI_SUM); }
  void sum(std::span<std::int64_t> values) override { reduce(values, MPI_INT64_T, MPI_SUM); }
  void minimum(std::span<double> values) override { reduce(values, MPI_DOUBLE, MPI_MIN); }
  void minimum(std::span<std::int64_t> values) override { reduce(values, MPI_INT64_T, MPI_MIN); }
  void maximum(std::span<double> values) override { reduce(values, MPI_DOUBLE, MPI_MAX); }
  void maximum(std::span<std::int64_t> values) override { reduce(values, MPI_INT64_T, MPI_MAX); }
  std::uint64_t sum_hash(std::uint64_t value) override {
    reduce(std::span(&value, 1), MPI_UINT64_T, MPI_SUM);
    return value;
  }
  std::int64_t exclusive_scan(std::int64_t value) override {
    std::int64_t below = 0;  // MPI leaves it as it is on rank 0
    MPI_Exscan(&value, &below, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return rank_ == 0 ? 0 : below;
  }
  bool any(bool value) override {
    int found = value ? 1 : 0;
    reduce(std::span(&found, 1), MPI_INT, MPI_MAX);
    return found != 0;
  }
  void broadcast(Bytes& bytes, int root) override;
  std::vector<Bytes> gather(std::span<const std::byte> bytes, int root) override;
  std::vector<Bytes> all_gather(std::span<const std::byte> bytes) override;
  void barrier() override { MPI_Barrier(MPI_COMM_WORLD); }
  std::unique_ptr<SharedFile> create_file(const std::filesystem::path& path) override;
  [[noreturn]] void abort(int exit_code) noexcept override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

 private:
  void take_what_has_come(int tag, std::vector<Incoming>& incoming);
  MpiSession session_;
  int rank_ = 0;
  int size_ = 1;
  int exchanges_ = 0;  // calls of exchange(), modulo 2
  std::vector<MPI_Request> requests_;
  std::vector<MPI_Request> messages_;  // of start_messages()
};

// Nobody knows who will write to him. Each rank takes what comes until all know that all has been taken: a message sent
// in synchronous mode is done when its receiver has begun to take it, and the barrier, entered when one's own messages
// are done, is complete when everybody's are (Hoefler, Siebert & Lumsdaine 2010, "NBX"). The work of a rank grows with
// its neighbours, not with the number of ranks. Tags alternate: a rank that has left may be writing again already.
void MpiCommunicator::exchange(std::span<const Outgoing> outgoing, std::vector<Incoming>& incoming) {
  const int tag = kExchangeTag + exchanges_;
  exchanges_ = 1 - exchanges_;
  incoming.clear();
  requests_.clear();
  for (const Outgoing& message : outgoing) {
    if (message.destination < 0 || message.destination >= size_) {
      throw std::invalid_argument("a message to a rank that does not exist");
    }
    if (message.bytes.empty()) continue;
    if (message.destination == rank_) {
      incoming.push_back({rank_, Bytes(message.bytes.begin(), message.bytes.end())});
      continue;
    }
    MPI_Issend(message.bytes.data(), count_of(message.bytes.size()), MPI_BYTE, message.destination, tag, MPI_COMM_WORLD,
               &requests_.emplace_back());
  }
  if (size_ == 1) return;
  MPI_Request barrier = MPI_REQUEST_NULL;
  for (bool all_taken = false; !all_taken;) {
    take_what_has_come(tag, incoming);
    int done = 0;
    if (barrier == MPI_REQUEST_NULL) {
      MPI_Testall(count_of(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE);
      if (done != 0) MPI_Ibarrier(MPI_COMM_WORLD, &barrier);
    } else {
      MPI_Test(&barrier, &done, MPI_STATUS_IGNORE);
      all_taken = done != 0;
    }
  }
  std::sort(incoming.begin(), incoming.end(), [](const Incoming& x, const Incoming& y) { return x.source < y.source; });
}

void MpiCommunicator::take_what_has_come(int tag, std::vector<Incoming>& incoming) {
  for (int waiting = 1; waiting != 0;) {
    MPI_Status status;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Improbe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &waiting, &message, &status);
    if (waiting == 0) return;
    int bytes = 0;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    Incoming& arrived = incoming.emplace_back(Incoming{status.MPI_SOURCE, Bytes(static_cast<std::size_t>(bytes))});
    MPI_Mrecv(arrived.bytes.data(), bytes, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  }
}

void MpiCommunicator::start_messages(std::span<const Outgoing> outgoing, std::span<const Expected> expected) {
  messages_.clear();
  for (const Expected& message : expected) {
    MPI_Irecv(message.bytes.data(), count_of(message.bytes.size()), MPI_BYTE, message.source, kMessageTag,
              MPI_COMM_WORLD, &messages_.emplace_back());
  }
  for (const Outgoing& message : outgoing) {
    MPI_Isend(message.bytes.data(), count_of(message.bytes.size()), MPI_BYTE, message.destination, kMessageTag,
              MPI_COMM_WORLD, &messages_.emplace_back());
  }
}

void MpiCommunicator::finish_messages() {
  MPI_Waitall(count_of(messages_.size()), messages_.data(), MPI_STATUSES_IGNORE);
  messages_.clear();
}

void MpiCommunicator::broadcast(Bytes& bytes, int root) {
  std::int64_t size = std::ssize(bytes);
  MPI_Bcast(&size, 1, MPI_INT64_T, root, MPI_COMM_WORLD);
  bytes.resize(static_cast<std::size_t>(size));
  MPI_Bcast(bytes.data(), count_of(bytes.size()), MPI_BYTE, root, MPI_COMM_WORLD);
}

std::vector<Bytes> MpiCommunicator::gather(std::span<const std::byte> bytes, int root) {
  std::vector<Incoming> incoming;
  const Outgoing message{root, bytes};
  exchange(std::span(&message, 1), incoming);
  if (rank_ != root) return {};
  std::vector<Bytes> by_rank(static_cast<std::size_t>(size_));
  for (Incoming& received : incoming) by_rank[static_cast<std::size_t>(received.source)] = std::move(received.bytes);
  return by_rank;
}

std::vector<Bytes> MpiCommunicator::all_gather(std::span<const std::byte> bytes) {
  std::vector<Outgoing> outgoing;
  for (int destination = 0; destination < size_; ++destination) outgoing.push_back({destination, bytes});
  std::vector<Incoming> incoming;
  exchange(outgoing, incoming);
  std::vector<Bytes> by_rank(static_cast<std::size_t>(size_));
  for (Incoming& received : incoming) by_rank[static_cast<std::size_t>(received.source)] = std::move(received.bytes);
  return by_rank;
}

class MpiFile final : public SharedFile {
 public:
  MpiFile(Communicator& communicator, const std::filesystem::path& path) : communicator_(communicator), path_(path) {
    communicator.agree(first() ? create_part(path) : "");
    const int error = MPI_File_open(MPI_COMM_WORLD, part_of(path).c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_);
    // where it opened on some ranks only it cannot be closed, which takes all
    if (communicator.any(error != MPI_SUCCESS)) file_ = MPI_FILE_NULL;
    agree(error == MPI_SUCCESS ? "" : mpi_message(error));
  }
  ~MpiFile() override {
    if (file_ == MPI_FILE_NULL) return;
    MPI_File_close(&file_);
    if (first()) discard_part(path_);
  }

  void write(std::span<const Chunk> chunks) override {
    ChunkQueue queue(chunks);
    std::string reason;
    for (Chunk piece = queue.next(); communicator_.any(!piece.bytes.empty()); piece = queue.next()) {
      MPI_Status status;
      const int bytes = count_of(piece.bytes.size());
      const int error = MPI_File_write_at_all(file_, piece.offset, piece.bytes.data(), bytes, MPI_BYTE, &status);
      if (error != MPI_SUCCESS && reason.empty()) reason = mpi_message(error);
    }
    agree(reason);
    end_ = std::max(end_, end_of(chunks));
  }

  void publish(bool durable) override {
    const int synced = durable ? MPI_File_sync(file_) : MPI_SUCCESS;
    agree(synced == MPI_SUCCESS ? "" : mpi_message(synced));
    const int closed = MPI_File_close(&file_);
    file_ = MPI_FILE_NULL;
    agree(closed == MPI_SUCCESS ? "" : mpi_message(closed));
    communicator_.maximum(std::span(&end_, 1));
    communicator_.agree(first() ? publish_part(path_, end_, durable) : "");
  }

 private:
  bool first() const { return communicator_.rank() == 0; }

  // A failure of one is the end of the file on all.
  void agree(const std::string& reason) {
    if (!communicator_.any(!reason.empty())) return;
    if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
    file_ = MPI_FILE_NULL;
    if (first()) discard_part(path_);
    communicator_.agree(reason.empty() ? "" : write_failure(path_, reason));
  }

  Communicator& communicator_;
  std::filesystem::path path_;
  MPI_File file_ = MPI_FILE_NULL;
  std::int64_t end_ = 0;
};

std::unique_ptr<SharedFile> MpiCommunicator::create_file(const std::filesystem::path& path) {
  return std::make_unique<MpiFile>(*this, path);
}

}  // namespace

std::unique_ptr<Communicator> make_mpi_communicator(int* argc, char*** argv) {
  return std::make_unique<MpiCommunicator>(argc, argv);
}

}  // namespace npfem::flow
