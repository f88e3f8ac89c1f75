// SPDX-License-Identifier: Apache-2.0
// Implements `latsch simulate`: runs one trial and prints the results of every experiment beside
// its measurement.

#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/console/ledgers.h"
#include "cli/console/parsed.h"
#include "cli/console/tables.h"
#include "cli/verbs/verbs.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/test_limits.h"

namespace latsch::cli {
namespace {

using correlation::Study;

/// Limits the address space of this process and of the programs that it starts, as that of a
/// worker is limited.
void limit_memory(double bytes) {
  if (!(bytes > 0.0)) return;
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min(static_cast<rlim_t>(bytes), limit.rlim_max);
  ::setrlimit(RLIMIT_AS, &limit);
}

int simulate(const std::string& file,
             const experiment::Language& language,
             const std::vector<std::string>& assignments) {
  const Study study = correlation::read_study(file, language);
  DesignPoint point = study.space.initial();
  std::set<std::string> set;
  for (const std::string& assignment : assignments) {
    const std::string name(trimmed(std::string_view(assignment).substr(0, assignment.find('='))));
    if (!set.insert(name).second)
      throw InputError("--set: " + name + " is set twice, expected each variable once");
    set_variable(study.space, assignment, point);
  }
  say("{}\n\n", study.title);
  print_point(study.space, point);
  say_ledgers(study, false);
  answer()["variables"] = answer_of(study.space, point);

  warn_of_implausible(study);
  for (const std::string& limit : correlation::limits_of_tests(study)) warn(limit);
  limit_memory(study.run.memory);
  const auto channels = correlation::simulate_all(study, point);
  if (!channels) {
    complain(channels.failure().reason);
    return kFailed;
  }
  for (const auto& experiment : study.experiments) {
    const auto comparison = correlation::comparison_of(experiment, study.experiments, *channels);
    if (!comparison) {
      complain("experiment " + experiment.name + ": " + comparison.failure().reason);
      return kFailed;
    }
    print_comparison(study, experiment, *channels);
    answer()["experiments"].push_back(answer_of(study, experiment, *channels));
  }
  const double target = correlation::objective(study)(point, *channels)->value;
  answer()["target"] = target;
  say("\ntarget {:.4f} %, {}\n",
      target * 100.0,
      correlation::target_in_words(correlation::fitted_exponents(study.experiments), target));
  const auto limits = correlation::limits_met_at(study, point);
  warn_of_limits_met(study, limits);
  answer()["limits"] = limits;
  return kDone;
}

}  // namespace

void add_simulate(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("simulate",
                                 "Runs one trial: every experiment beside its "
                                 "measurement");
  verb.footer(
      "Examples:\n  latsch simulate studies/tire_b_twin/study.toml\n"
      "  latsch simulate studies/tire_b_twin/study.toml --set \"matrix=12 N/mm^2\" --set \"belt=5 "
      "GPa\"");
  auto file = std::make_shared<std::string>();
  auto assignments = std::make_shared<std::vector<std::string>>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.add_option(
      "--set", *assignments, "NAME=VALUE of a variable, others at their initial values");
  verb.callback(
      [=, &program] { program.exit_code = simulate(*file, program.language, *assignments); });
}

}  // namespace latsch::cli
