// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/blas_core.h"

#include <dlfcn.h>

#include <cstdlib>
#include <set>

namespace latsch::numerics {
namespace {

std::mutex blas_mutex;

constexpr const char* kVariable = "OPENBLAS_CORETYPE";

template <class Function>
Function find(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

std::string ask(const char* function) {
  const auto question = find<char* (*)()>(function);
  return question ? question() : "unknown";
}

}  // namespace

std::string blas_core() { return ask("openblas_get_corename"); }
std::string blas_configuration() { return ask("openblas_get_config"); }

void choose_blas_core() {
  static const bool switched = [] {
    if (std::getenv(kVariable)) return false;
    const std::string better = better_blas_core(blas_core());
    return !better.empty() && use_blas_core(better);
  }();
  (void)switched;
}

BlasTurn::BlasTurn() : lock_(blas_mutex) { choose_blas_core(); }

std::string better_blas_core(const std::string& chosen) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (avx512 &&
      !std::set<std::string>{"SkylakeX", "Cooperlake", "SapphireRapids"}.contains(chosen)) {
    return "SkylakeX";
  }
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (!avx512 && avx2 && !std::set<std::string>{"Haswell", "Zen"}.contains(chosen))
    return "Haswell";
#endif
  (void)chosen;
  return "";
}

// Switches the kernels of OpenBLAS. OpenBLAS reads its environment variable when it is loaded,
// before any code of the program can set it, so this function makes OpenBLAS choose its kernels
// again, by the two functions that its own constructor and destructor call.
bool use_blas_core(const std::string& core) {
  const auto quit = find<void (*)()>("gotoblas_dynamic_quit");
  const auto init = find<void (*)()>("gotoblas_dynamic_init");
  if (!quit || !init) return false;
  const char* before = std::getenv(kVariable);
  const std::string kept = before ? before : "";
  setenv(kVariable, core.c_str(), 1);
  quit();
  init();
  if (before) {
    setenv(kVariable, kept.c_str(), 1);
  } else {
    unsetenv(kVariable);
  }
  return blas_core() == core;
}

}  // namespace latsch::numerics
