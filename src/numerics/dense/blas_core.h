// SPDX-License-Identifier: Apache-2.0
// Which kernels OpenBLAS runs on, and who may call it.
//
// Debian's OpenBLAS 0.3.21 knows the processors of its day; on a newer one it falls back to kernels
// of 2004, two to five times slower in matrix products. This module judges by the instruction set
// instead. A user's own OPENBLAS_CORETYPE wins.
//
// The build without threads, which is what trials want, is also one without locks: functions that
// run at the same time in two threads may get the same buffer and return wrong numbers. Everything
// here that calls BLAS or LAPACK holds a BlasTurn.
#pragma once

#include <mutex>
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

/// While it lives this thread is the only one to call BLAS, on kernels that suit the processor. One
/// at a time in a thread.
class BlasTurn {
 public:
  BlasTurn();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// The kernels that suit the instruction set, or "" where OpenBLAS' own choice uses it in full
/// already.
std::string better_blas_core(const std::string& chosen);

/// Switches to other kernels. False where this BLAS cannot. Not while a BLAS function runs.
bool use_blas_core(const std::string& core);

}  // namespace latsch::numerics
