// SPDX-License-Identifier: Apache-2.0
// Choice of OpenBLAS' kernels, and exclusive access to BLAS.
//
// Debian's OpenBLAS 0.3.21 recognizes the processors of its time. On a newer one it uses kernels of
// 2004, which are two to five times slower in matrix products. This module chooses kernels by the
// instruction set instead. The user's environment variable OPENBLAS_CORETYPE has priority.
//
// The single-threaded build of OpenBLAS, which suits trials, also has no locks: if two threads call
// it at the same time, both may get the same buffer, and the results are wrong. All code here that
// calls BLAS or LAPACK therefore holds a BlasTurn.
#pragma once

#include <mutex>
#include <string>

namespace latsch::numerics {

/// Returns the name of the kernels in use: "SkylakeX", "Haswell", "Zen" ...; "unknown" if the BLAS
/// is not OpenBLAS.
std::string blas_core();
/// Returns, for logs and benchmark tables, a text such as "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH
/// NO_AFFINITY SkylakeX SINGLE_THREADED".
std::string blas_configuration();

/// Switches to better kernels if OpenBLAS has any. Later calls do nothing.
void choose_blas_core();

/// While an object of this class lives, its thread is the only one that calls BLAS, on kernels that
/// suit the processor. A thread may hold only one at a time.
class BlasTurn {
 public:
  BlasTurn();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Returns the kernels that suit the instruction set, or "" if OpenBLAS' own choice already uses it
/// fully.
std::string better_blas_core(const std::string& chosen);

/// Switches to other kernels. Returns false if this BLAS cannot. Must not be called while a BLAS
/// function runs.
bool use_blas_core(const std::string& core);

}  // namespace latsch::numerics
