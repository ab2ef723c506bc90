// SPDX-License-Identifier: MPL-2.0
// Quantities with units, "5.5 uN/m", to and from the base units of npfem: um, us, fg.
//
// In base units force is pN, energy pN um (1e-18 J), stress Pa, a surface modulus uN/m, and 1 mPa s is 1000.
// Units are powers of ten of each other, so a unit only shifts the decimal point of what the user wrote: "2e-19 J" and
// "0.2 pN um" are the same double, and a printed quantity reads back as the same bits (degrees excepted).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace npfem::text {

/// Input that a person wrote and that cannot be used: where it is, what was found, what is allowed.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The dimension of a quantity: powers of length, time, mass and angle, and the words for messages and for printing.
struct Dimension {
  int length_power;
  int time_power;
  int mass_power;
  int angle_power;
  const char* name;  ///< "length"
  const char* unit;  ///< "um": the unit it is printed with

  static constexpr Dimension none() { return {0, 0, 0, 0, "number", "1"}; }
  static constexpr Dimension angle() { return {0, 0, 0, 1, "angle", "deg"}; }
  static constexpr Dimension length() { return {1, 0, 0, 0, "length", "um"}; }
  static constexpr Dimension curvature() { return {-1, 0, 0, 0, "curvature", "1/um"}; }
  static constexpr Dimension area() { return {2, 0, 0, 0, "area", "um2"}; }
  static constexpr Dimension volume() { return {3, 0, 0, 0, "volume", "um3"}; }
  static constexpr Dimension time() { return {0, 1, 0, 0, "time", "us"}; }
  static constexpr Dimension mass() { return {0, 0, 1, 0, "mass", "fg"}; }
  static constexpr Dimension velocity() { return {1, -1, 0, 0, "velocity", "mm/s"}; }
  static constexpr Dimension acceleration() { return {1, -2, 0, 0, "acceleration", "m/s2"}; }
  static constexpr Dimension rate() { return {0, -1, 0, 0, "rate", "1/s"}; }
  static constexpr Dimension flow_rate() { return {3, -1, 0, 0, "flow rate", "um3/s"}; }
  static constexpr Dimension density() { return {-3, 0, 1, 0, "density", "kg/m3"}; }
  static constexpr Dimension surface_density() { return {-2, 0, 1, 0, "mass per area", "fg/um2"}; }
  static constexpr Dimension force() { return {1, -2, 1, 0, "force", "pN"}; }
  static constexpr Dimension force_density() { return {-2, -2, 1, 0, "force per volume", "Pa/m"}; }
  static constexpr Dimension energy() { return {2, -2, 1, 0, "energy", "pN um"}; }
  static constexpr Dimension stress() { return {-1, -2, 1, 0, "stress", "Pa"}; }
  static constexpr Dimension surface_modulus() { return {0, -2, 1, 0, "surface modulus", "uN/m"}; }
  static constexpr Dimension surface_viscosity() { return {0, -1, 1, 0, "surface viscosity", "pN us/um"}; }
  static constexpr Dimension dynamic_viscosity() { return {-1, -1, 1, 0, "dynamic viscosity", "mPa s"}; }
  static constexpr Dimension kinematic_viscosity() { return {2, -1, 0, 0, "kinematic viscosity", "mm2/s"}; }

  /// True when the powers agree (the words do not count).
  bool same_as(const Dimension& other) const;
  bool is_none() const { return same_as(none()); }
};

/// "a length, like "0.5 um"": what a message says is needed.
std::string describe(const Dimension& dimension);

/// The value of `text` in base units. Accepted: a number and a unit ("5.5 uN/m", "1.2 mPa s", "1e-6 m2/s", "100 1/s",
/// "90 deg", "45 %"); units m s g N Pa J Hz L with the prefixes f p n u (or the micro sign) m c k M G; products by
/// blank,
/// '.', '*' or a middle dot; at most one '/' run; powers "m3", "m^3", "m-3". Where dimension is none a bare number is
/// enough. Throws InputError, also for a number that is not finite. Independent of the locale.
double parse_quantity(std::string_view text, const Dimension& dimension);

/// The base-unit `value` written in `unit` with the fewest digits that read back as the same double: "3.25 uN/m".
std::string format_quantity(double value, std::string_view unit);
inline std::string format_quantity(double value, const Dimension& d) {
  return format_quantity(value, d.unit);
}

/// Three digits, whatever the locale: "0.000123".
std::string format_rounded(double value);

/// The shortest decimal text that reads back as the same double, whatever the locale: "0.1", "1e-20".
std::string format_number(double value);

}  // namespace npfem::text
