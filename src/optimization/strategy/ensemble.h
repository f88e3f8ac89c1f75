// SPDX-License-Identifier: Apache-2.0
// Several optimizers at once on one pool of workers: each observes every outcome, whichever
// optimizer proposed the point.
//
// A coarse method finds the right basin, and a fine method continues from its best point. A method
// that does not suit the target costs only its share of the evaluations. The members take turns;
// the next turn goes to the member with the least
//
//   (turns so far + 1) / priority
//
// so a member of priority 2 gets twice as many steps as one of priority 1. If a member has no point
// to propose, the other members share its turns. The turn, not the worker, decides whose point is
// the next step, so the path is the same for any number of workers. Additional workers evaluate the
// points of the coming turns, in their order. A point whose outcome is known is not evaluated
// again: the other members observe this outcome.
//
// The ensemble ends when all members have ended, or with the first member that ends. A member that
// has ended resumes if a point of another member lets it improve, as a better point lets a
// generating-set search. [The "citizens" of HOPSPACK: Plantenga, SAND2009-6265]
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "optimization/problem/optimizer.h"

namespace latsch {

/// A member of an ensemble: an optimizer and its share of the steps.
struct EnsembleMember {
  std::unique_ptr<Optimizer> optimizer;  // the search
  int priority = 1;                      // weight of the member when steps are shared
};

class Ensemble : public Optimizer {
 public:
  /// Condition for the end of the ensemble: all members have ended, or the first of them has.
  enum class End { all, first };

  /// Throws InputError if there is no member or a priority is below 1.
  explicit Ensemble(std::vector<EnsembleMember> members, End end = End::all);

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

  /// Returns the number of steps that each member has had so far.
  const std::vector<long>& turns() const { return turns_; }

 private:
  int next(const std::vector<long>& turns, const std::vector<bool>& has_wishes) const;
  void tell_what_is_known();

  std::vector<EnsembleMember> members_;
  End end_;
  std::vector<long> turns_;
  std::unordered_map<std::string, Result<Score>> known_;  // outcomes by the bits of their points
};

}  // namespace latsch
