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
// First and last length of the steps of the refinement, in the unit cube. The last one sets how
// exactly places are found.
constexpr double kFirstReach = 0.03, kLastReach = 1e-5;
// DesignPlaces nearer than this share of every range are one place.
constexpr double kOnePlace = 0.02;
// SettledShares below this are given up.
constexpr double kLeastShare = 1e-3;
// The design is best if no sensitivity exceeds its mean by more.
constexpr double kBestRatio = 1.0 + 1e-4;
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

/// Returns the derivative of the criterion by M, with the sign of a gain.
Eigen::MatrixXd gain_matrix(const DesignProblem& problem, const Eigen::MatrixXd& M) {
  const Eigen::MatrixXd inverse = inverse_information(M);
  return problem.W ? Eigen::MatrixXd(inverse * *problem.W * inverse) : inverse;
}

double criterion_of(const DesignProblem& problem, const Eigen::MatrixXd& M) {
  if (problem.W) return (inverse_information(M) * *problem.W).trace();
  const numerics::Cholesky factors(M);
  if (!factors.is_positive_definite()) return kInfinity;
  return std::exp(-factors.log_determinant() / static_cast<double>(M.rows()));
}

using DesignGain = std::function<double(const Eigen::VectorXd& s)>;

/// Searches settings with the largest gain.
class PlaceSearch {
 public:
  explicit PlaceSearch(const DesignProblem& problem) : problem_(problem) {
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
  }

  const DesignPlaces& points() const { return points_; }

  /// Returns the best place; `others` are further places from which the search begins.
  Eigen::VectorXd best(const DesignGain& gain, const DesignPlaces& others = {}) const {
    std::vector<std::pair<double, Eigen::VectorXd>> rated;
    for (const DesignPlaces* places : {&points_, &others})
      for (const Eigen::VectorXd& s : *places) rated.emplace_back(gain(s), s);
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
  void add(const Eigen::VectorXd& s) {
    if (!problem_.admits || problem_.admits(s)) points_.push_back(s);
  }

  /// Moves s along single settings and diagonals of two while that gains, in ever shorter steps.
  void refine(const DesignGain& gain, double& value, Eigen::VectorXd& s) const {
    for (double reach = kFirstReach; reach > kLastReach;) {
      bool moved = false;
      for (const Eigen::VectorXd& way : ways_) {
        const Eigen::VectorXd to = (s + reach * way).cwiseMax(0.0).cwiseMin(1.0);
        if (to == s || (problem_.admits && !problem_.admits(to))) continue;
        const double reached = gain(to);
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
  DesignPlaces ways_ = ways_of(problem_.settings);
};

/// A design of shares that is being improved.
class SettledShares {
 public:
  SettledShares(const DesignProblem& problem, double tests) : problem_(problem), tests_(tests) {}

  void add(const Eigen::VectorXd& s, double share) {
    for (double& one : shares_) one *= 1.0 - share;
    places_.push_back(s);
    gains_.push_back(information_at(s));
    shares_.push_back(share);
  }
  /// Moves the place nearest to s onto it; false if none is near.
  bool move_near(const Eigen::VectorXd& s) {
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if ((places_[k] - s).lpNorm<Eigen::Infinity>() > kOnePlace) continue;
      places_[k] = s;
      gains_[k] = information_at(s);
      return true;
    }
    return false;
  }
  Eigen::MatrixXd information() const {
    Eigen::MatrixXd M = problem_.present;
    for (std::size_t k = 0; k < places_.size(); ++k) M += tests_ * shares_[k] * gains_[k];
    return M;
  }
  /// Multiplies every share by its sensitivity over the mean, to a power that makes the criterion
  /// fall at every step [Torsney 1983; Yu, Ann. Stat. 38 (2010) 1593].
  void settle() {
    const double power = problem_.W ? 0.5 : 1.0;
    for (int step = 0; step < kMostShareSteps; ++step) {
      const Eigen::MatrixXd G = gain_matrix(problem_, information());
      double mean = 0.0, change = 0.0, sum = 0.0;
      std::vector<double> phi;
      for (std::size_t k = 0; k < places_.size(); ++k) {
        phi.push_back(G.cwiseProduct(gains_[k]).sum());
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
  double mean_sensitivity(const Eigen::MatrixXd& G) const {
    double mean = 0.0;
    for (std::size_t k = 0; k < places_.size(); ++k)
      mean += shares_[k] * G.cwiseProduct(gains_[k]).sum();
    return mean;
  }
  const DesignPlaces& places() const { return places_; }
  const std::vector<double>& shares() const { return shares_; }

 private:
  Eigen::MatrixXd information_at(const Eigen::VectorXd& s) const {
    const Eigen::MatrixXd J = problem_.rows(s);
    return J.transpose() * J;
  }

  const DesignProblem& problem_;
  double tests_;
  DesignPlaces places_;
  std::vector<Eigen::MatrixXd> gains_;  // J'J at the places
  std::vector<double> shares_;
};

Eigen::MatrixXd information_of(const DesignProblem& problem, const DesignPlaces& tests) {
  Eigen::MatrixXd M = problem.present;
  for (const Eigen::VectorXd& s : tests) {
    const Eigen::MatrixXd J = problem.rows(s);
    M += J.transpose() * J;
  }
  return M;
}

}  // namespace

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
    const Eigen::MatrixXd G = gain_matrix(problem, shares.information());
    const DesignGain sensitivity = [&](const Eigen::VectorXd& s) {
      const Eigen::MatrixXd J = problem.rows(s);
      return (J * G * J.transpose()).trace();
    };
    const Eigen::VectorXd best = search.best(sensitivity, shares.places());
    design.largest_ratio = sensitivity(best) / shares.mean_sensitivity(G);
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
  const auto added_to = [&](const Eigen::MatrixXd& M, const DesignPlaces& near) {
    return search.best(
        [&](const Eigen::VectorXd& s) {
          const Eigen::MatrixXd J = problem.rows(s);
          return -criterion_of(problem, M + J.transpose() * J);
        },
        near);
  };
  for (int k = 0; k < count; ++k) tests.push_back(added_to(information_of(problem, tests), tests));
  double before = design_criterion(problem, tests);
  for (int round = 0; round < kMostExchanges; ++round) {
    for (std::size_t k = 0; k < tests.size(); ++k) {
      DesignPlaces others = tests;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      tests[k] = added_to(information_of(problem, others), tests);
    }
    const double after = design_criterion(problem, tests);
    if (!(after < (1.0 - kLeastExchange) * before)) break;
    before = after;
  }
  return tests;
}

double design_criterion(const DesignProblem& problem, const std::vector<Eigen::VectorXd>& tests) {
  return criterion_of(problem, information_of(problem, tests));
}

}  // namespace latsch
