// SPDX-License-Identifier: MPL-2.0
#include "parameter_table.h"

#include "error.h"
#include "material/material.h"
#include "nearest.h"

namespace npfem::capi {
namespace {

Parameter word_parameter(const char* key, const std::string& doc, const std::string& words) {
  return {key, "", doc + "; one of: " + words, ParameterKind::word};
}

std::vector<Parameter> describe_material() {
  std::vector<Parameter> parameters;
  for (const ParamInfo& p : Material::params()) {
    parameters.push_back({p.key, p.unit(), p.doc, ParameterKind::number, p.min, p.max, p.fallback});
  }
  for (const TextParamInfo& p : Material::text_params()) parameters.push_back(word_parameter(p.key, p.doc, p.words));
  return parameters;
}

std::vector<Parameter> describe_batch() {
  std::vector<Parameter> parameters;
  for (const OptionInfo& o : solver_options()) {
    parameters.push_back(
        {o.key, o.unit, o.doc, ParameterKind::number, o.least, o.largest, get_option(SolverOptions{}, o.key)});
  }
  parameters.push_back(word_parameter("method",
                                      "how a time step is taken: by the integrator to the tolerance, or exactly as the "
                                      "lineage does, to reproduce its runs",
                                      "default lineage"));
  return parameters;
}

}  // namespace

const std::vector<Parameter>& material_parameters() {
  static const std::vector<Parameter> parameters = describe_material();
  return parameters;
}

const std::vector<Parameter>& batch_parameters() {
  static const std::vector<Parameter> parameters = describe_batch();
  return parameters;
}

void require_parameter(const std::vector<Parameter>& parameters, std::string_view key, ParameterKind kind) {
  std::vector<std::string> keys;
  for (const Parameter& p : parameters) {
    if (p.key == key) {
      if (p.kind == kind) return;
      throw Error(Status::bad_argument,
                  "parameter \"" + p.key + "\" is " +
                      (kind == ParameterKind::number ? "a word; use npfem_set_text and npfem_get_text"
                                                     : "a number; use npfem_set_f64 and npfem_get_f64"));
    }
    keys.push_back(p.key);
  }
  throw Error(Status::unknown_name, "no parameter \"" + std::string(key) + "\"" + text::suggestion(key, keys));
}

std::string get_option_word(const SolverOptions& options) {
  return options.lineage ? "lineage" : "default";
}

void set_option_word(SolverOptions& options, std::string_view word) {
  if (word != "default" && word != "lineage") {
    throw Error(Status::unknown_name,
                "method \"" + std::string(word) + "\"" + text::suggestion(word, {"default", "lineage"}));
  }
  options.lineage = word == "lineage";
}

}  // namespace npfem::capi
