// SPDX-License-Identifier: MPL-2.0
#include "material/material.h"

#include <algorithm>

#include "error.h"
#include "key.h"
#include "nearest.h"

namespace npfem {
namespace {

using text::Dimension;

constexpr double largest = 1e9;             // of any modulus, in base units: far beyond membranes, far from overflow
constexpr double largest_viscosity = 1e15;  // 1e9 uN s/m

constexpr ParamInfo number_table[] = {
    {"shear_modulus", Dimension::surface_modulus(), 0, largest, 0,
     "in-plane shear modulus G_s of the laws skalak, neo_hookean, yeoh and wlc"},
    {"skalak_C", Dimension::none(), 0, 1e6, 1, "Skalak's C: the small-strain area modulus is G_s (1 + 2 C)"},
    {"yeoh_c3", Dimension::surface_modulus(), 0, largest, 0, "law yeoh: coefficient c3 of k^3, the stiffening"},
    {"wlc_rest_ratio", Dimension::none(), 0.05, 0.9, 1 / 2.2,
     "law wlc: length of a spectrin link at rest over its contour length"},
    {"lineage_mu", Dimension::surface_modulus(), 0, largest, 0, "law lineage: mu, the quartic stiffening"},
    {"lineage_lambda", Dimension::surface_modulus(), 0, largest, 0,
     "law lineage: Lambda, four times the small-strain shear modulus"},
    {"lineage_membrane_weight", Dimension::surface_modulus(), 0, largest, 0,
     "law lineage: stiffness that enters the matrix of the solver only, never the energy"},
    {"local_area_modulus", Dimension::surface_modulus(), 0, largest, 0,
     "local area, form smooth: K_L of (K_L/2)(J - 1)^2; form lineage: its weight, twice the small-strain area modulus; "
     "0 leaves it out"},
    {"collapse_modulus", Dimension::surface_modulus(), 0, largest, 0,
     "K of K (0.4 - J)^3/J on triangles below 0.4 of their rest area, so that none vanishes in strong flow; 0 leaves "
     "it out"},
    {"global_area_modulus", Dimension::surface_modulus(), 0, largest, 0,
     "k_A of (k_A/2)(A - A0)^2/A0 on the whole area; 0 leaves it out"},
    {"global_volume_modulus", Dimension::stress(), 0, largest, 0,
     "k_V of (k_V/2)(V - V0)^2/V0 on the volume, form exact; 0 leaves it out"},
    {"lineage_volume_weight", Dimension::surface_modulus(), 0, largest, 0,
     "weight of the lineage's volume force, form lineage; 0 leaves it out"},
    {"bending_modulus", Dimension::energy(), 0, largest, 0,
     "kappa_b of the laws dihedral, juelicher and cotangent (1 pN um = 1e-18 J)"},
    {"spontaneous_curvature", Dimension::curvature(), -1e3, 1e3, 0,
     "laws juelicher and cotangent with rest_angles flat: mean curvature H0 that the membrane prefers, half of "
     "Helfrich's "
     "c0, positive where convex"},
    {"lineage_bending_weight", Dimension::energy(), 0, largest, 0,
     "weight w of the law lineage: the Helfrich modulus is 3 w"},
    {"stress_free_reduced_volume", Dimension::none(), 0, 1, 0,
     "reduced volume of the oblate spheroid in which the membrane is free of shear; 0 is the shape itself"},
    {"membrane_shear_viscosity", Dimension::surface_viscosity(), 0, largest_viscosity, 0,
     "eta_s: tension 2 eta_s times the rate of shear strain (a red cell: 0.3 to 0.7 uN s/m); 0 leaves it out"},
    {"membrane_dilatational_viscosity", Dimension::surface_viscosity(), 0, largest_viscosity, 0,
     "eta_d: tension eta_d times the rate of area strain; 0 leaves it out"},
    {"membrane_density", Dimension::surface_density(), 0, largest, 0,
     "mass of the membrane per rest area; 0 where a surrounding fluid carries all inertia"},
    {"solid_density", Dimension::density(), 0, largest, 0,
     "mass per enclosed volume, shared equally by the vertices (the lineage's lumping)"},
};

constexpr TextParamInfo word_table[] = {
    {"membrane_law", "none skalak neo_hookean yeoh wlc lineage", "none", "in-plane elastic law of the membrane"},
    {"local_area_form", "lineage smooth", "lineage",
     "lineage: distance to the nearest deformation that keeps the area; smooth: square of the area strain"},
    {"global_volume_form", "exact lineage", "exact",
     "exact: the gradient of an energy; lineage: the force law of the lineage"},
    {"bending_law", "none dihedral juelicher cotangent lineage", "none",
     "dihedral: signed angle between triangles; juelicher, cotangent: Helfrich's energy of the mean curvature, from "
     "edges "
     "or from the cotangent Laplacian; lineage: magnitude of curvature only"},
    {"rest_angles", "shape flat", "shape",
     "rest curvature of the laws dihedral, juelicher and cotangent: that of the initial shape, or flat (with "
     "spontaneous_curvature, if any)"},
};

std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  for (const ParamInfo& info : number_table) keys.push_back(info.key);
  for (const TextParamInfo& info : word_table) keys.push_back(info.key);
  return keys;
}

[[noreturn]] void fail_unknown(std::string_view key) {
  throw Error(Status::unknown_name,
              "unknown material parameter \"" + std::string(key) + '"' + text::suggestion(key, all_keys()));
}

/// Position of `key` in a table; an error that tells numbers from words.
template <std::size_t n, class Info>
std::size_t index_of(std::string_view key, const Info (&table)[n], const char* kind) {
  for (std::size_t i = 0; i < n; ++i) {
    if (key == table[i].key) return i;
  }
  const std::vector<std::string> known = all_keys();
  if (std::find(known.begin(), known.end(), key) == known.end()) fail_unknown(key);
  throw Error(Status::unknown_name, "material parameter \"" + std::string(key) + "\" is not " + kind);
}

std::size_t number_index(std::string_view key) {
  return index_of(key, number_table, "a number, but a word");
}
std::size_t word_index(std::string_view key) {
  return index_of(key, word_table, "a word, but a number");
}

}  // namespace

Material::Material() {
  for (const ParamInfo& info : number_table) values_.push_back(info.fallback);
  for (const TextParamInfo& info : word_table) words_.push_back(info.fallback);
}

std::span<const ParamInfo> Material::params() {
  return number_table;
}
std::span<const TextParamInfo> Material::text_params() {
  return word_table;
}

double Material::get(std::string_view key) const {
  return values_[number_index(key)];
}

void Material::set(std::string_view key, double value) {
  const std::size_t i = number_index(key);
  const ParamInfo& info = number_table[i];
  if (!(value >= info.min && value <= info.max)) {
    throw Error(Status::bad_input, std::string(info.key) + " = " + text::format_number(value) + " is outside " +
                                       text::format_number(info.min) + " to " +
                                       text::format_quantity(info.max, info.unit()));
  }
  values_[i] = value;
  given_.emplace(key);
}

const std::string& Material::get_text(std::string_view key) const {
  return words_[word_index(key)];
}

void Material::set_text(std::string_view key, std::string_view value) {
  const std::size_t i = word_index(key);
  const std::vector<std::string> allowed = text::words_of(word_table[i].words);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    throw Error(Status::bad_input,
                std::string(key) + ": unknown word \"" + std::string(value) + '"' + text::suggestion(value, allowed));
  }
  words_[i] = value;
  given_.emplace(key);
}

std::string Material::source(std::string_view key) const {
  const auto found = sources_.find(key);
  return found == sources_.end() ? "" : found->second;
}

bool Material::is_given(std::string_view key) const {
  return given_.contains(key);
}

}  // namespace npfem
