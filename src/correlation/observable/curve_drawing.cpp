// SPDX-License-Identifier: Apache-2.0
// Draws a compared curve on the page of a study: measured and simulated curve and the band.
#include <algorithm>
#include <cmath>
#include <map>

#include "correlation/observable/curve.h"
#include "report/report.h"

namespace latsch::correlation {
namespace {

std::vector<double> values_of(const Channels& channels, const std::string& name) {
  const Channel* channel = channels.find(name);
  return channel ? channel->values : std::vector<double>{};
}

/// Returns y at x, linear between samples; x rises and its range contains the abscissa.
double value_between(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto right = std::upper_bound(xs.begin(), xs.end(), x);
  if (right == xs.end()) return ys.back();
  const auto i = right - xs.begin();
  const double share = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

/// Draws a band around all samples of a curve; the band is known only at the measured abscissas,
/// which are in ascending order.
void draw_around_samples(const report::Band& band,
                         const std::vector<double>& x,
                         const std::vector<double>& computed,
                         report::MeasuredCurve& picture) {
  std::map<double, std::pair<double, double>>
      beside;  // distance of the band's ends from the curve; the larger one if an x repeats
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double lower = band.lower[k] - computed[k], upper = band.upper[k] - computed[k];
    if (!std::isfinite(lower) || !std::isfinite(upper)) continue;
    const auto [at, is_new] = beside.try_emplace(x[k], lower, upper);
    if (!is_new)
      at->second = {std::min(at->second.first, lower), std::max(at->second.second, upper)};
  }
  if (beside.empty()) return;
  std::vector<double> xs, lower, upper;
  for (const auto& [at, ends] : beside) {
    xs.push_back(at);
    lower.push_back(ends.first);
    upper.push_back(ends.second);
  }
  std::vector<double> all = xs;
  for (const double at : picture.x_simulated) {
    if (xs.front() < at && at < xs.back()) all.push_back(at);
  }
  std::sort(all.begin(), all.end());
  for (const double at : all) {
    const double y = value_between(picture.x_simulated, picture.y_simulated, at);
    picture.x_band.push_back(at);
    picture.band.lower.push_back(y + value_between(xs, lower, at));
    picture.band.upper.push_back(y + value_between(xs, upper, at));
  }
}

}  // namespace

std::vector<double> Curve::shown_abscissas(const Channels& trial) const {
  std::vector<double> x = values_of(trial, c_.x);
  if (!c_.fits_delay) return x;
  if (const auto found = simulated(trial); found && found->delay)
    for (double& one : x) one += found->delay->value;
  return x;
}

void Curve::draw_over_natural(const ShownExperiment& shown, report::MeasuredCurve& picture) const {
  const NaturalAbscissa& over = *c_.natural;
  const auto ordered = [&](const std::vector<double>& values) {
    std::vector<double> sorted;
    if (values.size() == over.order.size())
      for (const std::size_t i : over.order) sorted.push_back(values[i]);
    return sorted;
  };
  picture.x_name = over.channel;
  picture.x_unit = over.shown;
  picture.x_measured = picture.x_simulated = ordered(over.values);
  picture.y_measured = ordered(c_.y_measured);
  picture.errors = ordered(shown.comparison.errors);
  picture.y_simulated = ordered(values_of(shown.found, c_.y));
  if (shown.initial) {
    picture.x_initial = picture.x_simulated;
    picture.y_initial = ordered(values_of(*shown.initial, c_.y));
  }
  if (over.groups.size() > 1)
    for (const auto& group : over.groups)
      picture.pieces.push_back({group.name, group.level, group.from, group.end});
}

namespace {

/// Changes a simulated curve to what a recording with these nuisance numbers would show.
void apply_numbers(const std::vector<SolvedNumber>& numbers,
                   std::vector<double>& x,
                   std::vector<double>& y) {
  double offset = 0.0, gain = 0.0, shift = 0.0;
  for (const SolvedNumber& number : numbers)
    (number.kind == NuisanceKind::offset ? offset
     : number.kind == NuisanceKind::gain ? gain
                                         : shift) = number.value;
  for (double& one : y) one = (1.0 + gain) * one + offset;
  for (double& one : x) one += shift;
}

/// Returns the simulated values of a comparison, which contain the nuisance numbers.
std::vector<double> values_in(const Comparison& comparison, const CurveMeasurement& curve) {
  std::vector<double> values = curve.y_compared;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= curve.scale * comparison.errors[i];
  return values;
}

}  // namespace

void Curve::draw(const ShownExperiment& shown, report::StudyReport& page) const {
  report::MeasuredCurve picture;
  picture.experiment = shown.name;
  picture.conditions = shown.conditions;
  picture.fitted = shown.fitted;
  picture.of_design = shown.of_design;
  picture.errors = shown.comparison.errors;
  const bool is_spectrum = c_.comparison.of_spectrum();
  if (is_spectrum || c_.comparison.what == ComparedCurve::about_mean) {
    // The picture shows the compared values, such as a spectrum, instead of the time series.
    picture.x_name = is_spectrum ? "frequency" : c_.x;
    picture.y_name = c_.compared_name;
    picture.x_unit = is_spectrum ? c_.x_compared_unit : c_.x_shown;
    picture.y_unit = is_spectrum ? c_.y_compared_unit : c_.y_shown;
    picture.x_measured = picture.x_simulated = c_.x_compared;
    picture.y_measured = c_.y_compared;
    if (const auto found = simulated(shown.found)) picture.y_simulated = found->values;
    if (!shown.comparison.nuisance.empty()) picture.y_simulated = values_in(shown.comparison, c_);
    const Result<SimulatedValues> start =
        shown.initial ? simulated(*shown.initial) : Failure{"not simulated"};
    if (start) {
      picture.x_initial = c_.x_compared;
      picture.y_initial = start->values;
    }
  } else if (c_.natural) {
    picture.y_name = c_.y;
    picture.y_unit = c_.y_shown;
    draw_over_natural(shown, picture);
  } else {
    picture.x_name = c_.x;
    picture.y_name = c_.y;
    picture.x_unit = c_.x_shown;
    picture.y_unit = c_.y_shown;
    picture.x_measured = c_.x_measured;
    picture.y_measured = c_.y_measured;
    picture.x_simulated = shown_abscissas(shown.found);
    picture.y_simulated = values_of(shown.found, c_.y);
    apply_numbers(shown.comparison.nuisance, picture.x_simulated, picture.y_simulated);
    if (shown.initial) {
      picture.x_initial = shown_abscissas(*shown.initial);
      picture.y_initial = values_of(*shown.initial, c_.y);
      if (shown.initial_comparison)
        apply_numbers(shown.initial_comparison->nuisance, picture.x_initial, picture.y_initial);
    }
  }
  if (shown.band) {
    const auto computed = simulated(shown.found);
    if (computed && c_.comparison.what == ComparedCurve::values && !c_.x.empty()) {
      picture.band.inside = shown.band->inside;
      draw_around_samples(
          *shown.band,
          c_.x_measured,
          shown.comparison.nuisance.empty() ? computed->values : values_in(shown.comparison, c_),
          picture);
    } else if (!c_.natural) {
      picture.band = *shown.band;
      picture.x_band = c_.x_compared;
    }
  }
  page.curves.push_back(std::move(picture));
}

}  // namespace latsch::correlation
