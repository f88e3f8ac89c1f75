// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/model_chains.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "optimization/posterior/chain_diagnostics.h"

namespace latsch {
namespace {

// Moves of the surrogate in one proposal: about as many as a walker needs to forget its place.
constexpr int kSurrogateMoves = 40, kSurrogateMovesOfVariable = 40;
constexpr double kShortJump = 2.38, kJumpJitter = 0.1;  // the jumps of walker_chains.h
constexpr double kLongJumps = 0.1;                      // share of moves of length 1
constexpr long kPlainEvery = 4;                         // rounds, one of which is of moves (2)
constexpr double kWay = 0.2;                            // share of the trials that is left out
constexpr Eigen::Index kGroups = 4;  // groups of walkers whose draws R-hat compares
constexpr int kLooks = 4;            // diagnoses, evenly over the rest
constexpr double kStuckModel = 2.0;  // distances of the quartiles below the first one
// Effective draws at which chains end before their trials are used up: the ends of intervals then
// scatter by 0.1 deviations, with the 400 that count as mixed by 0.13 and more.
constexpr double kEnoughEffective = 1000.0;
constexpr long kFewestRounds = 8;  // rounds that a diagnosis needs
constexpr std::uint64_t kStreamOfModel = 3'000'000;
constexpr int kFewestAlive = 3;  // walkers of a half whose differences span directions

/// Returns the draws of all walkers, rounds x walkers, as kGroups chains: those of the walkers with
/// the least first draws, and so on, round after round.
Eigen::MatrixXd grouped_by_start(const Eigen::MatrixXd& draws) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(draws.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return draws(0, a) < draws(0, b);
  });
  const Eigen::Index size = draws.cols() / kGroups;  // walkers of a group
  Eigen::MatrixXd grouped(draws.rows() * size, kGroups);
  for (Eigen::Index group = 0; group < kGroups; ++group)
    for (Eigen::Index round = 0; round < draws.rows(); ++round)
      for (Eigen::Index k = 0; k < size; ++k)
        grouped(round * size + k, group) =
            draws(round, order[static_cast<std::size_t>(group * size + k)]);
  return grouped;
}

}  // namespace

ModelChains::ModelChains(Eigen::MatrixXd starts,
                         PosteriorDensity density,
                         LogDensityAt surrogate,
                         const ModelChainOptions& options)
    : density_(std::move(density)),
      surrogate_(std::move(surrogate)),
      options_(options),
      places_(std::move(starts)),
      values_(places_.cols()),
      expected_(places_.cols()),
      way_sum_(Eigen::VectorXd::Zero(places_.cols())) {
  assert(places_.cols() >= 6 && places_.cols() % 2 == 0);
  if (surrogate_)
    moves_ = kSurrogateMoves + kSurrogateMovesOfVariable * static_cast<int>(places_.rows());
  for (Eigen::Index walker = 0; walker < places_.cols(); ++walker) {
    streams_.emplace_back(options.seed, kStreamOfModel + static_cast<std::uint64_t>(walker));
    expected_[walker] = surrogate_at(places_.col(walker));
    wanted_.emplace_back(places_.col(walker));
    movers_.push_back(static_cast<int>(walker));
  }
}

double ModelChains::surrogate_at(const Eigen::VectorXd& u) const {
  return surrogate_ ? surrogate_(u) : 0.0;
}

bool ModelChains::is_plain() const {
  return !surrogate_ || rounds_ % kPlainEvery == kPlainEvery - 1;
}

void ModelChains::propose_of(int walker) {
  const bool plain = is_plain();
  const auto half = static_cast<int>(places_.cols() / 2);
  const int others = walker < half ? half : 0;  // first walker of the half that rests
  const auto n = static_cast<double>(places_.rows());
  RandomStream& random = streams_[static_cast<std::size_t>(walker)];
  Eigen::VectorXd u = places_.col(walker);
  double expected = expected_[walker];
  bool has_moved = false;
  for (int move = 0; move < (plain ? 1 : moves_); ++move) {
    const auto a = static_cast<int>(random.below(static_cast<std::uint64_t>(half)));
    auto b = static_cast<int>(random.below(static_cast<std::uint64_t>(half - 1)));
    if (b >= a) ++b;
    const double jitter = std::exp(kJumpJitter * random.normal());
    const bool is_long = random.uniform() < kLongJumps;
    const double chance = random.uniform();
    const double gamma = is_long ? 1.0 : kShortJump / std::sqrt(2.0 * n) * jitter;
    const Eigen::VectorXd tried = u + gamma * (places_.col(others + a) - places_.col(others + b));
    if ((tried.array() < 0.0).any() || (tried.array() > 1.0).any()) continue;
    const double there = surrogate_at(tried);
    if (!plain && !(there > kNoDensity)) continue;
    if (!plain && !(std::log(1.0 - chance) < there - expected)) continue;
    u = tried;
    expected = there;
    has_moved = true;
  }
  ++proposals_;
  if (!has_moved) {        // the walker stays, and the model need not be asked
    if (!plain) ++moved_;  // (1) with y = x
    return;
  }
  movers_.push_back(walker);
  wanted_.push_back(u);
  wanted_expected_.conservativeResize(std::ssize(wanted_));
  wanted_expected_[std::ssize(wanted_) - 1] = expected;
}

void ModelChains::propose() {
  const auto half = static_cast<int>(places_.cols() / 2);
  do {
    movers_.clear();
    wanted_.clear();
    wanted_expected_.resize(0);
    if (phase_ == Phase::done) return;
    if (trials_ + half > options_.trials) {
      phase_ = Phase::done;
      return;
    }
    for (int k = 0; k < half; ++k) propose_of(half_ * half + k);
    if (!wanted_.empty()) return;
    if (half_ == 1) after_both_halves();
    half_ = 1 - half_;
    // a round without a question costs no trial; it must not go on for ever
    if (proposals_ > 1000 * options_.trials) phase_ = Phase::done;
  } while (true);
}

void ModelChains::decide(int walker, double value) {
  const auto k = static_cast<Eigen::Index>(std::find(movers_.begin(), movers_.end(), walker) -
                                           movers_.begin());
  RandomStream& random = streams_[static_cast<std::size_t>(walker)];
  const double chance = random.uniform();
  if (!(value > kNoDensity)) return;
  double ratio = value - values_[walker];                             // (2)
  if (!is_plain()) ratio += expected_[walker] - wanted_expected_[k];  // (1)
  if (!(std::log(1.0 - chance) < ratio)) return;
  places_.col(walker) = wanted_[static_cast<std::size_t>(k)];
  values_[walker] = value;
  expected_[walker] = wanted_expected_[k];
  ++moved_;
}

void ModelChains::observe(const std::vector<std::optional<double>>& sums) {
  assert(sums.size() == wanted_.size());
  for (std::size_t k = 0; k < sums.size(); ++k) {
    ++trials_;
    if (!sums[k]) ++failed_;
    const double value = sums[k] ? density_.at(*sums[k], wanted_[k]) : kNoDensity;
    if (phase_ == Phase::starts)
      values_[movers_[k]] = value;
    else
      decide(movers_[k], value);
  }
  if (phase_ == Phase::starts) {
    has_density_ = place_dead_starts();
    phase_ = has_density_ ? Phase::way : Phase::done;
  } else {
    if (half_ == 1) after_both_halves();
    half_ = 1 - half_;
  }
  propose();
}

/// Places walkers whose start has no density where another one of their half is.
bool ModelChains::place_dead_starts() {
  const auto half = static_cast<int>(places_.cols() / 2);
  for (const int first : {0, half}) {
    std::vector<int> alive;
    for (int walker = first; walker < first + half; ++walker)
      if (values_[walker] > kNoDensity && expected_[walker] > kNoDensity) alive.push_back(walker);
    if (std::ssize(alive) < kFewestAlive) return false;
    std::size_t next = 0;
    for (int walker = first; walker < first + half; ++walker) {
      if (std::binary_search(alive.begin(), alive.end(), walker)) continue;
      const int model = alive[next++ % alive.size()];
      places_.col(walker) = places_.col(model);
      values_[walker] = values_[model];
      expected_[walker] = expected_[model];
    }
  }
  return true;
}

void ModelChains::release_stuck() {
  if (way_rounds_ == 0) return;
  const Eigen::VectorXd means = way_sum_ / static_cast<double>(way_rounds_);
  const double first = quantile_of(means, 0.25), third = quantile_of(means, 0.75);
  const double limit = first - kStuckModel * (third - first);
  const auto half = static_cast<int>(places_.cols() / 2);
  for (int walker = 0; walker < places_.cols(); ++walker) {
    if (means[walker] >= limit) continue;
    const int begin = walker < half ? 0 : half;
    Eigen::Index best = 0;
    means.segment(begin, half).maxCoeff(&best);
    places_.col(walker) = places_.col(begin + best);
    values_[walker] = values_[begin + best];
    expected_[walker] = expected_[begin + best];
  }
}

void ModelChains::after_both_halves() {
  ++rounds_;
  const double share = static_cast<double>(trials_) / static_cast<double>(options_.trials);
  if (phase_ == Phase::way) {
    way_sum_ += values_;
    ++way_rounds_;
    if (share < kWay) return;
    release_stuck();
    phase_ = Phase::counted;
    proposals_ = moved_ = 0;
    return;
  }
  kept_.push_back(places_);
  kept_values_.push_back(values_);
  const double of_rest = (share - kWay) / (1.0 - kWay);
  if (of_rest * kLooks < looks_ + 1 || std::ssize(kept_) < kFewestRounds) return;
  ++looks_;
  PosteriorSamples judged;
  diagnose(judged);
  const bool are_enough = std::all_of(
      judged.diagnostics.begin(), judged.diagnostics.end(), [](const ChainDiagnostics& d) {
        return d.bulk >= kEnoughEffective && d.tail >= kEnoughEffective;
      });
  if (judged.unmixed.empty() && are_enough && options_.ends_when_mixed) phase_ = Phase::done;
}

void ModelChains::diagnose(PosteriorSamples& samples) const {
  for (Eigen::Index i = 0; i < places_.rows(); ++i) {
    if (std::ssize(kept_) < kFewestRounds) {  // too few to judge: nothing is known to have mixed
      samples.diagnostics.emplace_back();
      samples.unmixed.push_back(static_cast<int>(i));
      continue;
    }
    Eigen::MatrixXd draws(std::ssize(kept_), places_.cols());
    for (Eigen::Index k = 0; k < draws.rows(); ++k)
      draws.row(k) = kept_[static_cast<std::size_t>(k)].row(i);
    ChainDiagnostics d = chain_diagnostics(draws);
    d.rhat = chain_diagnostics(grouped_by_start(draws)).rhat;
    samples.diagnostics.push_back(d);
    const bool is_good =
        d.rhat <= kLargestRhat && d.bulk >= kFewestEffective && d.tail >= kFewestEffective;
    if (!is_good) samples.unmixed.push_back(static_cast<int>(i));
  }
}

double ModelChains::accepted() const {
  return proposals_ == 0 ? 0.0 : static_cast<double>(moved_) / static_cast<double>(proposals_);
}

PosteriorSamples ModelChains::samples() const {
  PosteriorSamples samples;
  diagnose(samples);
  const auto walkers = static_cast<long>(places_.cols());
  const long all = std::ssize(kept_) * walkers, taken = std::min<long>(options_.samples, all);
  samples.u.resize(places_.rows(), taken);
  samples.log_density.resize(taken);
  for (long k = 0; k < taken; ++k) {
    const long one = k * all / taken;
    const auto round = static_cast<std::size_t>(one / walkers);
    const auto walker = static_cast<int>(one % walkers);
    samples.u.col(k) = kept_[round].col(walker);
    samples.log_density[k] = kept_values_[round][walker];
    samples.chain.push_back(walker);
  }
  samples.steps = std::ssize(kept_) + way_rounds_;
  samples.accepted = accepted();
  return samples;
}

}  // namespace latsch
