// SPDX-License-Identifier: MPL-2.0
#include "nearest.h"

#include <gtest/gtest.h>

namespace npfem::text {
namespace {

TEST(EditDistance, CountsSlips) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("viscosty", "viscosity"), 1);
  EXPECT_EQ(edit_distance("sheer", "shear"), 1);
  EXPECT_EQ(edit_distance("hsear", "shear"), 1) << "two neighbours swapped";
  EXPECT_EQ(edit_distance("ca", "abc"), 3) << "optimal string alignment";
}

TEST(EditDistance, IsSymmetric) {
  const std::string words[] = {"shear", "sheer", "tube", "tub", "", "plates", "paltes"};
  for (const auto& a : words) {
    for (const auto& b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
  }
}

TEST(Nearest, FindsLikelySlipsOnly) {
  const std::vector<std::string> words = {"shear", "tube", "plates"};
  EXPECT_EQ(nearest("paltes", words), "plates");
  EXPECT_EQ(nearest("tueb", words), "tube");
  EXPECT_EQ(nearest("obstacle", words), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), words), "");
  EXPECT_EQ(nearest("x", {}), "");
}

TEST(Suggestion, ListsWhatIsAllowed) {
  EXPECT_EQ(suggestion("shaer", {"shear", "tube"}), "; did you mean \"shear\"? allowed: shear, tube");
  EXPECT_EQ(suggestion("zzzzzz", {"shear", "tube"}, "known keys"), "; known keys: shear, tube");
  EXPECT_EQ(suggestion("a", {}), "; allowed: none");
}

}  // namespace
}  // namespace npfem::text
