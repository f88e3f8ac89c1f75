// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/measurement_twin.h"
#include "correlation/laboratory/stated_difference.h"
#include "correlation/observable/compared_frame.h"
#include "correlation/observable/compared_kinds.h"
#include "correlation/observable/known_channels.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {
namespace {

std::string si_of(const std::string& unit) { return si_unit(Unit::of(unit).dimension()); }

bool rises(const std::vector<double>& x) {
  return std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) == x.end();
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

Failure wrong(const std::string& channel, const std::string& what) {
  return {fmt::format("channel \"{}\" {}", channel, what), Cause::bad_output};
}

/// Returns y at x, linear between samples; x rises and its range contains the abscissa.
double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto right = std::upper_bound(xs.begin(), xs.end(), x);
  if (right == xs.end()) return ys.back();
  const auto i = right - xs.begin();
  const double share = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

void take_what_is_compared(const Node& table, CurveMeasurement& curve) {
  constexpr double kLevelScale = 10.0;  // dB; ten times the power is an error of 100 %
  const ComparedCurve what = curve.comparison.what;
  const bool spectrum = curve.comparison.of_spectrum();
  const bool levels = what == ComparedCurve::band_levels;
  curve.compared_name =
      spectrum ? (levels ? "level of " : "PSD of ") + curve.y
               : curve.y + (what == ComparedCurve::about_mean ? " about its mean" : "");
  curve.x_compared = spectrum ? compared_frequencies(curve.comparison) : curve.x_measured;
  curve.x_compared_unit = spectrum ? "Hz" : curve.x_unit;
  curve.y_compared = compared_values(curve.comparison, curve.y_measured);
  curve.y_compared_unit = levels ? "dB" : spectrum ? "(" + curve.y_unit + ")^2/Hz" : curve.y_unit;
  const double most = levels ? kLevelScale : largest(curve.y_compared);
  curve.scale = table.quantity("scale", spectrum ? "1" : curve.y_unit, Range::positive(), most);
  if (table.has("scale") && !spectrum) curve.scale = read_difference(table, "scale", curve.y_unit);
  if (curve.scale == 0.0) table.reject("scale", "is missing: all measured values are 0");
}

std::vector<double> scaled(const std::vector<double>& values, double scale) {
  std::vector<double> shares = values;
  for (double& value : shares) value /= scale;
  return shares;
}

/// True if the delay of the recording is fitted. Throws InputError if a delay has no meaning.
bool read_delay(const Node& table, const CurveMeasurement& curve) {
  constexpr std::size_t kFewestSamples = 8;
  const auto nuisance = table.find_table("nuisance");
  // Beside other numbers, or with a prior, a delay is solved with them (nuisance_solver.h).
  if (!nuisance || nuisance->keys() != std::vector<std::string>{"delay"} ||
      nuisance->text("delay") != "free")
    return false;
  const ComparedCurve what = curve.comparison.what;
  if (what != ComparedCurve::values && what != ComparedCurve::about_mean)
    nuisance->reject("delay",
                     "is given beside a compare of spectra or of a path, to which a delay makes no "
                     "difference; expected compare = \"values\" or \"about_mean\", or no delay");
  if (curve.x.empty() || curve.x_unit != "s")
    nuisance->reject("delay",
                     (curve.x.empty() ? std::string("is asked for, but x is missing")
                                      : "is asked for, but x is in \"" + curve.x_unit + "\"") +
                         ": a delay needs a curve over time");
  if (curve.x_measured.size() < kFewestSamples)
    nuisance->reject("delay",
                     fmt::format("is asked for, but the measured curve has {} samples, expected {} "
                                 "at least",
                                 curve.x_measured.size(),
                                 kFewestSamples));
  if (!rises(curve.x_measured))
    nuisance->reject("delay", "is asked for, but the measured time does not rise everywhere");
  return true;
}

/// Returns the measured y minus the distances of the measured points from the simulated path.
std::vector<double> path_values(const CurveMeasurement& curve,
                                const std::vector<double>& x,
                                const std::vector<double>& y) {
  const double x_scale = curve.comparison.x_scale;
  const auto xs = scaled(x, x_scale), ys = scaled(y, curve.scale);
  std::vector<double> values;
  for (std::size_t i = 0; i < curve.x_measured.size(); ++i) {
    const double d =
        path_distance(curve.x_measured[i] / x_scale, curve.y_measured[i] / curve.scale, xs, ys);
    values.push_back(curve.y_measured[i] - d * curve.scale);
  }
  return values;
}

ComparedValues compared_curve(const CurveMeasurement& c) {
  ComparedValues values{
      .kind = "curve",
      .compared = c.compared_name,
      .over = c.x.empty() ? "sample by sample" : "over " + c.x,
      .whole = fmt::format("{:g} {}", c.scale, c.y_compared_unit),
      .asks = c.x.empty() ? std::vector{c.y} : std::vector{c.x, c.y},
      .passes_slopes = !c.comparison.of_spectrum() && c.comparison.what != ComparedCurve::path,
      .unit = c.y_compared_unit,
      .shown = c.y_compared_unit == c.y_unit ? c.y_shown : "",
      .measured = c.y_compared,
      .scales = std::vector<double>(c.y_compared.size(), c.scale)};
  for (std::size_t i = 0; i < c.y_compared.size(); ++i) {
    values.rows.push_back(
        c.x_compared.empty()
            ? fmt::format("{}, sample {}", c.compared_name, i + 1)
            : fmt::format("{} at {:g} {}", c.compared_name, c.x_compared[i], c.x_compared_unit));
  }
  return values;
}

}  // namespace

Curve::Curve(CurveMeasurement measured)
    : Observable(compared_curve(measured)), c_(std::move(measured)) {}

std::shared_ptr<const Curve> read_curve(const Node& table,
                                        const Measurement& measurement,
                                        const std::vector<KnownChannel>& channels) {
  CurveMeasurement curve;
  curve.x = table.text("x", "");
  if (!curve.x.empty()) curve.x_shown = named_channel(table, "x", curve.x, channels).unit;
  const std::string frame = table.has("frame") ? table.choice("frame", {"W", "H", "C"}) : "";
  const KnownChannel& y =
      channel_in_measured_frame(table, "y", table.text("y"), frame, channels, measurement);
  curve.y = y.name;
  curve.y_shown = y.unit;
  curve.x_unit = si_of(curve.x_shown);
  curve.y_unit = si_of(curve.y_shown);
  if (!curve.x.empty()) curve.x_measured = measurement.values(channel_part(curve.x), curve.x_unit);
  curve.y_measured = measurement.values(channel_part(curve.y), curve.y_unit);
  if (curve.y_measured.empty()) table.reject("measurement", "has no row of numbers");
  curve.comparison = read_comparison(table, curve.x_measured, curve.y_measured, curve.x_unit);
  curve.fits_delay = read_delay(table, curve);
  if (curve.x.empty() && !curve.comparison.of_spectrum()) {
    curve.natural = natural_abscissa(measurement, channel_part(curve.y));
    if (curve.natural)
      curve.y_shown = unit_of_file(measurement, channel_part(curve.y), curve.y_shown);
  }
  take_what_is_compared(table, curve);
  return std::make_shared<Curve>(std::move(curve));
}

namespace {

/// Returns a measured abscissa. If it lies beyond the end of the simulated ones by rounding only,
/// returns that end: a sum of time steps differs from the decimal number in a file.
double reached(double at, const std::vector<double>& x) {
  constexpr double kRounding = 1e-9;  // share of the interval from end to end
  const double end = std::clamp(at, x.front(), x.back());
  return std::abs(at - end) <= kRounding * (x.back() - x.front()) ? end : at;
}

/// Returns the simulated y at the measured abscissas minus a delay.
Result<std::vector<double>> at_measured(const CurveMeasurement& curve,
                                        const std::vector<double>& x,
                                        const std::vector<double>& y,
                                        double delay = 0.0) {
  if (const auto falls = std::adjacent_find(x.begin(), x.end(), std::greater_equal<>());
      falls != x.end()) {
    return wrong(curve.x, fmt::format("does not rise behind {:g} {}", *falls, curve.x_unit));
  }
  std::vector<double> values;
  for (const double measured : curve.x_measured) {
    const double at = reached(measured - delay, x);
    if (at < x.front() || at > x.back()) {
      return wrong(curve.x,
                   fmt::format("reaches from {0:g} to {1:g} {3}, but was measured at {2:g} {3}",
                               x.front(),
                               x.back(),
                               at,
                               curve.x_unit));
    }
    values.push_back(interpolated(x, y, at));
  }
  return values;
}

/// Returns the index of the simulated sample that ends the interval of an abscissa. Beyond the ends
/// it is the first or the last interval.
std::size_t end_of_interval(const std::vector<double>& x, double at) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::upper_bound(x.begin(), x.end() - 1, at) - x.begin()));
}

/// Returns the simulated y at the measured abscissas minus a shift. Beyond the ends of the
/// simulation the curve is continued with its last slope.
std::vector<double> continued_at_measured(const CurveMeasurement& curve,
                                          const std::vector<double>& x,
                                          const std::vector<double>& y,
                                          double shift) {
  std::vector<double> values;
  for (const double measured : curve.x_measured) {
    const double at = reached(measured - shift, x);
    const std::size_t r = end_of_interval(x, at), l = r - 1;
    values.push_back(y[l] + (at - x[l]) / (x[r] - x[l]) * (y[r] - y[l]));
  }
  return values;
}

/// Returns dy/dx of the curve at the measured abscissas minus a delay.
std::vector<double> steepness_at_measured(const CurveMeasurement& curve,
                                          const std::vector<double>& x,
                                          const std::vector<double>& y,
                                          double delay) {
  std::vector<double> steepness;
  for (const double measured : curve.x_measured) {
    const double at = reached(measured - delay, x);
    const std::size_t r = end_of_interval(x, at), l = r - 1;
    steepness.push_back((y[r] - y[l]) / (x[r] - x[l]));
  }
  return steepness;
}

/// Returns the derivatives of the curve at the measured abscissas minus a delay: dy - y' dx,
/// because both x and y depend on the variables. Empty if the derivatives of x or y are not known.
std::vector<double> slopes_at_measured(const CurveMeasurement& curve,
                                       const Channel& x,
                                       const Channel& y,
                                       double delay = 0.0) {
  if (x.slopes.empty() || y.slopes.empty() || x.values.size() < 2) return {};
  const std::size_t rows = y.values.size();
  std::vector<double> slopes;
  for (std::size_t column = 0; column < y.slopes.size(); column += rows) {
    for (const double measured : curve.x_measured) {
      const double at = reached(measured - delay, x.values);
      const std::size_t r = end_of_interval(x.values, at), l = r - 1;
      const double width = x.values[r] - x.values[l], share = (at - x.values[l]) / width;
      const double steepness = (y.values[r] - y.values[l]) / width;
      const auto between = [&](const std::vector<double>& S) {
        return S[column + l] + share * (S[column + r] - S[column + l]);
      };
      slopes.push_back(between(y.slopes) - steepness * between(x.slopes));
    }
  }
  return slopes;
}

std::vector<double> about_their_means(std::vector<double> slopes, std::size_t rows) {
  for (auto column = slopes.begin(); column != slopes.end(); column += static_cast<long>(rows)) {
    const auto end = column + static_cast<long>(rows);
    const double mean = std::accumulate(column, end, 0.0) / static_cast<double>(rows);
    std::for_each(column, end, [mean](double& slope) { slope -= mean; });
  }
  return slopes;
}

}  // namespace

Result<std::pair<const Channel*, const Channel*>> Curve::channels_of(
    const Channels& trial, const std::string& y_name) const {
  const Channel *x = trial.find(c_.x), *y = trial.find(y_name);
  if (!y) return wrong(y_name, "is missing");
  if (!x) return wrong(c_.x, "is missing");
  if (x->values.size() != y->values.size() || x->values.empty()) {
    return wrong(c_.x,
                 fmt::format("has {} values and \"{}\" {}, expected as many",
                             x->values.size(),
                             y_name,
                             y->values.size()));
  }
  return std::pair(x, y);
}

Result<SimulatedValues> Curve::samples(const Channels& trial, const std::string& y_name) const {
  const Channel* y = trial.find(y_name);
  if (!y) return wrong(y_name, "is missing");
  if (c_.x.empty()) {
    if (y->values.size() == c_.y_measured.size()) return SimulatedValues{y->values, y->slopes};
    return wrong(
        y_name,
        fmt::format(
            "has {} values, expected {} as measured", y->values.size(), c_.y_measured.size()));
  }
  const auto both = channels_of(trial, y_name);
  if (!both) return both.failure();
  const Channel* x = both->first;
  if (c_.comparison.what == ComparedCurve::path) {
    if (x->values.size() < 2) return wrong(c_.x, "has 1 value, expected a path of 2 at least");
    return SimulatedValues{path_values(c_, x->values, y->values)};
  }
  auto values = at_measured(c_, x->values, y->values);
  if (!values) return values.failure();
  return SimulatedValues{std::move(*values), slopes_at_measured(c_, *x, *y)};
}

Result<SimulatedValues> Curve::delayed_samples(const Channels& trial) const {
  const auto both = channels_of(trial, c_.y);
  if (!both) return both.failure();
  const Channel* x = both->first;
  const Channel* y = both->second;
  if (x->values.size() < 2 || !rises(x->values))
    return wrong(c_.x, "does not rise over two values at least, as a fitted delay needs it");
  const auto range = delay_range(c_.x_measured, x->values);
  if (!range) {
    return wrong(
        c_.x,
        fmt::format("reaches from {:g} to {:g} s and was measured from {:g} to {:g} s, which "
                    "leaves no room for the delay that nuisance asks for; select a "
                    "shorter stretch of the measurement, or simulate a longer one",
                    x->values.front(),
                    x->values.back(),
                    c_.x_measured.front(),
                    c_.x_measured.back()));
  }
  const bool about_mean = c_.comparison.what == ComparedCurve::about_mean;
  const std::size_t rows = c_.x_measured.size();
  const auto centered = [&](std::vector<double> slopes) {
    return about_mean ? about_their_means(std::move(slopes), rows) : slopes;
  };
  const auto by_delay = [&](double delay) {
    auto steepness = steepness_at_measured(c_, x->values, y->values, delay);
    for (double& one : steepness) one = -one;
    return centered(std::move(steepness));
  };
  FittedDelay delay = fit_delay(*range, [&](double at) {
    DelayedDifferences found{
        compared_values(c_.comparison, *at_measured(c_, x->values, y->values, at)), by_delay(at)};
    for (std::size_t i = 0; i < rows; ++i) {
      found.d[i] = (c_.y_compared[i] - found.d[i]) / c_.scale;
      found.by_delay[i] /= -c_.scale;
    }
    return found;
  });
  SimulatedValues found{*at_measured(c_, x->values, y->values, delay.value),
                        centered(slopes_at_measured(c_, *x, *y, delay.value))};
  if (!found.slopes.empty()) project_out(by_delay(delay.value), found.slopes, delay);
  found.delay = std::move(delay);
  return found;
}

Result<SimulatedValues> Curve::simulated(const Channels& trial) const {
  auto curve = c_.fits_delay ? delayed_samples(trial) : samples(trial, c_.y);
  if (!curve || c_.comparison.what == ComparedCurve::path) return curve;
  curve->values = compared_values(c_.comparison, curve->values);
  if (!passes_slopes()) curve->slopes.clear();
  if (c_.comparison.what == ComparedCurve::about_mean)
    curve->slopes = about_their_means(std::move(curve->slopes), curve->values.size());
  return curve;
}

Result<DelayRange> Curve::shift_range(const Channels& trial) const {
  const auto both = channels_of(trial, c_.y);
  if (!both) return both.failure();
  const std::vector<double>& x = both->first->values;
  if (x.size() < 2 || !rises(x))
    return wrong(c_.x, "does not rise over two values at least, as a shift along it needs it");
  // Without a shift the simulation has to cover the measurement, whatever the abscissa.
  if (const auto covered = at_measured(c_, x, both->second->values); !covered)
    return covered.failure();
  if (c_.x_unit == "s") {
    if (const auto range = delay_range(c_.x_measured, x)) return *range;
    return wrong(c_.x,
                 "covers no more than the measurement, which leaves no room for the delay that "
                 "nuisance asks for; select a shorter stretch of the measurement, or simulate a "
                 "longer one");
  }
  constexpr double kWidestShift = 0.1;  // share of the record, in either direction
  const auto [least, most] = std::minmax_element(c_.x_measured.begin(), c_.x_measured.end());
  const double widest = kWidestShift * (*most - *least);
  return DelayRange{-widest, widest};
}

Result<Comparison> Curve::compare_shifted(const Channels& trial,
                                          const ObjectiveSettings& settings,
                                          double shift) const {
  const auto both = channels_of(trial, c_.y);
  if (!both) return both.failure();
  const Channel &x = *both->first, &y = *both->second;
  if (x.values.size() < 2 || !rises(x.values))
    return wrong(c_.x, "does not rise over two values at least, as a shift along it needs it");
  SimulatedValues found{
      compared_values(c_.comparison, continued_at_measured(c_, x.values, y.values, shift)),
      slopes_at_measured(c_, x, y, shift)};
  auto steepness = steepness_at_measured(c_, x.values, y.values, shift);
  if (c_.comparison.what == ComparedCurve::about_mean) {
    found.slopes = about_their_means(std::move(found.slopes), found.values.size());
    steepness = about_their_means(std::move(steepness), found.values.size());
  }
  Comparison comparison = compare_values(c_.y_compared, found, scales(), settings);
  // d = (measured - y(x - shift)) / scale, so its derivative by the shift is y' / scale.
  comparison.by_shift = scaled(steepness, c_.scale);
  return comparison;
}

Result<Comparison> Curve::compare(const Channels& trial, const ObjectiveSettings& settings) const {
  const auto found = simulated(trial);
  if (!found) return found.failure();
  return compare_values(c_.y_compared, *found, scales(), settings);
}

std::vector<std::filesystem::path> Curve::write(const Channels& trial,
                                                const MeasurementFiles& files) const {
  Channels columns;
  if (files.measurement) {
    if (c_.comparison.what == ComparedCurve::path)
      throw InputError(files.measurement->place(),
                       "cannot be written by a twin: " + c_.y +
                           " is compared as a path, whose points belong to no sample");
    const auto y = samples(trial, c_.y);
    if (!y) throw InputError(files.measurement->place(), y.failure().reason);
    std::map<std::string, std::vector<double>> values{{channel_part(c_.y), y->values}};
    if (files.measurement->is_turned(channel_part(c_.y)))
      for (const std::string& beside : forces_beside(c_.y))
        if (const auto found = samples(trial, beside)) values[channel_part(beside)] = found->values;
    return {write_twin(*files.measurement, values, files.comment)};
  }
  if (files.is_shared) {
    columns = formats::CsvTable::read(files.values).channels();
  }
  const auto take = [&](const std::string& name, const std::string& unit) {
    const std::vector<double>& values = trial[name];
    if (!columns.empty() && columns.all().front().values.size() != values.size()) {
      throw InputError({files.values.string(), 0},
                       "is the measurement of experiments with different numbers of values: a twin "
                       "needs a file for each of them");
    }
    if (!columns.find(channel_part(name))) columns.add({channel_part(name), unit, values});
  };
  if (!c_.x.empty()) take(c_.x, c_.x_unit);
  take(c_.y, c_.y_unit);
  write_text_file(files.values, "# " + files.comment + "\n" + formats::csv_text(columns));
  return {files.values};
}

std::string Curve::table(const Channels& trial, const Comparison& comparison) const {
  const auto found = simulated(trial);
  std::string text = fmt::format("  {:>16} {:>18} {:>18} {:>9}\n",
                                 c_.x_compared.empty() ? "sample" : "at " + c_.x_compared_unit,
                                 "measured " + c_.y_compared_unit,
                                 "simulated " + c_.y_compared_unit,
                                 "error %");
  for (std::size_t i = 0; found && i < found->values.size(); ++i) {
    text += fmt::format("  {:16.6g} {:18.6g} {:18.6g} {:9.2f}\n",
                        c_.x_compared.empty() ? static_cast<double>(i + 1) : c_.x_compared[i],
                        c_.y_compared[i],
                        found->values[i],
                        comparison.errors[i] * 100.0);
  }
  return text;
}

std::pair<std::string, nlohmann::ordered_json> Curve::answer(const Channels& trial,
                                                             const Comparison& comparison) const {
  const auto found = simulated(trial);
  return {
      "curve",
      {{"at", json_of(c_.x_compared)},
       {"at_unit", c_.x_compared.empty() ? "" : c_.x_compared_unit},
       {"measured", json_of(c_.y_compared)},
       {"simulated", found ? json_of(found->values) : nlohmann::ordered_json(nullptr)},
       {"unit", c_.y_compared_unit},
       {"error", json_of(comparison.errors)},
       {"delay_s",
        comparison.delay ? json_of(comparison.delay->value) : nlohmann::ordered_json(nullptr)}}};
}

extern const ComparedKind kCurveKind;
const experiment::KeySection& curve_keys();

const ComparedKind kCurveKind = {
    "curve",
    true,
    [](const Node& table, const std::vector<KnownChannel>& channels, const Measurement* measurement)
        -> std::shared_ptr<const Observable> { return read_curve(table, *measurement, channels); },
    curve_keys};

}  // namespace latsch::correlation
