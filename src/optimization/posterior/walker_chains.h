// SPDX-License-Identifier: Apache-2.0
// Draws from a density in the unit cube by many walkers that move along each other's differences:
// differential evolution [ter Braak, Stat. Comput. 16 (2006) 239].
//
// The walkers form two halves, which move in turn. A walker at u moves to
//
//   u* = u + gamma (u_a - u_b)                                                                 (1)
//   gamma = 2.38 / sqrt(2 n) exp(c e), e normal, c = 0.1; in every tenth step gamma = 1
//
// where a and b are two walkers of the other half, which rests meanwhile. The move is accepted with
// probability min(1, p(u*) / p(u)). So the shape of the ensemble is the shape of the moves,
// whatever the correlations of the variables are, and nothing is tuned. A move of length 1 leads
// from one mode to another. A move out of the cube is refused, because the density is 0 there.
// Reflecting single coordinates at the faces would bias the samples: the reflected move is no
// longer symmetric where the differences of two coordinates are correlated. For two springs in
// series it moved a median by 0.17 deviations.
//
// If the density is a narrow curved valley, almost all moves (1) leave it. If fewer than 10 % of
// them were accepted before the first step that counts, or if the chains do not mix without it, and
// coordinates q(u) are known in which the valley is straight, every second step is
//
//   q(u*) = q(u) + gamma (q(u_a) - q(u_b))                                                     (2)
//
// It is solved for u* by Newton's method from u, and is refused if the way back from u* does not
// end at u [a check of Zappa, Holmes-Cerfon, Goodman, Commun. Pure Appl. Math. 71 (2018) 2609, for
// moves on surfaces]. The density of q is p(u) / |det dq/du|, so it is accepted with
// probability min(1, p(u*) |det dq/du(u)| / (p(u) |det dq/du(u*)|)).
//
// Every walker has a random stream of its own, and no decision depends on another walker of the
// same half, so the chains have the same bits for any number of threads.
//
// The number of walkers has to exceed 2 (n + 1) widely, because a half that lies in a plane never
// leaves it: walker_count() is max(40, 4 n).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/random.h"
#include "optimization/posterior/posterior_density.h"

namespace latsch {

/// Returns max(40, 4 n).
int walker_count(Eigen::Index variables);

/// Returns u with every coordinate reflected into 0 .. 1.
Eigen::VectorXd reflected_into_cube(Eigen::VectorXd u);

class WalkerChains {
 public:
  /// Begins at the columns of `starts`, n x walkers, an even number of at least 6. The density
  /// must not be 0 at any of them. Without `straight` there are no moves (2).
  WalkerChains(LogDensityAt density,
               Eigen::MatrixXd starts,
               std::uint64_t seed,
               Straightening straight = {});

  /// Moves every walker `steps` times. `density` is called by several threads if threads > 1.
  void advance(long steps, int threads = 1);

  /// Forgets all recorded steps, so that only later ones count.
  void forget();
  /// Moves walkers that are stuck where the density is negligible to the place of the likeliest
  /// walker of their half, and forgets the record. A walker is stuck if the mean of its recorded
  /// log densities lies below the first quartile of all walkers by more than twice the distance of
  /// the quartiles [Vrugt et al., Int. J. Nonlinear Sci. Numer. Simul. 10 (2009) 273]. One of 40
  /// walkers would else be 2.5 % of all samples. Only for steps that are left out later: the move
  /// is not reversible. Returns the number of walkers moved.
  int release_stuck();
  /// Decides by the moves (1) since the last decision whether moves (2) are made. Only before steps
  /// that are left out later.
  void straighten_if_frozen();
  /// Continues with another density from the present places. A walker whose density is 0 under it
  /// is placed where a walker of the same half is whose density is not; returns false if there is
  /// none in one of the halves.
  bool change_density(LogDensityAt density, Straightening straight = {});

  /// Moves each walker whose density is negligible beside that of the likeliest one, by a factor of
  /// exp(30 + 3 n), to uphill(place) if that place is likelier. Only for steps that are left out
  /// later.
  void raise(const std::function<Eigen::VectorXd(const Eigen::VectorXd& u)>& uphill);

  const Eigen::MatrixXd& places() const { return places_; }         // n x walkers
  const Eigen::VectorXd& log_densities() const { return values_; }  // one for each walker
  int walkers() const { return static_cast<int>(places_.cols()); }
  /// Share of the moves that were accepted since the beginning.
  double accepted() const;
  /// True if every second step is a move (2).
  bool is_straightened() const { return is_straightened_; }
  /// Makes every second step a move (2), and forgets the record. Returns false if they are made
  /// already, or if the coordinates are not known.
  bool straighten();

  /// The recorded steps. Not every step is recorded: `stride` doubles when there are too many.
  struct Record {
    std::vector<Eigen::MatrixXd> places;  // n x walkers each, in the order of the steps
    std::vector<Eigen::VectorXd> values;  // log densities
    long stride = 1;
  };
  const Record& record() const { return record_; }

 private:
  void move(int walker, long step);
  /// Draws a and b of a walker, and gamma.
  struct Difference {
    int a = 0, b = 0;
    double gamma = 0.0, chance = 0.0;
  };
  Difference drawn_difference(int walker, long step);
  void move_along_others(int walker, long step);
  void move_along_valley(int walker, long step);
  /// Returns u with q(u) = q, by Newton's method from `start`; nullopt if it does not converge.
  std::optional<Eigen::VectorXd> place_of(const Eigen::VectorXd& q,
                                          const Eigen::VectorXd& start) const;
  void keep(long step);
  /// Moves the walker beside another one, by a share of the difference of two walkers, or onto it
  /// if no such place has density.
  void set_beside(int walker, int model);

  LogDensityAt density_;
  Eigen::MatrixXd places_;
  Eigen::VectorXd values_;
  std::vector<RandomStream> streams_;
  Straightening straight_;
  bool is_straightened_ = false;
  std::vector<long> moved_;  // accepted moves of each walker
  // moves (1) of each walker since the last decision about moves (2), and those accepted
  std::vector<long> tried_together_, moved_together_;
  long steps_ = 0;
  Record record_;
};

}  // namespace latsch
