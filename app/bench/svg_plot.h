// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>
#include <vector>

namespace npfem::app::bench {

struct Point2 {
  double x, y;
};

/// Dots, and a line through the best of them: those that no other dot of the series beats in both x and y.
struct Series {
  std::string label, colour;
  std::vector<Point2> points;
};

/// One diagram with logarithmic axes.
struct Panel {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::vector<Point2> marks;  ///< circled
  std::string mark_label;
};

/// The panels side by side as an SVG picture. Numbers that are not positive and finite are left out.
std::string svg_plot(const std::vector<Panel>& panels);

/// The points that no other point beats in both x and y, by x.
std::vector<Point2> best_points(std::vector<Point2> points);

}  // namespace npfem::app::bench
