// SPDX-License-Identifier: Apache-2.0
// The 27 problems of nonlinear regression among the Statistical Reference Datasets of NIST, each
// from its two published starts:
//
//   r_i(b) = model(x_i, b) - y_i
//
// Their sums of squares are certified to eleven digits, computed in 128-bit precision.
// tables/NAME.txt holds observations, starts and certified values of one problem as NIST publishes
// them at https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml (public domain); the model
// functions are in nist_strd.cpp.
#pragma once

#include <string>
#include <vector>

#include "more_wild/more_wild_problems.h"

namespace latsch::nist_strd {

struct Dataset {
  std::string name;
  std::vector<double> start_1 = {}, start_2 = {};
  std::vector<double> certified = {};          // b
  double sum = 0.0;                            // sum of squares at the certified b
  std::vector<std::vector<double>> rows = {};  // x, y; for Nelson x1, x2, y
};

/// Throws InputError if the table cannot be read.
Dataset read_dataset(const std::string& name);
std::vector<std::string> names();
/// Throws std::out_of_range for an unknown name.
std::vector<double> residuals(const Dataset& dataset, const std::vector<double>& b);
/// Returns dr/db, a row for each residual with the derivatives by all parameters. They are computed
/// from the formulas themselves (dual.h).
std::vector<double> jacobian(const Dataset& dataset, const std::vector<double>& b);

/// Returns the regressions as problems of the Moré-Wild form, named "Misra1a, start 1" and so on.
/// The least value is the certified one; the first step of a variable is a tenth of its start
/// value. MGH10 and MGH17 from start 2 are left out, because they are two problems of the Moré-Wild
/// set, Meyer's and Osborne's first.
std::vector<more_wild::Problem> problems();

}  // namespace latsch::nist_strd
