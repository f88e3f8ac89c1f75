// SPDX-License-Identifier: Apache-2.0
// Measured against simulated, and how the target came down: figures as SVG text.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

/// Force over deflection with the error (2) of every point below.
std::string force_plot(const ForceCurve& curve);

/// Relative difference (1) of every paired mode as a bar, beside its label and both frequencies.
std::string frequency_plot(const ModalComparison& comparison);

/// Target of every trial, and the best so far.
std::string convergence_plot(const Convergence& convergence);

}  // namespace latsch::report
