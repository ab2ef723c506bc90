// SPDX-License-Identifier: MPL-2.0
#include "backend/cpu/state_blocks.h"

#include <algorithm>

namespace npfem::cpu {

StateBlocks::StateBlocks(std::vector<int> order, std::span<const Point> initial, int lanes)
    : order_(std::move(order)), lanes_(lanes) {
  for (const int vertex : order_) initial_.push_back(initial[static_cast<std::size_t>(vertex)]);
  grown(Field::position);
  grown(Field::velocity);
}

std::size_t StateBlocks::at(Field field, int cell, std::size_t row) const {
  const auto lanes = static_cast<std::size_t>(lanes_), c = static_cast<std::size_t>(cell);
  return ((c / lanes) * rows(field) + row) * lanes + c % lanes;
}

namespace {

bool starts_at_shape(Field field) {
  return field == Field::position || field == Field::tied_at;
}

}  // namespace

AlignedVector<double>& StateBlocks::grown(Field field) {
  AlignedVector<double>& values = fields_[static_cast<std::size_t>(field)];
  const std::size_t length = allocated_blocks_ * rows(field) * static_cast<std::size_t>(lanes_);
  // A field of an empty batch has no numbers yet; one stands for "wanted".
  values.resize(std::max<std::size_t>(length, 1), 0.0);
  return values;
}

void StateBlocks::require(Field field) {
  if (has(field)) return;
  grown(field);
  if (starts_at_shape(field)) {
    for (int c = 0; c < static_cast<int>(allocated_blocks_) * lanes_; ++c) reset(field, c);
  }
}

void StateBlocks::resize(int cells) {
  const int before = num_cells_;
  const auto needed = static_cast<std::size_t>((cells + lanes_ - 1) / lanes_);
  if (needed > allocated_blocks_) {
    const std::size_t first_new = allocated_blocks_;
    allocated_blocks_ = needed;
    for (std::size_t f = 0; f < num_fields; ++f) {
      if (!fields_[f].empty()) grown(static_cast<Field>(f));
    }
    for (auto c = static_cast<int>(first_new) * lanes_; c < static_cast<int>(needed) * lanes_; ++c) reset(c);
  }
  num_cells_ = cells;
  for (int c = std::max(before, 0); c < cells; ++c) reset(c);
  for (int c = cells; c < before; ++c) reset(c);
}

void StateBlocks::reset(int cell) {
  for (std::size_t f = 0; f < num_fields; ++f) {
    if (fields_[f].empty()) continue;
    reset(static_cast<Field>(f), cell);
  }
}

void StateBlocks::reset(Field field, int cell) {
  for (std::size_t row = 0; row < rows(field); ++row) {
    fields_[static_cast<std::size_t>(field)][at(field, cell, row)] =
        starts_at_shape(field) ? initial_[row / 3][row % 3] : 0.0;
  }
}

void StateBlocks::copy(int from, int to) {
  for (std::size_t f = 0; f < num_fields; ++f) {
    if (fields_[f].empty()) continue;
    const auto field = static_cast<Field>(f);
    for (std::size_t row = 0; row < rows(field); ++row)
      fields_[f][at(field, to, row)] = fields_[f][at(field, from, row)];
  }
}

void StateBlocks::write(Field field, int cell, std::span<const double> values) {
  const bool zero = std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
  if (zero && !has(field)) return;
  require(field);
  AlignedVector<double>& numbers = fields_[static_cast<std::size_t>(field)];
  const auto c = static_cast<std::size_t>(components(field));
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const auto vertex = static_cast<std::size_t>(order_[k]);
    for (std::size_t i = 0; i < c; ++i) numbers[at(field, cell, c * k + i)] = values[c * vertex + i];
  }
}

void StateBlocks::read(Field field, int cell, std::span<double> values) const {
  if (!has(field)) {
    std::fill(values.begin(), values.end(), 0.0);
    return;
  }
  const AlignedVector<double>& numbers = fields_[static_cast<std::size_t>(field)];
  const auto c = static_cast<std::size_t>(components(field));
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const auto vertex = static_cast<std::size_t>(order_[k]);
    for (std::size_t i = 0; i < c; ++i) values[c * vertex + i] = numbers[at(field, cell, c * k + i)];
  }
}

void StateBlocks::copy_from(const StateBlocks& other, int from, int to) {
  for (std::size_t f = 0; f < num_fields; ++f) {
    const auto field = static_cast<Field>(f);
    if (!other.has(field)) continue;
    require(field);
    for (std::size_t row = 0; row < rows(field); ++row)
      fields_[f][at(field, to, row)] = other.fields_[f][other.at(field, from, row)];
  }
}

bool StateBlocks::is_zero(Field field, int cell) const {
  if (!has(field)) return true;
  const AlignedVector<double>& numbers = fields_[static_cast<std::size_t>(field)];
  for (std::size_t row = 0; row < rows(field); ++row) {
    if (numbers[at(field, cell, row)] != 0) return false;
  }
  return true;
}

double* StateBlocks::block(Field field, int block) {
  if (!has(field)) return nullptr;
  return fields_[static_cast<std::size_t>(field)].data() +
         static_cast<std::size_t>(block) * rows(field) * static_cast<std::size_t>(lanes_);
}

}  // namespace npfem::cpu
