// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <gtest/gtest.h>

#include "cells.h"

namespace npfem::testing {

/// Forces that pull the two ends of a cell apart along x, `pull` pN on either side.
inline std::vector<double> stretching(const std::vector<double>& position, double pull) {
  std::vector<double> force(position.size(), 0.0);
  for (const double side : {-1.0, 1.0}) {
    std::vector<std::size_t> end;
    for (std::size_t i = 0; i < position.size(); i += 3) {
      if (side * position[i] > 3.0) end.push_back(i);
    }
    for (const std::size_t i : end) force[i] = side * pull / static_cast<double>(end.size());
  }
  return force;
}

/// A red cell of 66 vertices.
inline std::shared_ptr<const Model> red_cell(const Material& material) {
  return std::make_shared<const Model>(build_model(evans_fung_cell(2), material));
}

/// Stretches the cell by `pull` pN at either end to its equilibrium, then takes the load away.
inline void stretch_and_release(Batch& batch, double pull) {
  batch.write(Field::external_force, 0, 1, stretching(get(batch, Field::position), pull));
  ASSERT_EQ(batch.relax(), 0);
  batch.write(Field::external_force, 0, 1, uniform(batch.model(), 0, 0, 0));
}

}  // namespace npfem::testing
