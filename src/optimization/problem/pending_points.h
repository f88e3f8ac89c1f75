// SPDX-License-Identifier: Apache-2.0
// The points whose outcomes an ask/tell method waits for (optimizer.h), most wanted first, each
// with what the method has to know of it when its outcome comes; and what the method proposes: the
// different ones among them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "optimization/problem/design_point.h"

namespace latsch {

/// `Pending` has a DesignPoint `point`.
template <class Pending>
class PendingPoints {
 public:
  PendingPoints() = default;
  PendingPoints(std::initializer_list<Pending> points) : points_(points) {}

  bool empty() const { return points_.empty(); }
  std::ptrdiff_t size() const { return std::ssize(points_); }
  auto begin() const { return points_.begin(); }
  auto end() const { return points_.end(); }
  const Pending& front() const { return points_.front(); }
  const Pending& back() const { return points_.back(); }

  void push_back(Pending pending) { points_.push_back(std::move(pending)); }
  void clear() { points_.clear(); }

  bool contains(const DesignPoint& point) const { return find(point) != points_.end(); }

  /// The first one at that point, for which the method then no longer waits; nullopt: somebody
  /// else's point.
  std::optional<Pending> take(const DesignPoint& point) {
    const auto found = find(point);
    if (found == points_.end()) return std::nullopt;
    Pending taken = *found;
    points_.erase(found);
    return taken;
  }

 private:
  auto find(const DesignPoint& point) const {
    return std::find_if(
        points_.begin(), points_.end(), [&](const Pending& p) { return p.point == point; });
  }

  std::vector<Pending> points_;
};

/// What propose(count) answers: at most `count` points, none twice.
class Plan {
 public:
  explicit Plan(int count) : count_(count) {}

  bool is_full() const { return std::ssize(points_) >= count_; }
  bool is_empty() const { return points_.empty(); }
  /// Where it is neither full nor has the point already.
  void add(const DesignPoint& point) {
    const bool is_named = std::find(points_.begin(), points_.end(), point) != points_.end();
    if (!is_full() && !is_named) points_.push_back(point);
  }
  template <class Pending>
  void add(const PendingPoints<Pending>& pending) {
    for (const Pending& p : pending) add(p.point);
  }
  const std::vector<DesignPoint>& points() const { return points_; }

 private:
  int count_;
  std::vector<DesignPoint> points_;
};

}  // namespace latsch
