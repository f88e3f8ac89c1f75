// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/posterior_samples.h"

#include <algorithm>
#include <cmath>

namespace latsch {
namespace {

constexpr int kLengths[] = {1, 2, 4, 7, 10};  // lengths of the chains, in units of the first one
constexpr long kStepsOfAll = 1000, kStepsOfVariable = 200;
constexpr int kReleases = 3;  // times that stuck walkers are released before the first step counts
// Streams of starts follow those of the walkers.
constexpr std::uint64_t kStreamOfStarts = 1'000'000;
constexpr int kStartTrials = 200;  // draws of a start, each nearer to its center by a few percent
constexpr double kNearer = 0.95;

/// Returns the second half of the recorded draws of one variable, draws x walkers.
Eigen::MatrixXd draws_of(const WalkerChains::Record& record, Eigen::Index variable) {
  const std::size_t from = record.places.size() / 2;
  const auto count = static_cast<Eigen::Index>(record.places.size() - from);
  Eigen::MatrixXd draws(count, record.places.front().cols());
  for (Eigen::Index k = 0; k < count; ++k)
    draws.row(k) = record.places[from + static_cast<std::size_t>(k)].row(variable);
  return draws;
}

void diagnose(const WalkerChains& chains, PosteriorSamples& samples) {
  samples.diagnostics.clear();
  samples.unmixed.clear();
  for (Eigen::Index i = 0; i < chains.places().rows(); ++i) {
    const ChainDiagnostics d = chain_diagnostics(draws_of(chains.record(), i));
    samples.diagnostics.push_back(d);
    const bool is_good =
        d.rhat <= kLargestRhat && d.bulk >= kFewestEffective && d.tail >= kFewestEffective;
    if (!is_good) samples.unmixed.push_back(static_cast<int>(i));
  }
}

/// Runs the chains until their diagnostics are good, at most to ten times the first length.
PosteriorSamples lengthened(WalkerChains& chains, long first, int threads) {
  PosteriorSamples samples;
  for (const int length : kLengths) {
    chains.advance(first * length - samples.steps, threads);
    samples.steps = first * length;
    diagnose(chains, samples);
    if (samples.unmixed.empty()) break;
  }
  return samples;
}

/// Takes the places of all walkers at steps of even distance in the second half of the record.
void take_evenly(const WalkerChains& chains, int count, PosteriorSamples& samples) {
  const WalkerChains::Record& record = chains.record();
  const std::size_t from = record.places.size() / 2;
  const auto recorded = static_cast<long>(record.places.size() - from);
  const long walkers = chains.walkers();
  const long steps = std::min((count + walkers - 1) / walkers, recorded);
  const long taken = std::min<long>(count, steps * walkers);
  samples.u.resize(chains.places().rows(), taken);
  samples.log_density.resize(taken);
  for (long k = 0; k < taken; ++k) {
    const long step = (k / walkers + 1) * recorded / steps - 1;
    const auto walker = static_cast<int>(k % walkers);
    samples.u.col(k) = record.places[from + static_cast<std::size_t>(step)].col(walker);
    samples.log_density[k] = record.values[from + static_cast<std::size_t>(step)][walker];
    samples.chain.push_back(walker);
  }
}

}  // namespace

std::optional<Eigen::MatrixXd> walker_starts(const WhitenedFrame& frame,
                                             const Eigen::MatrixXd& modes,
                                             const LogDensityAt& density,
                                             std::uint64_t seed) {
  const Eigen::Index n = frame.center.size();
  Eigen::MatrixXd centers(n, 1 + modes.cols());
  centers.col(0) = frame.center;
  if (modes.cols() > 0) centers.rightCols(modes.cols()) = modes;
  for (Eigen::Index k = 0; k < centers.cols(); ++k)
    if (!(density(centers.col(k)) > kNoDensity)) return std::nullopt;
  const int walkers = walker_count(n);
  Eigen::MatrixXd starts(n, walkers);
  for (int walker = 0; walker < walkers; ++walker) {
    RandomStream random(seed, kStreamOfStarts + static_cast<std::uint64_t>(walker));
    const Eigen::VectorXd center = centers.col(walker % centers.cols());
    double length = 0.5;  // the frame has twice the deviations
    starts.col(walker) = center;
    for (int trial = 0; trial < kStartTrials; ++trial, length *= kNearer) {
      Eigen::VectorXd y(n);
      for (double& value : y) value = length * random.normal();
      const Eigen::VectorXd u = reflected_into_cube(center + frame.T * y);
      if (!(density(u) > kNoDensity)) continue;
      starts.col(walker) = u;
      break;
    }
  }
  return starts;
}

PosteriorSamples draw_samples(WalkerChains chains, const SampleOptions& options) {
  const Eigen::Index n = chains.places().rows();
  const long first =
      options.first_steps > 0 ? options.first_steps : kStepsOfAll + kStepsOfVariable * n;
  chains.forget();
  for (int k = 0; k < kReleases; ++k) {
    chains.advance(first / 4, options.threads);
    chains.straighten_if_frozen();
    chains.release_stuck();
  }
  PosteriorSamples samples = lengthened(chains, first, options.threads);
  if (!samples.unmixed.empty() && chains.straighten()) {
    chains.advance(first, options.threads);
    chains.forget();
    samples = lengthened(chains, first, options.threads);
  }
  take_evenly(chains, options.samples, samples);
  samples.accepted = chains.accepted();
  return samples;
}

}  // namespace latsch
