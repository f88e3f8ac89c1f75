// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/complex_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/measurement_twin.h"
#include "correlation/laboratory/stated_difference.h"
#include "correlation/observable/compared_kinds.h"
#include "formats/tables/csv_table.h"
#include "report/report.h"

namespace latsch::correlation {
namespace {

constexpr double kMostAverages = 1e6;
/// Coherence below which a response carries no information; its error is that of this coherence.
constexpr double kLeastCoherence = 1e-6;

std::vector<double> parts_of(const std::vector<std::complex<double>>& response) {
  std::vector<double> parts;
  for (const auto& value : response) parts.push_back(value.real());
  for (const auto& value : response) parts.push_back(value.imag());
  return parts;
}

ComparedValues compared_response(const ComplexResponse::Measured& m) {
  const std::string name = m.test + "/" + m.output;
  ComparedValues values{
      .kind = "frequency_response",
      .compared = name,
      .over = "over " + m.test + "/frequency",
      .whole = m.scale > 0.0 ? fmt::format("{:g} {}", m.scale, m.unit) : "",
      .asks = {m.test + "/frequency", m.test + "/re_" + m.output, m.test + "/im_" + m.output},
      .unit = m.unit,
      .measured = parts_of(m.response)};
  for (const char* part : {"real", "imaginary"}) {
    for (std::size_t i = 0; i < m.frequencies.size(); ++i) {
      values.rows.push_back(fmt::format("{} part of {} at {:g} Hz", part, name, m.frequencies[i]));
      values.scales.push_back(m.scale > 0.0 ? m.scale : std::abs(m.response[i]));
    }
  }
  return values;
}

}  // namespace

ComplexResponse::ComplexResponse(Measured measured)
    : Observable(compared_response(measured)), m_(std::move(measured)) {}

Result<SimulatedValues> ComplexResponse::simulated(const Channels& trial) const {
  const Channel* at = trial.find(m_.test + "/frequency");
  if (!at || at->values.empty())
    return Failure{"channel " + in_quotes(m_.test + "/frequency") + " is missing",
                   Cause::bad_output};
  const std::vector<double>& x = at->values;
  constexpr double kRounding = 1e-9;
  const double least = x.front() * (1.0 - kRounding), most = x.back() * (1.0 + kRounding);
  SimulatedValues found;
  for (const char* part : {"re_", "im_"}) {
    const Channel* y = trial.find(channel(part));
    if (!y || y->values.size() != x.size())
      return Failure{"channel " + in_quotes(channel(part)) +
                         " is missing or has another number of "
                         "values than its frequencies",
                     Cause::bad_output};
    for (const double frequency : m_.frequencies) {
      if (frequency < least || frequency > most)
        return Failure{fmt::format("channel {} reaches from {:g} to {:g} Hz, but was measured at "
                                   "{:g} Hz",
                                   in_quotes(m_.test + "/frequency"),
                                   x.front(),
                                   x.back(),
                                   frequency),
                       Cause::bad_output};
      const auto right = std::ranges::upper_bound(x, frequency);
      if (right == x.end() || right == x.begin()) {
        found.values.push_back(right == x.end() ? y->values.back() : y->values.front());
        continue;
      }
      const auto i = right - x.begin();
      const double share = (frequency - x[i - 1]) / (x[i] - x[i - 1]);
      found.values.push_back(y->values[i - 1] + share * (y->values[i] - y->values[i - 1]));
    }
  }
  return found;
}

std::vector<double> ComplexResponse::deviations(const MeasurementNoise& noise,
                                                const ObjectiveSettings& settings) const {
  std::vector<double> deviations = Observable::deviations(noise, settings);
  if (m_.random.empty()) return deviations;
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    const std::size_t i = k % m_.frequencies.size();
    deviations[k] =
        std::hypot(deviations[k], m_.random[i] * std::abs(m_.response[i]) / scales()[k]);
  }
  return deviations;
}

Result<Comparison> ComplexResponse::compare(const Channels& trial,
                                            const ObjectiveSettings& settings) const {
  const auto found = simulated(trial);
  if (!found) return found.failure();
  return compare_values(measured_values(), *found, scales(), settings);
}

std::vector<std::filesystem::path> ComplexResponse::write(const Channels& trial,
                                                          const MeasurementFiles& files) const {
  const auto found = simulated(trial);
  if (files.measurement) {
    if (!found) throw InputError(files.measurement->place(), found.failure().reason);
    const auto middle = found->values.begin() + std::ssize(m_.frequencies);
    return {write_twin(*files.measurement,
                       {{"re_" + m_.output, {found->values.begin(), middle}},
                        {"im_" + m_.output, {middle, found->values.end()}}},
                       files.comment)};
  }
  Channels columns;
  if (files.is_shared) columns = formats::CsvTable::read(files.values).channels();
  for (const std::string& name : {std::string("frequency"), "re_" + m_.output, "im_" + m_.output}) {
    const std::string unit = name == "frequency" ? "Hz" : m_.unit;
    if (!columns.find(name)) columns.add({name, unit, trial[m_.test + "/" + name]});
  }
  write_text_file(files.values, "# " + files.comment + "\n" + formats::csv_text(columns));
  return {files.values};
}

void ComplexResponse::draw(const ShownExperiment& shown, report::StudyReport& page) const {
  const std::size_t count = m_.frequencies.size();
  for (const auto& [part, prefix, first] : {std::tuple{"real part", "re_", std::size_t{0}},
                                            std::tuple{"imaginary part", "im_", count}}) {
    const auto begin = static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    const auto half = [&](const std::vector<double>& all) {
      return std::vector<double>(all.begin() + begin, all.begin() + end);
    };
    report::MeasuredCurve picture;
    picture.experiment = shown.name + ", " + part;
    picture.conditions = shown.conditions;
    picture.fitted = shown.fitted;
    picture.of_design = shown.of_design;
    picture.x_name = m_.test + "/frequency";
    picture.y_name = channel(prefix);
    picture.x_unit = "Hz";
    picture.y_unit = m_.unit;
    picture.x_measured = m_.frequencies;
    picture.y_measured = half(measured_values());
    if (shown.comparison.errors.size() == 2 * count) picture.errors = half(shown.comparison.errors);
    const auto of = [&](const Channels& trial, const std::string& name) {
      const Channel* channel = trial.find(name);
      return channel ? channel->values : std::vector<double>{};
    };
    picture.x_simulated = of(shown.found, picture.x_name);
    picture.y_simulated = of(shown.found, picture.y_name);
    if (shown.initial) {
      picture.x_initial = of(*shown.initial, picture.x_name);
      picture.y_initial = of(*shown.initial, picture.y_name);
    }
    if (shown.band && shown.band->lower.size() == 2 * count) {
      picture.x_band = m_.frequencies;
      picture.band.inside = shown.band->inside;
      picture.band.lower = half(shown.band->lower);
      picture.band.upper = half(shown.band->upper);
    }
    page.curves.push_back(std::move(picture));
  }
}

std::string ComplexResponse::table(const Channels& trial, const Comparison& comparison) const {
  const auto found = simulated(trial);
  std::string text = fmt::format("  {:>10} {:>26} {:>26} {:>9}\n",
                                 "at Hz",
                                 "measured " + m_.unit,
                                 "simulated " + m_.unit,
                                 "error %");
  const std::size_t count = m_.frequencies.size();
  for (std::size_t i = 0; found && i < count; ++i) {
    text +=
        fmt::format("  {:10.5g} {:>26} {:>26} {:9.2f}\n",
                    m_.frequencies[i],
                    fmt::format("{:.5g} {:+.5g} i", m_.response[i].real(), m_.response[i].imag()),
                    fmt::format("{:.5g} {:+.5g} i", found->values[i], found->values[count + i]),
                    100.0 * std::hypot(comparison.errors[i], comparison.errors[count + i]));
  }
  return text;
}

std::pair<std::string, nlohmann::ordered_json> ComplexResponse::answer(
    const Channels& trial, const Comparison& comparison) const {
  const auto found = simulated(trial);
  const std::size_t count = m_.frequencies.size();
  const auto half = [&](const std::vector<double>& all, std::size_t first) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return json_of(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count)));
  };
  const auto parts = [&](const std::vector<double>& all) {
    return nlohmann::ordered_json{{"real", half(all, 0)}, {"imaginary", half(all, count)}};
  };
  return {"frequency_response",
          {{"at", json_of(m_.frequencies)},
           {"at_unit", "Hz"},
           {"unit", m_.unit},
           {"measured", parts(measured_values())},
           {"simulated", found ? parts(found->values) : nlohmann::ordered_json(nullptr)},
           {"error", parts(comparison.errors)}}};
}

namespace {

/// Returns the random errors of each part relative to |H| from the column of coherences.
std::vector<double> read_random_errors(const Node& table,
                                       const Measurement& measurement,
                                       std::size_t count) {
  if (!table.has("averages")) {
    if (table.has("coherence"))
      table.reject("coherence",
                   "is given without averages, expected the number of averages of the measured "
                   "response, without which a coherence says no error");
    return {};
  }
  const double averages = table.quantity("averages", "1", Range::between(1.0, kMostAverages));
  if (!table.has("noise"))
    table.reject("averages",
                 "is given without noise, expected the noise that the response has where the "
                 "coherence is 1, such as noise = \"2 %\"");
  const std::string column = table.text("coherence", "coherence");
  const std::vector<double>& coherence = measurement.values(column, "1");
  std::vector<double> random;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(coherence[i] >= 0.0 && coherence[i] <= 1.0))
      table.reject("coherence",
                   fmt::format("names the column {} of the measurement, whose value {} is {:g}, "
                               "expected 0 to 1",
                               in_quotes(column),
                               i + 1,
                               coherence[i]));
    const double share = std::max(coherence[i], kLeastCoherence);
    random.push_back(std::sqrt((1.0 - share) / (2.0 * averages * share)));
  }
  measurement.note_use(column, "experiment " + table.name());
  return random;
}

}  // namespace

std::shared_ptr<const ComplexResponse> read_complex_response(
    const Node& table, const std::vector<KnownChannel>& channels, const Measurement& measurement) {
  const std::string y = table.text("y");
  const std::size_t slash = y.find('/');
  ComplexResponse::Measured m;
  if (slash != y.npos) {
    m.test = y.substr(0, slash);
    m.output = y.substr(slash + 1);
  }
  std::vector<std::string> outputs;
  for (const KnownChannel& one : channels)
    if (const std::size_t re = one.name.find("/re_"); re != one.name.npos)
      outputs.push_back(one.name.substr(0, re + 1) + one.name.substr(re + 4));
  if (slash == y.npos || !find(channels, m.test + "/re_" + m.output) ||
      !find(channels, m.test + "/im_" + m.output) || !find(channels, m.test + "/frequency"))
    table.reject("y",
                 fmt::format("is {}, expected TEST/OUTPUT of a test that records re_OUTPUT and "
                             "im_OUTPUT over frequency{}",
                             in_quotes(y),
                             outputs.empty() ? "" : ": " + list_of(outputs)));
  m.unit = si_unit(Unit::of(find(channels, m.test + "/re_" + m.output)->unit).dimension());
  m.frequencies = measurement.values("frequency", "Hz");
  const std::vector<double>& real = measurement.values("re_" + m.output, m.unit);
  const std::vector<double>& imaginary = measurement.values("im_" + m.output, m.unit);
  if (real.empty()) table.reject("measurement", "has no row of numbers");
  for (std::size_t i = 0; i < real.size(); ++i) m.response.emplace_back(real[i], imaginary[i]);
  if (table.has("scale")) m.scale = read_difference(table, "scale", m.unit);
  for (std::size_t i = 0; i < real.size(); ++i)
    if (m.scale == 0.0 && m.response[i] == 0.0)
      table.reject("scale",
                   fmt::format("is missing: the measured response at {:g} Hz is 0, which gives no "
                               "scale",
                               m.frequencies[i]));
  m.random = read_random_errors(table, measurement, real.size());
  return std::make_shared<ComplexResponse>(std::move(m));
}

extern const ComparedKind kFrequencyResponseKind;
const experiment::KeySection& complex_response_keys();

const ComparedKind kFrequencyResponseKind = {
    "frequency_response",
    true,
    [](const Node& table,
       const std::vector<KnownChannel>& channels,
       const Measurement* measurement) -> std::shared_ptr<const Observable> {
      return read_complex_response(table, channels, *measurement);
    },
    complex_response_keys};

}  // namespace latsch::correlation
