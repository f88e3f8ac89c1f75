// SPDX-License-Identifier: Apache-2.0
// Figures of measured against simulated values, and of the target over the trials, as SVG text.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

/// Draws force over deflection, with the error (2) of every point below.
std::string force_plot(const ComparedForces& curve);

/// Draws the relative difference (1) of every paired mode as a bar, beside its label and both
/// frequencies.
std::string frequency_plot(const ModalComparison& comparison);

/// Draws the target of every trial, and the best so far.
std::string convergence_plot(const Convergence& convergence);

}  // namespace latsch::report
