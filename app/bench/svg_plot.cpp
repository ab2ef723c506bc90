// SPDX-License-Identifier: MPL-2.0
#include "bench/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "quantity.h"

namespace npfem::app::bench {
namespace {

constexpr double panel_width = 560, panel_height = 460;
constexpr double left = 74, right = 16, top = 44, bottom = 56;

bool is_drawable(const Point2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y > 0;
}

/// Whole decades around all numbers of one axis, and their place on the picture.
class Axis {
 public:
  Axis(const std::vector<double>& values, double from, double to) : from_(from), to_(to) {
    if (values.empty()) return;
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    first_ = static_cast<int>(std::floor(std::log10(*least)));
    last_ = std::max(first_ + 1, static_cast<int>(std::ceil(std::log10(*largest))));
  }
  double place(double value) const { return from_ + (to_ - from_) * (std::log10(value) - first_) / (last_ - first_); }
  int first() const { return first_; }
  int last() const { return last_; }

 private:
  double from_, to_;
  int first_ = 0, last_ = 1;
};

/// Tenths of a pixel, whatever the locale.
std::string pixels(double value) {
  return text::format_number(std::round(10 * value) / 10);
}

std::string line(Point2 a, Point2 b, const char* colour) {
  return "<line x1=\"" + pixels(a.x) + "\" y1=\"" + pixels(a.y) + "\" x2=\"" + pixels(b.x) + "\" y2=\"" + pixels(b.y) +
         "\" stroke=\"" + colour + "\"/>\n";
}

std::string words(Point2 at, const std::string& content, const std::string& more) {
  return "<text x=\"" + pixels(at.x) + "\" y=\"" + pixels(at.y) + "\" " + more + ">" + content + "</text>\n";
}

std::string circle(Point2 at, double radius, const std::string& style) {
  return "<circle cx=\"" + pixels(at.x) + "\" cy=\"" + pixels(at.y) + "\" r=\"" + pixels(radius) + "\" " + style +
         "/>\n";
}

std::string decade(int power) {
  return "10<tspan dy=\"-5\" font-size=\"9\">" + std::to_string(power) + "</tspan>";
}

std::string frame(const Panel& panel, const Axis& x, const Axis& y) {
  std::string svg;
  const double y_top = top, y_bottom = panel_height - bottom, x_left = left, x_right = panel_width - right;
  for (int p = x.first(); p <= x.last(); ++p) {
    const double at = x.place(std::pow(10.0, p));
    svg += line({at, y_top}, {at, y_bottom}, "#e4e4e4");
    svg += words({at, y_bottom + 18}, decade(p), "text-anchor=\"middle\"");
  }
  for (int p = y.first(); p <= y.last(); ++p) {
    const double at = y.place(std::pow(10.0, p));
    svg += line({x_left, at}, {x_right, at}, "#e4e4e4");
    svg += words({x_left - 8, at + 4}, decade(p), "text-anchor=\"end\"");
  }
  svg += line({x_left, y_bottom}, {x_right, y_bottom}, "#444") + line({x_left, y_top}, {x_left, y_bottom}, "#444");
  svg += words({x_left, 26}, panel.title, "font-size=\"15\" font-weight=\"bold\"");
  svg += words({0.5 * (x_left + x_right), panel_height - 14}, panel.x_label, "text-anchor=\"middle\"");
  const std::string middle = pixels(0.5 * (y_top + y_bottom));
  svg += words({0, 0}, panel.y_label, "text-anchor=\"middle\" transform=\"translate(20 " + middle + ") rotate(-90)\"");
  return svg;
}

std::string draw(const Panel& panel) {
  std::vector<double> xs, ys;
  for (const Series& series : panel.series) {
    for (const Point2& p : series.points) {
      if (is_drawable(p)) xs.push_back(p.x), ys.push_back(p.y);
    }
  }
  const Axis x(xs, left, panel_width - right), y(ys, panel_height - bottom, top);
  const auto place = [&](const Point2& p) { return Point2{x.place(p.x), y.place(p.y)}; };
  std::string svg = frame(panel, x, y);
  double label_y = top + 14;
  for (const Series& series : panel.series) {
    for (const Point2& p : series.points) {
      if (is_drawable(p)) svg += circle(place(p), 2.2, "fill=\"" + series.colour + "\" fill-opacity=\"0.45\"");
    }
    std::string corners;
    for (const Point2& p : best_points(series.points)) corners += pixels(place(p).x) + "," + pixels(place(p).y) + " ";
    svg += "<polyline points=\"" + corners + "\" fill=\"none\" stroke=\"" + series.colour + "\" stroke-width=\"2\"/>\n";
    svg += line({panel_width - 150, label_y - 4}, {panel_width - 130, label_y - 4}, series.colour.c_str());
    svg += words({panel_width - 124, label_y}, series.label, "");
    label_y += 16;
  }
  for (const Point2& p : panel.marks) {
    if (is_drawable(p)) svg += circle(place(p), 8, "fill=\"none\" stroke=\"#000\" stroke-width=\"2\"");
  }
  if (!panel.marks.empty()) {
    svg += circle({panel_width - 140, label_y - 4}, 6, "fill=\"none\" stroke=\"#000\" stroke-width=\"2\"");
    svg += words({panel_width - 124, label_y}, panel.mark_label, "");
  }
  return svg;
}

}  // namespace

std::vector<Point2> best_points(std::vector<Point2> points) {
  std::erase_if(points, [](const Point2& p) { return !is_drawable(p); });
  std::sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) { return a.x < b.x; });
  std::vector<Point2> best;
  for (const Point2& p : points) {
    if (best.empty() || p.y < best.back().y) best.push_back(p);
  }
  return best;
}

std::string svg_plot(const std::vector<Panel>& panels) {
  const std::string width = pixels(panel_width * static_cast<double>(panels.size())), height = pixels(panel_height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height + "\" width=\"" +
                    width + "\" height=\"" + height + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  for (std::size_t k = 0; k < panels.size(); ++k) {
    svg += "<g transform=\"translate(" + pixels(panel_width * static_cast<double>(k)) + " 0)\">\n" + draw(panels[k]) +
           "</g>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace npfem::app::bench
