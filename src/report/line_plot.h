// SPDX-License-Identifier: Apache-2.0
// Plots of several lines y(x) in one frame, as SVG text: time series, spectra, frequency responses.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace latsch::report {

struct PlotLine {
  std::string name;  // name in the legend; empty: no entry
  /// values in the units of the plot; values that are not finite are omitted
  std::vector<double> x, y;
  int color = 0;                    // index of the line's color, see category() in color_map.h
  std::vector<double> spread = {};  // half width of a band around y; may be empty
  bool are_dots = false;            // draws dots that are not joined
  /// ends of the band, as an alternative to `spread`; may be empty
  std::vector<double> lower = {}, upper = {};
  bool is_dashed = false;
};

struct LinePlot {
  std::string description = {};            // text for screen readers
  std::string x_title = {}, y_title = {};  // with units
  std::vector<PlotLine> lines;
  bool logarithmic_y = false;  // omits values that are not positive
  double width = 520.0, height = 300.0;
  /// Range of the data along x; the plot outside it is shaded. If both ends are equal, all is
  /// shaded; nullopt: nothing is.
  std::optional<std::pair<double, double>> data = {};
};

std::string line_plot(const LinePlot& plot);

}  // namespace latsch::report
