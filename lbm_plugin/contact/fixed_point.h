// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace npfem::flow {

/// Forces of contacts as whole multiples of 2^-40 pN (1e-12 pN), so that their sums are exact: the same in any order,
/// on any number of ranks and threads, and zero over each pair to the last bit. One contact may hold up to 8192 pN, and
/// 1024 contacts of that size may meet in one vertex; what settings could exceed it are refused.
struct ContactLoad {
  std::array<std::int64_t, 3> force{};  ///< 2^-40 pN
  std::int64_t stiffness = 0;           ///< 2^-20 pN/um

  void add(const ContactLoad& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) force[axis] += other.force[axis];
    stiffness += other.stiffness;
  }
  bool is_zero() const { return (force[0] | force[1] | force[2] | stiffness) == 0; }
  friend bool operator==(const ContactLoad&, const ContactLoad&) = default;
};

inline constexpr double largest_contact_force = 8192;            ///< pN
inline constexpr double largest_contact_stiffness = 8589934592;  ///< pN/um

inline std::int64_t fixed_force(double force) {
  return std::llrint(force * 0x1p40);
}
inline double force_of(std::int64_t fixed) {
  return static_cast<double>(fixed) * 0x1p-40;
}
inline std::int64_t fixed_stiffness(double stiffness) {
  return std::llrint(stiffness * 0x1p20);
}
inline double stiffness_of(std::int64_t fixed) {
  return static_cast<double>(fixed) * 0x1p-20;
}

}  // namespace npfem::flow
