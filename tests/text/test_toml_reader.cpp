// SPDX-License-Identifier: MPL-2.0
#include "toml_reader.h"

#include <gtest/gtest.h>

#include <random>

#include "mutate.h"

namespace npfem::text {
namespace {

constexpr Key dx{.name = "dx", .dimension = Dimension::length(), .range = Range::positive, .doc = "lattice spacing"};
constexpr Key haematocrit{.name = "haematocrit", .range = Range::fraction, .fallback = "20 %"};
constexpr Key steps{.name = "steps", .kind = Kind::integer, .range = Range::positive, .fallback = "10"};
constexpr Key periodic{.name = "periodic", .kind = Kind::boolean, .fallback = "true"};
constexpr Key title{.name = "title", .kind = Kind::text, .fallback = "\"a run\""};
constexpr Key kind{.name = "kind", .kind = Kind::choice, .choices = "shear tube plates", .fallback = "shear"};
constexpr Key size{.name = "size", .kind = Kind::vector3, .dimension = Dimension::length()};
constexpr Key forces{.name = "forces", .kind = Kind::quantities, .dimension = Dimension::force()};
constexpr Key restart{.name = "restart", .kind = Kind::text, .fallback = optional};

Document document(const std::string& text) {
  return Document::parse_text(text, "scene.toml");
}

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Reader, FetchesEveryKind) {
  const Document doc = document(
      "dx = '0.5 um'\nhaematocrit = 0.4\nsteps = 7\nperiodic = false\ntitle = 'x'\nkind = 'tube'\n"
      "size = ['20 um', '0.02 mm', '5e-5 m']\nforces = ['3 pN', '-1 nN']\n");
  const Table root = doc.root();
  EXPECT_EQ(root.quantity(dx), 0.5);
  EXPECT_EQ(root.quantity(haematocrit), 0.4);
  EXPECT_EQ(root.integer(steps), 7);
  EXPECT_FALSE(root.boolean(periodic));
  EXPECT_EQ(root.text(title), "x");
  EXPECT_EQ(root.choice(kind), "tube");
  EXPECT_EQ(root.vector3(size), (std::array<double, 3>{20, 20, 50}));
  EXPECT_EQ(root.quantities(forces), (std::vector<double>{3, -1000}));
  EXPECT_FALSE(root.has(restart));
  root.finish();
}

TEST(Reader, FillsInFallbacksAndWritesThemBack) {
  const Document doc = document("dx = '0.5 um'\n");
  const Table root = doc.root();
  EXPECT_EQ(root.quantity(haematocrit), 0.2);
  EXPECT_EQ(root.integer(steps), 10);
  EXPECT_TRUE(root.boolean(periodic));
  EXPECT_EQ(root.choice(kind), "shear");
  EXPECT_EQ(root.text(title), "a run");
  EXPECT_EQ(root.quantity(dx), 0.5);
  root.finish();
  EXPECT_EQ(
      doc.to_toml(),
      "dx = \"0.5 um\"\nhaematocrit = \"20 %\"\nsteps = 10\nperiodic = true\nkind = \"shear\"\ntitle = \"a run\"\n");
}

TEST(Reader, TellsTheLineOfAWrongValue) {
  const auto read = [](const std::string& text, auto&& fetch) {
    return message_of([&] {
      const Document doc = document(text);
      fetch(doc.root().table("fluid"));
    });
  };
  const auto fetch_dx = [](const Table& t) { t.quantity(dx); };
  EXPECT_EQ(read("\n[fluid]\n  dx = 0.5\n", fetch_dx),
            "scene.toml:3:8: fluid.dx: 0.5 has no unit; a length, like \"1 um\" is needed");
  EXPECT_EQ(read("[fluid]\ndx = '-1 um'\n", fetch_dx), "scene.toml:2:6: fluid.dx: \"-1 um\" must be greater than 0");
  EXPECT_EQ(read("[fluid]\ndx = nan\n", fetch_dx),
            "scene.toml:2:6: fluid.dx: nan has no unit; a length, like \"1 um\" is needed");
  EXPECT_EQ(read("[fluid]\n", fetch_dx), "scene.toml:1:1: missing key \"fluid.dx\": a length, like \"1 um\" is needed");
  EXPECT_EQ(read("", fetch_dx), "scene.toml: missing key \"fluid.dx\": a length, like \"1 um\" is needed");
  EXPECT_EQ(read("[fluid]\nkind = 'tueb'\n", [](const Table& t) { t.choice(kind); }),
            "scene.toml:2:8: fluid.kind: unknown word \"tueb\"; did you mean \"tube\"? allowed: shear, tube, plates");
  EXPECT_EQ(read("[fluid]\nsteps = 1.5\n", [](const Table& t) { t.integer(steps); }),
            "scene.toml:2:9: fluid.steps: found 1.5, but an integer is needed, like 100");
  EXPECT_EQ(read("[fluid]\nhaematocrit = nan\n", [](const Table& t) { t.quantity(haematocrit); }),
            "scene.toml:2:15: fluid.haematocrit: nan is not a finite number");
  EXPECT_EQ(read("[fluid]\nhaematocrit = 1.5\n", [](const Table& t) { t.quantity(haematocrit); }),
            "scene.toml:2:15: fluid.haematocrit: 1.5 must lie between 0 and 1");
  EXPECT_EQ(read("[fluid]\nsize = ['1 um', '2 um']\n", [](const Table& t) { t.vector3(size); }),
            "scene.toml:2:8: fluid.size: found 2 items, but a list of three, each a length, like \"1 um\" is needed");
  EXPECT_EQ(read("fluid = 3\n", fetch_dx), "scene.toml:1:9: fluid: found 3, but a table is needed");
  EXPECT_EQ(read("[fluid]\ndx = 1979-05-27\n", fetch_dx),
            "scene.toml:2:6: dates and times mean nothing here; put text in quotes");
  EXPECT_EQ(read("[fluid]\nrestart = 'x'\n", [](const Table& t) { t.fail("restart", "is not a checkpoint"); }),
            "scene.toml:2:11: fluid.restart: is not a checkpoint");
}

TEST(Reader, RefusesUnknownKeysWithTheNearestOne) {
  const std::string message = message_of([] {
    const Document doc = document("[fluid]\ndx = '1 um'\nstesp = 3\n");
    const Table fluid = doc.root().table("fluid");
    fluid.quantity(dx);
    fluid.integer(steps);
    doc.root().finish();
  });
  EXPECT_EQ(message, "scene.toml:3:1: unknown key \"stesp\" in [fluid]; did you mean \"steps\"? known keys: dx, steps");
  EXPECT_EQ(message_of([] { document("a = 1\n").root().finish(); }),
            "scene.toml:1:1: unknown key \"a\" at the top level; known keys: none");
}

TEST(Reader, FindsUnknownKeysInArraysOfTables) {
  const Document doc = document("[[cells]]\nsteps = 1\n[[cells]]\nsteps = 2\nfoo = 3\n");
  const auto cells = doc.root().tables("cells");
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[1].path(), "cells[1]");
  EXPECT_EQ(cells[0].integer(steps) + cells[1].integer(steps), 3);
  EXPECT_EQ(message_of([&] { doc.root().finish(); }),
            "scene.toml:5:1: unknown key \"foo\" in [cells[1]]; known keys: steps");
  EXPECT_TRUE(doc.root().tables("walls").empty());
}

TEST(Overrides, ReplaceAndCreate) {
  Document doc = document("[run]\nsteps = 1\n[[cells]]\nkind = 'tube'\n");
  doc.set("run.steps=100");
  doc.set("cells[0].kind", "plates");
  doc.set("fluid.dx", "0.25 um");
  EXPECT_EQ(doc.root().table("run").integer(steps), 100);
  EXPECT_EQ(doc.root().tables("cells")[0].choice(kind), "plates");
  EXPECT_EQ(doc.root().table("fluid").quantity(dx), 0.25);
  doc.root().finish();
}

TEST(Overrides, AreNamedInMessages) {
  Document doc = document("[run]\nsteps = 1\n");
  doc.set("run.steps=many");
  EXPECT_EQ(message_of([&] { doc.root().table("run").integer(steps); }),
            "--set run.steps=many: run.steps: found \"many\", but an integer is needed, like 100");
  EXPECT_EQ(message_of([&] { doc.set("run"); }), "--set run: write --set path=value, like --set run.steps=100");
  EXPECT_EQ(message_of([&] { doc.set("run..x=1"); }), "--set run..x=1: a path looks like run.steps or cells[0].count");
  EXPECT_EQ(message_of([&] { doc.set("cells[3].x=1"); }),
            "--set cells[3].x=1: there is no cells[3]; the document has 0");
  EXPECT_EQ(message_of([&] { doc.set("run.steps.x=1"); }), "--set run.steps.x=1: steps is not a table");
  doc.set("run.setps=1");
  EXPECT_EQ(message_of([&] { doc.root().finish(); }).substr(0, 36), "--set run.setps=1: unknown key \"setp");
}

TEST(Overrides, CannotSmuggleInASecondKey) {
  Document doc = document("");
  doc.set("title", "1\nsteps = 5");
  EXPECT_EQ(doc.root().text(title), "1\nsteps = 5");
  EXPECT_EQ(doc.root().integer(steps), 10);
}

TEST(Document, WrittenBackReadsTheSame) {
  const std::string text =
      "a = 1\nb = 0.1\nc = \"tab\\t \\\"quoted\\\" \\u0001\"\nd = [1, 2.0, [\"x\"]]\ninline = { p = 1, \"odd key\" = 2 "
      "}\n"
      "[t]\nx = -1e-300\n[t.u]\ny = true\n[[l]]\nn = 1\n[[l]]\nn = 2\n[l.deep]\nm = inf\n";
  const std::string once = document(text).to_toml();
  EXPECT_EQ(document(once).to_toml(), once);
  EXPECT_NE(once.find("[[l]]\nn = 2\n\n[l.deep]\nm = inf\n"), std::string::npos) << once;
  EXPECT_NE(once.find("d = [1, 2.0, [\"x\"]]\n"), std::string::npos) << once;
}

TEST(Document, TellsWhereTheTomlIsWrong) {
  EXPECT_EQ(message_of([] { document("a = 1\nb = = 2\n"); }).substr(0, 16), "scene.toml:2:5: ");
  EXPECT_EQ(message_of([] { document("a = 1\nb = 1 \u00b5m\n"); }).substr(0, 16), "scene.toml:2:7: ");
  EXPECT_EQ(message_of([] { document("[[[x]]]"); }).substr(0, 16), "scene.toml:1:3: ");
  EXPECT_EQ(message_of([] { Document::parse_file("/nowhere/scene.toml"); }),
            "cannot read \"/nowhere/scene.toml\": no such file");
}

TEST(Document, CannotExhaustTheStack) {
  for (const int depth : {300, 100000}) {
    std::string dots = "a", braces = "x = ";
    for (int i = 0; i < depth; ++i) dots += ".a", braces += "{a=";
    const std::string brackets(static_cast<std::size_t>(depth), '[');
    for (const std::string& text :
         {dots + " = 1", '[' + dots + ']', "x = {" + dots + " = 1}", braces, brackets, "x = " + brackets}) {
      EXPECT_EQ(message_of([&] { document(text); }).substr(0, 13), "scene.toml:1:") << text.substr(0, 20);
    }
    Document doc = document("");
    EXPECT_EQ(message_of([&] { doc.set(dots, "1"); }).substr(0, 11), "--set: the ");
  }
}

TEST(Document, SurvivesRandomDamage) {
  const std::string text =
      "dx = '0.5 um'\nhaematocrit = 0.4\nsteps = 7\nsize = ['20 um', '0.02 mm', '5e-5 m']\n[[cells]]\nkind = 'tube'\n"
      "[run]\nforces = [\"3 pN\"]\n";
  std::mt19937 random(3);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    try {
      const Document doc = document(npfem_test::mutated(text, random));
      const Table root = doc.root();
      root.quantity(dx);
      root.quantity(haematocrit);
      root.integer(steps);
      root.vector3(size);
      for (const Table& cell : root.tables("cells")) cell.choice(kind);
      root.table("run").quantities(forces);
      root.finish();
      ASSERT_NE(document(doc.to_toml()).to_toml(), "");
      ++accepted;
    } catch (const InputError& error) {
      ASSERT_GT(std::string(error.what()).size(), 10u);
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 19000);
}

TEST(KeyTable, IsWrittenFromTheKeys) {
  const Key keys[] = {dx, haematocrit, kind, restart};
  EXPECT_EQ(markdown_table(keys),
            "| key | value | default | meaning |\n|---|---|---|---|\n"
            "| `dx` | length (`um`), > 0 | required | lattice spacing |\n"
            "| `haematocrit` | number, 0 to 1 | `20 %` |  |\n"
            "| `kind` | `shear`, `tube`, `plates` | `shear` |  |\n"
            "| `restart` | text | none |  |\n");
}

}  // namespace
}  // namespace npfem::text
