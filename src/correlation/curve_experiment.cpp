// SPDX-License-Identifier: Apache-2.0
#include "correlation/curve_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/units.h"
#include "formats/csv_table.h"

namespace latsch::correlation {
namespace {

/// The unit in which the simulator writes a channel.
std::string unit_of(const Node& table,
                    const char* key,
                    const Simulator& simulator,
                    const std::string& channel) {
  std::vector<std::string> names;
  for (const OutputReader& output : simulator.outputs) {
    for (const auto& quantity : output.quantities) {
      names.push_back(output.name + "/" + quantity.name);
      if (names.back() == channel) return quantity.unit;
    }
  }
  table.reject(key, "is " + in_quotes(channel) + ", expected " + list_of(names));
}

std::string si_of(const std::string& unit) { return si_unit(Unit::of(unit).dimension()); }

std::string last_part(const std::string& channel) {
  return channel.substr(channel.find_last_of('/') + 1);
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

}  // namespace

CurveExperiment read_curve(const Node& table,
                           const std::filesystem::path& measurement,
                           const Simulator& simulator) {
  CurveExperiment curve;
  curve.x = table.text("x", "");
  curve.y = table.text("y");
  if (!curve.x.empty()) curve.x_shown = unit_of(table, "x", simulator, curve.x);
  curve.y_shown = unit_of(table, "y", simulator, curve.y);
  curve.x_unit = si_of(curve.x_shown);
  curve.y_unit = si_of(curve.y_shown);
  const auto columns = formats::CsvTable::read(measurement);
  if (!curve.x.empty()) curve.x_measured = columns.numbers(last_part(curve.x), curve.x_unit);
  curve.y_measured = columns.numbers(last_part(curve.y), curve.y_unit);
  if (curve.y_measured.empty()) table.reject("measurement", "has no row of numbers");
  const double most = largest(curve.y_measured);
  curve.scale = table.quantity("scale", curve.y_unit, Range::positive(), most);
  if (curve.scale == 0.0) table.reject("scale", "is missing: all measured values are 0");
  return curve;
}

std::vector<std::string> value_names(const CurveExperiment& curve) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < curve.y_measured.size(); ++i) {
    names.push_back(curve.x.empty()
                        ? fmt::format("{}, sample {}", curve.y, i + 1)
                        : fmt::format("{} at {:g} {}", curve.y, curve.x_measured[i], curve.x_unit));
  }
  return names;
}

Result<std::vector<double>> simulated_curve(const CurveExperiment& curve,
                                            const Channels& channels) {
  const Channel* y = channels.find(curve.y);
  if (!y) return wrong(curve.y, "is missing");
  if (curve.x.empty()) {
    if (y->values.size() == curve.y_measured.size()) return y->values;
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
  const auto falls = std::adjacent_find(x->values.begin(), x->values.end(), std::greater_equal<>());
  if (falls != x->values.end()) {
    return wrong(curve.x, fmt::format("does not rise behind {:g} {}", *falls, curve.x_unit));
  }
  std::vector<double> values;
  for (const double at : curve.x_measured) {
    if (at < x->values.front() || at > x->values.back()) {
      return wrong(curve.x,
                   fmt::format("reaches from {0:g} to {1:g} {3}, but was measured at {2:g} {3}",
                               x->values.front(),
                               x->values.back(),
                               at,
                               curve.x_unit));
    }
    values.push_back(interpolated(x->values, y->values, at));
  }
  return values;
}

Result<Comparison> compare_curve(const CurveExperiment& curve,
                                 const Channels& channels,
                                 const ObjectiveSettings& settings) {
  const auto simulated = simulated_curve(curve, channels);
  if (!simulated) return simulated.failure();
  Comparison comparison;
  for (std::size_t i = 0; i < simulated->size(); ++i) {
    const double d = (curve.y_measured[i] - (*simulated)[i]) / curve.scale;
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
