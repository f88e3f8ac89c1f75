// SPDX-License-Identifier: Apache-2.0
// Several optimizers at once on one pool of workers: each observes every outcome, whichever
// proposed it.
//
// A coarse method finds the basin, and a fine one continues from its best point. A method that
// fails on this kind of target costs only its share. Members take turns; the next is the one with
// the least
//
//   (turns so far + 1) / priority
//
// so a member of priority 2 gets twice the steps of one of priority 1, and the members that still
// want points share the steps of those that want none. The turn, not the worker, decides whose
// point is the next step, so the path is the same for any number of workers. Workers beyond the
// first get the points the members want, in the order of their coming turns. A point that some
// member knows is not evaluated again: the others observe its outcome.
//
// The ensemble ends when all members have ended, or with the first that ends. A member that has
// ended resumes if another member's point gives it reason to, as a better point does for a
// generating-set search. [The "citizens" of HOPSPACK: Plantenga, SAND2009-6265]
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "optimization/problem/optimizer.h"

namespace latsch {

/// A search with its share of the steps.
struct EnsembleMember {
  std::unique_ptr<Optimizer> optimizer;  // the search
  int priority = 1;                      // its share of the steps
};

class Ensemble : public Optimizer {
 public:
  /// The ensemble ends when all members have ended, or with the first.
  enum class End { all, first };

  /// Throws InputError if there is no member or a priority is below 1.
  explicit Ensemble(std::vector<EnsembleMember> members, End end = End::all);

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

  /// Number of steps every member was given.
  const std::vector<long>& turns() const { return turns_; }

 private:
  int next(const std::vector<long>& turns, const std::vector<bool>& has_wishes) const;
  void tell_what_is_known();

  std::vector<EnsembleMember> members_;
  End end_;
  std::vector<long> turns_;
  std::unordered_map<std::string, Result<Score>> known_;  // keys are the bits of points
};

}  // namespace latsch
