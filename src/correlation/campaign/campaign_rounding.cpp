// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/campaign_rounding.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.h"
#include "base/units.h"

namespace latsch::correlation {
namespace {

// Values of a setting nearer than this share of its range become one.
constexpr double kOneLevel = 0.02;
constexpr double kStepsOfRange = 100.0;

/// Returns the place of the multiple of the step next to a place, below or above it.
double stepped(const CampaignSetting& setting, double place, double (*to_whole)(double)) {
  const Unit unit = Unit::of(setting.unit);
  const double step = rounding_step(setting);
  const double number = unit.from_si(setting.at(place));
  const double si = unit.to_si(static_cast<long double>(step * to_whole(number / step)));
  return std::clamp(setting.place(si), 0.0, 1.0);
}

double nearest_whole(double x) { return std::round(x); }
double whole_below(double x) { return std::floor(x); }
double whole_above(double x) { return std::ceil(x); }

}  // namespace

double rounding_step(const CampaignSetting& setting) {
  const Unit unit = Unit::of(setting.unit);
  const double range = unit.from_si(setting.upper) - unit.from_si(setting.lower);
  const double power = std::pow(10.0, std::floor(std::log10(range / kStepsOfRange)));
  const double share = range / kStepsOfRange / power;
  // the slack lets a range of 1000 have steps of 10 although its logarithm is rounded
  constexpr double kSlack = 1e-9;
  return power * (share >= 5.0 - kSlack ? 5.0 : share >= 2.0 - kSlack ? 2.0 : 1.0);
}

double tidy_value(const CampaignSetting& setting, double value) {
  constexpr int kDigits = 10;
  const Unit unit = Unit::of(setting.unit);
  return unit.to_si(*parse_number(format_number(unit.from_si(value), kDigits)));
}

std::vector<Eigen::VectorXd> rounded_places(
    const CampaignSettings& campaign,
    const std::vector<Eigen::VectorXd>& places,
    const std::function<bool(const Eigen::VectorXd&)>& admits) {
  std::vector<Eigen::VectorXd> rounded = places;
  for (std::size_t i = 0; i < campaign.settings.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return places[a][k] < places[b][k];
    });
    for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
      const double first = places[order[from]][k];
      double sum = 0.0, last = first;
      for (; to < order.size() && places[order[to]][k] - first <= kOneLevel; ++to) {
        last = places[order[to]][k];
        sum += last;
      }
      // an end of the range stays what it is
      const double level =
          first <= 0.0 ? 0.0
          : last >= 1.0
              ? 1.0
              : stepped(campaign.settings[i], sum / static_cast<double>(to - from), nearest_whole);
      for (std::size_t one = from; one < to; ++one) rounded[order[one]][k] = level;
    }
  }
  for (std::size_t test = 0; test < places.size(); ++test) {
    if (admits(rounded[test])) continue;
    Eigen::VectorXd nearest = places[test];
    double least = 1e300;
    const auto d = static_cast<int>(campaign.settings.size());
    for (int corner = 0; corner < 1 << d; ++corner) {
      Eigen::VectorXd tried = places[test];
      for (int i = 0; i < d; ++i)
        tried[i] = stepped(campaign.settings[static_cast<std::size_t>(i)],
                           places[test][i],
                           (corner >> i) & 1 ? whole_above : whole_below);
      const double distance = (tried - places[test]).norm();
      if (!(distance < least) || !admits(tried)) continue;
      least = distance;
      nearest = tried;
    }
    rounded[test] = nearest;
  }
  return rounded;
}

}  // namespace latsch::correlation
