// SPDX-License-Identifier: MPL-2.0
#include "interrupt.h"

#include <csignal>

namespace npfem::app {
namespace {

volatile std::sig_atomic_t requested = 0;

void ask_to_save(int) {
  if (requested == 0) requested = static_cast<int>(Request::save);
}

void ask_to_end(int signal) {
  requested = static_cast<int>(Request::interrupt);
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_signals() {
  std::signal(SIGTERM, ask_to_save);
  std::signal(SIGUSR1, ask_to_save);
  std::signal(SIGINT, ask_to_end);
  std::signal(SIGXFSZ, SIG_IGN);
}

Request request() {
  return static_cast<Request>(static_cast<int>(requested));
}

}  // namespace npfem::app
