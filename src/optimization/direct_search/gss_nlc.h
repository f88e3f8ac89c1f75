// SPDX-License-Identifier: Apache-2.0
// GSS-NLC: generating-set search with nonlinear constraints, which an evaluation reports beside the
// target (Score::constraints, Score::equations).
//
//   repeat  minimize  P_k = f + rho_k p(v)  (penalty.h) with gss.h, which satisfies bounds and
//           linear constraints, from the best point so far, down to a step of delta_k
//   until   v counts as fulfilled and delta_k is the step tolerance, or rho is at its largest
//   with    rho_k+1 = 10 rho_k while v is not fulfilled, delta_k+1 = delta_k / 4, and a tenth of
//           the width of smoothing
//
// Each search first observes all known outcomes, judged by its own P, so nothing is evaluated
// twice. The method is for targets with kinks and points that fail; if all functions are smooth,
// sqp.h needs a tenth of the evaluations. With the squared penalty the result violates the
// constraints by about lambda / (2 rho), where lambda is their multiplier. With an exact penalty
// the result is on the constraints, but kinks stop the search early if equations are curved: by 2
// to 5 % in problem 71 of Hock and Schittkowski.
//
// [Griffin & Kolda, Appl. Math. Res. Express 2010, 36; the "GSS-NLC" of HOPSPACK, Plantenga,
// SAND2009-6265]
#pragma once

#include <memory>
#include <vector>

#include "optimization/direct_search/gss.h"
#include "optimization/direct_search/penalty.h"

namespace latsch {

/// Search and penalty.
struct GssNlcOptions {
  /// Initial step of the first search and tolerance of the last. The contraction is larger than
  /// without a penalty, because a faster contraction leaves the penalty's valleys too early:
  /// problem 71 of Hock and Schittkowski then ends 0.7 % off.
  GssOptions gss = {.contraction = 0.5};
  Penalty penalty = Penalty::l2_squared;  // kind of the penalty
  double rho = 1.0;          // rho of the first search: change of the target worth a violation of 1
  double largest_rho = 1e8;  // the search gives up beyond it
  double alpha = 1.0;  // alpha of the first search: width of smoothing, in units of the constraints
};

class GssNlc : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit GssNlc(const DesignSpace& space, const GssNlcOptions& options = {});

  /// Proposes no points beyond the search for the present rho.
  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override { return search_->converged(); }

  /// Present factor of the penalty.
  double rho() const { return rho_; }

 private:
  struct Known {
    DesignPoint point;
    Result<Score> outcome;
  };

  Result<Score> penalized(const Result<Score>& outcome) const;
  const Known* best() const;
  void begin_search(double initial_step);
  void end_search();

  DesignSpace space_;
  GssNlcOptions options_;
  double rho_, alpha_, delta_;
  std::vector<Known> known_;
  std::unique_ptr<Gss> search_;
};

}  // namespace latsch
