// SPDX-License-Identifier: Apache-2.0
// What latsch --version prints: the program, and what it is built with and runs on.
#pragma once

#include <string>

namespace latsch::cli {

/// "latsch 0.1.0 (AMD EPYC, kernels avx2)", then a line a part: compiler, libraries by the versions
/// that are loaded, MPI, the page of `latsch serve`. Throws where LATSCH_KERNELS is impossible.
std::string version_text();
/// Its number alone: "0.1.0".
std::string version_number();

}  // namespace latsch::cli
