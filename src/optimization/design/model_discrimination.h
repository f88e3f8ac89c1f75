// SPDX-License-Identifier: Apache-2.0
// Tests that tell two models apart (T-optimality).
//
// One model predicts y(s) at the settings s, in units of the noise; its rival predicts z(s, v) with
// variables v of its own in their unit cube. Tests at s_1 .. s_N are worth
//   T = min over v of  sum |y(s_i) - z(s_i, v)|^2 + (v - v_0)' M_0 (v - v_0)                   (1)
// the sum of squares that the rival cannot fit, if the first model is true [Atkinson, Fedorov,
// Biometrika 62 (1975) 57]. The last term is what is known of v already.
//
// Given other tests, at whose best v the rival has the slopes F and M = M_0 + sum F'F, one more
// test at s with the difference d = y - z raises T by
//   d' (I + F M^-1 F')^-1 d                                                                    (2)
// if the rival is linear near v. Tests are chosen one after the other by (2), then each is chosen
// anew given the others; a choice stays only if T itself, with v fitted anew, is larger.
//
// Limits: (1) is minimized from several starts, which need not find the least of several minima; T
// is then too large.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace latsch {

/// Two models between which tests are to decide.
struct RivalProblem {
  int settings = 1;  // number of settings
  /// Returns y(s).
  std::function<Eigen::VectorXd(const Eigen::VectorXd& s)> truth;
  /// Returns z(s, v), as long as y(s).
  std::function<Eigen::VectorXd(const Eigen::VectorXd& s, const Eigen::VectorXd& v)> rival;
  /// Returns true if a rig can make a test at s; empty: it can at all.
  std::function<bool(const Eigen::VectorXd& s)> admits = {};
  Eigen::VectorXd start;    // v_0
  Eigen::MatrixXd present;  // M_0
  double finest = 1e-4;     // last length of the steps of a search, in the unit cube
};

/// Fit of the rival to what the first model predicts.
struct RivalFit {
  Eigen::VectorXd v;
  double T = 0.0;     // (1)
  Eigen::MatrixXd M;  // information of v
};

/// Fits the rival at these tests; each counts `weight` times.
RivalFit fit_rival(const RivalProblem& problem,
                   const std::vector<Eigen::VectorXd>& tests,
                   double weight = 1.0);

/// Returns the settings of `count` tests. Empty if nothing is admitted.
std::vector<Eigen::VectorXd> best_tests_against(const RivalProblem& problem, int count);

}  // namespace latsch
