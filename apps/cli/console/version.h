// SPDX-License-Identifier: Apache-2.0
// The output of latsch --version: the program, its build and the machine.
#pragma once

#include <string>

namespace latsch::cli {

/// Returns "latsch 0.1.0 (AMD EPYC, kernels avx2)", then a line for each part: compiler, libraries
/// in the loaded versions, MPI, the page of `latsch serve`. Throws if LATSCH_KERNELS is impossible.
std::string version_text();
/// Returns the version number alone: "0.1.0".
std::string version_number();

}  // namespace latsch::cli
