// SPDX-License-Identifier: Apache-2.0
// Units for the plots of a page, where people do not expect SI: lengths below a meter in mm, angles
// in deg, forces of a kilonewton or more in kN, and quantities derived from these. Tables stay in
// SI.
#pragma once

#include <string>
#include <vector>

namespace latsch::cli {

struct PlotUnit {
  std::string unit;
  double factor = 1.0;  // factor from SI to the unit
};

/// Returns the unit in which to plot values that have the unit `si`; `si` itself if it is suitable.
PlotUnit plot_unit(const std::string& si, const std::vector<double>& values);
/// Returns the values converted to the plot's unit; values that are not finite stay as they are.
std::vector<double> in_plot_unit(std::vector<double> values, const PlotUnit& unit);

}  // namespace latsch::cli
