// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/curve_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/text.h"
#include "base/units.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {
namespace {

const KnownChannel& known_channel(const Node& table,
                                  const char* key,
                                  const std::vector<KnownChannel>& channels,
                                  const std::string& channel) {
  std::vector<std::string> names;
  for (const KnownChannel& known : channels) {
    if (known.name == channel) return known;
    names.push_back(known.name);
  }
  table.reject(key, "is " + in_quotes(channel) + ", expected " + list_of(names));
}

std::string si_of(const std::string& unit) { return si_unit(Unit::of(unit).dimension()); }

std::string last_part(const std::string& channel) {
  return channel.substr(channel.find_last_of('/') + 1);
}

/// A column of a measurement; the name of a force or moment may say its frame: "Fy", "FyW", "FZH".
struct MeasuredColumn {
  std::string name, frame;
};
MeasuredColumn column_of(const formats::CsvTable& table, const std::string& channel) {
  const auto same = [](const std::string& a, const std::string& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
      return std::tolower(x) == std::tolower(y);
    });
  };
  if (!table.has(channel)) {
    for (const std::string& column : table.columns())
      for (const char* frame : {"W", "H", "C"})
        if (same(column, channel + frame)) return {column, frame};
  }
  return {channel, ""};
}

/// Forces are compared in the frame of the measurement, which the rig records them in.
void check_frame(const Node& table, const MeasuredColumn& measured, const KnownChannel& channel) {
  std::string frame = measured.frame;
  if (table.has("frame")) {
    frame = table.choice("frame", {"W", "H", "C"});
    if (!measured.frame.empty() && measured.frame != frame)
      table.reject("frame",
                   fmt::format("is {}, but the measurement has the column {}",
                               in_quotes(frame),
                               in_quotes(measured.name)));
  }
  if (frame.empty() || frame == channel.frame) return;
  const std::string test = channel.name.substr(0, channel.name.find('/'));
  const char* key = table.has("frame") ? "frame" : "measurement";
  if (channel.frame.empty())
    table.reject(key,
                 fmt::format("is in axes {}, but {} is no force or moment in a frame",
                             frame,
                             in_quotes(channel.name)));
  table.reject(key,
               fmt::format("is in axes {0}, but {1} is recorded in axes {2}; put frame = \"{0}\" "
                           "into the file of [test.{3}]",
                           frame,
                           in_quotes(channel.name),
                           channel.frame,
                           test));
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

Failure wrong(const std::string& channel, const std::string& what) {
  return {fmt::format("channel \"{}\" {}", channel, what), Cause::bad_output};
}

/// y at x, linear between samples; x rises and reaches around it.
double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto right = std::upper_bound(xs.begin(), xs.end(), x);
  if (right == xs.end()) return ys.back();
  const auto i = right - xs.begin();
  const double share = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

void take_what_is_compared(const Node& table, CurveExperiment& curve) {
  constexpr double kLevelScale = 10.0;  // dB: ten times the power is an error of 100 %
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
  if (curve.scale == 0.0) table.reject("scale", "is missing: all measured values are 0");
}

std::vector<double> scaled(const std::vector<double>& values, double scale) {
  std::vector<double> shares = values;
  for (double& value : shares) value /= scale;
  return shares;
}

/// The measured y less the distances of the measured points from the simulated path.
std::vector<double> path_values(const CurveExperiment& curve,
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

}  // namespace

CurveExperiment read_curve(const Node& table,
                           const std::filesystem::path& measurement,
                           const std::vector<KnownChannel>& channels) {
  CurveExperiment curve;
  curve.x = table.text("x", "");
  curve.y = table.text("y");
  if (!curve.x.empty()) curve.x_shown = known_channel(table, "x", channels, curve.x).unit;
  const KnownChannel& y = known_channel(table, "y", channels, curve.y);
  curve.y_shown = y.unit;
  curve.x_unit = si_of(curve.x_shown);
  curve.y_unit = si_of(curve.y_shown);
  const auto columns = formats::CsvTable::read(measurement);
  if (!curve.x.empty()) curve.x_measured = columns.numbers(last_part(curve.x), curve.x_unit);
  const MeasuredColumn column = column_of(columns, last_part(curve.y));
  check_frame(table, column, y);
  curve.y_measured = columns.numbers(column.name, curve.y_unit);
  if (curve.y_measured.empty()) table.reject("measurement", "has no row of numbers");
  curve.comparison = read_comparison(table, curve.x_measured, curve.y_measured, curve.x_unit);
  take_what_is_compared(table, curve);
  return curve;
}

std::vector<std::string> value_names(const CurveExperiment& curve) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < curve.y_compared.size(); ++i) {
    names.push_back(curve.x_compared.empty()
                        ? fmt::format("{}, sample {}", curve.compared_name, i + 1)
                        : fmt::format("{} at {:g} {}",
                                      curve.compared_name,
                                      curve.x_compared[i],
                                      curve.x_compared_unit));
  }
  return names;
}

namespace {

/// Simulated y at the measured abscissas.
Result<std::vector<double>> at_measured(const CurveExperiment& curve,
                                        const std::vector<double>& x,
                                        const std::vector<double>& y) {
  const auto falls = std::adjacent_find(x.begin(), x.end(), std::greater_equal<>());
  if (falls != x.end()) {
    return wrong(curve.x, fmt::format("does not rise behind {:g} {}", *falls, curve.x_unit));
  }
  std::vector<double> values;
  for (const double at : curve.x_measured) {
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

}  // namespace

Result<std::vector<double>> simulated_curve(const CurveExperiment& curve,
                                            const Channels& channels) {
  const Channel* y = channels.find(curve.y);
  if (!y) return wrong(curve.y, "is missing");
  if (curve.x.empty()) {
    if (y->values.size() == curve.y_measured.size()) {
      return compared_values(curve.comparison, y->values);
    }
    return wrong(
        curve.y,
        fmt::format(
            "has {} values, expected {} as measured", y->values.size(), curve.y_measured.size()));
  }
  const Channel* x = channels.find(curve.x);
  if (!x) return wrong(curve.x, "is missing");
  if (x->values.size() != y->values.size() || x->values.empty()) {
    return wrong(curve.x,
                 fmt::format("has {} values and \"{}\" {}, expected as many",
                             x->values.size(),
                             curve.y,
                             y->values.size()));
  }
  if (curve.comparison.what == ComparedCurve::path) {
    if (x->values.size() < 2) return wrong(curve.x, "has 1 value, expected a path of 2 at least");
    return path_values(curve, x->values, y->values);
  }
  auto values = at_measured(curve, x->values, y->values);
  if (!values) return values;
  return compared_values(curve.comparison, *values);
}

Result<Comparison> compare_curve(const CurveExperiment& curve,
                                 const Channels& channels,
                                 const ObjectiveSettings& settings) {
  const auto simulated = simulated_curve(curve, channels);
  if (!simulated) return simulated.failure();
  Comparison comparison;
  for (std::size_t i = 0; i < simulated->size(); ++i) {
    const double d = (curve.y_compared[i] - (*simulated)[i]) / curve.scale;
    comparison.errors.push_back(d);
    comparison.value += std::pow(std::abs(d), settings.exponent);
    comparison.mean_error += std::abs(d);
    comparison.largest_error = std::max(comparison.largest_error, std::abs(d));
  }
  const auto count = static_cast<double>(simulated->size());
  comparison.value /= count;
  comparison.differences = comparison.errors;
  comparison.mean_error /= count;
  return comparison;
}

}  // namespace latsch::correlation
