// SPDX-License-Identifier: MPL-2.0
#include "communicator/serial_communicator.h"
#include "session.h"

namespace npfem::app {

std::unique_ptr<flow::Communicator> make_communicator(int*, char***) {
  return std::make_unique<flow::SerialCommunicator>();
}

}  // namespace npfem::app
