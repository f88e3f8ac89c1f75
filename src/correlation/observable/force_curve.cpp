// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/force_curve.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/units.h"
#include "correlation/laboratory/measurement_twin.h"
#include "formats/tables/measurement_file.h"
#include "report/report.h"

namespace latsch::correlation {

namespace {

ComparedValues compared_forces(const std::string& test, const LoadDeflectionCurve& measured) {
  std::vector<std::string> rows;
  for (const double x : measured.position) rows.push_back(format_quantity(x, "mm", 4));
  return {.kind = "load_deflection",
          .compared = "force",
          .error_name = "dF",
          .asks = {test + "/force"},
          .rows = std::move(rows),
          .passes_slopes = true,
          .unit = "N",
          .measured = measured.force,
          .scales = measured.force};
}

}  // namespace

ForceCurve::ForceCurve(std::string test, LoadDeflectionCurve measured)
    : Observable(compared_forces(test, measured)),
      test_(std::move(test)),
      measured_(std::move(measured)) {}

const std::vector<double>& ForceCurve::channel(const Channels& trial, const char* name) const {
  return trial[test_ + "/" + name];
}

std::string ForceCurve::compared(const ObjectiveSettings& settings) const {
  return (settings.compared == Compared::force ? "" : "root of ") + Observable::compared(settings);
}

std::vector<double> ForceCurve::deviations(const MeasurementNoise& noise,
                                           const ObjectiveSettings& settings) const {
  // The relative deviation of a root is half that of the value.
  const double part = settings.compared == Compared::root_force ? 0.5 : 1.0;
  auto deviations = Observable::deviations(noise, settings);
  for (double& one : deviations) one *= part;
  return deviations;
}

Result<Comparison> ForceCurve::compare(const Channels& trial,
                                       const ObjectiveSettings& settings) const {
  const Channel* force = trial.find(test_ + "/force");
  const SimulatedValues simulated{channel(trial, "force"), force->slopes};
  if (simulated.values.size() != measured_.force.size()) {
    return Failure{fmt::format("channel \"{}/force\" has {} values, expected {} as measured",
                               test_,
                               simulated.values.size(),
                               measured_.force.size()),
                   Cause::bad_output};
  }
  return compare_forces(measured_.force, simulated, settings);
}

std::vector<std::filesystem::path> ForceCurve::write(const Channels& trial,
                                                     const MeasurementFiles& files) const {
  LoadDeflectionCurve curve = measured_;
  const bool radii = curve.abscissa == Abscissa::loaded_radius;
  if (files.measurement) {
    const std::string column = files.measurement->has("force") ? "force" : "Fz";
    return {write_twin(*files.measurement, {{column, channel(trial, "force")}}, files.comment)};
  }
  curve.position = channel(trial, radii ? "loaded_radius" : "deflection");
  curve.force = channel(trial, "force");
  curve.spread.clear();
  formats::write_load_deflection(files.values, curve, files.comment);
  return {files.values};
}

void ForceCurve::draw(const ShownExperiment& shown, report::StudyReport& page) const {
  report::ComparedForces curve;
  curve.experiment = shown.name;
  curve.conditions = shown.conditions;
  curve.fitted = shown.fitted;
  curve.of_design = shown.of_design;
  curve.over_loaded_radius = measured_.abscissa == Abscissa::loaded_radius;
  curve.abscissa = measured_.position;
  curve.measured = measured_.force;
  curve.simulated = channel(shown.found, "force");
  if (shown.initial) curve.initial = channel(*shown.initial, "force");
  if (shown.band) curve.band = *shown.band;
  page.forces.push_back(std::move(curve));
}

std::string ForceCurve::table(const Channels& trial, const Comparison& comparison) const {
  std::string text = fmt::format("  {:>13} {:>16} {:>13} {:>13} {:>9} {:>10} {:>9} {:>10}\n",
                                 "deflection mm",
                                 "loaded radius mm",
                                 "measured N",
                                 "simulated N",
                                 "error %",
                                 "length mm",
                                 "width mm",
                                 "area cm^2");
  // Not every model computes its contact patch, and not every test its loaded radius; a missing
  // value becomes a dash.
  const auto cell = [&](const char* name, std::size_t j, double factor, int digits) {
    const Channel* found = trial.find(test_ + "/" + name);
    if (!found || j >= found->values.size()) return std::string("-");
    return fmt::format("{:.{}f}", found->values[j] * factor, digits);
  };
  for (std::size_t j = 0; j < measured_.force.size(); ++j) {
    text += fmt::format("  {:>13} {:>16} {:13.1f} {:13.1f} {:9.2f} {:>10} {:>9} {:>10}\n",
                        cell("deflection", j, 1e3, 3),
                        cell("loaded_radius", j, 1e3, 3),
                        measured_.force[j],
                        channel(trial, "force")[j],
                        comparison.errors[j] * 100.0,
                        cell("patch_length", j, 1e3, 1),
                        cell("patch_width", j, 1e3, 1),
                        cell("patch_area", j, 1e4, 1));
  }
  return text;
}

std::pair<std::string, nlohmann::ordered_json> ForceCurve::answer(
    const Channels& trial, const Comparison& comparison) const {
  return {"forces",
          {{"deflection_m", json_of(channel(trial, "deflection"))},
           {"measured_N", json_of(measured_.force)},
           {"simulated_N", json_of(channel(trial, "force"))},
           {"error", json_of(comparison.errors)}}};
}

LoadDeflectionCurve force_curve_of(const Measurement& measurement) {
  LoadDeflectionCurve curve;
  const bool radii = measurement.has("loaded_radius") && !measurement.has("deflection");
  curve.abscissa = radii ? Abscissa::loaded_radius : Abscissa::deflection;
  curve.position = measurement.values(radii ? "loaded_radius" : "deflection", "m");
  curve.force = measurement.values(measurement.has("force") ? "force" : "Fz", "N");
  if (!measurement.has("force") && measurement.frame("Fz") == "C")
    throw InputError(measurement.place(),
                     "measurement." + measurement.name() +
                         ": Fz is in axes C, where a tire is pressed along the normal of the road; "
                         "put in_frame = \"W\" into it");
  if (measurement.has("spread")) curve.spread = measurement.values("spread", "N");
  const auto fault = find_fault(curve);
  if (!fault) return curve;
  throw InputError(
      fault->point < 0 ? measurement.place() : measurement.place(static_cast<size_t>(fault->point)),
      (measurement.is_stated() ? "measurement." + measurement.name() + ": " : "") + fault->message +
          way_out_of(curve, *fault));
}

}  // namespace latsch::correlation
