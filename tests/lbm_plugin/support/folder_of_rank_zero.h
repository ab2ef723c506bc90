// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <cstring>
#include <filesystem>
#include <string>

#include "communicator/communicator.h"
#include "mpi_environment.h"
#include "scratch_folder.h"

/// Every rank makes a scratch folder; all of them write into that of rank 0.
inline std::filesystem::path folder_of_rank_zero(const ScratchFolder& own) {
  std::string path = own.path().string();
  npfem::flow::Bytes bytes(path.size());
  std::memcpy(bytes.data(), path.data(), path.size());
  world().broadcast(bytes, 0);
  path.assign(bytes.size(), ' ');
  std::memcpy(path.data(), bytes.data(), bytes.size());
  return path;
}
