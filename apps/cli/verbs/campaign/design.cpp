// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/campaign/design.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/console/console.h"
#include "cli/run/interrupt.h"
#include "cli/run/trials.h"
#include "cli/run/workers.h"
#include "cli/verbs/campaign/design_text.h"
#include "correlation/campaign/campaign.h"
#include "correlation/campaign/campaign_files.h"
#include "correlation/posterior/posterior.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/trial_ownership.h"
#include "experiment/language/known_limits.h"

namespace latsch::cli {
namespace {

using correlation::Campaign;
using correlation::CampaignPlan;
using correlation::CampaignStart;
using correlation::Study;

/// Returns points of the posterior density, evenly spread over its samples.
std::vector<DesignPoint> draws_of(const Study& study, const correlation::Posterior& posterior) {
  std::vector<DesignPoint> draws;
  const Eigen::Index count = posterior.samples.size();
  for (int k = 0; k < correlation::kCampaignDraws && count > 0; ++k)
    draws.push_back(posterior.point(study.space, k * count / correlation::kCampaignDraws));
  return draws;
}

/// A study at its fit, or before it, and what is known of its variables.
struct DesignBegin {
  Study study;
  CampaignStart start;
};

/// Begins at the best trial of the journal. Returns nullopt if a signal interrupted the trials
/// around it, a Failure if the fit is no start.
std::optional<Result<DesignBegin>> begin_after_fit(const Study& as_read,
                                                   int workers,
                                                   Workers& workers_of_study) {
  Journal journal = Journal::open(as_read.run.journal, correlation::identity(as_read));
  const correlation::StagesRun searched = correlation::recorded_stages(as_read, journal);
  Study study = searched.study;
  if (workers > 0) study.run.workers = workers;
  correlation::require_best(study, journal);
  if (!searched.has_ended)
    warn(
        "no search of this study has ended, so the design begins at the best trial so far, which "
        "need not be at a minimum; run latsch run " +
        study.file.string() + " first");
  std::optional<Result<DesignBegin>> answer;
  const auto best = correlation::best_trial(study, journal);
  if (!best) {
    answer.emplace(Failure{"no trial in " + study.run.journal.string() + " succeeded"});
    return answer;
  }
  const TrialsRun trials(workers_of_study, study);
  Executor& executor = workers_of_study.start(study);
  const auto found = correlation::identify(study,
                                           best->point,
                                           correlation::Depth::at_the_point,
                                           executor,
                                           journal,
                                           counting_options(study, "trials around the fit"));
  if (!found) return std::nullopt;
  workers_of_study.end();
  if (!*found) {
    answer.emplace(found->failure());
    return answer;
  }
  auto start = correlation::start_after_fit(study, **found);
  if (!start) {
    answer.emplace(start.failure());
    return answer;
  }
  if (correlation::why_no_posterior(study).empty())
    if (const auto posterior = correlation::recorded_posterior(study, journal);
        posterior && posterior->is_mixed())
      start->draws = draws_of(study, *posterior);
  answer.emplace(DesignBegin{study, *std::move(start)});  // the run of the trials still uses it
  return answer;
}

std::optional<Result<DesignBegin>> begin_design(const Study& study,
                                                int workers,
                                                Workers& workers_of_study) {
  if (std::filesystem::exists(study.run.journal))
    return begin_after_fit(study, workers, workers_of_study);
  std::optional<Result<DesignBegin>> answer;
  auto start = correlation::start_before_fit(study);
  if (start)
    answer.emplace(DesignBegin{study, *std::move(start)});
  else
    answer.emplace(start.failure());
  return answer;
}

/// Reads the study of the rival, and the values that its journal gives for its variables.
DesignBegin begin_rival(const Study& study, const experiment::Language& language) {
  const std::filesystem::path& file = study.campaign->against;
  const Study rival = correlation::read_study(file, language);
  if (const std::string why = correlation::why_no_rival(study, rival, language); !why.empty())
    throw InputError({study.file.string(), 0},
                     "design.against is " + file.string() + ", which " + why);
  if (std::filesystem::exists(rival.run.journal)) {
    const Journal journal = Journal::read(rival.run.journal, correlation::identity(rival));
    const Study fitted = correlation::recorded_stages(rival, journal).study;
    if (const auto found = correlation::recorded_identifiability(fitted, journal)) {
      auto known = correlation::start_of_rival(fitted, &*found);
      if (!known) throw InputError({file.string(), 0}, known.failure().reason);
      return {fitted, *std::move(known)};
    }
  }
  warn(file.string() +
       " has not been fitted, so the variables of the rival count as anywhere in their ranges");
  return {rival, *correlation::start_of_rival(rival, nullptr)};
}

/// Says how well kriged slopes are known.
void say_kriging(const Study& study, const correlation::KrigedSlopes& kriged) {
  constexpr double kTrusted = 0.8;
  std::vector<std::string> all, poor;
  for (int i = 0; i < study.space.size(); ++i) {
    const double Q2 = kriged.least_slopes[static_cast<std::size_t>(i)];
    all.push_back(fmt::format("{} {:.2f}", study.space[i].name, Q2));
    if (Q2 < kTrusted) poor.push_back(study.space[i].name);
  }
  say("Slopes are interpolated between {} settings, from {} trial{}; Q^2 of samples left out: "
      "{}.\n",
      kriged.runs,
      kriged.trials,
      kriged.trials == 1 ? "" : "s",
      fmt::join(all, ", "));
  if (!poor.empty())
    warn(
        fmt::format("the interpolation of the slopes by {} is poor (Q^2 below {}), so where the "
                    "tests stand for {} is not to be trusted; more runs in [design] improve it",
                    fmt::join(poor, ", "),
                    kTrusted,
                    poor.size() == 1 ? "it" : "them"));
}

/// Sets the slopes of a plan. Returns false if a signal interrupted the trials; throws InputError
/// or sets `fault` if there are none.
bool set_slopes(CampaignPlan& plan, std::string& fault) {
  const Study& study = plan.study;
  const std::string why = correlation::why_no_test_slopes(study);
  const bool takes_long = correlation::takes_long(study);
  plan.computes_slopes = why.empty() && study.campaign->runs == 0 && !takes_long;
  if (plan.computes_slopes) {
    std::vector<DesignPoint> points{plan.start.point};
    points.insert(points.end(), plan.start.draws.begin(), plan.start.draws.end());
    plan.slopes = correlation::computed_slopes(study, points);
    return true;
  }
  if (!why.empty())
    say("The model computes no slopes for the test: {}.\n", why);
  else if (study.campaign->runs == 0)
    say("The model takes long, so it does not run at every setting that is asked for.\n");
  if (!plan.start.draws.empty()) {
    say("Slopes are interpolated at the fit alone, so the samples of the posterior density are not "
        "used.\n");
    plan.start.draws.clear();
  }
  auto kriged = correlation::kriged_slopes(
      study, plan.start.point, plan.start.lengths, counting_options(study, "trials of the design"));
  if (!kriged) return false;
  if (!*kriged) {
    fault = kriged->failure().reason;
    return true;
  }
  say_kriging(study, **kriged);
  plan.slopes = std::move((*kriged)->slopes);
  return true;
}

/// Warns of limits of the model that matter in the tests, such as ranges of a tire's file.
void warn_of_limits_in_tests(const Study& study,
                             const CampaignStart& start,
                             const Campaign& campaign) {
  constexpr std::size_t kMostLimits = 5;
  const auto specimen = study.specimens->at(study, start.point);
  std::vector<std::string> limits;
  for (const auto& chosen : campaign.tests) {
    experiment::MovableTest moved = *study.campaign->movable;
    for (std::size_t i = 0; i < chosen.values.size(); ++i)
      moved.set(study.campaign->settings[i].path, chosen.values[i]);
    const auto test = moved.test();
    const auto* tells = dynamic_cast<const experiment::TellsLimits*>(test.get());
    if (!tells) return;
    for (const std::string& limit : tells->limits(*specimen))
      if (std::find(limits.begin(), limits.end(), limit) == limits.end()) limits.push_back(limit);
  }
  for (std::size_t k = 0; k < std::min(limits.size(), kMostLimits); ++k) warn(limits[k]);
  if (limits.size() > kMostLimits)
    warn(
        fmt::format("{} further limits of the model matter in the tests; latsch test names those "
                    "of each",
                    limits.size() - kMostLimits));
}

struct DesignOptions {
  std::string study, output;
  int count = 0, workers = 0;
};

int design(const DesignOptions& options, const experiment::Language& language) {
  Study as_read = correlation::read_study(options.study, language);
  if (!as_read.campaign)
    throw InputError({as_read.file.string(), 0},
                     "has no [design], which names the test whose settings may move: test = "
                     "\"NAME\", settings = {load = [\"1 kN\", \"8 kN\"]}; see latsch help study");
  const int count = options.count > 0 ? options.count : as_read.campaign->count;
  if (options.workers > 0) as_read.run.workers = options.workers;
  Workers workers_of_study(as_read);
  if (workers_of_study.served(as_read)) return kDone;
  catch_interrupts();
  auto begin = begin_design(as_read, options.workers, workers_of_study);
  if (!begin) {
    say("Interrupted; the same command continues.\n");
    return kStopped;
  }
  if (!*begin) throw InputError({as_read.file.string(), 0}, begin->failure().reason);
  CampaignPlan plan{(*begin)->study, std::move((*begin)->start), nullptr};
  std::optional<DesignBegin> rival;
  if (!as_read.campaign->against.empty()) {
    rival.emplace(begin_rival(as_read, language));
    plan.rival = &rival->study;
    plan.rival_start = rival->start;
  }
  std::string fault;
  if (!set_slopes(plan, fault)) {
    say("Interrupted; the same command continues.\n");
    return kStopped;
  }
  if (!fault.empty()) {
    complain(fault);
    return kFailed;
  }
  const auto campaign = correlation::plan_campaign(plan, count);
  if (!campaign) throw InputError({as_read.file.string(), 0}, campaign.failure().reason);
  print_design_ground(plan.study, plan.start, *campaign);
  print_campaign_tests(plan.study, *campaign);
  print_standings(plan.study, plan.start, *campaign);
  print_worth(plan.study, *campaign);
  warn_of_limits_in_tests(plan.study, plan.start, *campaign);
  answer_design(plan.study, plan.start, *campaign);
  const auto folder = options.output.empty() ? correlation::campaign_folder(as_read)
                                             : std::filesystem::path(options.output);
  correlation::write_campaign_tests(plan.study, *campaign, folder);
  const auto table = correlation::campaign_table_file(as_read);
  correlation::write_campaign_table(plan.study, *campaign, table);
  say_written(table.string());
  say_written(folder.string());
  say("latsch test {} {} runs the first one.\n",
      as_read.file.string(),
      (folder / correlation::campaign_test_file(*campaign, 0)).string());
  return kDone;
}

}  // namespace

void add_design(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("design", "Chooses the settings of the next tests");
  verb.footer(
      "Example:\n  latsch design studies/race_tire_design/study.toml --count 12\n\n"
      "Moves the settings of a test inside the limits of the rig, as [design] of the study states, "
      "until the\n"
      "variables would be known best. Begins at the best trial of latsch run and at the samples of "
      "latsch\n"
      "sample, or at the priors of a study that has not been fitted. Writes a table "
      "STUDY.design.csv and one file\n"
      "for each test, which latsch test runs.");
  auto options = std::make_shared<DesignOptions>();
  verb.add_option("study", options->study, "Study file (TOML)").required();
  verb.add_option("--count", options->count, "Number of tests, instead of the study's")
      .between(1, correlation::kMostCampaignTests);
  verb.add_option("--workers", options->workers, "Workers, instead of the study's")
      .between(1, 1024);
  verb.add_option("-o,--output", options->output, "Folder of the tests; STUDY.design unless given");
  verb.callback([=, &program] { program.exit_code = design(*options, program.language); });
}

}  // namespace latsch::cli
