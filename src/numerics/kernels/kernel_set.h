// SPDX-License-Identifier: Apache-2.0
// Choice of the instruction set for kernels. Time-critical loops are compiled once for each set
// (for_each_kernel_set.h), and the best set that the processor supports is chosen when the first of
// them is called:
//
//   avx512    eight doubles in a register, 32 registers (AVX-512 F, VL, DQ)
//   avx2      four doubles, 16 registers, fused multiply-add (2013 and later)
//   baseline  instructions that every processor of the architecture has; on x86-64 without fused
//             multiply-add
//
// avx2 and avx512 give the same bits: the same operations in the same order. baseline rounds the
// product of a multiply-add before it adds, so its results differ in the last digits. The
// environment variable LATSCH_KERNELS = avx512 | avx2 | baseline forces a set.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__)
#define LATSCH_X86_KERNELS 1
#else
#define LATSCH_X86_KERNELS 0
#endif

namespace latsch {

enum class KernelSet { baseline, avx2, avx512 };

std::string_view name(KernelSet set);
/// Returns the sets that this processor supports, slowest first.
const std::vector<KernelSet>& kernel_sets();
/// Returns the set named by LATSCH_KERNELS = `forced`; nullptr or empty: the best one. Throws
/// InputError if no set has this name or the processor does not support it.
KernelSet chosen_kernel_set(const char* forced);

/// Returns the operating system's name of the processor, as "AMD EPYC 7763", or "unknown
/// processor".
std::string processor_name();

namespace detail {
inline constexpr int kNotChosen = -1;
extern std::atomic<int> kernel_set_in_use;
KernelSet choose_kernel_set();
}  // namespace detail

/// Returns the set in use. The first call reads LATSCH_KERNELS and may throw as chosen_kernel_set()
/// does.
inline KernelSet kernel_set() {
  const int set = detail::kernel_set_in_use.load(std::memory_order_relaxed);
  return set == detail::kNotChosen ? detail::choose_kernel_set() : static_cast<KernelSet>(set);
}

/// Selects another set of kernel_sets() while the object lives, so that tests and benchmarks can
/// run all of them.
class WithKernelSet {
 public:
  explicit WithKernelSet(KernelSet set);
  ~WithKernelSet();
  WithKernelSet(const WithKernelSet&) = delete;
  WithKernelSet& operator=(const WithKernelSet&) = delete;

 private:
  int before_;
};

}  // namespace latsch

/// Selects the function of the set in use: LATSCH_KERNEL(add)(x, y) calls avx512::add, avx2::add or
/// baseline::add, which for_each_kernel_set.h compiles. It must be used in the namespace that
/// contains these namespaces.
#if LATSCH_X86_KERNELS
#define LATSCH_KERNEL(function)                                              \
  (::latsch::kernel_set() == ::latsch::KernelSet::avx512 ? &avx512::function \
   : ::latsch::kernel_set() == ::latsch::KernelSet::avx2 ? &avx2::function   \
                                                         : &baseline::function)
#else
#define LATSCH_KERNEL(function) (&baseline::function)
#endif
