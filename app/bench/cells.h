// SPDX-License-Identifier: MPL-2.0
// Red cells set up for a measurement, through the C interface.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/clock.h"
#include "npfem/npfem.hpp"

namespace npfem::app::bench {

inline const std::vector<std::string> precision_names{"double", "mixed", "float"};

/// How cells are stepped.
struct Setting {
  std::string backend = "cpu";
  bool lineage = false;
  int precision = 0;  ///< index in precision_names
  int threads = 1;
  int matrix = 0;
  int integrator = 0;
  bool lone_cells = false;
  double time_step = 0.25;  ///< us
  double tolerance = 1e-4;  ///< pN
  bool to_the_end = false;  ///< for a solution to compare with: 5000 iterations are allowed; the lineage makes 30,
                            ///< whatever it thinks of its objective
};

/// The red cell of a preset on a mesh of 66, 258, 1026 or 4098 vertices; one without a mass gets 400 fg/um2, about that
/// of the fluid that moves with it.
api::Model red_cell(const std::string& material, int vertices);
int level_of(int vertices);

api::Batch make_batch(const api::Model& model, const Setting& setting, int cells);

/// Positions and velocities of `cells` cells from which every repeat starts.
struct Start {
  int cells;
  std::vector<double> position, velocity;
};
/// Cells at their initial shape in a shear of about 1000 1/s, each a little different.
Start sheared_start(const api::Model& model, int cells);
/// `count` copies of one state.
Start copies_of(std::span<const double> position, std::span<const double> velocity, int count);
void restore(api::Batch& batch, const Start& start);

/// Means over cells and steps; the time is the median over repeats.
struct Measurement {
  double us_per_cell_step = 0, wall_us_per_cell_step = 0;
  double iterations = 0, evaluations = 0, flops = 0;
  double residual = 0;  ///< largest, pN
  int failed_cells = 0;
  std::vector<double> position;  ///< at the end, of the first cells (see first_cells)
};
/// Cells whose positions are compared.
inline constexpr int first_cells = 8;

/// `steps` steps from the start, again and again: at least `repeats` times and about `least_us` in all.
Measurement measure(api::Batch& batch, const Start& start, Clock clock, int steps, int repeats);

double largest_distance(std::span<const double> a, std::span<const double> b);
double median(std::vector<double> values);

/// Thrown where the user has asked for an end.
struct Interrupted {};
void stop_if_interrupted();

}  // namespace npfem::app::bench
