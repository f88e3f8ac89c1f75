// SPDX-License-Identifier: Apache-2.0
// Draws samples of a density until its chains have converged by their diagnostics, or a limit of
// steps is reached.
//
// Walkers start from the linear density around a fit, or around several. Stuck walkers are released
// three times; later, the first half of all steps is left out. The chains run until every variable
// has R-hat <= 1.01 and effective numbers of draws >= 400 [Vehtari et al. 2021], at most to ten
// times their first length. Chains that have not converged then begin anew in the coordinates in
// which a valley is straight (walker_chains.h), if they are known and did not serve before. What
// does not converge is named, not hidden: `unmixed`.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "optimization/posterior/chain_diagnostics.h"
#include "optimization/posterior/residual_surrogate.h"
#include "optimization/posterior/walker_chains.h"

namespace latsch {

constexpr double kLargestRhat = 1.01;
constexpr double kFewestEffective = 400.0;

struct SampleOptions {
  int samples = 2000;    // number of samples that are kept
  long first_steps = 0;  // steps of each walker before the first diagnosis; 0: 1000 + 200 n
  std::uint64_t seed = 0;
  int threads = 1;  // does not change the result
};

struct PosteriorSamples {
  Eigen::MatrixXd u;                          // n x samples, in the unit cube
  Eigen::VectorXd log_density;                // one a sample
  std::vector<int> chain;                     // walker of each sample
  std::vector<ChainDiagnostics> diagnostics;  // one a variable
  std::vector<int> unmixed;                   // variables whose diagnostics fall short
  long steps = 0;         // number of steps of each walker, the first half included
  double accepted = 0.0;  // share of accepted moves

  Eigen::Index size() const { return u.cols(); }
};

/// Returns starts of the walkers, n x walker_count(n), drawn from the normal density of the frame's
/// deviations around its center, reflected into the cube. `modes` are further centers, one in each
/// column; walkers are shared evenly among all. A start of density 0 is drawn again, nearer and
/// nearer to the center. Returns nullopt if the density is 0 at a center.
std::optional<Eigen::MatrixXd> walker_starts(const WhitenedFrame& frame,
                                             const Eigen::MatrixXd& modes,
                                             const LogDensityAt& density,
                                             std::uint64_t seed);

/// Runs the chains on and returns their samples.
PosteriorSamples draw_samples(WalkerChains chains, const SampleOptions& options);

}  // namespace latsch
