// SPDX-License-Identifier: Apache-2.0
// Units of the axes of a page's plots that people do not read in SI: lengths below a meter in mm,
// angles in deg, forces of a kilonewton or more in kN, and quantities derived from these. Tables
// stay in SI.
#pragma once

#include <string>
#include <vector>

namespace latsch::cli {

struct PlotUnit {
  std::string unit;
  double factor = 1.0;  // converts from SI
};

/// Chooses the unit for values in this SI unit; the SI unit itself if it is suitable.
PlotUnit plot_unit(const std::string& si, const std::vector<double>& values);
/// Returns the values in the given unit; values that are not finite stay.
std::vector<double> in_plot_unit(std::vector<double> values, const PlotUnit& unit);

}  // namespace latsch::cli
