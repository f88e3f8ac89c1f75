// SPDX-License-Identifier: Apache-2.0
// Estimates whether chains have forgotten their start and how many independent draws they are worth
// [Vehtari, Gelman, Simpson, Carpenter, Bürkner, Bayesian Anal. 16 (2021) 667; numbers of equations
// and sections are theirs].
//
// Every chain of N draws is split into two halves, so that a slow drift shows. With B the variance
// between the M split chains and W the mean variance within,
//
//   R-hat = sqrt(((N - 1)/N W + B/N) / W)                                                    (3, 4)
//   S_eff = M N / tau,  tau = 1 + 2 sum of rho_t over t = 1 .. T                        (10 ... 13)
//
// where rho_t is the autocorrelation of the chains together and T ends at the first pair of rho_t
// whose sum is not positive; the sums of pairs are made to fall monotonically [Geyer 1992]. The
// draws are replaced by the normal scores of their ranks, so that heavy tails do no harm (14).
// R-hat is the larger one of the draws and of their distances to the median, which shows chains
// that differ in spread alone (section 4.1). The bulk is the effective number of the normal scores,
// the tail the smaller one of the indicators of the 5 % and 95 % quantiles (section 4.3).
//
// Walkers of one ensemble (walker_chains.h) move along each other's differences. They are
// independent given the other half, and their joint density is the product of the wanted one, so
// each is a chain of its own here.
#pragma once

#include <Eigen/Core>

namespace latsch {

struct ChainDiagnostics {
  double rhat = 0.0;  // rank-normalized split R-hat; NaN: the draws are constant
  double bulk = 0.0;  // effective number of draws for means and medians
  double tail = 0.0;  // effective number of draws for the 5 % and 95 % quantiles
};

/// Returns the diagnostics of the chains of one variable: N draws x M chains, N >= 4.
ChainDiagnostics chain_diagnostics(const Eigen::MatrixXd& chains);

/// Returns R-hat of chains as they are, neither split nor normalized (3, 4).
double plain_rhat(const Eigen::MatrixXd& chains);

/// Returns the effective number of draws of chains as they are (10 ... 13).
double effective_draws(const Eigen::MatrixXd& chains);

/// Returns the quantile p of the values by linear interpolation between the sorted ones, the first
/// of which is quantile 0 and the last quantile 1.
double quantile_of(Eigen::VectorXd values, double p);

}  // namespace latsch
