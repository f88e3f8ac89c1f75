// SPDX-License-Identifier: Apache-2.0
// Designs of further measurements whose settings vary continuously.
//
// A test at the settings s, in the unit cube of the settings, adds the rows J(s) of derivatives of
// its residuals by the n variables, each divided by its noise. N tests with the shares w_i make
//   M = M_0 + N sum w_i J(s_i)' J(s_i)
// of the information M_0 that is there. The aim is to make least
//   D    -ln det M          volume of the confidence ellipsoid, or
//   W    tr(W M^-1)         W = 1: mean variance of the variables (A); W = c c': variance of c'u;
//                           W = mean of g g': mean variance of predictions with slopes g (I).
// With G = M^-1 for D and M^-1 W M^-1 otherwise, the sensitivity of a test is
//   phi(s) = tr(J(s) G J(s)')
// and shares are best if and only if phi nowhere exceeds its mean over the design [Kiefer,
// Wolfowitz, Canad. J. Math. 12 (1960) 363; Fedorov, Theory of Optimal Experiments, 1972, ch. 2].
// The largest ratio is returned, so that a design proves itself.
//
// With the slopes at several draws of the variables, the criterion is its mean over the draws, of
// ln det M for D. M_0 is the same for all.
//
// Limits: with one draw M belongs to the slopes at one point, so the design is a local one.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace latsch {

/// A campaign whose tests can be chosen.
struct DesignProblem {
  int settings = 1;  // number of settings
  /// Returns J(s), one row for each residual of a test, one column for each variable; the columns
  /// of further draws follow those of the first.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& s)> rows;
  /// Returns true if a rig can make a test at s; empty: it can at all.
  std::function<bool(const Eigen::VectorXd& s)> admits = {};
  Eigen::MatrixXd present;                          // M_0, n x n
  std::optional<Eigen::MatrixXd> W = std::nullopt;  // nullopt: D
  int draws = 1;                                    // draws of the variables
  /// Last length of the steps of a search, in the unit cube. It sets how exactly places are found.
  double finest = 1e-5;
};

/// A design of shares.
struct SharedDesign {
  std::vector<Eigen::VectorXd> places;  // settings in the unit cube
  std::vector<double> shares;           // their sum is 1
  double largest_ratio = 0.0;           // largest phi over its mean; 1: no design is better
};

/// Returns the best shares of `tests` tests. Places nearer than 2 % of all ranges are one place.
/// Returns no places if nothing is admitted.
SharedDesign best_shares(const DesignProblem& problem, double tests = 1.0);

/// Returns the settings of `count` whole tests: each in turn where it gains most, then each chosen
/// anew given the others until that gains less than 0.1 %. Places may repeat: these are replicates.
std::vector<Eigen::VectorXd> best_tests(const DesignProblem& problem, int count);

/// Returns the criterion of the information with these tests: (det M)^(-1/n) for D, else tr(W
/// M^-1). Half the value is worth twice the tests, if the tests outweigh what was there. With
/// `weight` every test counts as that many.
double design_criterion(const DesignProblem& problem,
                        const std::vector<Eigen::VectorXd>& tests,
                        double weight = 1.0);

/// Returns the indices of the tests in the order of their gain: each in turn is the one that gains
/// most after those before it.
std::vector<int> order_of_gain(const DesignProblem& problem,
                               const std::vector<Eigen::VectorXd>& tests);

/// Returns the admitted places from which searches begin: 256 points of a low-discrepancy sequence
/// and the corners.
std::vector<Eigen::VectorXd> first_places(const DesignProblem& problem);

}  // namespace latsch
