// SPDX-License-Identifier: Apache-2.0
// Compiles the file LATSCH_KERNELS_IN once for each kernel set (kernel_set.h):
//
//   // scale.cpp
//   #define LATSCH_KERNELS_IN "models/x/scale_kernels.h"
//   #include "numerics/kernels/for_each_kernel_set.h"
//   namespace latsch::x {
//   void scale(double* x, int n) { LATSCH_KERNEL(scale)(x, n); }
//   }
//
//   // scale_kernels.h
//   #include "numerics/kernels/kernel_lanes.h"
//   namespace latsch::x::LATSCH_KERNELS {
//   using namespace latsch::LATSCH_KERNELS;
//   void scale(double* x, int n) {
//     for (int i = 0; i < n; i += 8) store(2.0 * lanes(x + i), x + i);
//   }
//   }
//
// The whole file may use the instructions of the set. Code that is not a kernel therefore belongs
// elsewhere, and other headers that the file needs must be included before, in the .cpp file: their
// functions must not be compiled with instructions that another processor lacks, and they would be
// if they are not inlined. Headers made for kernels are included once per set; kernel_lanes.h shows
// their include guards. The options of the .cpp file (-O2, -O3) hold for all sets.
#ifdef LATSCH_KERNEL_FILE_READ
#error "one file of kernels a .cpp file"
#endif
#define LATSCH_KERNEL_FILE_READ

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "numerics/kernels/kernel_set.h"

#if LATSCH_X86_KERNELS
#include <immintrin.h>

#define LATSCH_KERNEL_WIDTH 8
#define LATSCH_KERNELS avx512
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512dq,avx2,fma"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq,avx2,fma,prefer-vector-width=512")
#endif
#include LATSCH_KERNELS_IN
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#undef LATSCH_KERNELS
#undef LATSCH_KERNEL_WIDTH
#define LATSCH_KERNEL_TOGGLE

#define LATSCH_KERNEL_WIDTH 4
#define LATSCH_KERNELS avx2
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
#include LATSCH_KERNELS_IN
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#undef LATSCH_KERNELS
#undef LATSCH_KERNEL_WIDTH
#undef LATSCH_KERNEL_TOGGLE
#endif

#define LATSCH_KERNEL_WIDTH 2
#define LATSCH_KERNELS baseline
#include LATSCH_KERNELS_IN
