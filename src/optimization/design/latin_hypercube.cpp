// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/latin_hypercube.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/random.h"

namespace latsch {
namespace {

constexpr int kMostStarts = 20;

/// Returns d^-p of a squared distance, with p = 20: large enough that the nearest pair dominates
/// the sum.
double term(int squared) {
  const double d2 = squared, d4 = d2 * d2, d8 = d4 * d4;
  return 1.0 / (d8 * d8 * d4);
}

/// Assignment of the shares of every variable to the points. Squared distances, in units of a
/// share, are sums of squares of whole numbers and therefore exact.
class Shares {
 public:
  Shares(int points, int variables, std::uint64_t seed, int start)
      : points_(points), variables_(variables), share_(variables), squared_(points) {
    for (int v = 0; v < variables; ++v) {
      RandomStream random(seed, static_cast<std::uint64_t>(start) * variables + v);
      share_[v].resize(points);
      std::iota(share_[v].begin(), share_[v].end(), 0);
      for (int i = points - 1; i > 0; --i) std::swap(share_[v][i], share_[v][random.below(i + 1)]);
    }
    for (int i = 0; i < points; ++i) squared_[i].resize(points);
    for (int i = 0; i < points; ++i) measure(i);
  }

  int points() const { return points_; }
  int variables() const { return variables_; }
  int share(int variable, int point) const { return share_[variable][point]; }
  int squared_distance(int i, int j) const { return squared_[i][j]; }

  /// Returns the change of the sum of d^-p if points i and j exchange their coordinates of variable
  /// v.
  double change(int i, int j, int v) const {
    const std::vector<int>& share = share_[v];
    double change = 0.0;
    for (int k = 0; k < points_; ++k) {  // the distance between i and j does not change
      if (k == i || k == j) continue;
      const int shift = square(share[j] - share[k]) - square(share[i] - share[k]);
      const int d_i = squared_[i][k], d_j = squared_[j][k];
      change += term(d_i + shift) - term(d_i) + term(d_j - shift) - term(d_j);
    }
    return change;
  }

  void exchange(int i, int j, int v) {
    std::swap(share_[v][i], share_[v][j]);
    measure(i);
    measure(j);
  }

 private:
  static int square(int x) { return x * x; }

  void measure(int i) {
    for (int k = 0; k < points_; ++k) {
      int sum = 0;
      for (const auto& share : share_) sum += square(share[i] - share[k]);
      squared_[i][k] = squared_[k][i] = sum;
    }
  }

  int points_, variables_;
  std::vector<std::vector<int>> share_;    // share_[variable][point]
  std::vector<std::vector<int>> squared_;  // squared distances, in units of a share
};

struct Pair {
  int i, j;
};

Pair closest(const Shares& shares) {
  Pair pair{0, 1};
  for (int i = 0; i < shares.points(); ++i) {
    for (int j = i + 1; j < shares.points(); ++j) {
      if (shares.squared_distance(i, j) < shares.squared_distance(pair.i, pair.j)) pair = {i, j};
    }
  }
  return pair;
}

struct Exchange {
  int i, j, variable;
};

/// Returns the exchange that lowers phi_p the most; nullopt if none does.
std::optional<Exchange> best_exchange(const Shares& shares, Pair pair) {
  std::optional<Exchange> best;
  // A gain below the rounding error of the sum does not count: otherwise two exchanges could undo
  // each other forever.
  double least = -1e-9 * term(shares.squared_distance(pair.i, pair.j));
  for (int i : {pair.i, pair.j}) {
    for (int j = 0; j < shares.points(); ++j) {
      if (j == i) continue;
      for (int v = 0; v < shares.variables(); ++v) {
        const double change = shares.change(i, j, v);
        if (change >= least) continue;
        least = change;
        best = {i, j, v};
      }
    }
  }
  return best;
}

Shares improved(Shares shares) {
  while (const auto exchange = best_exchange(shares, closest(shares))) {
    shares.exchange(exchange->i, exchange->j, exchange->variable);
  }
  return shares;
}

int least_distance(const Shares& shares) {
  const Pair pair = closest(shares);
  return shares.squared_distance(pair.i, pair.j);
}

}  // namespace

SamplingPlan latin_hypercube(const DesignSpace& space, int points, std::uint64_t seed) {
  if (points < 2 || points > kMostLatinHypercubePoints) {
    throw InputError(fmt::format(
        "Latin hypercube: {} points, expected 2 to {}", points, kMostLatinHypercubePoints));
  }
  Shares best = improved(Shares(points, space.size(), seed, 0));
  const int starts = std::clamp(kMostLatinHypercubePoints / points, 1, kMostStarts);
  for (int start = 1; start < starts; ++start) {
    Shares other = improved(Shares(points, space.size(), seed, start));
    if (least_distance(other) > least_distance(best)) best = std::move(other);
  }
  SamplingPlan plan;
  for (int i = 0; i < points; ++i) {
    std::vector<double> u;
    for (int v = 0; v < space.size(); ++v) u.push_back((best.share(v, i) + 0.5) / points);
    plan.points.push_back(space.from_unit(u));
  }
  return plan;
}

}  // namespace latsch
