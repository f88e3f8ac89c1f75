// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/continuous_design.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/dense/cholesky.h"
#include "optimization/design/sobol.h"
#include "optimization/problem/infinity.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

using DesignPlaces = std::vector<Eigen::VectorXd>;

// Points of the low-discrepancy sequence among which the best are refined, and their number.
constexpr int kDesignPoints = 256;
constexpr std::size_t kRefined = 4;
// First length of the steps of the refinement, in the unit cube.
constexpr double kFirstReach = 0.03;
// DesignPlaces nearer than this share of every range are one place.
constexpr double kOnePlace = 0.02;
// SettledShares below this are given up.
constexpr double kLeastShare = 1e-3;
// The design is best if no sensitivity exceeds its mean by more. A place that is off by d exceeds
// it by about d^2, so this finds places to a thousandth of the range.
constexpr double kBestRatio = 1.0 + 1e-6;
constexpr int kMostAdditions = 300, kMostShareSteps = 2000;
// Relative change of shares that ends their iteration.
constexpr double kSettledShare = 1e-9;
// DesignGain of a round of exchanges that ends them.
constexpr double kLeastExchange = 1e-3;
constexpr int kMostExchanges = 50;

Eigen::MatrixXd inverse_information(const Eigen::MatrixXd& M) {
  return numerics::PivotedCholesky(M).solve(
      Eigen::MatrixXd(Eigen::MatrixXd::Identity(M.rows(), M.cols())));
}

/// One matrix for each draw of the variables.
using OfDraws = std::vector<Eigen::MatrixXd>;

/// Returns J'J of each draw.
OfDraws gain_of_rows(const DesignProblem& problem, const Eigen::MatrixXd& J) {
  const Eigen::Index n = problem.present.rows();
  OfDraws gains;
  for (int k = 0; k < problem.draws; ++k) {
    const auto own = J.middleCols(k * n, n);
    gains.emplace_back(own.transpose() * own);
  }
  return gains;
}

OfDraws present_of_draws(const DesignProblem& problem) {
  return OfDraws(static_cast<std::size_t>(problem.draws), problem.present);
}

void add_scaled(double factor, const OfDraws& more, OfDraws& M) {
  for (std::size_t k = 0; k < M.size(); ++k) M[k] += factor * more[k];
}

/// Returns the derivative of the criterion by M, with the sign of a gain, for each draw.
OfDraws gain_matrices(const DesignProblem& problem, const OfDraws& M) {
  OfDraws G;
  for (const Eigen::MatrixXd& one : M) {
    const Eigen::MatrixXd inverse = inverse_information(one);
    G.push_back(problem.W ? Eigen::MatrixXd(inverse * *problem.W * inverse) : inverse);
  }
  return G;
}

/// Returns the mean of tr(J G J') over the draws.
double sensitivity_of(const DesignProblem& problem, const OfDraws& G, const Eigen::MatrixXd& J) {
  const Eigen::Index n = problem.present.rows();
  double sum = 0.0;
  for (std::size_t k = 0; k < G.size(); ++k) {
    const auto own = J.middleCols(static_cast<Eigen::Index>(k) * n, n);
    sum += (own * G[k]).cwiseProduct(own).sum();
  }
  return sum / static_cast<double>(G.size());
}

double criterion_of(const DesignProblem& problem, const OfDraws& M) {
  double sum = 0.0;
  for (const Eigen::MatrixXd& one : M) {
    if (problem.W) {
      sum += (inverse_information(one) * *problem.W).trace();
      continue;
    }
    const numerics::Cholesky factors(one);
    if (!factors.is_positive_definite()) return kInfinity;
    sum += factors.log_determinant() / static_cast<double>(one.rows());
  }
  const double mean = sum / static_cast<double>(M.size());
  return problem.W ? mean : std::exp(-mean);
}

/// Computes how much one more test lowers the criterion: the mean of ln det M for D, else of tr(W
/// M^-1), by the lemmas of a change of few rows.
class OneMoreTest {
 public:
  OneMoreTest(const DesignProblem& problem, const OfDraws& M) : problem_(problem) {
    for (const Eigen::MatrixXd& one : M) {
      inverse_.push_back(inverse_information(one));
      if (problem.W) weighed_.push_back(inverse_.back() * *problem.W * inverse_.back());
    }
  }

  double gain(const Eigen::MatrixXd& J) const {
    const Eigen::Index n = problem_.present.rows(), m = J.rows();
    double sum = 0.0;
    for (std::size_t k = 0; k < inverse_.size(); ++k) {
      const Eigen::MatrixXd own = J.middleCols(static_cast<Eigen::Index>(k) * n, n);
      const numerics::Cholesky factors(
          Eigen::MatrixXd(Eigen::MatrixXd::Identity(m, m) + own * inverse_[k] * own.transpose()));
      if (!factors.is_positive_definite()) return -kInfinity;
      if (!problem_.W) {
        sum += factors.log_determinant();
        continue;
      }
      const Eigen::MatrixXd X = factors.solve_lower(own);
      sum += (X * weighed_[k]).cwiseProduct(X).sum();
    }
    return sum / static_cast<double>(inverse_.size());
  }

 private:
  const DesignProblem& problem_;
  OfDraws inverse_, weighed_;
};

/// Returns what a test with the rows J gains.
using DesignGain = std::function<double(const Eigen::MatrixXd& J)>;

/// Searches settings with the largest gain.
class PlaceSearch {
 public:
  explicit PlaceSearch(const DesignProblem& problem)
      : problem_(problem), points_(first_places(problem)), ways_(ways_of(problem.settings)) {
    for (const Eigen::VectorXd& s : points_) rows_.push_back(problem.rows(s));
  }

  const DesignPlaces& points() const { return points_; }

  /// Returns the best place; `others` are further places from which the search begins.
  Eigen::VectorXd best(const DesignGain& gain, const DesignPlaces& others = {}) const {
    std::vector<std::pair<double, Eigen::VectorXd>> rated;
    for (std::size_t k = 0; k < points_.size(); ++k) rated.emplace_back(gain(rows_[k]), points_[k]);
    for (const Eigen::VectorXd& s : others) rated.emplace_back(gain(problem_.rows(s)), s);
    std::stable_sort(
        rated.begin(), rated.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    rated.resize(std::min(rated.size(), kRefined));
    for (auto& [value, s] : rated) refine(gain, value, s);
    return std::max_element(rated.begin(),
                            rated.end(),
                            [](const auto& a, const auto& b) { return a.first < b.first; })
        ->second;
  }

 private:
  /// Moves s along single settings and diagonals of two while that gains, in ever shorter steps.
  void refine(const DesignGain& gain, double& value, Eigen::VectorXd& s) const {
    for (double reach = kFirstReach; reach > problem_.finest;) {
      bool moved = false;
      for (const Eigen::VectorXd& way : ways_) {
        const Eigen::VectorXd to = (s + reach * way).cwiseMax(0.0).cwiseMin(1.0);
        if (to == s || (problem_.admits && !problem_.admits(to))) continue;
        const double reached = gain(problem_.rows(to));
        if (!(reached > value)) continue;
        value = reached;
        s = to;
        moved = true;
      }
      if (!moved) reach *= 0.5;
    }
  }

  static DesignPlaces ways_of(int settings) {
    DesignPlaces ways;
    for (int i = 0; i < settings; ++i) {
      for (const double sign : {1.0, -1.0}) {
        ways.push_back(sign * Eigen::VectorXd::Unit(settings, i));
        for (int j = i + 1; j < settings; ++j)
          for (const double other : {1.0, -1.0})
            ways.push_back(sign * Eigen::VectorXd::Unit(settings, i) +
                           other * Eigen::VectorXd::Unit(settings, j));
      }
    }
    return ways;
  }

  const DesignProblem& problem_;
  DesignPlaces points_;
  std::vector<Eigen::MatrixXd> rows_;  // at the points
  DesignPlaces ways_;
};

/// A design of shares that is being improved.
class SettledShares {
 public:
  SettledShares(const DesignProblem& problem, double tests) : problem_(problem), tests_(tests) {}

  void add(const Eigen::VectorXd& s, double share) {
    for (double& one : shares_) one *= 1.0 - share;
    places_.push_back(s);
    gains_.push_back(gain_of_rows(problem_, problem_.rows(s)));
    shares_.push_back(share);
  }
  /// Moves the place nearest to s onto it; false if none is near.
  bool move_near(const Eigen::VectorXd& s) {
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if ((places_[k] - s).lpNorm<Eigen::Infinity>() > kOnePlace) continue;
      places_[k] = s;
      gains_[k] = gain_of_rows(problem_, problem_.rows(s));
      return true;
    }
    return false;
  }
  OfDraws information() const {
    OfDraws M = present_of_draws(problem_);
    for (std::size_t k = 0; k < places_.size(); ++k) add_scaled(tests_ * shares_[k], gains_[k], M);
    return M;
  }
  /// Multiplies every share by its sensitivity over the mean, to a power that makes the criterion
  /// fall at every step [Torsney 1983; Yu, Ann. Stat. 38 (2010) 1593].
  void settle() {
    const double power = problem_.W ? 0.5 : 1.0;
    for (int step = 0; step < kMostShareSteps; ++step) {
      const OfDraws G = gain_matrices(problem_, information());
      double mean = 0.0, change = 0.0, sum = 0.0;
      std::vector<double> phi;
      for (std::size_t k = 0; k < places_.size(); ++k) {
        phi.push_back(mean_product(G, gains_[k]));
        mean += shares_[k] * phi[k];
      }
      for (std::size_t k = 0; k < places_.size(); ++k) {
        const double next = shares_[k] * std::pow(phi[k] / mean, power);
        change = std::max(change, std::abs(next - shares_[k]));
        shares_[k] = next;
        sum += next;
      }
      for (double& share : shares_) share /= sum;
      if (change < kSettledShare) break;
    }
    for (std::size_t k = places_.size(); k-- > 0;) {
      if (shares_[k] >= kLeastShare || places_.size() == 1) continue;
      places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(k));
      gains_.erase(gains_.begin() + static_cast<std::ptrdiff_t>(k));
      shares_.erase(shares_.begin() + static_cast<std::ptrdiff_t>(k));
    }
    const double sum = std::accumulate(shares_.begin(), shares_.end(), 0.0);
    for (double& share : shares_) share /= sum;
  }
  double mean_sensitivity(const OfDraws& G) const {
    double mean = 0.0;
    for (std::size_t k = 0; k < places_.size(); ++k)
      mean += shares_[k] * mean_product(G, gains_[k]);
    return mean;
  }
  const DesignPlaces& places() const { return places_; }
  const std::vector<double>& shares() const { return shares_; }

 private:
  static double mean_product(const OfDraws& G, const OfDraws& gains) {
    double sum = 0.0;
    for (std::size_t k = 0; k < G.size(); ++k) sum += G[k].cwiseProduct(gains[k]).sum();
    return sum / static_cast<double>(G.size());
  }

  const DesignProblem& problem_;
  double tests_;
  DesignPlaces places_;
  std::vector<OfDraws> gains_;  // J'J at the places
  std::vector<double> shares_;
};

OfDraws information_of(const DesignProblem& problem,
                       const DesignPlaces& tests,
                       double weight = 1.0) {
  OfDraws M = present_of_draws(problem);
  for (const Eigen::VectorXd& s : tests)
    add_scaled(weight, gain_of_rows(problem, problem.rows(s)), M);
  return M;
}

}  // namespace

std::vector<Eigen::VectorXd> first_places(const DesignProblem& problem) {
  DesignPlaces places;
  const auto add = [&](const Eigen::VectorXd& s) {
    if (!problem.admits || problem.admits(s)) places.push_back(s);
  };
  std::vector<DesignVariable> variables;
  for (int i = 0; i < problem.settings; ++i) variables.push_back({.name = std::to_string(i)});
  for (const DesignPoint& point : sobol(DesignSpace(variables), kDesignPoints).points)
    add(to_vector(point.values));
  // corners, where gains are often largest
  constexpr int kMostCorners = 10;
  for (int k = 0; problem.settings <= kMostCorners && k < 1 << problem.settings; ++k) {
    Eigen::VectorXd corner(problem.settings);
    for (int i = 0; i < problem.settings; ++i) corner[i] = (k >> i) & 1;
    add(corner);
  }
  return places;
}

SharedDesign best_shares(const DesignProblem& problem, double tests) {
  const PlaceSearch search(problem);
  SharedDesign design;
  if (search.points().empty()) return design;
  SettledShares shares(problem, tests);
  // enough places that M has an inverse
  const auto first = std::min<std::size_t>(search.points().size(),
                                           2 * static_cast<std::size_t>(problem.present.rows()));
  for (std::size_t k = 0; k < first; ++k)
    shares.add(search.points()[k], 1.0 / static_cast<double>(k + 1));
  for (int addition = 0; addition < kMostAdditions; ++addition) {
    shares.settle();
    const OfDraws G = gain_matrices(problem, shares.information());
    const DesignGain sensitivity = [&](const Eigen::MatrixXd& J) {
      return sensitivity_of(problem, G, J);
    };
    const Eigen::VectorXd best = search.best(sensitivity, shares.places());
    design.largest_ratio = sensitivity(problem.rows(best)) / shares.mean_sensitivity(G);
    if (design.largest_ratio <= kBestRatio) break;
    if (!shares.move_near(best))
      shares.add(best, 1.0 / static_cast<double>(shares.places().size() + 1));
  }
  design.places = shares.places();
  design.shares = shares.shares();
  return design;
}

std::vector<Eigen::VectorXd> best_tests(const DesignProblem& problem, int count) {
  const PlaceSearch search(problem);
  DesignPlaces tests;
  if (search.points().empty()) return tests;
  const auto added_to = [&](const DesignPlaces& others, const DesignPlaces& near) {
    const OneMoreTest more(problem, information_of(problem, others));
    return search.best([&](const Eigen::MatrixXd& J) { return more.gain(J); }, near);
  };
  for (int k = 0; k < count; ++k) tests.push_back(added_to(tests, tests));
  double before = design_criterion(problem, tests);
  for (int round = 0; round < kMostExchanges; ++round) {
    for (std::size_t k = 0; k < tests.size(); ++k) {
      DesignPlaces others = tests;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      tests[k] = added_to(others, tests);
    }
    const double after = design_criterion(problem, tests);
    if (!(after < (1.0 - kLeastExchange) * before)) break;
    before = after;
  }
  return tests;
}

double design_criterion(const DesignProblem& problem,
                        const std::vector<Eigen::VectorXd>& tests,
                        double weight) {
  return criterion_of(problem, information_of(problem, tests, weight));
}

std::vector<int> order_of_gain(const DesignProblem& problem,
                               const std::vector<Eigen::VectorXd>& tests) {
  std::vector<Eigen::MatrixXd> rows;
  for (const Eigen::VectorXd& s : tests) rows.push_back(problem.rows(s));
  std::vector<int> order;
  std::vector<bool> is_taken(tests.size(), false);
  OfDraws M = present_of_draws(problem);
  for (std::size_t taken = 0; taken < tests.size(); ++taken) {
    const OneMoreTest more(problem, M);
    double most = -kInfinity;
    std::size_t next = tests.size();
    for (std::size_t k = 0; k < tests.size(); ++k) {
      if (is_taken[k]) continue;
      const double gain = more.gain(rows[k]);
      if (next < tests.size() && !(gain > most)) continue;
      most = gain;
      next = k;
    }
    is_taken[next] = true;
    order.push_back(static_cast<int>(next));
    add_scaled(1.0, gain_of_rows(problem, rows[next]), M);
  }
  return order;
}

}  // namespace latsch
