// SPDX-License-Identifier: Apache-2.0
// Plot, as SVG text, of a measured curve and its simulated counterpart, for any quantity.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

/// Plots y over x in the measured range, and below it the error of every measured value.
std::string curve_plot(const MeasuredCurve& curve);

}  // namespace latsch::report
