// SPDX-License-Identifier: Apache-2.0
// A measured curve of any quantity beside the simulated one, as SVG text.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

/// Draws y over x in the measured range, with the error of every measured value below.
std::string curve_plot(const MeasuredCurve& curve);

}  // namespace latsch::report
