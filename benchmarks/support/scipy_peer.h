// SPDX-License-Identifier: Apache-2.0
// Runs SciPy's least_squares for comparison with our methods, in a separate process that requests
// residuals over a pipe. The evaluations for its finite differences are counted, and the problems
// are the same to the bit.
#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace latsch::benchmarks {

class SciPy {
 public:
  struct Answer {
    std::optional<std::vector<double>> residuals = {};  // none: the evaluation failed
    bool is_spent = false;                              // no evaluations are left in the budget
    std::vector<double> jacobian = {};                  // row by row; only for solve_by_slopes
  };
  using Ask = std::function<Answer(const std::vector<double>& x)>;

  SciPy();
  ~SciPy();
  SciPy(const SciPy&) = delete;
  SciPy& operator=(const SciPy&) = delete;

  /// Solves from `start`, in the unit cube or without bounds. `difference` is the relative step of
  /// the finite differences; 0: the step that SciPy chooses.
  void solve(const std::vector<double>& start, bool in_cube, double difference, const Ask& ask);
  /// Solves by method trf with the Jacobian that `ask` returns, and with variables scaled by it.
  /// Empty bounds mean no bounds.
  void solve_by_slopes(const std::vector<double>& start,
                       const std::vector<double>& lower,
                       const std::vector<double>& upper,
                       const Ask& ask);

 private:
  void run(const std::string& task, std::size_t n, const Ask& ask);

  int child_ = -1;
  std::FILE* to_ = nullptr;
  std::FILE* from_ = nullptr;
};

}  // namespace latsch::benchmarks
