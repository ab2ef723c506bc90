// SPDX-License-Identifier: MPL-2.0
#include "import/lineage_xml.h"

#include <gtest/gtest.h>

#include "quantity.h"

namespace npfem::flow {
namespace {

const std::string sample = R"(<?xml version="1.0" ?>

<Type> Shear_Flow </Type>
<!--> a comment with <tags> and -- in it <-->
<System>
    <dx_p> 0.5 </dx_p> <!--> um <-->
    <flag> TRUE </flag>
    <empty></empty>
    <none/>
    <weight> 250. </weight>
    <tol> 1e-5 </tol>
</System>
<Other note="x"><dx_p>7</dx_p></Other>)";

std::string error_of(const std::string& text) {
  try {
    LineageXml::parse(text, "p.xml");
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

template <class Call>
std::string error_at(const Call& call) {
  try {
    call(LineageXml::parse(sample, "p.xml"));
  } catch (const text::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(LineageXml, HasManyTopLevelElementsAndOddComments) {
  const LineageXml xml = LineageXml::parse(sample, "p.xml");
  EXPECT_EQ(xml.text("Type"), "Shear_Flow");
  EXPECT_EQ(xml.number("System/dx_p"), 0.5);
  EXPECT_EQ(xml.number("Other/dx_p"), 7);
  EXPECT_EQ(xml.number("System/weight"), 250);
  EXPECT_EQ(xml.positive("System/tol"), 1e-5);
  EXPECT_TRUE(xml.boolean("System/flag"));
  EXPECT_EQ(xml.text("System/empty"), "");
  EXPECT_EQ(xml.text("System/none"), "");
  EXPECT_EQ(xml.whole_number("Other/dx_p", 1), 7);
}

TEST(LineageXml, ErrorsNameFileLineAndKey) {
  EXPECT_EQ(error_at([](const LineageXml& xml) { xml.number("System/dxp"); }),
            "p.xml: missing key System/dxp; there is System/dx_p in line 6");
  EXPECT_EQ(error_at([](const LineageXml& xml) { xml.number("Type"); }),
            "p.xml:3: Type: found \"Shear_Flow\" where a number is needed");
  EXPECT_EQ(error_at([](const LineageXml& xml) { xml.boolean("System/dx_p"); }),
            "p.xml:6: System/dx_p: found \"0.5\" where true or false is needed");
  EXPECT_EQ(error_at([](const LineageXml& xml) { xml.whole_number("System/dx_p", 1); }),
            "p.xml:6: System/dx_p: 0.5 is not allowed: a whole number from 1 on is needed");
}

TEST(LineageXml, BrokenFilesAreRefused) {
  EXPECT_EQ(error_of("<a>\n<b> 1 </a>"), "p.xml:2: </a> closes another element than the last one opened, in line 2");
  EXPECT_EQ(error_of("<a> 1"), "p.xml:1: <a> is not closed");
  EXPECT_EQ(error_of("</a>"), "p.xml:1: </a> closes nothing");
  EXPECT_EQ(error_of("<a> 1 </a>\n<a> 2 </a>"), "p.xml:2: a is given already, in line 1");
  EXPECT_EQ(error_of("\n<!--> comment >"), "p.xml:2: found a comment that does not end");
  EXPECT_EQ(error_of("<a"), "p.xml:1: found a tag that does not end");
  EXPECT_EQ(error_of("<>"), "p.xml:1: found a tag without a name");
  EXPECT_EQ(error_of("text"), "p.xml:1: found text outside of any element");
}

}  // namespace
}  // namespace npfem::flow
