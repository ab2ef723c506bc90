// SPDX-License-Identifier: MPL-2.0
// Text through the interface: buffers of any size, and numbers that no locale of the host can change.
#include <gtest/gtest.h>

#include <filesystem>
#include <locale>
#include <string>
#include <vector>

#include "npfem/npfem.hpp"

namespace {

using namespace npfem::api;

std::string last_error() {
  return text_of([](char* b, std::int32_t n) { return npfem_last_error(b, n); });
}

TEST(TextOut, IsCutToTheBufferAndAlwaysEnded) {
  const std::string version = text_of([](char* b, std::int32_t n) { return npfem_version(b, n); });
  const auto length = static_cast<std::int32_t>(version.size());
  for (std::int32_t capacity = 1; capacity <= length + 2; ++capacity) {
    std::vector<char> buffer(static_cast<std::size_t>(capacity) + 1, '#');
    EXPECT_EQ(npfem_version(buffer.data(), capacity), length);
    EXPECT_EQ(std::string(buffer.data()), version.substr(0, static_cast<std::size_t>(capacity) - 1));
    EXPECT_EQ(buffer.back(), '#') << "written beyond the buffer of " << capacity;
  }
  EXPECT_EQ(npfem_version(nullptr, 0), length);
}

TEST(TextOut, NeverEndsInsideACharacter) {
  // The message holds a path of two-byte characters.
  EXPECT_EQ(npfem_material_load("/gibt/es/nicht/\xc3\xa4\xc3\xa4\xc3\xa4"), NPFEM_ERROR_IO);
  const std::string whole = last_error();
  for (std::size_t capacity = 1; capacity <= whole.size(); ++capacity) {
    std::string cut(capacity, '#');
    npfem_last_error(cut.data(), static_cast<std::int32_t>(capacity));
    cut.resize(cut.find('\0'));
    EXPECT_EQ(whole.substr(0, cut.size()), cut);
    EXPECT_GE(cut.size() + 2, capacity);
    EXPECT_NE(static_cast<unsigned char>(whole[cut.size()]) & 0xc0u, 0x80u) << cut;
  }
}

TEST(TextOut, MessagesLongerThanTheirStoreAreCut) {
  const std::string path = "/" + std::string(100000, 'x');
  EXPECT_EQ(npfem_mesh_load((path + ".off").c_str()), NPFEM_ERROR_IO);
  EXPECT_GT(last_error().size(), 1000u);
  EXPECT_LT(last_error().size(), 4096u);
}

TEST(LastError, StaysUntilTheNextFailure) {
  EXPECT_EQ(npfem_mesh_load("a.xyz"), NPFEM_ERROR_INPUT);
  const std::string message = last_error();
  EXPECT_EQ(npfem_abi_version(), 1);
  EXPECT_GT(npfem_material_preset_count(), 0);
  EXPECT_EQ(last_error(), message);
}

/// A host that writes 3,25 and 1.000.000.
class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// The global C++ locale, and the C locale where this machine has a German one, for the length of a test.
class ForeignLocale : public testing::Test {
 protected:
  void SetUp() override {
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    previous_ = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  }
  void TearDown() override {
    std::locale::global(previous_);
    std::setlocale(LC_ALL, "C");
  }

 private:
  std::locale previous_;
};

TEST_F(ForeignLocale, MaterialsKeepTheirNumbers) {
  Material material = Material::preset("rbc");
  material.set("bending_modulus", 0.3125);
  material.set("global_area_modulus", 1234567.5);
  const std::string toml =
      text_of([&](char* b, std::int32_t n) { return check(npfem_material_to_text(material.handle(), b, n)); });
  EXPECT_NE(toml.find("\"0.3125 pN um\""), std::string::npos) << toml;
  EXPECT_NE(toml.find("\"1234567.5 uN/m\""), std::string::npos) << toml;
  const Material again = Material::parse(toml);
  EXPECT_EQ(again.number("bending_modulus"), 0.3125);
  EXPECT_EQ(again.number("global_area_modulus"), 1234567.5);
}

TEST_F(ForeignLocale, MeshesKeepTheirPositions) {
  const Mesh mesh = Mesh::generate("rbc", 2);
  std::vector<double> before(198), after(198);
  check(npfem_mesh_get_positions(mesh.handle(), before.data(), 198));
  for (const char* ending : {".off", ".obj", ".ply"}) {
    const auto path = std::filesystem::temp_directory_path() / (std::string("npfem_capi_locale") + ending);
    mesh.save(path.string());
    check(npfem_mesh_get_positions(Mesh::load(path.string()).handle(), after.data(), 198));
    EXPECT_EQ(before, after) << ending;
    std::filesystem::remove(path);
  }
}

}  // namespace
