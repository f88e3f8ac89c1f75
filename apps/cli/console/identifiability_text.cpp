// SPDX-License-Identifier: Apache-2.0
#include "cli/console/identifiability_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/console/certainty_answers.h"
#include "cli/console/console.h"
#include "cli/console/tables.h"
#include "correlation/study_report/report_identifiability.h"

namespace latsch::cli {
namespace {

using correlation::Identifiability;
using correlation::Study;

constexpr double kStrongCorrelation = 0.9;
constexpr size_t kShownGains = 6;

/// True if the last stage holds the variable constant, so that it has no interval.
bool is_kept(const Study& study, int i) {
  return !study.free.empty() && !std::binary_search(study.free.begin(), study.free.end(), i);
}

void print_spectrum(const Study& study, const Confidence& c) {
  say("\nDirections of the variables, from the best determined to the least\n");
  say("  {:>15} {:>22}  {}\n", "singular value", "deviation, % of range", "direction");
  for (Eigen::Index k = 0; k < c.singular_values.size(); ++k) {
    const double deviation = c.deviation(static_cast<int>(k));
    say("  {:15.4g} {:>22}  {}\n",
        c.singular_values[k],
        deviation < 1.0 ? fmt::format("{:.2f}", 100.0 * deviation) : "more than 100: flat",
        correlation::direction_text(study.space, c.directions.col(k)));
  }
}

void print_correlations(const Study& study, const Confidence& c) {
  bool any = false;
  for (int i = 0; i < study.space.size(); ++i) {
    for (int j = i + 1; j < study.space.size(); ++j) {
      if (std::abs(c.correlation(i, j)) < kStrongCorrelation) continue;
      say("{}  {} and {}: {:+.3f}\n",
          any ? "" : "\nVariables that the data hardly distinguish, by their correlation\n",
          study.space[i].name,
          study.space[j].name,
          c.correlation(i, j));
      any = true;
    }
  }
}

void print_verdicts(const Study& study, const Identifiability& result) {
  say("\nProfiles: each variable held at other values, all others fitted anew\n");
  for (const TargetProfile& profile : result.identification.profiles()) {
    const DesignVariable& v = study.space[profile.variable];
    say("  {:<16} {}\n", v.name, in_words(profile));
    say("  {:<16} 95 %: {}\n", "", correlation::profile_text(study.space, profile));
    for (int place : profile.other_minima) {
      const ProfilePoint& at = profile.points[place];
      std::vector<double> u(at.u.begin(), at.u.end());
      say("  {:<16} another minimum near {}, {}\n",
          "",
          correlation::value_text(study.space,
                                  profile.variable,
                                  study.space.from_unit(u).values[profile.variable],
                                  correlation::reported_interval(study, result, profile.variable)),
          at.S - profile.least <= profile.threshold ? "as good" : "not as good");
    }
  }
}

void print_cross_validation(const Study& study, const CrossValidation& validation) {
  say("\nCross-validation: each experiment predicted from the fit of the others\n");
  say("  {:<16} {:>14} {:>16}\n", "left out", "rms fitted", "rms predicted");
  for (const LeftOut& fold : validation.left_out()) {
    say("  {:<16} {:14.4g} {:>16}\n",
        study.experiments[fold.group].name,
        fold.fitted,
        std::isnan(fold.predicted) ? "refit did not converge"
                                   : fmt::format("{:.4g}", fold.predicted));
  }
}

}  // namespace

void print_gains(const Study& study,
                 const std::string& title,
                 const std::vector<correlation::MeasurementGain>& gains) {
  if (gains.empty()) return;
  say("\n{}\n  {:<42} {:>18}  helps most, deviation in % of range\n",
      title,
      "measurement",
      "confidence region");
  for (size_t k = 0; k < std::min(kShownGains, gains.size()); ++k) {
    say("  {:<42} {:>18}  {}: {:.3g} -> {:.3g}\n",
        gains[k].measurement,
        fmt::format("1 / {:.3g}", gains[k].shrinkage),
        study.space[gains[k].helps].name,
        100.0 * gains[k].before,
        100.0 * gains[k].after);
  }
}

void print_bands(const Study& study, const std::vector<correlation::ExperimentBand>& bands) {
  say("\nComputed values: the widest 95 % band of each experiment, as uncertain as the variables "
      "are\n");
  for (size_t e = 0; e < bands.size(); ++e) {
    const correlation::StudyExperiment& experiment = study.experiments[e];
    const std::string inside = inside_text(bands[e]);
    say("  {:<16} {:<10} {}{}\n",
        experiment.name,
        experiment.fitted ? "fitted" : "predicted",
        bands[e].is_known() ? widest_text(experiment, bands[e]) : "",
        inside.empty() ? "" : "; " + inside + " inside band and noise");
    if (bands[e].delay) say("  {:<16} delay {}\n", "", bands[e].delay->in_words());
    for (const std::string& remark : bands[e].remarks) say("  {:<16} {}\n", "", remark);
  }
}

void print_delays(const Study& study, const std::vector<correlation::ExperimentBand>& bands) {
  for (size_t e = 0; e < bands.size(); ++e)
    if (bands[e].delay)
      say("  Delay of {}: {}\n", study.experiments[e].name, bands[e].delay->in_words());
}

void print_nuisance(const Study& study, const std::vector<correlation::ExperimentBand>& bands) {
  bool is_first = true;
  for (size_t e = 0; e < bands.size(); ++e) {
    for (const correlation::NuisanceRow& row : bands[e].nuisance) {
      if (is_first)
        say("\nNumbers of the recordings, solved at every trial, +- one standard deviation\n");
      is_first = false;
      say("  {:<16} {}\n", study.experiments[e].name, row.in_words());
    }
  }
  for (const correlation::ExperimentBand& band : bands) {
    if (!band.nuisance_costs.empty()) say("  Their cost\n");
    for (const correlation::NuisanceCost& cost : band.nuisance_costs)
      say("    {}\n", correlation::cost_text(study, cost));
    for (const std::string& remark : band.nuisance_remarks) say("  {}\n", remark);
  }
}

void print_missed(const Study& study, const std::vector<correlation::MissedValue>& missed) {
  if (missed.empty()) return;
  say("\nMissed by more than three times their noise, 1 % if none is stated; to first order\n");
  for (const correlation::MissedValue& one : missed) say("  {}\n", one.in_words(study.space));
}

void print_intervals(const Study& study, const Identifiability& result) {
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    if (is_kept(study, i)) {
      say("  {:<{}} {:<16} kept: the last stage does not free it\n",
          v.name,
          name_width(study.space.variables()),
          shown(v, result.best.values[i]));
      continue;
    }
    const Interval interval = correlation::reported_interval(study, result, i);
    const std::string shift = correlation::shift_text(study, result, i);
    say("  {:<{}} {:<16} 95 %: {}{}\n",
        v.name,
        name_width(study.space.variables()),
        correlation::value_text(study.space, i, result.best.values[i], interval),
        correlation::interval_text(study, result, i),
        shift.empty() ? "" : ", mesh and step: " + shift);
  }
  const std::vector<std::string> remarks = correlation::remarks(study, result);
  for (const std::string& remark : remarks) say("  {}\n", remark);
  answer()["remarks"] = remarks;
}

void print_identifiability(const Study& study, const Identifiability& result) {
  const Confidence& c = result.identification.confidence();
  print_spectrum(study, c);
  print_correlations(study, c);
  if (!result.identification.profiles().empty()) print_verdicts(study, result);
  if (result.cross_validation) print_cross_validation(study, *result.cross_validation);
  answer_certainty(study, result);
  const auto gains = correlation::repetition_gains(study, result);
  answer()["repetitions"] = gains_of(study, gains);
  print_gains(
      study, "What would add information: repeated measurements, the most useful first", gains);
}

}  // namespace latsch::cli
