// SPDX-License-Identifier: Apache-2.0
// The points whose outcomes an ask/tell method waits for (optimizer.h), most urgent first, each
// with the data that the method needs when the outcome arrives. The header also has the plan of
// different points that a method proposes.
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

/// `Pending` needs a member `point` of type DesignPoint.
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

  /// Removes and returns the first pending entry at the given point; nullopt if the method does not
  /// wait for it.
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

/// The points that propose(count) returns: at most `count`, all different.
class Plan {
 public:
  explicit Plan(int count) : count_(count) {}

  bool is_full() const { return std::ssize(points_) >= count_; }
  bool is_empty() const { return points_.empty(); }
  /// Adds the point unless the plan is full or contains it already.
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
