// SPDX-License-Identifier: MPL-2.0
#include "material/material.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <set>

#include "error.h"
#include "file.h"
#include "key.h"
#include "mesh/generate.h"
#include "mutate.h"

namespace npfem {
namespace {

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string file_message(const std::string& parameters) {
  return message_of(
      [&] { Material::from_toml("schema_version = 1\nname = 'm'\n[parameters]\n" + parameters + "\n", "m.toml"); });
}

void expect_equal(const Material& a, const Material& b) {
  EXPECT_EQ(a.name(), b.name());
  EXPECT_EQ(a.description(), b.description());
  EXPECT_EQ(a.mesh().shape, b.mesh().shape);
  EXPECT_EQ(a.mesh().level, b.mesh().level);
  EXPECT_EQ(a.mesh().diameter, b.mesh().diameter);
  for (const ParamInfo& info : Material::params()) {
    EXPECT_EQ(a.get(info.key), b.get(info.key)) << info.key;
    EXPECT_EQ(a.is_given(info.key), b.is_given(info.key)) << info.key;
    EXPECT_EQ(a.source(info.key), b.source(info.key)) << info.key;
  }
  for (const TextParamInfo& info : Material::text_params()) {
    EXPECT_EQ(a.get_text(info.key), b.get_text(info.key)) << info.key;
  }
}

TEST(Params, DescribeThemselves) {
  std::set<std::string> keys;
  for (const ParamInfo& info : Material::params()) {
    EXPECT_TRUE(keys.insert(info.key).second) << info.key;
    EXPECT_GT(std::string(info.doc).size(), 10u) << info.key;
    EXPECT_LE(info.min, info.fallback) << info.key;
    EXPECT_LE(info.fallback, info.max) << info.key;
    EXPECT_EQ(text::parse_quantity(std::string("1 ") + (info.dimension.is_none() ? "" : info.unit()), info.dimension),
              1)
        << info.key << ": the number is the same in its unit and in base units";
    EXPECT_EQ(Material().get(info.key), info.fallback);
    EXPECT_NE(Material::reference_page().find(std::string("`") + info.key + "`"), std::string::npos);
  }
  for (const TextParamInfo& info : Material::text_params()) {
    EXPECT_TRUE(keys.insert(info.key).second) << info.key;
    EXPECT_NO_THROW(Material().set_text(info.key, info.fallback)) << info.key;
  }
}

TEST(Material, KeepsWhatIsSetAndRefusesTheRest) {
  Material material;
  material.set("shear_modulus", 2.5);
  material.set_text("membrane_law", "skalak");
  EXPECT_EQ(material.get("shear_modulus"), 2.5);
  EXPECT_EQ(material.get_text("membrane_law"), "skalak");
  EXPECT_TRUE(material.is_given("shear_modulus"));
  EXPECT_FALSE(material.is_given("skalak_C"));
  for (const double value : {-1.0, 1e10, std::nan(""), static_cast<double>(INFINITY)}) {
    EXPECT_THROW(material.set("shear_modulus", value), Error);
  }
  EXPECT_EQ(message_of([&] { material.set("shear_modulus", -1); }),
            "shear_modulus = -1 is outside 0 to 1000000000 uN/m");
  EXPECT_EQ(message_of([&] { material.set("stress_free_reduced_volume", 2); }),
            "stress_free_reduced_volume = 2 is outside 0 to 1");
  EXPECT_EQ(message_of([&] { material.set("shear_modulsu", 1); }).substr(0, 81),
            "unknown material parameter \"shear_modulsu\"; did you mean \"shear_modulus\"? allowed");
  EXPECT_EQ(message_of([&] { material.get("membrane_law"); }),
            "material parameter \"membrane_law\" is not a number, but a word");
  EXPECT_EQ(message_of([&] { material.set_text("membrane_law", "skalk"); }),
            "membrane_law: unknown word \"skalk\"; did you mean \"skalak\"? allowed: none, skalak, neo_hookean, yeoh, "
            "wlc, lineage");
  EXPECT_EQ(material.get("shear_modulus"), 2.5) << "unchanged by what was refused";
  EXPECT_EQ(material.get_text("membrane_law"), "skalak");
}

TEST(Material, EveryNumberRefusesWhatIsOutsideItsRangeAndSaysWhich) {
  for (const ParamInfo& info : Material::params()) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double value : {std::nextafter(info.min, -infinity), std::nextafter(info.max, infinity), infinity,
                               -infinity, std::numeric_limits<double>::quiet_NaN()}) {
      Material material;
      const std::string text = message_of([&] { material.set(info.key, value); });
      EXPECT_TRUE(text.starts_with(std::string(info.key) + " = ")) << info.key << ": " << text;
      EXPECT_NE(text.find("is outside"), std::string::npos) << text;
      EXPECT_EQ(material.get(info.key), info.fallback);
    }
  }
}

TEST(MaterialFile, TellsTheLine) {
  EXPECT_EQ(file_message("shear_modulus = 3"),
            "m.toml:4:17: parameters.shear_modulus: 3 has no unit; a surface modulus, like \"1 uN/m\" is needed");
  EXPECT_EQ(file_message("shear_modulus = '-3 uN/m'"),
            "m.toml:4:17: parameters.shear_modulus: shear_modulus = -3 is outside 0 to 1000000000 uN/m");
  EXPECT_EQ(
      file_message("shear_modulus = '3 um'"),
      "m.toml:4:17: parameters.shear_modulus: \"3 um\" is a length, but a surface modulus, like \"1 uN/m\" is needed");
  EXPECT_NE(file_message("shear_modulsu = '3 uN/m'")
                .find("m.toml:4:1: unknown key \"shear_modulsu\" in [parameters]; did you mean \"shear_modulus\"?"),
            std::string::npos);
  EXPECT_NE(file_message("membrane_law = 'rubber'").find("m.toml:4:16: "), std::string::npos);
  EXPECT_NE(file_message("[mesh]\nlevel = 99").find("m.toml:5:9: mesh.level: must lie between 0 and 8"),
            std::string::npos);
  EXPECT_NE(file_message("[mesh]\nshape = 'cube'").find("rbc, platelet, sphere, icosphere"), std::string::npos);
  EXPECT_NE(file_message("[sources]\nshear = 'x'").find("unknown key \"shear\" in [sources]"), std::string::npos);
  EXPECT_NE(message_of([] { Material::from_toml("schema_version = 2\nname = 'm'", "m"); }).find("schema_version"),
            std::string::npos);
  EXPECT_EQ(message_of([] { Material::from_toml("schema_version = 1", "m"); }).substr(0, 26),
            "m:1:1: missing key \"name\":");
  EXPECT_EQ(message_of([] { Material::from_file("/nowhere/m.toml"); }),
            "cannot read \"/nowhere/m.toml\": no such file");
}

TEST(MaterialFile, ComesBackBitForBit) {
  for (const std::string& name : Material::preset_names()) {
    const Material preset = Material::preset(name);
    expect_equal(Material::from_toml(preset.to_toml(), "back"), preset);
  }
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> exponent(-12, 8);
  for (int i = 0; i < 500; ++i) {
    Material material;
    material.rename("a \"quoted\" name\n");
    material.set_mesh({"platelet", i % 9, std::pow(10, exponent(random))});
    for (const ParamInfo& info : Material::params()) {
      material.set(info.key, std::clamp(std::pow(10, exponent(random)), info.min, info.max));
    }
    expect_equal(Material::from_toml(material.to_toml(), "back"), material);
  }
}

TEST(MaterialFile, SurvivesRandomDamage) {
  std::mt19937 random(7);
  const std::string text = Material::preset("rbc").to_toml();
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    try {
      const Material material = Material::from_toml(npfem_test::mutated(text, random), "m");
      for (const ParamInfo& info : Material::params()) {
        ASSERT_TRUE(material.get(info.key) >= info.min && material.get(info.key) <= info.max) << info.key;
      }
      ++accepted;
    } catch (const Error& error) {
      ASSERT_EQ(error.status(), Status::bad_input);
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 19000);
}

TEST(Presets, AreTheShippedOnes) {
  EXPECT_EQ(Material::preset_names(),
            (std::vector<std::string>{"rbc", "rbc-viscous", "platelet", "palabos-rbc", "palabos-platelet"}));
  EXPECT_EQ(message_of([] { Material::preset("rcb"); }),
            "unknown material \"rcb\"; did you mean \"rbc\"? allowed: rbc, rbc-viscous, platelet, palabos-rbc, "
            "palabos-platelet");
}

TEST(Presets, GiveASourceForEveryValueAndAMesh) {
  for (const std::string& name : Material::preset_names()) {
    const Material material = Material::preset(name);
    EXPECT_EQ(material.name(), name);
    EXPECT_GT(material.description().size(), 20u);
    EXPECT_NO_THROW(generate_mesh(material.mesh().shape, material.mesh().level, material.mesh().diameter));
    for (const ParamInfo& info : Material::params()) {
      EXPECT_EQ(material.is_given(info.key), material.source(info.key).size() > 10) << name << ' ' << info.key;
    }
    for (const TextParamInfo& info : Material::text_params()) {
      EXPECT_TRUE(material.is_given(info.key) || material.source(info.key).empty()) << name << ' ' << info.key;
    }
  }
}

TEST(Presets, HaveTheStatedValues) {
  const Material rbc = Material::preset("rbc");
  EXPECT_EQ(rbc.get("shear_modulus"), 3.25);
  EXPECT_EQ(rbc.get("skalak_C"), 10);
  EXPECT_EQ(rbc.get("bending_modulus"), 0.3) << "3e-19 J";
  EXPECT_EQ(rbc.get("global_area_modulus"), 2500);
  EXPECT_EQ(rbc.get("global_volume_modulus"), 2000);
  EXPECT_EQ(rbc.get("stress_free_reduced_volume"), 0.95);
  EXPECT_EQ(rbc.get_text("membrane_law"), "skalak");
  EXPECT_EQ(rbc.get("solid_density"), 0);
  const Material lineage = Material::preset("palabos-rbc");
  EXPECT_EQ(lineage.get("lineage_mu"), 35);
  EXPECT_EQ(lineage.get("lineage_lambda"), 5);
  EXPECT_EQ(lineage.get("lineage_membrane_weight"), 27.5);
  EXPECT_EQ(lineage.get("local_area_modulus"), 5000);
  EXPECT_EQ(lineage.get("lineage_volume_weight"), 250);
  EXPECT_EQ(lineage.get("lineage_bending_weight"), 1);
  EXPECT_EQ(lineage.get("solid_density"), 1125);
  EXPECT_EQ(Material::preset("palabos-platelet").get("lineage_bending_weight"), 100);
  EXPECT_GT(Material::preset("platelet").get("shear_modulus"), 10 * rbc.get("shear_modulus"));
}

TEST(MaterialReference, DocsHoldTheLoadersOwnTable) {
  const std::string page = text::read_file(std::string(NPFEM_SOURCE) + "/docs/materials.md");
  EXPECT_NE(page.find(Material::reference_page()), std::string::npos) << "docs/materials.md is out of date";
}

}  // namespace
}  // namespace npfem
