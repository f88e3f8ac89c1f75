// SPDX-License-Identifier: Apache-2.0
// Which kernels OpenBLAS runs on.
//
// Debian's OpenBLAS 0.3.21 knows the processors of its day; on a newer one it falls back to kernels
// of 2004, two to five times slower in matrix products. This module judges by the instruction set
// instead. Everything here that calls BLAS does so first. A user's own OPENBLAS_CORETYPE wins.
#pragma once

#include <string>

namespace latsch::numerics {

/// Name of the kernels in use: "SkylakeX", "Haswell", "Zen" ...; "unknown" where the BLAS is not
/// OpenBLAS.
std::string blas_core();
/// "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH NO_AFFINITY SkylakeX SINGLE_THREADED": for logs and
/// benchmark tables.
std::string blas_configuration();

/// Switches to the better kernels if there are any; the second call and later ones do nothing.
void choose_blas_core();

/// The kernels that suit the instruction set, or "" where OpenBLAS' own choice uses it in full
/// already.
std::string better_blas_core(const std::string& chosen);

/// Switches to other kernels. False where this BLAS cannot. Not while a BLAS function runs.
bool use_blas_core(const std::string& core);

}  // namespace latsch::numerics
