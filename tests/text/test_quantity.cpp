// SPDX-License-Identifier: MPL-2.0
#include "quantity.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <numbers>
#include <random>

#include "mutate.h"

namespace npfem::text {
namespace {

std::string message_of(std::string_view text, const Dimension& dimension) {
  try {
    parse_quantity(text, dimension);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ParseQuantity, GivesBaseUnitsExactly) {
  // um, us, fg: every line but the angle is exact, to the last bit.
  EXPECT_EQ(parse_quantity("0.5 um", Dimension::length()), 0.5);
  EXPECT_EQ(parse_quantity("5.5 uN/m", Dimension::surface_modulus()), 5.5);
  EXPECT_EQ(parse_quantity("2e-19 J", Dimension::energy()), 0.2);
  EXPECT_EQ(parse_quantity("100 1/s", Dimension::rate()), 1e-4);
  EXPECT_EQ(parse_quantity("100 s-1", Dimension::rate()), 1e-4);
  EXPECT_EQ(parse_quantity("2 MHz", Dimension::rate()), 2);
  EXPECT_EQ(parse_quantity("1025 kg/m3", Dimension::density()), 1025);
  EXPECT_EQ(parse_quantity("1.025 g/cm^3", Dimension::density()), 1025);
  EXPECT_EQ(parse_quantity("1.2 mPa s", Dimension::dynamic_viscosity()), 1200);
  EXPECT_EQ(parse_quantity("1.2 mPa.s", Dimension::dynamic_viscosity()), 1200);
  EXPECT_EQ(parse_quantity("1.2mPa*s", Dimension::dynamic_viscosity()), 1200);
  EXPECT_EQ(parse_quantity("1e-6 m2/s", Dimension::kinematic_viscosity()), 1);
  EXPECT_EQ(parse_quantity("1e-6 m^2/s", Dimension::kinematic_viscosity()), 1);
  EXPECT_EQ(parse_quantity("1e-6 m2 s^-1", Dimension::kinematic_viscosity()), 1);
  EXPECT_EQ(parse_quantity("3 pN", Dimension::force()), 3);
  EXPECT_EQ(parse_quantity("2 kPa", Dimension::stress()), 2000);
  EXPECT_EQ(parse_quantity("20 mm/s", Dimension::velocity()), 0.02);
  EXPECT_EQ(parse_quantity("0.42 uN s/m", Dimension::surface_viscosity()), 420000);
  EXPECT_EQ(parse_quantity("94 fL", Dimension::volume()), 94);
  EXPECT_EQ(parse_quantity("1 kg/m/s2", Dimension::stress()), 1);
  EXPECT_EQ(parse_quantity("+7 us", Dimension::time()), 7);
  EXPECT_EQ(parse_quantity("45 %", Dimension::none()), 0.45);
  EXPECT_EQ(parse_quantity("0.3", Dimension::none()), 0.3);
  EXPECT_EQ(parse_quantity("0e999 m", Dimension::length()), 0);
  EXPECT_DOUBLE_EQ(parse_quantity("90 deg", Dimension::angle()), std::numbers::pi / 2);
  EXPECT_EQ(parse_quantity("1 rad", Dimension::angle()), 1);
}

TEST(ParseQuantity, UnderstandsTheSignsOfThePrintedPage) {
  EXPECT_EQ(parse_quantity("0.5 \u00b5m", Dimension::length()), 0.5);
  EXPECT_EQ(parse_quantity("0.5 \u03bcm", Dimension::length()), 0.5);
  EXPECT_EQ(parse_quantity("1.2 mPa\u00b7s", Dimension::dynamic_viscosity()), 1200);
  EXPECT_EQ(parse_quantity("1025 kg/m\u00b3", Dimension::density()), 1025);
  EXPECT_DOUBLE_EQ(parse_quantity("180\u00b0", Dimension::angle()), std::numbers::pi);
}

TEST(ParseQuantity, SaysWhatWasFoundAndWhatIsNeeded) {
  EXPECT_EQ(message_of("0.5", Dimension::length()), "\"0.5\" has no unit, but a length, like \"1 um\" is needed");
  EXPECT_EQ(message_of("5 um", Dimension::surface_modulus()),
            "\"5 um\" is a length, but a surface modulus, like \"1 uN/m\" is needed");
  EXPECT_EQ(message_of("5 um", Dimension::none()),
            "\"5 um\" is a length, but a number without unit, like 0.5 is needed");
  EXPECT_EQ(message_of("fast", Dimension::velocity()), "found \"fast\", but a velocity, like \"1 mm/s\" is needed");
  EXPECT_NE(message_of("1 parsec", Dimension::length()).find("unknown unit \"parsec\""), std::string::npos);
  EXPECT_NE(message_of("1 kg/m s", Dimension::dynamic_viscosity()).find("either way"), std::string::npos);
}

TEST(ParseQuantity, RefusesWhatIsNotAFiniteQuantity) {
  for (const char* text :
       {"", " ", "um", "nan um", "inf um", "-inf um", "1e999 um", "1e-999 um", "1e308 Mm", "- 1 um", "1 um um^",
        "1 um/", "1 um^99", "0x10 um", "1,5 um", "1 um;", "+-1 um", "1 .um", "1 kum^2 2"}) {
    EXPECT_NE(message_of(text, Dimension::length()), "") << text;
  }
  EXPECT_NE(message_of("1 rad", Dimension::none()), "") << "an angle is not a number";
}

TEST(FormatQuantity, WritesTheFewestDigits) {
  EXPECT_EQ(format_quantity(3.25, "uN/m"), "3.25 uN/m");
  EXPECT_EQ(format_quantity(0.2, "J"), "2e-19 J");
  EXPECT_EQ(format_quantity(1200, Dimension::dynamic_viscosity()), "1.2 mPa s");
  EXPECT_EQ(format_quantity(1e-4, "1/s"), "100 1/s");
  EXPECT_EQ(format_quantity(0.1, "1"), "0.1");
  EXPECT_EQ(format_number(-1e-20), "-1e-20");
  EXPECT_EQ(format_number(1234500), "1234500");
  EXPECT_EQ(format_number(0.00125), "0.00125");
}

TEST(FormatQuantity, ReadsBackAsTheSameBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-30, 30), mantissa(-10, 10);
  const Dimension dimensions[] = {Dimension::none(),   Dimension::length(), Dimension::energy(),
                                  Dimension::rate(),   Dimension::stress(), Dimension::dynamic_viscosity(),
                                  Dimension::density()};
  for (int i = 0; i < 20000; ++i) {
    const double value = mantissa(random) * std::pow(10, exponent(random));
    const Dimension& dimension = dimensions[i % 7];
    ASSERT_EQ(parse_quantity(format_quantity(value, dimension), dimension), value) << format_quantity(value, dimension);
  }
}

TEST(ParseQuantity, IsIndependentOfTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name)) break;
  }
  EXPECT_EQ(parse_quantity("0.5 um", Dimension::length()), 0.5);
  EXPECT_EQ(format_quantity(0.5, "um"), "0.5 um");
  std::setlocale(LC_ALL, before.c_str());
}

TEST(ParseQuantity, SurvivesRandomDamage) {
  std::mt19937 random(2);
  const std::string samples[] = {"5.5 uN/m", "1.2e-3 mPa s", "-100 1/s", "1e-6 m^2/s", "0.42 uN.s/m"};
  int accepted = 0;
  for (std::size_t i = 0; i < 20000; ++i) {
    try {
      const double value = parse_quantity(npfem_test::mutated(samples[i % 5], random), Dimension::surface_modulus());
      ASSERT_TRUE(std::isfinite(value));
      ++accepted;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 19000);
}

}  // namespace
}  // namespace npfem::text
