// SPDX-License-Identifier: Apache-2.0
// Several optimizers at once on one pool of workers: each sees every outcome, whoever asked for it.
//
// A coarse method finds the basin, a fine one takes over from its best point; one that fails on
// this kind of target costs its share and no more. Members take turns; next is the one of the least
//
//   (turns so far + 1) / priority
//
// so that a member of priority 2 gets twice the steps of one of priority 1, and all of them what
// others need no more. The turn, not the worker, decides whose point is the next step: the
// trajectory is the same for any number of workers. Workers beyond the first are given what the
// members want, in the order of their coming turns. A point some member knows is not asked for
// again: the others are told what came of it.
//
// It ends when all members have, or with the first that does. A member that ended goes on where
// another one's point gives it reason to, as a generating-set search does for a better one.
// [The "citizens" of HOPSPACK: Plantenga, SAND2009-6265]
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "optimization/problem/optimizer.h"

namespace latsch {

struct EnsembleMember {
  std::unique_ptr<Optimizer> optimizer;
  int priority = 1;  // its share of the steps
};

class Ensemble : public Optimizer {
 public:
  enum class End { all, first };

  /// Throws InputError where there is no member or a priority is below 1.
  explicit Ensemble(std::vector<EnsembleMember> members, End end = End::all);

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

  /// Steps every member was given.
  const std::vector<long>& turns() const { return turns_; }

 private:
  int next(const std::vector<long>& turns, const std::vector<bool>& has_wishes) const;
  void tell_what_is_known();

  std::vector<EnsembleMember> members_;
  End end_;
  std::vector<long> turns_;
  std::unordered_map<std::string, Result<Score>> known_;  // by the bits of the point
};

}  // namespace latsch
