// SPDX-License-Identifier: MPL-2.0
#include "run_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>

#include "file.h"
#include "output/run_output.h"

namespace npfem::app {
namespace {

/// Whether the open file is still the one of that name: the run that held it may have removed it meanwhile.
bool is_at(int file, const std::string& path) {
  struct stat open {
  }, named{};
  return fstat(file, &open) == 0 && stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

/// errno of the attempt; 0 where it holds.
int try_lock(int file) {
  int result = 0;
  do {
    result = flock(file, LOCK_EX | LOCK_NB);
  } while (result != 0 && errno == EINTR);
  return result == 0 ? 0 : errno;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder) : path_((folder / flow::lock_file_name).string()) {
  for (;;) {
    const int file = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) throw text::FileError("cannot write \"" + path_ + "\": " + std::strerror(errno));
    const int error = try_lock(file);
    if (error == 0 && is_at(file, path_)) {
      file_ = file;
      return;
    }
    close(file);
    if (error == 0) continue;
    if (error == EWOULDBLOCK) {
      throw text::FileError("another npfem is at work in the folder \"" + folder.string() +
                            "\"; wait until it has ended, or stop it with SIGTERM, which saves its state, and resume "
                            "then; a new run needs another folder");
    }
    unlink(path_.c_str());  // the file system knows no locks
    return;
  }
}

RunLock::~RunLock() {
  if (!held()) return;
  unlink(path_.c_str());  // before letting go: whoever opened it meanwhile sees that it is no longer at its place
  close(file_);
}

std::unique_ptr<RunLock> lock_run(Session& session, const std::filesystem::path& folder) {
  std::unique_ptr<RunLock> lock;
  on_first_rank(session, [&] { lock = std::make_unique<RunLock>(folder); });
  if (lock && !lock->held()) {
    std::cerr << "npfem: the file system of \"" << folder.string()
              << "\" knows no locks: see to it that no second run works there\n";
  }
  return lock;
}

}  // namespace npfem::app
