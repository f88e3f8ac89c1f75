// SPDX-License-Identifier: Apache-2.0
// Plots, as SVG text, of measured and simulated values, and of the target over the trials.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

/// Plots force over deflection, and below it the error of every point, as defined by equation (2).
std::string force_plot(const ComparedForces& curve);

/// Plots the relative difference, equation (1), of every pair of measured and simulated modes as a
/// bar, beside the label and both frequencies.
std::string frequency_plot(const ModalComparison& comparison);

/// Plots the target of every trial, and the best target so far.
std::string convergence_plot(const Convergence& convergence);

}  // namespace latsch::report
