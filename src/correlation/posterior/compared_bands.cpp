// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/compared_bands.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "base/file.h"
#include "base/units.h"
#include "correlation/observable/curve.h"
#include "correlation/posterior/posterior_file.h"

namespace latsch::correlation {
namespace {

/// Returns SI values in a unit; values of a level in dB, which no unit converts, stay as they are.
std::vector<double> read_in(const std::string& unit, std::vector<double> values) {
  const auto known = Unit::find(unit);
  for (double& value : values)
    if (known) value = known->from_si(value);
  return values;
}

/// Returns the text of a cell, which is quoted if it contains a comma or a quotation mark.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::optional<std::size_t> ComparedBands::most_different() const {
  std::optional<std::size_t> found;
  double most = -1.0;
  for (std::size_t k = 0; k < lower.size(); ++k) {
    const double ratio = (upper[k] - lower[k]) / (linear_upper[k] - linear_lower[k]);
    const double factor = std::abs(std::log(ratio));
    if (!std::isfinite(factor) || factor <= most) continue;
    most = factor;
    found = k;
  }
  return found;
}

std::vector<ComparedBands> compared_bands(const Study& study,
                                          const Posterior& posterior,
                                          const std::vector<ExperimentBand>& linear) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<ComparedBands> all;
  for (const SampledBand& band : posterior.bands) {
    const auto e = static_cast<std::size_t>(band.experiment);
    const StudyExperiment& experiment = study.experiments[e];
    const Observable& observable = *experiment.observable;
    const std::string unit = observable.shown_unit();
    const std::vector<double> unknown(observable.values(), kUnknown);
    const bool is_known = e < linear.size() && linear[e].is_known();
    ComparedBands one{band.experiment, unit, observable.rows()};
    one.measured = read_in(unit, observable.measured_values());
    one.computed = is_known ? read_in(unit, linear[e].computed) : unknown;
    one.linear_lower = is_known ? read_in(unit, linear[e].lower) : unknown;
    one.linear_upper = is_known ? read_in(unit, linear[e].upper) : unknown;
    one.lower = read_in(unit, band.lower);
    one.median = read_in(unit, band.median);
    one.upper = read_in(unit, band.upper);
    const auto* curve = dynamic_cast<const Curve*>(&observable);
    if (curve && curve->measured().x_measured.size() == observable.values()) {
      one.x_name = curve->measured().x;
      one.x_unit = curve->measured().x_shown;
      one.x = read_in(one.x_unit, curve->measured().x_measured);
    } else {
      one.x_name = "value";
      for (std::size_t k = 1; k <= observable.values(); ++k)
        one.x.push_back(static_cast<double>(k));
    }
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<ExperimentBand> recorded_bands(const Study& study, const Journal& journal) {
  const auto what = recorded_identifiability(study, journal);
  return what ? prediction_bands(study, *what, journal) : std::vector<ExperimentBand>{};
}

std::filesystem::path bands_file(const Study& study) {
  return std::filesystem::path(study.file).replace_extension(".bands.csv");
}

void write_bands(const Study& study,
                 const Posterior& posterior,
                 const std::vector<ComparedBands>& bands,
                 const std::filesystem::path& file) {
  write_file(file, [&](std::ostream& out) {
    out << "experiment,value,unit,measured,computed,linear lower,linear upper,lower,median,upper,"
           "density\n";
    for (const ComparedBands& band : bands) {
      const std::string& name = study.experiments[static_cast<std::size_t>(band.experiment)].name;
      for (std::size_t k = 0; k < band.names.size(); ++k)
        out << fmt::format("{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{}\n",
                           cell(name),
                           cell(band.names[k]),
                           band.unit,
                           band.measured[k],
                           band.computed[k],
                           band.linear_lower[k],
                           band.linear_upper[k],
                           band.lower[k],
                           band.median[k],
                           band.upper[k],
                           density_word(posterior));
    }
  });
}

}  // namespace latsch::correlation
