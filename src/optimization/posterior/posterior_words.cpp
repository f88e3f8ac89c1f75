// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/posterior_words.h"

#include <algorithm>
#include <cmath>

#include "optimization/posterior/chain_diagnostics.h"

namespace latsch {
namespace {

constexpr double kAsLinear = 0.25;   // deviations
constexpr double kSkewed = 1.5;      // ratio of the half widths, or its inverse
constexpr double kBent = 0.2;        // share of the variance
constexpr double kModeShare = 0.05;  // share of the samples on each side of a valley
constexpr double kAtBound = 0.01;    // share of the range
constexpr double kCutShare = 0.025;  // share of the samples
constexpr double kOpen = 0.25;       // share of the range
constexpr int kBins = 24;            // bins of the histogram, between the 0.5 and 99.5 % points
constexpr double kByChance = 3.0;    // deviations of a count

/// Returns the counts of the samples in bins of equal width; samples outside count in the end bins.
std::vector<double> histogram(const Eigen::VectorXd& x) {
  const double from = quantile_of(x, 0.005), to = quantile_of(x, 0.995);
  std::vector<double> counts(kBins, 0.0);
  if (!(to > from)) return counts;
  for (const double value : x) {
    const double place = (value - from) / (to - from) * kBins;
    ++counts[static_cast<std::size_t>(std::clamp(place, 0.0, kBins - 1.0))];
  }
  return counts;
}

bool has_two_modes(const Eigen::VectorXd& x) {
  const std::vector<double> counts = histogram(x);
  const auto all = static_cast<double>(x.size());
  double left = 0.0;
  for (std::size_t k = 1; k + 1 < counts.size(); ++k) {
    left += counts[k - 1];
    const double right = all - left - counts[k];
    const auto valley = counts.begin() + static_cast<std::ptrdiff_t>(k);
    const double lower_peak = std::min(*std::max_element(counts.begin(), valley),
                                       *std::max_element(valley + 1, counts.end()));
    const double chance = kByChance * std::sqrt(lower_peak + *valley);
    if (*valley < 0.5 * lower_peak && lower_peak - *valley > chance && left > kModeShare * all &&
        right > kModeShare * all)
      return true;
  }
  return false;
}

double share_at_bounds(const Eigen::VectorXd& x) {
  const double lower = (x.array() < kAtBound).cast<double>().mean();
  const double upper = (x.array() > 1.0 - kAtBound).cast<double>().mean();
  return std::max(lower, upper);
}

}  // namespace

double bent_share(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::ArrayXd a = x.array() - x.mean(), b = y.array() - y.mean();
  const double aa = a.square().sum(), all = b.square().sum();
  if (!(aa > 0.0) || !(all > 0.0)) return 0.0;
  // a^2 without its mean and its part along a
  Eigen::ArrayXd square = a.square() - a.square().mean();
  square -= (square * a).sum() / aa * a;
  const Eigen::ArrayXd rest = b - (b * a).sum() / aa * a;
  const double own = square.square().sum();
  if (!(own > 0.0)) return 0.0;
  const double along = (square * rest).sum();
  return along * along / own / all;
}

std::vector<PosteriorShape> posterior_shapes(const Eigen::MatrixXd& u,
                                             const std::vector<Interval>& linear) {
  std::vector<PosteriorShape> shapes;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const Eigen::VectorXd x = u.row(i).transpose();
    PosteriorShape s;
    s.lower = quantile_of(x, 0.025);
    s.median = quantile_of(x, 0.5);
    s.upper = quantile_of(x, 0.975);
    s.mean = x.mean();
    s.deviation = std::sqrt((x.array() - s.mean).square().sum() /
                            std::max(1.0, static_cast<double>(x.size() - 1)));
    const Interval& own = linear[static_cast<std::size_t>(i)];
    const double off = std::max(std::abs(s.lower - std::clamp(own.lower, 0.0, 1.0)),
                                std::abs(s.upper - std::clamp(own.upper, 0.0, 1.0)));
    s.distance = off == 0.0 ? 0.0 : off / s.deviation;
    s.as_linear = s.distance <= kAsLinear;
    const double below = s.median - s.lower, above = s.upper - s.median;
    s.skewed = above > kSkewed * below || below > kSkewed * above;
    for (Eigen::Index j = 0; j < u.rows(); ++j)
      if (j != i && bent_share(u.row(j).transpose(), x) > kBent)
        s.bananas.push_back(static_cast<int>(j));
    s.two_modes = has_two_modes(x);
    s.cut = share_at_bounds(x) > kCutShare;
    s.open = s.deviation > kOpen;
    shapes.push_back(std::move(s));
  }
  return shapes;
}

std::string in_words(const PosteriorShape& shape, const std::vector<std::string>& names) {
  std::string text;
  const auto say = [&text](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
  if (shape.skewed) say("skewed");
  for (const int other : shape.bananas)
    say("banana with " + names[static_cast<std::size_t>(other)]);
  if (shape.two_modes) say("two modes");
  if (shape.cut) say("cut by its bound");
  if (shape.open) say("open");
  if (text.empty() && shape.as_linear) return "as the linear interval";
  return text.empty() ? "unlike the linear interval" : text;
}

}  // namespace latsch
