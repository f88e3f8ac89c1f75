// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/curve_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "measurement/band_level.h"
#include "numerics/signals/mean.h"
#include "numerics/signals/sample_count.h"

namespace latsch::correlation {
namespace {

constexpr double kUniform = 0.1;  // share of a step by which times may deviate from uniform
constexpr long kFewestSamples = 8;
// least mean square, which keeps the level in dB finite for a band without power
constexpr double kWeakest = 1e-30;

const std::vector<std::string> kNames{"values", "about_mean", "psd", "band_levels", "path"};

double rate_of(const Node& table, const std::vector<double>& x, const std::string& x_unit) {
  if (x.empty()) return table.quantity("rate", "Hz", Range::positive());
  if (x_unit != "s") {
    table.reject("x", "is in \"" + x_unit + "\", expected a time: the spectrum is taken over it");
  }
  const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double expected = x.front() + static_cast<double>(i) * step;
    if (!(step > 0.0) || std::abs(x[i] - expected) > kUniform * step) {
      table.reject("measurement",
                   fmt::format("is not sampled at a constant rate: sample {} is at {:.9g} s, "
                               "expected {:.9g} s",
                               i + 1,
                               x[i],
                               expected));
    }
  }
  return 1.0 / step;
}

numerics::Convention convention_of(const Node& table) {
  const auto name = table.choice("convention", {"scipy", "octave", "matlab"}, "scipy");
  if (name == "octave") return numerics::Convention::octave;
  return name == "matlab" ? numerics::Convention::matlab : numerics::Convention::scipy;
}

FrequencyBand band_of(const Node& table, double rate, const numerics::WelchSettings& welch) {
  const FrequencyBand whole{rate / welch.length, rate / 2.0};
  if (!table.has("band")) return whole;
  const auto edges = table.quantities("band", "Hz", Range::positive());
  if (edges.size() != 2 || edges[0] >= edges[1]) {
    table.reject("band",
                 R"(is no band, expected two rising frequencies such as ["5 Hz", "300 Hz"])");
  }
  if (edges[1] > 0.5 * rate * (1.0 + kUniform * kUniform))
    table.reject("band",
                 fmt::format("ends at {:g} Hz, but the {:g} samples a second hold nothing above "
                             "{:g} Hz; expected a band up to there",
                             edges[1],
                             rate,
                             0.5 * rate));
  return {edges[0], std::min(edges[1], rate / 2.0)};
}

void read_spectrum(const Node& table,
                   const std::vector<double>& x,
                   long samples,
                   const std::string& x_unit,
                   CurveComparison& comparison) {
  if (samples < kFewestSamples) {
    table.reject(
        "measurement",
        fmt::format(
            "has {} samples, expected {} at least for a spectrum", samples, kFewestSamples));
  }
  comparison.rate = rate_of(table, x, x_unit);
  std::optional<int> segment;
  if (table.has("segment")) {
    const double seconds = table.quantity("segment", "s", Range::positive());
    segment = numerics::sample_count(seconds, comparison.rate);
    if (*segment > samples)
      table.reject("segment",
                   fmt::format("is {:g} s, but the record has {:.4g} s; expected a part of it",
                               seconds,
                               static_cast<double>(samples) / comparison.rate));
    if (*segment < kFewestSamples) {
      table.reject("segment", fmt::format("is {} samples, expected 8 at least", *segment));
    }
  }
  comparison.welch =
      numerics::welch_settings(convention_of(table), static_cast<int>(samples), segment);
  comparison.band = band_of(table, comparison.rate, comparison.welch);
  if (compared_frequencies(comparison).empty()) {
    table.reject(table.has("band") ? "band" : "measurement",
                 fmt::format("holds no frequency of the spectrum: its lines are {:.4g} Hz apart",
                             comparison.rate / comparison.welch.length));
  }
}

numerics::Density density(const CurveComparison& comparison, const std::vector<double>& y) {
  return numerics::power_density(y, comparison.rate, comparison.welch);
}

bool inside(const CurveComparison& comparison, double frequency) {
  const double slack = 1e-9 * comparison.rate;
  return frequency >= comparison.band.lower - slack && frequency <= comparison.band.upper + slack;
}

}  // namespace

CurveComparison read_comparison(const Node& table,
                                const std::vector<double>& x,
                                const std::vector<double>& y,
                                const std::string& x_unit) {
  CurveComparison comparison;
  const auto name = table.choice("compare", kNames, kNames.front());
  comparison.what =
      static_cast<ComparedCurve>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
  if (comparison.of_spectrum()) {
    read_spectrum(table, x, static_cast<long>(y.size()), x_unit, comparison);
  }
  if (comparison.what == ComparedCurve::path) {
    if (x.empty()) table.reject("x", "is missing: a path needs both channels");
    double largest = 0.0;
    for (const double value : x) largest = std::max(largest, std::abs(value));
    comparison.x_scale = table.quantity("x_scale", x_unit, Range::positive(), largest);
    if (comparison.x_scale == 0.0) table.reject("x_scale", "is missing: all measured x are 0");
  }
  return comparison;
}

std::vector<double> compared_frequencies(const CurveComparison& comparison) {
  std::vector<double> frequencies;
  if (comparison.what == ComparedCurve::band_levels) {
    for (const FrequencyBand& band : third_octave_bands(comparison.band)) {
      frequencies.push_back(std::sqrt(band.lower * band.upper));
    }
    return frequencies;
  }
  for (int k = 0; k <= comparison.welch.length / 2; ++k) {
    const double frequency = k * comparison.rate / comparison.welch.length;
    if (inside(comparison, frequency)) frequencies.push_back(frequency);
  }
  return frequencies;
}

std::vector<double> compared_values(const CurveComparison& comparison,
                                    const std::vector<double>& y) {
  std::vector<double> values;
  if (comparison.what == ComparedCurve::psd) {
    const auto S = density(comparison, y);
    for (std::size_t k = 0; k < S.value.size(); ++k) {
      if (inside(comparison, S.frequency[k])) values.push_back(S.value[k]);
    }
    return values;
  }
  if (comparison.what == ComparedCurve::band_levels) {
    const auto S = density(comparison, y);
    for (const FrequencyBand& band : third_octave_bands(comparison.band)) {
      values.push_back(10.0 * std::log10(std::max(kWeakest, band_power(S, band))));
    }
    return values;
  }
  values = y;
  if (comparison.what == ComparedCurve::about_mean) {
    const double level = numerics::mean(y);
    for (double& value : values) value -= level;
  }
  return values;
}

double path_distance(double x,
                     double y,
                     const std::vector<double>& xs,
                     const std::vector<double>& ys) {
  double nearest = std::numeric_limits<double>::infinity(), sign = 1.0;
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    const double dx = xs[i + 1] - xs[i], dy = ys[i + 1] - ys[i], square = dx * dx + dy * dy;
    if (square == 0.0) continue;
    const double share = std::clamp(((x - xs[i]) * dx + (y - ys[i]) * dy) / square, 0.0, 1.0);
    const double distance = std::hypot(x - xs[i] - share * dx, y - ys[i] - share * dy);
    if (distance < nearest) {
      nearest = distance;
      sign = dx * (y - ys[i]) - dy * (x - xs[i]) < 0.0 ? -1.0 : 1.0;
    }
  }
  return sign * nearest;
}

}  // namespace latsch::correlation
