// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/slope_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch {
namespace {

// Largest ratio `bend` for which three points count as lying on a straight line.
constexpr double kStraight = 0.25;
constexpr double kLengthFactor = 4.0;         // ratio of successive lengths
constexpr double kLongestDifference = 0.25;   // longest difference, as a share of the range
constexpr double kShortestDifference = 1e-4;  // shortest difference, as a share of the range
// Largest factor by which the length of a difference is increased in one step.
constexpr double kMostLengthening = 16.0;
constexpr size_t kMostLengths = 5;  // largest number of lengths tried
// Largest number of shorter lengths tried if the evaluation fails on all sides.
constexpr int kMostShortened = 2;
// If a length is divided by four, curvature reduces the second difference to a sixteenth. A second
// difference above this share of the former one counts as roughness.
constexpr double kRoughness = 0.25;
// Change of the residuals, as a share of their size, that counts as no change.
constexpr double kUnfelt = 1e-12;

}  // namespace

SlopeSearch::SlopeSearch(std::function<bool(double)> has_room, double first_length)
    : has_room_(std::move(has_room)) {
  double length = first_length;
  while (!plan(length) && length > kShortestDifference) length /= kLengthFactor;
}

bool SlopeSearch::is_open(double offset) const {
  const auto failed = [&](const Point& p) { return !p.r && p.offset == offset; };
  return has_room_(offset) && std::none_of(points_.begin(), points_.end(), failed);
}

/// Requests the points of a difference of the given length that are not known yet. Returns false if
/// there is no room for them on any side.
bool SlopeSearch::plan(double length) {
  for (const auto& [a, b] : {std::pair(1.0, -1.0), std::pair(1.0, 2.0), std::pair(-1.0, -2.0)}) {
    if (!is_open(a * length) || !is_open(b * length)) continue;
    wanted_.clear();
    for (const double offset : {a * length, b * length}) {
      if (!known(offset)) wanted_.push_back(offset);
    }
    planned_ = length;
    return true;
  }
  return false;
}

const Eigen::VectorXd* SlopeSearch::known(double offset) const {
  for (const Point& p : points_) {
    if (p.r && p.offset == offset) return &*p.r;
  }
  return nullptr;
}

std::optional<SlopeSearch::Tried> SlopeSearch::stencil(const Eigen::VectorXd& center,
                                                       double h) const {
  Tried t{h, 0.0, 0.0, {}, {}, {}};
  const Eigen::VectorXd *up = known(h), *down = known(-h);
  if (up && down) {
    t.slope = (*up - *down) / (2.0 * h);
    t.terms = {{h, 0.5 / h}, {-h, -0.5 / h}};
    t.second = *up + *down - 2.0 * center;
  } else {
    const double side = known(2.0 * h) ? 1.0 : -1.0;
    const Eigen::VectorXd *one = known(side * h), *two = known(side * 2.0 * h);
    if (!one || !two) return std::nullopt;
    t.slope = side * (4.0 * *one - *two - 3.0 * center) / (2.0 * h);
    const double unit = side / (2.0 * h);
    t.terms = {{side * h, 4.0 * unit}, {side * 2.0 * h, -unit}, {0.0, -3.0 * unit}};
    t.second = *two + center - 2.0 * *one;
  }
  t.change = h * t.slope.norm();
  const bool is_felt = t.change > kUnfelt * center.norm();
  t.bend = is_felt ? t.second.norm() / (2.0 * t.change) : 0.0;
  return t;
}

void SlopeSearch::observe(const Eigen::VectorXd& center,
                          double felt,
                          const std::vector<std::optional<Eigen::VectorXd>>& residuals) {
  assert(residuals.size() == wanted_.size());
  for (size_t k = 0; k < residuals.size(); ++k) points_.push_back({wanted_[k], residuals[k]});
  wanted_.clear();
  double length = planned_;
  while (true) {
    if (auto found = stencil(center, length)) {
      tried_.push_back(std::move(*found));
      const auto next = next_length(felt);
      if (!next || !plan(*next)) break;
      length = *next;
    } else if (!plan(length)) {  // all other sides at this length have failed, too
      if (shortened_++ >= kMostShortened || !tried_.empty()) break;
      length /= kLengthFactor;
      if (!plan(length)) break;
    }
    if (!wanted_.empty()) return;
  }
  wanted_.clear();
  finish(center);
}

const SlopeSearch::Tried* SlopeSearch::at_length(double length) const {
  for (const Tried& t : tried_) {
    if (std::abs(t.length - length) < 1e-9 * length) return &t;
  }
  return nullptr;
}

/// Returns the length to try next; nullopt if the last one is good enough or no other one is to be
/// tried.
std::optional<double> SlopeSearch::next_length(double felt) const {
  if (tried_.size() >= kMostLengths) return std::nullopt;
  const Tried& last = tried_.back();
  const auto by_length = [](const Tried& a, const Tried& b) { return a.length < b.length; };
  const double longest = std::max_element(tried_.begin(), tried_.end(), by_length)->length;
  const double shortest = std::min_element(tried_.begin(), tried_.end(), by_length)->length;
  const auto longer = [&](double factor) -> std::optional<double> {
    const double length = std::min(kLongestDifference, factor * longest);
    return length > 1.5 * longest ? std::optional(length) : std::nullopt;
  };
  if (last.change < felt) {
    const double wished = last.length * felt / std::max(last.change, felt / kMostLengthening);
    return longer(std::max(2.0, std::min(kMostLengthening, wished / longest)));
  }
  if (last.bend <= kStraight) return std::nullopt;
  const auto is_rough = [](const Tried* one, const Tried* shorter) {
    if (!one || !shorter) return false;
    const double curvature = kLengthFactor * kLengthFactor * shorter->second.norm();
    return one->second.norm() < kRoughness * curvature;
  };
  if (is_rough(&last, at_length(last.length / kLengthFactor)) ||
      is_rough(at_length(last.length * kLengthFactor), &last)) {
    return longer(kLengthFactor);
  }
  const double length = shortest / kLengthFactor;
  return length >= kShortestDifference ? std::optional(length) : std::nullopt;
}

void SlopeSearch::finish(const Eigen::VectorXd& center) {
  if (!tried_.empty()) {
    // The last length tried is used if its three points are straight, because it was chosen to
    // match the length of the confidence interval.
    const Tried* best = &tried_.back();
    if (best->bend > kStraight) {
      for (const Tried& t : tried_) {
        if (t.bend < best->bend) best = &t;
      }
    }
    slope_ = best->slope;
    terms_ = best->terms;
    length_ = best->length;
    bend_ = best->bend;
    quality_ = best->bend <= kStraight ? SlopeQuality::straight : SlopeQuality::rough;
    return;
  }
  const Point* nearest = nullptr;
  for (const Point& p : points_) {
    if (p.r && (!nearest || std::abs(p.offset) < std::abs(nearest->offset))) nearest = &p;
  }
  if (!nearest) return;
  slope_ = (*nearest->r - center) / nearest->offset;
  terms_ = {{nearest->offset, 1.0 / nearest->offset}, {0.0, -1.0 / nearest->offset}};
  length_ = std::abs(nearest->offset);
  quality_ = SlopeQuality::one_sided;
}

}  // namespace latsch
