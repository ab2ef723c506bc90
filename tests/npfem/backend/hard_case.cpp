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
      std::ofstream(path)
          << "# Hard cases\n\n"
             "What the cell solver does where solvers break: each case is a test with its bounds in\n"
             "`tests/npfem/backend/test_hard_cases.cpp`. This table is a snapshot of its output:\n"
             "`NPFEM_HARD_CASES=docs/hard_cases.md test_hard_cases`.\n\n"
             "*iterations*: most in one solve (above the cap of 200 in a step and 2000 at rest: Newton's\n"
             "method finished it); *errors*: worst after any solve, against the rest volume and area,\n"
             "elastic strain included. \"Plasma\": each vertex is dragged with its share of 6 pi eta a.\n\n"
          << text
          << "\nWithout a collapse barrier (`collapse_modulus`) the tension of the whole area\n"
             "(`global_area_modulus`) can hold triangles that have lost their own: area is the length of a\n"
             "vector, which has no slope at zero, so the minimum lies on a kink where no residual force\n"
             "vanishes. Scrambled vertices make such triangles, and so do 1000 pN where the neck behind a bead\n"
             "closes and the tips of cells in strong shear. The stretched cell is shown on its symmetric branch: with "
             "a disturbance of\n"
             "0.02 um it leaves it at 550 pN, and the neck closes at about 650 pN. The tweezers experiment\n"
             "ends at 200 pN.\n";
    }
  }
};
const auto* const table = ::testing::AddGlobalTestEnvironment(new Table);

}  // namespace
}  // namespace npfem::testing
