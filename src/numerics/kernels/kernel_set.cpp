// SPDX-License-Identifier: Apache-2.0
#include "numerics/kernels/kernel_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "base/error.h"

namespace latsch {
namespace detail {

std::atomic<int> kernel_set_in_use = kNotChosen;

KernelSet choose_kernel_set() {
  const KernelSet set = chosen_kernel_set(std::getenv("LATSCH_KERNELS"));
  int none = kNotChosen;
  kernel_set_in_use.compare_exchange_strong(none, static_cast<int>(set));
  return static_cast<KernelSet>(kernel_set_in_use.load());
}

}  // namespace detail

namespace {

constexpr KernelSet kAll[] = {KernelSet::baseline, KernelSet::avx2, KernelSet::avx512};

bool supported(KernelSet set) {
#if LATSCH_X86_KERNELS
  // These builtins also check that the operating system saves the wide registers.
  __builtin_cpu_init();
  switch (set) {
    case KernelSet::baseline:
      return true;
    case KernelSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case KernelSet::avx512:
      return supported(KernelSet::avx2) && __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq");
  }
#endif
  return set == KernelSet::baseline;
}

std::string names(const std::vector<KernelSet>& sets) {
  std::string list;
  for (const KernelSet set : sets) list += (list.empty() ? "" : ", ") + std::string(name(set));
  return list;
}

}  // namespace

std::string_view name(KernelSet set) {
  switch (set) {
    case KernelSet::avx512:
      return "avx512";
    case KernelSet::avx2:
      return "avx2";
    case KernelSet::baseline:
      break;
  }
  return "baseline";
}

const std::vector<KernelSet>& kernel_sets() {
  static const std::vector<KernelSet> sets = [] {
    std::vector<KernelSet> found;
    std::copy_if(std::begin(kAll), std::end(kAll), std::back_inserter(found), supported);
    return found;
  }();
  return sets;
}

KernelSet chosen_kernel_set(const char* forced) {
  const auto& here = kernel_sets();
  if (forced == nullptr || *forced == '\0') return here.back();
  for (const KernelSet set : kAll) {
    if (name(set) != forced) continue;
    if (std::find(here.begin(), here.end(), set) != here.end()) return set;
    throw InputError(
        fmt::format("LATSCH_KERNELS is \"{}\", which this processor ({}) does not have, expected "
                    "one of: {}; without LATSCH_KERNELS the best is taken",
                    forced,
                    processor_name(),
                    names(here)));
  }
  throw InputError(
      fmt::format("LATSCH_KERNELS is \"{}\", expected one of: {}", forced, names(here)));
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

WithKernelSet::WithKernelSet(KernelSet set) : before_(detail::kernel_set_in_use) {
  detail::kernel_set_in_use = static_cast<int>(set);
}
WithKernelSet::~WithKernelSet() { detail::kernel_set_in_use = before_; }

}  // namespace latsch
