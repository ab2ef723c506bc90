// SPDX-License-Identifier: MPL-2.0
#include "interrupt.h"

#include <csignal>
#include <initializer_list>

namespace npfem::app {
namespace {

volatile std::sig_atomic_t requested = 0;

void request(int signal) {
  requested = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, request);
}

bool interrupt_requested() {
  return requested != 0;
}

}  // namespace npfem::app
