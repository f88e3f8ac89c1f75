// SPDX-License-Identifier: Apache-2.0
// SciPy's least_squares beside our methods, in a process of its own that asks for residuals over a
// pipe: its differences count as evaluations, and the problems are the same to the bit.
#pragma once

#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

namespace latsch::benchmarks {

class SciPy {
 public:
  struct Answer {
    std::optional<std::vector<double>> residuals = {};  // none: the point failed
    bool is_spent = false;                              // no evaluations are left
  };
  using Ask = std::function<Answer(const std::vector<double>& x)>;

  SciPy();
  ~SciPy();
  SciPy(const SciPy&) = delete;
  SciPy& operator=(const SciPy&) = delete;

  /// From `start`, in the unit cube or without bounds; `difference`: relative step, 0: its own.
  void solve(const std::vector<double>& start, bool in_cube, double difference, const Ask& ask);

 private:
  int child_ = -1;
  std::FILE* to_ = nullptr;
  std::FILE* from_ = nullptr;
};

}  // namespace latsch::benchmarks
