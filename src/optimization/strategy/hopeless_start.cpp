// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/hopeless_start.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "optimization/design/latin_hypercube.h"
#include "optimization/problem/pending_points.h"

namespace latsch {
namespace {

// Number of failures with the same message after which points spread over the space are tried.
constexpr int kSuspicious = 5;
constexpr int kSpread = 8;  // number of points spread over the space
// Number of points from which these are chosen if linear constraints exclude some.
constexpr int kDrawn = 64;

std::vector<DesignPoint> spread(const DesignSpace& space) {
  std::vector<DesignPoint> points =
      latin_hypercube(space, space.constraints().empty() ? kSpread : kDrawn).points;
  std::erase_if(points, [&](const DesignPoint& point) { return !space.contains(point); });
  if (std::ssize(points) > kSpread) points.resize(kSpread);
  return points;
}

bool is_number(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string words_of(const std::string& reason) {
  std::istringstream words(reason);
  std::string text;
  for (std::string word; words >> word;) {
    if (word.find('/') != std::string::npos || std::any_of(word.begin(), word.end(), is_number)) {
      word = "#";
    }
    text += word + ' ';
  }
  return text;
}

HopelessStart::HopelessStart(const DesignSpace& space, std::unique_ptr<Optimizer> optimizer)
    : space_(space), optimizer_(std::move(optimizer)) {}

std::vector<DesignPoint> HopelessStart::propose(int count) const {
  if (reason_) return {};
  Plan plan(count);
  for (const DesignPoint& point : spread_) plan.add(point);
  if (plan.is_full() || optimizer_->converged()) return plan.points();
  for (const DesignPoint& point : optimizer_->propose(count)) plan.add(point);
  return plan.points();
}

void HopelessStart::observe(const DesignPoint& point, const Result<Score>& outcome) {
  optimizer_->observe(point, outcome);
  if (!is_watching_) return;
  const bool is_spread = !spread_.empty() && spread_.front() == point;
  if (is_spread) spread_.erase(spread_.begin());
  if (outcome || (alike_ > 0 && words_of(outcome.failure().reason) != first_)) {
    is_watching_ = false;
    spread_.clear();
    return;
  }
  first_ = words_of(outcome.failure().reason);
  ++alike_;
  if (is_spread && spread_.empty()) reason_ = outcome.failure().reason;
  if (alike_ == kSuspicious) spread_ = spread(space_);
}

bool HopelessStart::converged() const {
  return reason_ || (spread_.empty() && optimizer_->converged());
}

}  // namespace latsch
