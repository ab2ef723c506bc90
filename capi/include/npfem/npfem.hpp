// SPDX-License-Identifier: MPL-2.0
// A thin RAII wrapper over npfem.h for C++ programs: handles released by destructors, errors thrown with the C text.
// Shapes, units and thread rules are those of npfem.h.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "npfem/npfem.h"

namespace npfem::api {

/// A call of the C interface that failed, with its status and its message.
class Failure : public std::runtime_error {
 public:
  Failure(std::int32_t status, const std::string& message) : std::runtime_error(message), status_(status) {}
  std::int32_t status() const { return status_; }

 private:
  std::int32_t status_;
};

/// Text from any function of the form f(..., char* buffer, int32_t capacity).
template <class Getter>
std::string text_of(Getter&& get) {
  std::string text(256, '\0');
  std::int32_t length = get(text.data(), static_cast<std::int32_t>(text.size()));
  if (length >= static_cast<std::int32_t>(text.size())) {
    text.resize(static_cast<std::size_t>(length) + 1);
    length = get(text.data(), static_cast<std::int32_t>(text.size()));
  }
  text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return text;
}

/// Passes a result through; throws Failure when it is an error.
inline std::int32_t check(std::int32_t result) {
  if (result < 0) throw Failure(result, text_of([](char* b, std::int32_t n) { return npfem_last_error(b, n); }));
  return result;
}

inline std::int32_t length_of(std::size_t n) {
  if (n > 0x7fffffffu) throw Failure(NPFEM_ERROR_ARGUMENT, "array too long for the C interface");
  return static_cast<std::int32_t>(n);
}

/// Owns one handle.
class Object {
 public:
  Object() = default;
  explicit Object(std::int32_t created) : handle_(check(created)) {}
  Object(Object&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Object() {
    if (handle_ > 0) npfem_release(handle_);
  }
  std::int32_t handle() const { return handle_; }

  void set(const std::string& key, double value) { check(npfem_set_f64(handle_, key.c_str(), value)); }
  void set(const std::string& key, const std::string& word) {
    check(npfem_set_text(handle_, key.c_str(), word.c_str()));
  }
  double number(const std::string& key) const {
    double value = 0;
    check(npfem_get_f64(handle_, key.c_str(), &value));
    return value;
  }
  std::string word(const std::string& key) const {
    return text_of([&](char* b, std::int32_t n) { return check(npfem_get_text(handle_, key.c_str(), b, n)); });
  }

 protected:
  std::int32_t handle_ = 0;
};

class Mesh : public Object {
 public:
  using Object::Object;
  static Mesh generate(const std::string& shape, int level, double size_um = 0) {
    return Mesh(npfem_mesh_generate(shape.c_str(), level, size_um));
  }
  static Mesh load(const std::string& path) { return Mesh(npfem_mesh_load(path.c_str())); }
  static Mesh from(std::span<const double> xyz_um, std::span<const std::int32_t> triangles) {
    return Mesh(npfem_mesh_create(xyz_um.data(), length_of(xyz_um.size()), triangles.data(),
                                  length_of(triangles.size())));
  }
  void save(const std::string& path) const { check(npfem_mesh_save(handle_, path.c_str())); }
  int vertices() const { return check(npfem_mesh_vertex_count(handle_)); }
  int triangles() const { return check(npfem_mesh_triangle_count(handle_)); }
  double measure(const std::string& key) const {
    double value = 0;
    check(npfem_mesh_measure(handle_, key.c_str(), &value));
    return value;
  }
};

class Material : public Object {
 public:
  using Object::Object;
  static Material preset(const std::string& name) { return Material(npfem_material_preset(name.c_str())); }
  static Material load(const std::string& path) { return Material(npfem_material_load(path.c_str())); }
  static Material parse(const std::string& toml) { return Material(npfem_material_parse(toml.c_str())); }
  Mesh mesh(int level = -1) const { return Mesh(npfem_material_mesh(handle_, level)); }
};

class Model : public Object {
 public:
  using Object::Object;
  Model(const Mesh& mesh, const Material& material)
      : Object(npfem_model_create(mesh.handle(), material.handle())) {}
  static Model load_lineage(const std::string& folder, double solid_density, double volume_weight) {
    return Model(npfem_model_load_lineage(folder.c_str(), solid_density, volume_weight));
  }
  int vertices() const { return check(npfem_model_vertex_count(handle_)); }
  int triangle_count() const { return check(npfem_model_triangle_count(handle_)); }
  std::vector<std::int32_t> triangles() const {
    std::vector<std::int32_t> ids(3 * static_cast<std::size_t>(triangle_count()));
    check(npfem_model_get_triangles(handle_, ids.data(), length_of(ids.size())));
    return ids;
  }
  /// "rest_position" (3 numbers a vertex), "rest_area", "solid_mass" (1 number a vertex).
  std::vector<double> get(const std::string& field) const {
    const std::size_t components = field == "rest_position" ? 3 : 1;
    std::vector<double> values(components * static_cast<std::size_t>(vertices()));
    check(npfem_model_get(handle_, field.c_str(), values.data(), length_of(values.size())));
    return values;
  }
  double measure(const std::string& key) const {
    double value = 0;
    check(npfem_model_measure(handle_, key.c_str(), &value));
    return value;
  }
};

class Batch : public Object {
 public:
  using Object::Object;
  Batch(const Model& model, const std::string& backend, int cells)
      : Object(npfem_batch_create(model.handle(), backend.c_str(), cells)) {}
  int cells() const { return check(npfem_batch_cell_count(handle_)); }
  int add(int cells) { return check(npfem_batch_add(handle_, cells)); }
  void remove(int cell) { check(npfem_batch_remove(handle_, cell)); }
  void write(const std::string& field, int first, int count, std::span<const double> values) {
    check(npfem_batch_set(handle_, field.c_str(), first, count, values.data(), length_of(values.size())));
  }
  void read(const std::string& field, int first, int count, std::span<double> values) const {
    check(npfem_batch_get(handle_, field.c_str(), first, count, values.data(), length_of(values.size())));
  }
  int step(int steps = 1) { return check(npfem_batch_step(handle_, steps)); }
  int relax() { return check(npfem_batch_relax(handle_)); }
  void evaluate() { check(npfem_batch_evaluate(handle_)); }
  std::vector<std::int32_t> status() const { return per_cell<std::int32_t>(npfem_batch_get_status); }
  std::vector<std::int32_t> iterations() const { return per_cell<std::int32_t>(npfem_batch_get_iterations); }
  std::vector<double> residual() const { return per_cell<double>(npfem_batch_get_residual); }
  std::string status_text(int cell) const {
    return text_of([&](char* b, std::int32_t n) { return check(npfem_batch_status_text(handle_, cell, b, n)); });
  }
  std::vector<double> measure(const std::string& key) const {
    const int n = cells();
    std::vector<double> values(static_cast<std::size_t>(n));
    if (n > 0) check(npfem_batch_measure(handle_, key.c_str(), 0, n, values.data(), n));
    return values;
  }
  std::vector<std::int64_t> state_hash() const { return per_cell<std::int64_t>(npfem_batch_state_hash); }
  std::vector<double> pack(int cell) const {
    std::vector<double> values(static_cast<std::size_t>(check(npfem_batch_pack_length(handle_))));
    check(npfem_batch_pack(handle_, cell, values.data(), length_of(values.size())));
    return values;
  }
  void unpack(int cell, std::span<const double> values) {
    check(npfem_batch_unpack(handle_, cell, values.data(), length_of(values.size())));
  }

 private:
  template <class T, class Getter>
  std::vector<T> per_cell(Getter get) const {
    const int n = cells();
    std::vector<T> values(static_cast<std::size_t>(n));
    if (n > 0) check(get(handle_, 0, n, values.data(), n));
    return values;
  }
};

}  // namespace npfem::api
