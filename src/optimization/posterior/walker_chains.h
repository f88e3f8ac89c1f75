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
// Every walker has a random stream of its own, and no decision depends on another walker of the
// same half, so the chains have the same bits for any number of threads.
//
// The number of walkers has to exceed 2 (n + 1) widely, because a half that lies in a plane never
// leaves it: walker_count() is max(40, 4 n).
#pragma once

#include <Eigen/Core>
#include <cstdint>
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
  /// must not be 0 at any of them.
  WalkerChains(LogDensityAt density, Eigen::MatrixXd starts, std::uint64_t seed);

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
  /// Continues with another density from the present places. A walker whose density is 0 under it
  /// is placed where a walker of the same half is whose density is not; returns false if there is
  /// none in one of the halves.
  bool change_density(LogDensityAt density);

  const Eigen::MatrixXd& places() const { return places_; }         // n x walkers
  const Eigen::VectorXd& log_densities() const { return values_; }  // one for each walker
  int walkers() const { return static_cast<int>(places_.cols()); }
  /// Share of the moves that were accepted since the beginning.
  double accepted() const;

  /// The recorded steps. Not every step is recorded: `stride` doubles when there are too many.
  struct Record {
    std::vector<Eigen::MatrixXd> places;  // n x walkers each, in the order of the steps
    std::vector<Eigen::VectorXd> values;  // log densities
    long stride = 1;
  };
  const Record& record() const { return record_; }

 private:
  void move(int walker, long step);
  void keep(long step);
  /// Moves the walker beside another one, by a share of the difference of two walkers, or onto it
  /// if no such place has density.
  void set_beside(int walker, int model);

  LogDensityAt density_;
  Eigen::MatrixXd places_;
  Eigen::VectorXd values_;
  std::vector<RandomStream> streams_;
  std::vector<long> moved_;  // accepted moves of each walker
  long steps_ = 0;
  Record record_;
};

}  // namespace latsch
