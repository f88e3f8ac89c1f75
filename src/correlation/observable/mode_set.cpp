// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/mode_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/tables/measurement_file.h"
#include "report/report.h"

namespace latsch::correlation {

namespace {

ComparedValues compared_modes(const std::string& test, const std::vector<ModeRecord>& measured) {
  ComparedValues values{.kind = "modes",
                        .compared = "frequency",
                        .error_name = "df",
                        .asks = {test + "/frequency"},
                        .is_sweep = false,
                        .passes_slopes = true,
                        .unit = "Hz"};
  for (const ModeRecord& mode : measured) {
    values.rows.push_back(mode.label());
    values.measured.push_back(mode.frequency);
  }
  values.scales = values.measured;
  return values;
}

}  // namespace

ModeSet::ModeSet(std::string test,
                 std::vector<ModeRecord> measured,
                 std::size_t count,
                 Eigen::Matrix3Xd points)
    : Observable(compared_modes(test, measured)),
      test_(std::move(test)),
      measured_(std::move(measured)),
      count_(count),
      points_(std::move(points)) {}

std::vector<std::filesystem::path> ModeSet::write(const Channels& trial,
                                                  const MeasurementFiles& files) const {
  auto modes = simulated(trial);
  modes.resize(std::min(modes.size(), count_));
  const ModeTable table = experiment::mode_table(modes, points_);
  formats::write_modes(files.values, table, files.comment);
  if (files.shapes.empty()) return {files.values};
  formats::write_shapes(files.shapes, table, files.comment);
  return {files.values, files.shapes};
}

std::vector<ModeRecord> ModeSet::simulated(const Channels& trial) const {
  return experiment::mode_records(recording_of(test_, trial));
}

Result<Comparison> ModeSet::compare(const Channels& trial,
                                    const ObjectiveSettings& settings) const {
  const Channel* frequency = trial.find(test_ + "/frequency");
  return compare_modes(
      measured_, simulated(trial), settings, frequency ? frequency->slopes : std::vector<double>());
}

void ModeSet::draw(const ShownExperiment& shown, report::StudyReport& page) const {
  report::ModalComparison modal;
  modal.experiment = shown.name;
  modal.conditions = shown.conditions;
  modal.fitted = shown.fitted;
  if (shown.band) modal.band.inside = shown.band->inside;
  const auto found = simulated(shown.found);
  std::map<int, double> at_start;  // initial frequency of each measured mode
  if (shown.initial) {
    for (const ComparedFrequency& one : shown.initial_comparison->compared)
      at_start[one.measured] = one.frequency;
  }
  const ModePairing& pairing = shown.comparison.pairing;
  for (std::size_t k = 0; k < pairing.pairs.size(); ++k) {
    const ModePair& pair = pairing.pairs[k];
    const ModeRecord& measured = measured_[pair.measured];
    report::ComparedModes row;
    row.label = measured.label();
    row.measured = measured.frequency;
    row.simulated = shown.comparison.compared[k].frequency;
    if (const auto at = at_start.find(pair.measured); at != at_start.end())
      row.initial = at->second;
    if (pairing.is_by_shape) row.likeness = pair.likeness;
    if (shown.band) {
      modal.band.lower.push_back(shown.band->lower[static_cast<std::size_t>(pair.measured)]);
      modal.band.upper.push_back(shown.band->upper[static_cast<std::size_t>(pair.measured)]);
    }
    modal.pairs.push_back(std::move(row));
  }
  for (const int i : shown.comparison.pairing.missing)
    modal.missing.push_back({measured_[i].label(), measured_[i].frequency});
  for (const int j : shown.comparison.pairing.extra)
    modal.extra.push_back({found[j].label(), found[j].frequency});
  page.modes.push_back(std::move(modal));
}

std::string ModeSet::table(const Channels& trial, const Comparison& comparison) const {
  const auto found = simulated(trial);
  std::string text = fmt::format("  {:>12} {:>13} {:>9} {:>6}  {:<22} {}\n",
                                 "measured Hz",
                                 "simulated Hz",
                                 "error %",
                                 "MAC",
                                 "measured as",
                                 "simulated as");
  for (std::size_t k = 0; k < comparison.pairing.pairs.size(); ++k) {
    const ModePair& pair = comparison.pairing.pairs[k];
    text += fmt::format("  {:12.2f} {:13.2f} {:9.2f} {:>6}  {:<22} {}\n",
                        measured_[pair.measured].frequency,
                        comparison.compared[k].frequency,
                        comparison.errors[pair.measured] * 100.0,
                        comparison.pairing.is_by_shape ? fmt::format("{:.2f}", pair.likeness) : "-",
                        measured_[pair.measured].label(),
                        found[pair.simulated].label());
  }
  for (const int i : comparison.pairing.missing) {
    text += fmt::format("  {:12.2f} {:>13} {:9.2f} {:>6}  {:<22} no simulated mode is like it\n",
                        measured_[i].frequency,
                        "-",
                        comparison.errors[i] * 100.0,
                        "-",
                        measured_[i].label());
  }
  for (const int j : comparison.pairing.extra) {
    text += fmt::format("  {:>12} {:13.2f} {:>9} {:>6}  {:<22} {}\n",
                        "-",
                        found[j].frequency,
                        "-",
                        "-",
                        "not measured",
                        found[j].label());
  }
  for (const std::string& remark : remarks(comparison)) text += "  " + remark + "\n";
  return text;
}

std::vector<std::string> ModeSet::remarks(const Comparison& comparison) const {
  std::vector<std::string> all =
      remarks_on_close(measured_, comparison.pairing.close, comparison.compared);
  for (const ModePair& pair : comparison.pairing.pairs) {
    if (!comparison.pairing.is_by_shape && pair.likeness == 0.0)
      all.push_back(remark_on_mixed(measured_[static_cast<std::size_t>(pair.measured)]));
  }
  return all;
}

std::pair<std::string, nlohmann::ordered_json> ModeSet::answer(const Channels& trial,
                                                               const Comparison& comparison) const {
  const auto found = simulated(trial);
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < comparison.pairing.pairs.size(); ++k) {
    const ModePair& pair = comparison.pairing.pairs[k];
    rows.push_back({{"measured_Hz", json_of(measured_[pair.measured].frequency)},
                    {"simulated_Hz", json_of(comparison.compared[k].frequency)},
                    {"error", json_of(comparison.errors[pair.measured])},
                    {"likeness",
                     comparison.pairing.is_by_shape ? nlohmann::ordered_json(json_of(pair.likeness))
                                                    : nlohmann::ordered_json(nullptr)},
                    {"measured_as", measured_[pair.measured].label()},
                    {"simulated_as", found[pair.simulated].label()}});
  }
  for (const int i : comparison.pairing.missing) {
    rows.push_back({{"measured_Hz", json_of(measured_[i].frequency)},
                    {"simulated_Hz", nullptr},
                    {"error", json_of(comparison.errors[i])},
                    {"measured_as", measured_[i].label()}});
  }
  return {"modes", std::move(rows)};
}

}  // namespace latsch::correlation
