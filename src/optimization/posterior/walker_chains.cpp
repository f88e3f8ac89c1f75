// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/walker_chains.h"

#include <algorithm>
#include <barrier>
#include <cassert>
#include <cmath>
#include <numeric>
#include <thread>
#include <utility>

#include "numerics/dense/cholesky.h"
#include "optimization/posterior/chain_diagnostics.h"

namespace latsch {
namespace {

constexpr double kBestJump = 2.38;  // ter Braak's gamma for a normal density, over sqrt(2 n)
constexpr double kJitter = 0.1;     // c of (1): moves are no lattice
constexpr double kNegligible = 30.0, kNegligibleOfVariable = 3.0;  // see raise()
constexpr double kFrozen = 0.1;      // share of accepted moves (1) below which (2) are made
constexpr int kNewtonSteps = 15;     // Newton steps for (2)
constexpr double kSolved = 1e-10;    // last step of (2), in the unit cube
constexpr double kBack = 1e-7;       // largest distance of the way back of (2), in the unit cube
constexpr double kStuck = 2.0;       // distances of the quartiles below the first one
constexpr double kCopyBeside = 0.3;  // share of a difference by which a copy is set apart
constexpr int kTrialsBeside = 12;    // each half as far as the one before, to the other side
constexpr long kLongJumpEvery = 10;  // steps
constexpr std::size_t kMostKept = 2048;  // steps of a record; then every second one is dropped

}  // namespace

int walker_count(Eigen::Index variables) { return std::max(40, 4 * static_cast<int>(variables)); }

Eigen::VectorXd reflected_into_cube(Eigen::VectorXd u) {
  for (double& x : u) {
    x = std::abs(std::remainder(x, 2.0));  // the period of two reflections
  }
  return u;
}

WalkerChains::WalkerChains(LogDensityAt density,
                           Eigen::MatrixXd starts,
                           std::uint64_t seed,
                           Straightening straight)
    : density_(std::move(density)),
      places_(std::move(starts)),
      values_(places_.cols()),
      straight_(std::move(straight)) {
  assert(walkers() >= 6 && walkers() % 2 == 0);
  for (int walker = 0; walker < walkers(); ++walker) {
    values_[walker] = density_(places_.col(walker));
    assert(std::isfinite(values_[walker]));
    streams_.emplace_back(seed, static_cast<std::uint64_t>(walker));
  }
  const auto count = static_cast<std::size_t>(walkers());
  moved_.assign(count, 0);
  tried_together_.assign(count, 0);
  moved_together_.assign(count, 0);
}

void WalkerChains::move(int walker, long step) {
  // steps in pairs, so that every tenth move of each kind is a long one
  if (!is_straightened_)
    move_along_others(walker, step);
  else if (step % 2 == 0)
    move_along_others(walker, step / 2);
  else
    move_along_valley(walker, step / 2);
}

WalkerChains::Difference WalkerChains::drawn_difference(int walker, long step) {
  const int half = walkers() / 2;
  const int others = walker < half ? half : 0;  // first walker of the half that rests
  RandomStream& random = streams_[static_cast<std::size_t>(walker)];
  const auto a = static_cast<int>(random.below(static_cast<std::uint64_t>(half)));
  auto b = static_cast<int>(random.below(static_cast<std::uint64_t>(half - 1)));
  if (b >= a) ++b;
  const double n = static_cast<double>(places_.rows());
  const double jitter = std::exp(kJitter * random.normal());
  const double chance = random.uniform();
  const bool is_long = step % kLongJumpEvery == kLongJumpEvery - 1;
  const double gamma = is_long ? 1.0 : kBestJump / std::sqrt(2.0 * n) * jitter;
  return {others + a, others + b, gamma, chance};
}

std::optional<Eigen::VectorXd> WalkerChains::place_of(const Eigen::VectorXd& q,
                                                      const Eigen::VectorXd& start) const {
  Eigen::VectorXd u = start;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::MatrixXd slopes = straight_.slopes(u);
    const numerics::Cholesky factor(slopes.transpose() * slopes);
    if (!factor.is_positive_definite()) return std::nullopt;
    const Eigen::VectorXd way =
        factor.solve(Eigen::VectorXd(slopes.transpose() * (q - straight_.coordinates(u))));
    if (!(way.norm() < 10.0)) return std::nullopt;  // ten widths of the cube
    u += way;
    if (way.norm() < kSolved) return u;
  }
  return std::nullopt;
}

void WalkerChains::move_along_valley(int walker, long step) {
  const Difference d = drawn_difference(walker, step);
  const Eigen::VectorXd from = places_.col(walker);
  const Eigen::VectorXd q = straight_.coordinates(from);
  const auto tried = place_of(q + d.gamma * (straight_.coordinates(places_.col(d.a)) -
                                             straight_.coordinates(places_.col(d.b))),  // (2)
                              from);
  if (!tried || (tried->array() < 0.0).any() || (tried->array() > 1.0).any()) return;
  const double value = density_(*tried);
  if (!(value > kNoDensity)) return;
  const auto log_determinant = [this](const Eigen::VectorXd& u) {
    const Eigen::MatrixXd slopes = straight_.slopes(u);
    const numerics::Cholesky factor(slopes.transpose() * slopes);
    return factor.is_positive_definite() ? 0.5 * factor.log_determinant() : kNoDensity;
  };
  const double balance = log_determinant(from) - log_determinant(*tried);
  if (!(std::log(1.0 - d.chance) < value - values_[walker] + balance)) return;
  const auto back = place_of(q, *tried);
  if (!back || (*back - from).norm() > kBack) return;
  places_.col(walker) = *tried;
  values_[walker] = value;
  ++moved_[static_cast<std::size_t>(walker)];
}

void WalkerChains::move_along_others(int walker, long step) {
  const Difference d = drawn_difference(walker, step);
  ++tried_together_[static_cast<std::size_t>(walker)];
  const Eigen::VectorXd tried =
      places_.col(walker) + d.gamma * (places_.col(d.a) - places_.col(d.b));  // (1)
  if ((tried.array() < 0.0).any() || (tried.array() > 1.0).any()) return;
  const double value = density_(tried);
  if (!(value > kNoDensity) || !(std::log(1.0 - d.chance) < value - values_[walker])) return;
  places_.col(walker) = tried;
  values_[walker] = value;
  ++moved_[static_cast<std::size_t>(walker)];
  ++moved_together_[static_cast<std::size_t>(walker)];
}

void WalkerChains::advance(long steps, int threads) {
  const int half = walkers() / 2;
  threads = std::clamp(threads, 1, half);
  const auto move_part = [&](int thread, int first, long step) {
    const int from = first + half * thread / threads, to = first + half * (thread + 1) / threads;
    for (int walker = from; walker < to; ++walker) move(walker, step);
  };
  std::barrier turn(threads);
  const auto run = [&](int thread) {
    for (long step = steps_; step < steps_ + steps; ++step) {
      move_part(thread, 0, step);
      turn.arrive_and_wait();
      move_part(thread, half, step);
      turn.arrive_and_wait();
      if (thread == 0) keep(step + 1);
      if (threads > 1) turn.arrive_and_wait();
    }
  };
  std::vector<std::jthread> team;
  for (int thread = 1; thread < threads; ++thread) team.emplace_back(run, thread);
  run(0);
  team.clear();
  steps_ += steps;
}

void WalkerChains::keep(long step) {
  if (step % record_.stride != 0) return;
  record_.places.push_back(places_);
  record_.values.push_back(values_);
  if (record_.places.size() < kMostKept) return;
  // every second one stays, those whose step is a multiple of the doubled stride
  const bool first_stays = (step / record_.stride - std::ssize(record_.places) + 1) % 2 == 0;
  std::size_t kept = 0;
  for (std::size_t k = first_stays ? 0 : 1; k < record_.places.size(); k += 2, ++kept) {
    if (kept == k) continue;
    record_.places[kept] = std::move(record_.places[k]);
    record_.values[kept] = std::move(record_.values[k]);
  }
  record_.places.resize(kept);
  record_.values.resize(kept);
  record_.stride *= 2;
}

void WalkerChains::forget() { record_ = {}; }

// Walkers at one place have no differences, and a half in which all of them stood at one place
// could never move the other half again.
void WalkerChains::set_beside(int walker, int model) {
  RandomStream& random = streams_[static_cast<std::size_t>(walker)];
  const auto count = static_cast<std::uint64_t>(walkers());
  const Eigen::VectorXd there = places_.col(model);
  double share = kCopyBeside;
  for (int trial = 0; trial < kTrialsBeside; ++trial, share *= -0.5) {
    const int a = static_cast<int>(random.below(count)), b = static_cast<int>(random.below(count));
    const Eigen::VectorXd beside = there + share * (places_.col(a) - places_.col(b));
    if ((beside.array() < 0.0).any() || (beside.array() > 1.0).any() || beside == there) continue;
    const double value = density_(beside);
    if (!(value > kNoDensity)) continue;
    places_.col(walker) = beside;
    values_[walker] = value;
    return;
  }
  places_.col(walker) = there;
  values_[walker] = values_[model];
}

void WalkerChains::straighten_if_frozen() {
  const long tried = std::accumulate(tried_together_.begin(), tried_together_.end(), 0L);
  const long accepted = std::accumulate(moved_together_.begin(), moved_together_.end(), 0L);
  is_straightened_ =
      straight_ && static_cast<double>(accepted) < kFrozen * static_cast<double>(tried);
  std::fill(tried_together_.begin(), tried_together_.end(), 0);
  std::fill(moved_together_.begin(), moved_together_.end(), 0);
}

int WalkerChains::release_stuck() {
  if (record_.values.empty()) return 0;
  Eigen::VectorXd means = Eigen::VectorXd::Zero(walkers());
  for (const Eigen::VectorXd& values : record_.values) means += values;
  means /= static_cast<double>(record_.values.size());
  const double first = quantile_of(means, 0.25), third = quantile_of(means, 0.75);
  const double limit = first - kStuck * (third - first);
  const int half = walkers() / 2;
  int moved = 0;
  for (int walker = 0; walker < walkers(); ++walker) {
    if (means[walker] >= limit) continue;
    const int begin = walker < half ? 0 : half;
    Eigen::Index best = 0;
    means.segment(begin, half).maxCoeff(&best);
    set_beside(walker, begin + static_cast<int>(best));
    ++moved;
  }
  forget();
  return moved;
}

bool WalkerChains::change_density(LogDensityAt density, Straightening straight) {
  density_ = std::move(density);
  straight_ = std::move(straight);
  is_straightened_ = is_straightened_ && straight_;
  for (int walker = 0; walker < walkers(); ++walker)
    values_[walker] = density_(places_.col(walker));
  const int half = walkers() / 2;
  for (int first : {0, half}) {
    std::vector<int> alive;
    for (int walker = first; walker < first + half; ++walker)
      if (values_[walker] > kNoDensity) alive.push_back(walker);
    if (std::ssize(alive) < 3) return false;  // fewer have no differences to move along
    std::size_t next = 0;
    for (int walker = first; walker < first + half; ++walker) {
      if (values_[walker] > kNoDensity) continue;
      set_beside(walker, alive[next++ % alive.size()]);
    }
  }
  return true;
}

bool WalkerChains::straighten() {
  if (is_straightened_ || !straight_) return false;
  is_straightened_ = true;
  forget();
  return true;
}

void WalkerChains::raise(const std::function<Eigen::VectorXd(const Eigen::VectorXd& u)>& uphill) {
  const double least = values_.maxCoeff() - kNegligible -
                       kNegligibleOfVariable * static_cast<double>(places_.rows());
  for (int walker = 0; walker < walkers(); ++walker) {
    if (values_[walker] >= least) continue;
    const Eigen::VectorXd above = uphill(places_.col(walker));
    const double value = density_(above);
    if (!(value > values_[walker])) continue;
    places_.col(walker) = above;
    values_[walker] = value;
  }
}

double WalkerChains::accepted() const {
  const long moved = std::accumulate(moved_.begin(), moved_.end(), 0L);
  const long tried = steps_ * walkers();
  return tried == 0 ? 0.0 : static_cast<double>(moved) / static_cast<double>(tried);
}

}  // namespace latsch
