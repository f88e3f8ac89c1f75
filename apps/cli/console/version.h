// SPDX-License-Identifier: Apache-2.0
// Text of `latsch --version`: the program, its build and the machine.
#pragma once

#include <string>

namespace latsch::cli {

/// Returns "latsch 0.1.0 (AMD EPYC, kernels avx2)", then a line for each of: compiler, versions of
/// the loaded libraries, MPI, the page of `latsch serve`. Throws if LATSCH_KERNELS names a kernel
/// set that this processor lacks.
std::string version_text();
/// Returns the version number alone: "0.1.0".
std::string version_number();

}  // namespace latsch::cli
