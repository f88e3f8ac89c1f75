// SPDX-License-Identifier: Apache-2.0
// A global search for targets that are sums over residuals: short searches for minima from points
// spread over the space, which count the basins and know when to end.
//
// The method follows multi-level single linkage [Rinnooy Kan, Timmer, Math. Program. 39 (1987) 57]
// with searches by residuals. In each round
//   1. points of a low-discrepancy sequence are evaluated, kFirst (n + 1) in the first round, the
//      start among them, and kLater (n + 1) in every later one;
//   2. the best quarter of all N points so far may start searches, the best point first. A point
//      does not if a better one lies within (ln N / N)^(1/n) / 2 of it, or if a known minimum
//      explains it (explained_point.h), if need be with one or two trials on the way to the
//      minimum. A search has kProbe (n + 1) trials. If its sum of squares then is within the factor
//      kWorthIt of the best search at that stage, it has kDescent (n + 1) further ones, and more if
//      it is the best of all; otherwise it waits. A search that a known minimum explains ends
//      there. From round kPatience on, the best one that waits goes on;
//   3. the method ends if fewer than half a basin is expected unseen. With W basins that H points
//      belong to, W (H - 1) / (H - W - 2) basins are expected in all [Boender, Rinnooy Kan, Math.
//      Program. 37 (1987) 59], W of which are seen. Searches that wait go on before this end
//      counts.
//
// A point belongs to the basin whose minimum its search found, to one whose minimum explains it, or
// to that of the better point beside it. A point that is explained costs no search of its own.
//
// Limits: the rule counts points that are explained like points that were followed, so the
// expectation is too low where the models explain too much: ripple on a slope, or two minima whose
// sums of squares hardly differ (explained_point.h). It knows nothing of basins so narrow that no
// point lies in them. Searches follow one another; idle workers evaluate what the present search
// would propose next, or the points of the round.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/found_basin.h"
#include "optimization/problem/optimizer.h"
#include "optimization/strategy/explained_point.h"

namespace latsch {

struct BasinSearchOptions {
  int budget = 100;        // most trials that the method asks for, in units of n + 1
  std::uint64_t seed = 1;  // selects the points that are spread over the space
};

class BasinSearch : public Optimizer {
 public:
  /// Returns a search that starts at the initial point of the given space.
  using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

  /// Throws InputError for a budget below 1.
  BasinSearch(const DesignSpace& space,
              const BasinSearchOptions& options,
              MakeOptimizer make_optimizer);

  std::vector<DesignPoint> propose(int count) const override;
  /// Throws InputError for a score without residuals.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override { return !ending_.empty(); }
  std::string ending() const override { return ending_; }
  std::vector<EndingClaim> claims() const override { return claims_; }
  /// Returns the basins, lowest first, with the points that belong to them by now.
  std::vector<FoundBasin> basins() const override;
  std::string basins_in_words() const override;
  /// Returns how many basins are expected that no point has seen; infinite if too few points belong
  /// to one.
  double expected_unseen() const;

 private:
  /// One of the points that are spread over the space.
  struct Spread {
    DesignPoint point;
    Eigen::VectorXd u;
    std::optional<Score> score = {};  // nullopt: not evaluated yet, or failed
    int basin = -1;                   // basin that it belongs to; -1: not known
    int linked_to = -1;               // better point beside it; -1: none
    bool has_searched = false;
  };
  /// A search for a minimum.
  struct Descent {
    std::size_t from = 0;  // point at which it starts
    std::unique_ptr<Optimizer> optimizer;
    int trials = 0, limit = 0;
    bool is_probe = true;
    std::optional<DesignPoint> best;
    std::optional<Score> best_score;
    double sum_of_squares() const;  // the least one; infinite: none yet
  };
  /// A trial on the way from a point to the minimum nearest to it.
  struct Crossing {
    std::size_t from = 0;
    std::size_t basin = 0;
    int tries = 0;
    DesignPoint point;
  };

  void spread_points();
  double radius() const;
  bool take_outcome(Spread& point) const;
  bool use_known_outcome();
  void choose_candidates();
  void link(Spread& point, double radius) const;
  bool begin_next();
  bool begin_crossing(std::size_t i, int tries);
  void cross();
  void begin_descent(std::size_t i);
  void tell_worse(Optimizer& optimizer, const Spread& from) const;
  void descend();
  void end_probe(Descent& descent);
  bool end_if_explained();
  void end_descent(int basin);
  int add_basin(const Descent& descent);
  bool resume_best_waiting();
  void end_round();
  void count_hits();
  std::string evidence() const;
  bool is_explained(std::size_t basin,
                    const Eigen::VectorXd& u,
                    const Score& score,
                    double largest_error) const;
  int explaining_basin(const Eigen::VectorXd& u, const Score& score, double largest_error) const;
  std::optional<DesignPoint> awaited() const;
  bool is_spent() const { return trials_ >= options_.budget * (space_.size() + 1); }
  std::vector<int> basins_of_points() const;
  std::vector<FoundBasin> counted(const std::vector<int>& basin_of_point) const;
  int followed() const;
  void end(const std::string& why, const std::string& statement);

  DesignSpace space_;
  BasinSearchOptions options_;
  MakeOptimizer make_optimizer_;
  std::unordered_map<std::string, Result<Score>> outcomes_;  // key: bits of the point
  std::vector<DesignPoint> known_points_;                    // those that did not fail, in order
  std::vector<KnownResiduals> known_;                        // their residuals
  std::vector<Spread> points_;
  int trials_ = 0;                       // outcomes of points that the method asked for
  std::size_t evaluated_ = 0;            // number of points that are evaluated or have failed
  std::vector<std::size_t> candidates_;  // those of this round, the next one last
  std::optional<Crossing> crossing_;
  std::optional<Descent> descent_;
  std::vector<Descent> waiting_;
  std::vector<FoundBasin> basins_;
  std::vector<KnownResiduals> minima_;  // one for each basin
  double best_probe_;                   // least sum of squares at the end of a probe
  int rounds_ = 0;
  bool has_resumed_ = false;  // in this round
  std::string ending_;
  std::vector<EndingClaim> claims_;
};

}  // namespace latsch
