// SPDX-License-Identifier: Apache-2.0
// Measured and simulated values, from the channels in the journal. The journal has no channels of
// experiments that are only predicted; if the model allows it, they are simulated again at the
// point.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "correlation/study/study_experiment.h"
#include "correlation/target/predictions.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/test_limits.h"
#include "numerics/signals/welch.h"
#include "report/report.h"
#include "studio/views/json_values.h"
#include "studio/views/kept_identifiability.h"
#include "studio/views/recorded_trial.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

using correlation::Study;

constexpr std::size_t kMostSamples = 4000;  // most samples of a curve on a page

/// Samples of a curve. A long curve is divided into stretches, and the least and the greatest value
/// of each are kept, in their order.
struct Samples {
  std::vector<double> x, y;
};

Samples thinned(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t count = std::min(x.size(), y.size());
  if (count <= kMostSamples)
    return {{x.begin(), x.begin() + count}, {y.begin(), y.begin() + count}};
  const std::size_t width = (2 * count + kMostSamples - 1) / kMostSamples;
  Samples few;
  for (std::size_t begin = 0; begin < count; begin += width) {
    const auto from = y.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to = y.begin() + static_cast<std::ptrdiff_t>(std::min(count, begin + width));
    const auto [least, greatest] = std::minmax_element(from, to);
    for (const auto at : {std::min(least, greatest), std::max(least, greatest)}) {
      few.x.push_back(x[static_cast<std::size_t>(at - y.begin())]);
      few.y.push_back(*at);
    }
  }
  return few;
}

Json line(const std::vector<double>& x,
          const std::vector<double>& y,
          const std::string& x_unit,
          const std::string& y_unit) {
  const Samples few = thinned(x, y);
  return {{"x", in_unit(few.x, x_unit)}, {"y", in_unit(few.y, y_unit)}};
}

/// Returns the abscissa x, or the sample numbers if x is empty.
std::vector<double> abscissa_of(const std::vector<double>& x, std::size_t count) {
  if (!x.empty()) return x;
  std::vector<double> numbers(count);
  for (std::size_t k = 0; k < count; ++k) numbers[k] = static_cast<double>(k + 1);
  return numbers;
}

bool is_of_time(const std::string& name) { return name == "time" || name.ends_with("/time"); }

/// Returns y interpolated at evenly spaced times between the first and the last; empty if the times
/// do not increase.
std::vector<double> even_samples(const std::vector<double>& t,
                                 const std::vector<double>& y,
                                 double rate) {
  std::vector<double> even;
  std::size_t k = 0;
  for (double at = t.front(); at <= t.back(); at += 1.0 / rate) {
    while (k + 2 < t.size() && t[k + 1] < at) ++k;
    const double share = (at - t[k]) / (t[k + 1] - t[k]);
    if (!(t[k + 1] > t[k])) return {};
    even.push_back(y[k] + share * (y[k + 1] - y[k]));
  }
  return even;
}

Json psd(const report::MeasuredCurve& curve) {
  constexpr std::size_t kLeastSamples = 64;  // least number of samples for a useful spectrum
  if (!is_of_time(curve.x_name) || curve.x_measured.size() < kLeastSamples ||
      curve.x_simulated.size() < kLeastSamples)
    return nullptr;
  const double span = curve.x_measured.back() - curve.x_measured.front();
  if (!(span > 0.0)) return nullptr;
  const double rate = static_cast<double>(curve.x_measured.size() - 1) / span;
  const auto density = [&](const std::vector<double>& t, const std::vector<double>& y) {
    const auto even = even_samples(t, y, rate);
    if (even.size() < kLeastSamples) return numerics::Density{};
    return numerics::power_density(
        even,
        rate,
        numerics::welch_settings(numerics::Convention::scipy,
                                 static_cast<int>(even.size()),
                                 static_cast<int>(std::max(kLeastSamples, even.size() / 4))));
  };
  const auto measured = density(curve.x_measured, curve.y_measured);
  const auto simulated = density(curve.x_simulated, curve.y_simulated);
  if (measured.value.empty() || simulated.value.empty()) return nullptr;
  return {{"unit", "(" + curve.y_unit + ")^2/Hz"},
          {"measured", {{"x", finite(measured.frequency)}, {"y", finite(measured.value)}}},
          {"simulated", {{"x", finite(simulated.frequency)}, {"y", finite(simulated.value)}}}};
}

Json band_of(const std::vector<double>& x,
             const report::Band& band,
             const std::string& x_unit,
             const std::string& y_unit) {
  if (band.lower.empty() || band.lower.size() != x.size()) return nullptr;
  return {{"x", in_unit(x, x_unit)},
          {"lower", in_unit(band.lower, y_unit)},
          {"upper", in_unit(band.upper, y_unit)},
          {"inside", band.inside}};
}

Json curve_of(const report::ComparedForces& curve) {
  Json errors = Json::array();
  for (std::size_t k = 0; k < curve.measured.size(); ++k)
    errors.push_back(finite((curve.measured[k] - curve.simulated[k]) / curve.measured[k]));
  return {{"experiment", curve.experiment},
          {"conditions", curve.conditions},
          {"fitted", curve.fitted},
          {"x_name", curve.over_loaded_radius ? "loaded radius" : "deflection"},
          {"x_unit", "mm"},
          {"y_name", "force"},
          {"y_unit", "N"},
          {"x", in_unit(curve.abscissa, "mm")},
          {"measured", finite(curve.measured)},
          {"simulated", line(curve.abscissa, curve.simulated, "mm", "N")},
          {"initial",
           curve.initial.empty() ? Json(nullptr) : line(curve.abscissa, curve.initial, "mm", "N")},
          {"errors", errors},
          {"band", band_of(curve.abscissa, curve.band, "mm", "N")},
          {"psd", nullptr}};
}

/// Returns the simulated line and the measured points of every piece; null if the curve has one
/// piece.
Json pieces_of(const report::MeasuredCurve& curve) {
  if (curve.pieces.empty() || curve.y_simulated.size() != curve.x_measured.size()) return nullptr;
  Json pieces = Json::array();
  for (const auto& piece : curve.pieces) {
    const auto part = [&](const std::vector<double>& all) {
      return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(piece.from),
                                 all.begin() + static_cast<std::ptrdiff_t>(piece.end));
    };
    pieces.push_back(
        line(part(curve.x_measured), part(curve.y_simulated), curve.x_unit, curve.y_unit));
    pieces.back()["name"] = piece.name;
    pieces.back()["level"] = piece.level;
    pieces.back()["measured"] =
        line(part(curve.x_measured), part(curve.y_measured), curve.x_unit, curve.y_unit);
  }
  return pieces;
}

Json curve_of(const report::MeasuredCurve& curve) {
  const auto x_measured = abscissa_of(curve.x_measured, curve.y_measured.size());
  const std::string x_unit = curve.x_measured.empty() ? "1" : curve.x_unit;
  const Samples measured = thinned(x_measured, curve.y_measured);
  const Samples errors = thinned(x_measured, curve.errors);
  return {{"experiment", curve.experiment},
          {"conditions", curve.conditions},
          {"fitted", curve.fitted},
          {"x_name", curve.x_name.empty() ? "sample" : curve.x_name},
          {"x_unit", x_unit},
          {"y_name", curve.y_name},
          {"y_unit", curve.y_unit},
          {"x", in_unit(measured.x, x_unit)},
          {"measured", in_unit(measured.y, curve.y_unit)},
          {"simulated",
           line(abscissa_of(curve.x_simulated, curve.y_simulated.size()),
                curve.y_simulated,
                x_unit,
                curve.y_unit)},
          {"initial",
           curve.y_initial.empty() ? Json(nullptr)
                                   : line(abscissa_of(curve.x_initial, curve.y_initial.size()),
                                          curve.y_initial,
                                          x_unit,
                                          curve.y_unit)},
          {"pieces", pieces_of(curve)},
          {"errors", finite(errors.y)},
          {"errors_x", in_unit(errors.x, x_unit)},
          {"band", band_of(curve.x_band, curve.band, x_unit, curve.y_unit)},
          {"psd", psd(curve)}};
}

Json modes_of(const report::ModalComparison& modes) {
  Json pairs = Json::array(), missing = Json::array(), extra = Json::array();
  for (const auto& pair : modes.pairs) {
    pairs.push_back({{"label", pair.label},
                     {"measured", finite(pair.measured)},
                     {"simulated", finite(pair.simulated)},
                     {"initial", finite(pair.initial)},
                     {"error", finite((pair.measured - pair.simulated) / pair.measured)},
                     {"likeness", finite(pair.likeness)}});
  }
  for (const auto& mode : modes.missing)
    missing.push_back({{"label", mode.label}, {"frequency", finite(mode.frequency)}});
  for (const auto& mode : modes.extra)
    extra.push_back({{"label", mode.label}, {"frequency", finite(mode.frequency)}});
  return {{"experiment", modes.experiment},
          {"conditions", modes.conditions},
          {"fitted", modes.fitted},
          {"pairs", pairs},
          {"missing", missing},
          {"extra", extra}};
}

Json value_of(const report::MeasuredValue& value) {
  return {{"name", value.name},
          {"compared", value.compared},
          {"unit", value.unit},
          {"fitted", value.fitted},
          {"weight", value.weight},
          {"measured", in_unit(value.measured, value.unit)},
          {"found", in_unit(value.found, value.unit)},
          {"initial", value.initial ? in_unit(*value.initial, value.unit) : Json(nullptr)},
          {"lower", value.lower ? in_unit(*value.lower, value.unit) : Json(nullptr)},
          {"upper", value.upper ? in_unit(*value.upper, value.unit) : Json(nullptr)},
          {"error",
           value.measured != 0.0 ? finite((value.found - value.measured) / std::abs(value.measured))
                                 : Json(nullptr)}};
}

}  // namespace

Json comparison_view(const ShelvedStudy& shelved, const std::string& trial) {
  const RecordedTrial recorded = recorded_trial(shelved, trial);
  const KeptIdentifiability kept = kept_identifiability(shelved);
  const Drawn drawn = draw(recorded, kept.what);
  Json view{{"trial", recorded.trial},
            {"initial", recorded.initial_trial ? Json(*recorded.initial_trial) : Json(nullptr)},
            {"curves", Json::array()},
            {"modes", Json::array()},
            {"values", Json::array()},
            {"absent", Json::array()},
            {"no_bands", kept.why_not_at(recorded.point)}};
  for (const auto& curve : drawn.page.forces) view["curves"].push_back(curve_of(curve));
  for (const auto& curve : drawn.page.curves) view["curves"].push_back(curve_of(curve));
  for (const auto& modes : drawn.page.modes) view["modes"].push_back(modes_of(modes));
  for (const auto& value : drawn.page.values) view["values"].push_back(value_of(value));
  for (const auto& [experiment, reason] : drawn.absent)
    view["absent"].push_back({{"experiment", experiment}, {"reason", reason}});
  return view;
}

Json limits_view(const ShelvedStudy& shelved, const std::string& trial) {
  const RecordedTrial recorded = recorded_trial(shelved, trial);
  return {{"trial", recorded.trial},
          {"limits", correlation::limits_met_at(*recorded.study, recorded.point)}};
}

}  // namespace latsch::studio
