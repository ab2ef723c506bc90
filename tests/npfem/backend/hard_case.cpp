// SPDX-License-Identifier: MPL-2.0
#include "hard_case.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace npfem::testing {

std::vector<HardCase>& hard_cases() {
  static std::vector<HardCase> cases;
  return cases;
}

namespace {

std::string row(const HardCase& c) {
  char numbers[96];
  std::snprintf(numbers, sizeof numbers, "%d | %.1e | %.1e", c.iterations, c.volume_error, c.area_error);
  return "| " + c.name + " | " + c.back_end + " | " + c.outcome + " | " + numbers + " |\n";
}

class Table : public ::testing::Environment {
 public:
  void TearDown() override {
    std::string text =
        "| case | back end | outcome | iterations | volume error | area error |\n|---|---|---|---:|---:|---:|\n";
    for (const HardCase& c : hard_cases()) text += row(c);
    std::fputs(text.c_str(), stdout);
    if (const char* path = std::getenv("NPFEM_HARD_CASES")) {
      std::ofstream(path) << "# Hard cases\n\n"
                             "What the cell solver does where solvers break: each case is a test with its bounds in\n"
                             "`tests/npfem/backend/test_hard_cases.cpp`. This table is a snapshot of its output:\n"
                             "`NPFEM_HARD_CASES=docs/hard_cases.md test_hard_cases`.\n\n"
                             "*iterations*: most in one solve (a number above the cap of 200 or 2000 quasi-Newton\n"
                             "iterations: Newton's method finished it); *errors*: worst after any solve, against the\n"
                             "rest volume and area, elastic strain included.\n\n"
                          << text;
    }
  }
};
const auto* const table = ::testing::AddGlobalTestEnvironment(new Table);

}  // namespace
}  // namespace npfem::testing
