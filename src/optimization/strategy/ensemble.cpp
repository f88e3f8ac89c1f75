// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/error.h"
#include "optimization/problem/pending_points.h"

namespace latsch {
namespace {

constexpr int kNobody = -1;

}  // namespace

Ensemble::Ensemble(std::vector<EnsembleMember> members, End end)
    : members_(std::move(members)), end_(end), turns_(members_.size(), 0) {
  if (members_.empty()) throw InputError("ensemble: it has no member, expected one or more");
  for (const EnsembleMember& member : members_) {
    if (member.priority >= 1) continue;
    throw InputError(fmt::format("ensemble: priority {}, expected 1 or more", member.priority));
  }
}

int Ensemble::next(const std::vector<long>& turns, const std::vector<bool>& has_wishes) const {
  int next = kNobody;
  const auto is_before = [&](int a, int b) {  // compares (turns + 1) / priority without division
    return (turns[a] + 1) * members_[b].priority < (turns[b] + 1) * members_[a].priority;
  };
  for (int m = 0; m < std::ssize(members_); ++m) {
    if (has_wishes[m] && (next == kNobody || is_before(m, next))) next = m;
  }
  return next;
}

std::vector<DesignPoint> Ensemble::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  if (converged()) return {};
  std::vector<std::vector<DesignPoint>> wishes;
  std::vector<bool> has_wishes;
  for (const EnsembleMember& member : members_) {
    const bool ended = member.optimizer->converged();
    wishes.push_back(ended ? std::vector<DesignPoint>{} : member.optimizer->propose(count));
    // The points are reversed, so that the next one is at the end.
    std::reverse(wishes.back().begin(), wishes.back().end());
    has_wishes.push_back(!wishes.back().empty());
  }
  std::vector<long> turns = turns_;
  while (!plan.is_full()) {
    const int m = next(turns, has_wishes);
    if (m == kNobody) break;
    const DesignPoint point = std::move(wishes[m].back());
    wishes[m].pop_back();
    has_wishes[m] = !wishes[m].empty();
    ++turns[m];
    if (!known_.contains(point.bits())) plan.add(point);
  }
  return plan.points();
}

void Ensemble::observe(const DesignPoint& point, const Result<Score>& outcome) {
  std::vector<bool> is_searching;
  for (const EnsembleMember& member : members_) {
    is_searching.push_back(!member.optimizer->converged());
  }
  const int m = next(turns_, is_searching);
  if (m != kNobody && members_[m].optimizer->propose(1).front() == point) ++turns_[m];
  known_.insert_or_assign(point.bits(), outcome);
  for (const EnsembleMember& member : members_) member.optimizer->observe(point, outcome);
  tell_what_is_known();
}

void Ensemble::tell_what_is_known() {
  for (const EnsembleMember& member : members_) {
    while (!member.optimizer->converged()) {
      const DesignPoint wanted = member.optimizer->propose(1).front();
      const auto known = known_.find(wanted.bits());
      if (known == known_.end()) break;
      member.optimizer->observe(wanted, known->second);
    }
  }
}

bool Ensemble::converged() const {
  const auto ended = [](const EnsembleMember& member) { return member.optimizer->converged(); };
  return end_ == End::first ? std::any_of(members_.begin(), members_.end(), ended)
                            : std::all_of(members_.begin(), members_.end(), ended);
}

}  // namespace latsch
