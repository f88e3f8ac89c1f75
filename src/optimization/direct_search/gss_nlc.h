// SPDX-License-Identifier: Apache-2.0
// GSS-NLC: generating-set search with nonlinear constraints, which an evaluation reports beside the
// target (Score::constraints, Score::equations).
//
//   repeat  minimize  P_k = f + rho_k p(v)  by gss.h from the best point so far, down to a step of
//           delta_k; v are the violations, p the penalty (penalty.h). gss.h satisfies bounds and
//           linear constraints.
//   until   v counts as fulfilled and delta_k is the step tolerance, or rho is at its largest
//   with    rho_k+1 = 10 rho_k while v is not fulfilled, delta_k+1 = delta_k / 4, and a tenth of
//           the smoothing width alpha
//
// Each search first observes all known outcomes, judged by its own P_k, so nothing is evaluated
// twice. The method is for targets with kinks and points that fail; if all functions are smooth,
// sqp.h needs a tenth of the evaluations. With the squared penalty the result violates the
// constraints by about lambda / (2 rho), where lambda is their Lagrange multiplier. With an exact
// penalty the result lies on the constraints, but the kinks of the penalty stop the search early if
// equality constraints are curved: 2 to 5 % above the minimum in problem 71 of Hock and
// Schittkowski.
//
// [Griffin & Kolda, Appl. Math. Res. Express 2010, 36; the "GSS-NLC" of HOPSPACK, Plantenga,
// SAND2009-6265]
#pragma once

#include <memory>
#include <vector>

#include "optimization/direct_search/gss.h"
#include "optimization/direct_search/penalty.h"

namespace latsch {

/// Options of the searches and of the penalty.
struct GssNlcOptions {
  /// Options of each search: initial step of the first search and step tolerance of the last one.
  /// The contraction factor is 0.5, larger than without a penalty, because a faster contraction
  /// shortens the steps before the search has followed the valley of the penalty: problem 71 of
  /// Hock and Schittkowski then ends 0.7 % above the minimum.
  GssOptions gss = {.contraction = 0.5};
  Penalty penalty = Penalty::l2_squared;  // kind of the penalty
  double rho = 1.0;          // rho of the first search: change of the target worth a violation of 1
  double largest_rho = 1e8;  // the search ends without success beyond this value of rho
  /// Smoothing width alpha of the first search, in the units of the constraints.
  double alpha = 1.0;
};

class GssNlc : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit GssNlc(const DesignSpace& space, const GssNlcOptions& options = {});

  /// Proposes only points of the search for the present penalty factor rho.
  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override { return search_->converged(); }

  /// The present penalty factor rho.
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
