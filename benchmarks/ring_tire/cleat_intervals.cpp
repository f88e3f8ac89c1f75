// SPDX-License-Identifier: Apache-2.0
#include "cleat_intervals.h"

#include <fmt/format.h>

#include "base/scratch_folder_testing.h"
#include "cleat_cases.h"
#include "command.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/target/best_trial.h"
#include "fit_study.h"

namespace latsch::benchmarks::cleat {
namespace {

namespace fs = std::filesystem;
using correlation::Study;

// Least number of the twelve intervals that must contain the true value. Even if the intervals are
// right, one of nine fits has fewer.
constexpr int kFewest = 11;

/// Returns the specimen's true parameters in the order of the study's variables.
DesignPoint truth_of(const Study& study) {
  DesignPoint truth = study.space.initial();
  for (int i = 0; i < study.space.size(); ++i)
    for (const Number& number : kNumbers)
      if (study.space[i].paths.front() == number.path)
        truth.values[static_cast<std::size_t>(i)] = study.model.get(number.path) * number.truth;
  return truth;
}

struct Count {
  int hold = 0, hold_without_refined = 0;
  long trials = 0;
};

Count count(const Study& study) {
  const Journal journal = Journal::read(study.run.journal);
  const auto what = correlation::recorded_identifiability(study, journal);
  if (!what || !what->refined_shift) throw InputError("the study ended without intervals");
  auto without = *what;
  without.refined_shift.reset();
  const DesignPoint truth = truth_of(study);
  const std::vector<double> u = study.space.to_unit(truth);
  Count count{0, 0, journal.size()};
  for (int i = 0; i < study.space.size(); ++i) {
    const double at = u[static_cast<std::size_t>(i)];
    const auto holds = [&](const correlation::Identifiability& by) {
      const Interval interval = correlation::reported_interval(study, by, i);
      return interval.lower <= at && at <= interval.upper;
    };
    const Interval shown = correlation::reported_interval(study, *what, i);
    const double half = 0.5 * (shown.upper - shown.lower);
    fmt::print("  {:20} {:6.2f} of a half width off, mesh and step {:+.2f}{}\n",
               study.space[i].name,
               (at - 0.5 * (shown.lower + shown.upper)) / half,
               (*what->refined_shift)[i] / half,
               holds(*what) ? "" : "  does not hold");
    count.hold += holds(*what);
    count.hold_without_refined += holds(without);
  }
  return count;
}

}  // namespace

void count_intervals(int draws, Table& table) {
  std::vector<Case> fitted = cases();
  std::erase_if(fitted, [](const Case& one) { return !one.fitted; });
  int hold = 0, without = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const ScratchFolder folder;
    fs::copy(study_folder(), folder / "study", fs::copy_options::recursive);
    const fs::path file = folder / "study" / "study.toml";
    const auto language = experiment::language();
    if (draw > 0) {
      const Study study = correlation::read_study(file, language);
      measure(fitted, tire_at(study.model, truth_of(study)), draw);
      write(fitted, folder / "study");
    }
    (void)run_command(fmt::format("{} run {} --quiet", program().string(), file.string()));
    const Count found = count(correlation::read_study(file, language));
    hold += found.hold;
    without += found.hold_without_refined;
    const std::string what = "intervals that hold the specimen's number";
    const std::string value = fmt::format("{} of 12 ({} trials)", found.hold, found.trials);
    if (draw == 0)
      table.row(what, value, fmt::format(">= {}", kFewest), found.hold >= kFewest);
    else
      table.note(fmt::format("draw {} of the noise", draw), value);
    table.note("of the model's mesh and step alone",
               fmt::format("{} of 12", found.hold_without_refined));
  }
  if (draws == 1) return;
  const double all = 12.0 * draws;
  table.row("share of intervals that hold, all draws",
            fmt::format("{:.3f}", hold / all),
            ">= 0.95",
            hold >= 0.95 * all);
  table.note("of the model's mesh and step alone", fmt::format("{:.3f}", without / all));
}

}  // namespace latsch::benchmarks::cleat
