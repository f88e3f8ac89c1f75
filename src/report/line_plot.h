// SPDX-License-Identifier: Apache-2.0
// Lines y(x) in one frame, as SVG text: time series, spectra, responses.
#pragma once

#include <string>
#include <vector>

namespace latsch::report {

struct PlotLine {
  std::string name;                            // in the legend; empty: none
  std::vector<double> x, y;                    // as a person reads them; not finite: left out
  int color = 0;                               // a category, see color_map.h
  std::vector<double> spread;                  // a band of +- this around y; may be empty
  bool are_dots = false;                       // not joined
  std::vector<double> lower = {}, upper = {};  // or a band between these; may be empty
};

struct LinePlot {
  std::string description;       // for screen readers
  std::string x_title, y_title;  // with units
  std::vector<PlotLine> lines;
  bool logarithmic_y = false;  // values that are not positive are left out
  double width = 520.0, height = 300.0;
};

std::string line_plot(const LinePlot& plot);

}  // namespace latsch::report
