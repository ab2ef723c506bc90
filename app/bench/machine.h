// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>

namespace npfem::app::bench {

std::string cpu_name();
int core_count();
/// Programs that wanted a core in the last minute, on average; -1 where the system does not tell.
double load_average();
/// Bytes of the heap in use; 0 where the system does not tell.
double heap_bytes();

}  // namespace npfem::app::bench
