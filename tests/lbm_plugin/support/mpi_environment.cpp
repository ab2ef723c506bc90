// SPDX-License-Identifier: MPL-2.0
#include "mpi_environment.h"

#include <gtest/gtest.h>

#include <iostream>
#include <memory>
#include <string>

#include "communicator/mpi_communicator.h"

namespace {

std::unique_ptr<npfem::flow::Communicator> communicator;

// Rank 0 reports everything; the others only what fails, with their number.
class FailuresOnly : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    name_ = std::string(test.test_suite_name()) + "." + test.name();
  }
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::cerr << "rank " << communicator->rank() << ", " << name_ << ": "
              << (result.file_name() ? result.file_name() : "") << ':' << result.line_number() << ": "
              << result.summary() << '\n';
  }
  std::string name_;  // GoogleTest holds its lock while it reports a result: it cannot be asked then
};

}  // namespace

npfem::flow::Communicator& world() {
  return *communicator;
}

int main(int argc, char** argv) {
  communicator = npfem::flow::make_mpi_communicator(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (communicator->rank() != 0) {
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailuresOnly);
  }
  const int result = RUN_ALL_TESTS();
  communicator.reset();
  return result;
}
