// SPDX-License-Identifier: Apache-2.0
// Lines y(x) in one frame, as SVG text: time series, spectra, responses.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace latsch::report {

struct PlotLine {
  std::string name;  // name in the legend; empty: none
  /// in the units a person reads; values that are not finite are left out
  std::vector<double> x, y;
  int color = 0;                               // index of a category, see color_map.h
  std::vector<double> spread;                  // half width of a band around y; may be empty
  bool are_dots = false;                       // draws dots that are not joined
  std::vector<double> lower = {}, upper = {};  // band limits, alternative to `spread`; may be empty
  bool is_dashed = false;
};

struct LinePlot {
  std::string description;       // for screen readers
  std::string x_title, y_title;  // with units
  std::vector<PlotLine> lines;
  bool logarithmic_y = false;  // omits values that are not positive
  double width = 520.0, height = 300.0;
  /// The ends of the data along x; the rest is shaded. Equal ends: all is shaded.
  /// nullopt: nothing is.
  std::optional<std::pair<double, double>> data = {};
};

std::string line_plot(const LinePlot& plot);

}  // namespace latsch::report
