// SPDX-License-Identifier: Apache-2.0
// Units of the axes of a page's plots, where people do not read SI: lengths below a meter in mm,
// angles in deg, forces of a kilonewton or more in kN, and what is made of them. Tables stay SI.
#pragma once

#include <string>
#include <vector>

namespace latsch::cli {

struct PlotUnit {
  std::string unit;
  double factor = 1.0;  // from SI
};

/// Of values in this SI unit; the unit itself where it is as good as any.
PlotUnit plot_unit(const std::string& si, const std::vector<double>& values);
/// The values in it; not finite ones stay.
std::vector<double> in_plot_unit(std::vector<double> values, const PlotUnit& unit);

}  // namespace latsch::cli
