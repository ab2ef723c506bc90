// SPDX-License-Identifier: MPL-2.0
// A material: what the membrane of one type of cell is made of, as named numbers and words in base units
// (um, us, fg: uN/m for surface moduli, pN um = 1e-18 J for energies, Pa). The tables below describe every parameter,
// so that a host builds its sliders from them and a new energy adds no symbol to the C ABI.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quantity.h"

namespace npfem {

/// One number of a material. In `unit()` and in base units it is the same number.
struct ParamInfo {
  const char* key;
  text::Dimension dimension;
  double min, max, fallback;  ///< base units
  const char* doc;

  const char* unit() const { return dimension.unit; }
};

/// One word of a material.
struct TextParamInfo {
  const char* key;
  const char* words;  ///< the allowed ones, between blanks
  const char* fallback;
  const char* doc;
};

/// The mesh that a material is usually put on: the arguments of generate_mesh.
struct MeshRecipe {
  std::string shape = "sphere";
  int level = 3;
  double diameter = 0;  ///< um; 0 = the natural one of the shape
};

class Material {
 public:
  Material();  ///< every parameter at its fallback: a membrane without any energy

  /// The parameters that exist, in a fixed order.
  static std::span<const ParamInfo> params();
  static std::span<const TextParamInfo> text_params();

  /// By key. Throws Error(unknown_name) with the nearest key, Error(bad_input) outside [min, max] or for a word that is
  /// not allowed; the material is then unchanged.
  double get(std::string_view key) const;
  void set(std::string_view key, double value);
  const std::string& get_text(std::string_view key) const;
  void set_text(std::string_view key, std::string_view value);

  /// The citation or reason behind a parameter, "" when none is given.
  std::string source(std::string_view key) const;
  /// The keys that were given in the file or set since; the others have their fallback.
  bool is_given(std::string_view key) const;

  const std::string& name() const { return name_; }
  const std::string& description() const { return description_; }
  const MeshRecipe& mesh() const { return mesh_; }
  void rename(std::string name) { name_ = std::move(name); }
  void set_mesh(MeshRecipe recipe) { mesh_ = std::move(recipe); }

  /// A material file; `name` stands for it in messages. Throws Error(bad_input) with file:line:column.
  static Material from_toml(std::string_view toml, const std::string& name);
  static Material from_file(const std::string& path);
  /// Reads back as an equal material, bit for bit.
  std::string to_toml() const;

  /// A material of materials/, embedded in the library: "rbc", "rbc-viscous", "platelet", "palabos-rbc",
  /// "palabos-platelet".
  static Material preset(std::string_view name);
  static std::vector<std::string> preset_names();
  /// The text of materials/<name>.toml.
  static std::string preset_text(std::string_view name);

  /// A Markdown table of all parameters, for the reference page.
  static std::string reference_page();

 private:
  std::string name_ = "unnamed";
  std::string description_;
  MeshRecipe mesh_;
  std::vector<double> values_;      // in the order of params()
  std::vector<std::string> words_;  // in the order of text_params()
  std::map<std::string, std::string, std::less<>> sources_;
  std::set<std::string, std::less<>> given_;
};

}  // namespace npfem
