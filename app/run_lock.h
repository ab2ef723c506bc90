// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "session.h"

namespace npfem::app {

/// One run at a time in an output folder: two would cut, replace and remove each other's files. Held by one process of
/// the run while it lasts, as an exclusive flock() on the file "run.lock" in the folder. The kernel lets go of it with
/// the process however that ends; the file is removed at the end, and one that a killed run has left locks nobody out.
///
/// Between machines that share the folder it acts where the file system passes locks on: NFS does (from Linux 2.6.12 on
/// as a lock on the bytes of the file; not when mounted with nolock or local_lock), Lustre when mounted with flock. One
/// that knows no locks at all cannot be guarded: held() is then false.
class RunLock {
 public:
  /// text::FileError where another run holds the folder, or where it cannot be written to.
  explicit RunLock(const std::filesystem::path& folder);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  bool held() const { return file_ >= 0; }

 private:
  std::string path_;
  int file_ = -1;
};

/// Locks the folder for the whole group of processes; the first one holds the lock, the others get nothing. Warns where
/// the file system knows no locks. text::FileError on every rank.
std::unique_ptr<RunLock> lock_run(Session& session, const std::filesystem::path& folder);

}  // namespace npfem::app
