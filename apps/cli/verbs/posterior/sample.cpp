// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/posterior/sample.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/text.h"
#include "base/units.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/tables.h"
#include "cli/run/interrupt.h"
#include "cli/run/trials.h"
#include "cli/run/workers.h"
#include "correlation/doe/doe_conflict.h"
#include "correlation/posterior/compared_bands.h"
#include "correlation/posterior/posterior.h"
#include "correlation/posterior/posterior_file.h"
#include "correlation/posterior/posterior_price.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/trial_ownership.h"

namespace latsch::cli {
namespace {

using correlation::Posterior;
using correlation::PosteriorMethod;
using correlation::Study;

/// Says in words whose samples they are, since not all are those of the model.
const char* whose(const Posterior& posterior) {
  if (posterior.stands_for_model()) return "samples of the variables";
  return posterior.is_mixed() ? "samples of a surrogate that does not stand for the model"
                              : "samples of chains that do not mix";
}

void print_samples(const Study& study, const Posterior& posterior) {
  const std::vector<std::string> names = correlation::axis_names(study, posterior);
  const int width = name_width(study.space.variables());
  say("\n{} {}, with 95 % intervals\n  {:<{}} {:<16} {:<28} {:<28} {:>6} {:>6}  {}\n",
      posterior.samples.size(),
      whose(posterior),
      "",
      width,
      "median",
      "samples",
      "linear",
      "R-hat",
      "draws",
      "shape");
  for (std::size_t a = 0; a < names.size(); ++a) {
    const PosteriorShape& shape = posterior.shapes[a];
    const ChainDiagnostics& d = posterior.samples.diagnostics[a];
    const Interval own{shape.lower, shape.upper};
    say("  {:<{}} {:<16} {:<28} {:<28} {:>6.3f} {:>6.0f}  {}\n",
        names[a],
        width,
        correlation::value_text(
            study.space, posterior.axes[a], posterior.value_at(study.space, a, shape.median), own),
        correlation::interval_text(study.space, posterior.axes[a], own),
        correlation::interval_text(study.space, posterior.axes[a], posterior.linear[a]),
        d.rhat,
        std::min(d.bulk, d.tail),
        posterior.stands_for_model() ? in_words(shape, names)
        : posterior.is_mixed()       ? "not the model's"
                                     : "not mixed");
  }
}

/// Warns of variables whose fitted value lies outside of the interval of the samples.
void warn_of_fits_outside(const Study& study, const Posterior& posterior) {
  const std::vector<std::string> names = correlation::axis_names(study, posterior);
  const std::vector<double> fit = study.space.to_unit(posterior.center);
  std::vector<std::string> outside;
  for (std::size_t a = 0; a < names.size(); ++a) {
    const double u = fit[static_cast<std::size_t>(posterior.axes[a])];
    const PosteriorShape& shape = posterior.shapes[a];
    if (u < shape.lower || u > shape.upper) outside.push_back(names[a]);
  }
  answer()["fit_outside"] = outside;
  if (outside.empty()) return;
  warn(
      fmt::format("the fitted value of {} of {} variables lies outside of the interval of the "
                  "samples: {}. Fit and samples weigh the values differently, for example because "
                  "neighbors share noise or weights are stated, or the fit is no minimum; do not "
                  "report the fit with the intervals of the samples",
                  outside.size(),
                  names.size(),
                  fmt::join(outside, ", ")));
}

void print_standing(const Study& study, const Posterior& posterior) {
  const std::string chains =
      posterior.method == PosteriorMethod::surrogate
          ? ""
          : fmt::format(", {} of them for the chains", posterior.chain_trials);
  say("\n{} trial{} beyond the fit{}{}; the surrogate learned from {}{}.\n",
      posterior.trials,
      posterior.trials == 1 ? "" : "s",
      chains,
      posterior.failed > 0 ? fmt::format(", of which {} failed", posterior.failed) : "",
      posterior.learned_from,
      posterior.trials > posterior.chain_trials && !posterior.settled
          ? "; the limit of runs ended the learning, not two good batches in a row"
          : "");
  const std::string verdict = correlation::verdict_text(posterior);
  const std::string without_period = verdict.substr(0, verdict.size() - 1);
  if (!posterior.is_mixed())
    complain(without_period);
  else if (posterior.check.verdict == SurrogateVerdict::stands ||
           posterior.method != PosteriorMethod::surrogate)
    say("{}\n", verdict);
  else
    warn(without_period);
  for (const std::string& remark : posterior.remarks) say("{}\n", remark);
  for (const int axis : posterior.samples.unmixed) {
    const ChainDiagnostics& d = posterior.samples.diagnostics[static_cast<std::size_t>(axis)];
    warn(
        fmt::format("the chains do not mix in {} after {} steps: R-hat {:.3f}, {:.0f} effective "
                    "draws of the bulk and {:.0f} of the tails, expected at most 1.01 and at least "
                    "400",
                    study.space[posterior.axes[static_cast<std::size_t>(axis)]].name,
                    posterior.samples.steps,
                    d.rhat,
                    d.bulk,
                    d.tail));
  }
}

void answer_samples(const Study& study, const Posterior& posterior) {
  const std::vector<std::string> names = correlation::axis_names(study, posterior);
  for (std::size_t a = 0; a < names.size(); ++a) {
    const PosteriorShape& shape = posterior.shapes[a];
    const DesignVariable& variable = study.space[posterior.axes[a]];
    const Unit unit = Unit::of(variable.unit);
    const auto shown_at = [&](double u) -> Json {
      if (!std::isfinite(u) || u < 0.0 || u > 1.0) return nullptr;
      return unit.from_si(posterior.value_at(study.space, a, u));
    };
    const ChainDiagnostics& d = posterior.samples.diagnostics[a];
    answer()["variables"].push_back(
        {{"name", names[a]},
         {"unit", variable.unit},
         {"median", shown_at(shape.median)},
         {"interval", {shown_at(shape.lower), shown_at(shape.upper)}},
         {"linear", {shown_at(posterior.linear[a].lower), shown_at(posterior.linear[a].upper)}},
         {"shape", posterior.stands_for_model() ? Json(in_words(shape, names)) : Json()},
         {"rhat", d.rhat},
         {"bulk", d.bulk},
         {"tail", d.tail}});
  }
  answer()["method"] = correlation::name(posterior.method);
  answer()["accepted"] = posterior.samples.accepted;
  answer()["chain_trials"] = posterior.chain_trials;
  answer()["mixed"] = posterior.is_mixed();
  answer()["stands_for_model"] = posterior.stands_for_model();
  answer()["samples"] = posterior.samples.size();
  answer()["trials"] = posterior.trials;
  answer()["failed"] = posterior.failed;
  answer()["check"] = {{"verdict", name(posterior.check.verdict)},
                       {"draws", posterior.check.draws},
                       {"failed", posterior.check.failed},
                       {"deviation", posterior.check.deviation},
                       {"largest", posterior.check.largest}};
}

/// Returns "19.2 .. 21 N" with the digits that the width supports.
std::string band_text(double lower, double upper, const std::string& unit) {
  if (!std::isfinite(upper - lower)) return "not known";
  const double half = 0.5 * (upper - lower);
  return fmt::format("{} .. {}{}",
                     format_known(lower, half),
                     format_known(upper, half),
                     unit == "1" ? "" : " " + unit);
}

/// Prints, for each experiment, the value whose two bands differ most.
void print_bands(const Study& study, const std::vector<correlation::ComparedBands>& bands) {
  say("\n95 % bands of computed values, where the two differ most\n  {:<{}} {:<16} {:<28} {}\n",
      "",
      name_width(study.experiments),
      "value",
      "samples",
      "linear");
  for (const correlation::ComparedBands& band : bands) {
    const auto most = band.most_different();
    const std::string& name = study.experiments[static_cast<std::size_t>(band.experiment)].name;
    if (!most) {
      say("  {:<{}} the linear bands are not known: latsch identify {} computes them\n",
          name,
          name_width(study.experiments),
          study.file.string());
      continue;
    }
    const std::size_t k = *most;
    say("  {:<{}} {:<16} {:<28} {}\n",
        name,
        name_width(study.experiments),
        band.names[k],
        band_text(band.lower[k], band.upper[k], band.unit),
        band_text(band.linear_lower[k], band.linear_upper[k], band.unit));
    answer()["bands"].push_back({{"experiment", name},
                                 {"value", band.names[k]},
                                 {"unit", band.unit},
                                 {"interval", {band.lower[k], band.upper[k]}},
                                 {"linear", {band.linear_lower[k], band.linear_upper[k]}}});
  }
  const auto is_predicted = [](const auto& one) { return !one.fitted; };
  if (std::any_of(study.experiments.begin(), study.experiments.end(), is_predicted))
    say("  Experiments that are only predicted have only linear bands.\n");
}

void print_checks(const Study& study, const Posterior& posterior) {
  say("\nPredictive check: rank of each experiment's chi^2 among those of data that the model "
      "makes; {:g} to {:g} is expected\n",
      correlation::kLeastRank,
      correlation::kLargestRank);
  for (const correlation::PredictiveCheck& check : posterior.checks) {
    const std::string& name = study.experiments[static_cast<std::size_t>(check.experiment)].name;
    say("  {:<{}} chi^2 {:.3g} a value; {}\n",
        name,
        name_width(study.experiments),
        check.chi_square,
        check.in_words());
    answer()["predictive_checks"].push_back({{"experiment", name},
                                             {"rank", check.rank ? Json(*check.rank) : Json()},
                                             {"chi_square", check.chi_square},
                                             {"refused", check.is_refused()}});
  }
}

/// Prints the measured values that no point of the study's design of experiments reaches, or what
/// is missing to tell them.
void print_conflict_before_fit(const Study& study, const Journal& journal) {
  const auto found =
      study.doe ? correlation::doe_conflict(
                      study, correlation::plan(*study.doe, study.space).points, journal)
                : correlation::DoeConflict{
                      .refusal =
                          "the study has no [doe]; latsch doe with a scattered one of at least ten "
                          "points for each variable tells it"};
  say("\nMeasured values that no point of the design before the fit comes near, by three "
      "deviations\n");
  if (!found.refusal.empty()) {
    answer()["conflict_refused"] = found.refusal;
    say("  not told: {}\n", found.refusal);
    return;
  }
  for (const correlation::UnreachedValues& row : found.rows) {
    answer()["conflict"].push_back(answer_of(study, row));
    say("  {:<{}} {}\n",
        study.experiments[static_cast<std::size_t>(row.experiment)].name,
        name_width(study.experiments),
        correlation::in_words(study, row));
  }
}

/// Prints and writes what the samples say about computed values, unless they are not those of the
/// model.
void tell_bands(const Study& study, const Posterior& posterior, const Journal& journal) {
  if (!posterior.stands_for_model()) {
    say("\nBands from the samples and the predictive check are not shown: the samples are not "
        "those "
        "of the model.\n");
    return;
  }
  const auto bands =
      correlation::compared_bands(study, posterior, correlation::recorded_bands(study, journal));
  print_bands(study, bands);
  print_checks(study, posterior);
  const std::filesystem::path file = correlation::bands_file(study);
  correlation::write_bands(study, posterior, bands, file);
  say_written(file.string());
}

}  // namespace

int sample(const std::string& file, const experiment::Language& language, const Sampling& asked) {
  const auto& [workers, output, writes_report] = asked;
  const Study as_read = correlation::read_study(file, language);
  Study study = as_read;
  if (workers > 0) study.run.workers = workers;
  if (!std::filesystem::exists(study.run.journal))
    throw InputError(study.run.journal.string() +
                     " does not exist: there is no fit whose posterior could be sampled; start "
                     "with latsch run");
  if (const std::string reason = correlation::why_no_posterior(study); !reason.empty())
    throw InputError({study.file.string(), 0}, reason);
  Workers workers_of_study(study);
  if (workers_of_study.served(study)) return kDone;
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  const correlation::StagesRun searched = correlation::recorded_stages(study, journal);
  study = searched.study;
  if (workers > 0) study.run.workers = workers;
  correlation::require_best(study, journal);
  correlation::mark_target(study, journal);
  if (!searched.has_ended)
    warn(
        "no search of this study has ended, so the samples are drawn around the best trial so far, "
        "which need not be at a minimum; run latsch run " +
        study.file.string() + " first");
  const auto best = correlation::best_trial(study, journal);
  if (!best) {
    complain("no trial in " + study.run.journal.string() + " succeeded");
    return kFailed;
  }
  const double seconds = correlation::median_trial_time(journal);
  if (const std::string price = correlation::price_text(study, seconds); !price.empty())
    say("{}\n", price);
  answer()["price"] = {{"chain_runs", study.posterior.chain_runs},
                       {"trial_s", std::isfinite(seconds) ? Json(seconds) : Json()}};
  catch_interrupts();
  const TrialsRun trials(workers_of_study, study);
  Executor& executor = workers_of_study.start(study);
  const auto found = correlation::sample_posterior(
      study, best->point, executor, journal, counting_options(study, "trials of the posterior"));
  if (!found) {
    say("Interrupted; {} trials are safe. The same command continues.\n", journal.size());
    return kStopped;
  }
  if (!*found) {
    complain(found->failure().reason);
    return kFailed;
  }
  const Posterior& posterior = **found;
  print_samples(study, posterior);
  print_standing(study, posterior);
  if (!posterior.stands_for_model() && posterior.method == PosteriorMethod::surrogate) {
    Study delayed = study;
    delayed.posterior.method = PosteriorMethod::delayed;
    delayed.posterior.chain_runs = correlation::kDelayedRuns;
    say("{}\n", correlation::price_text(delayed, seconds));
  }
  if (posterior.stands_for_model()) warn_of_fits_outside(study, posterior);
  answer_samples(study, posterior);
  tell_bands(study, posterior, journal);
  print_conflict_before_fit(study, journal);
  const std::filesystem::path to =
      output.empty() ? correlation::samples_file(study) : std::filesystem::path(output);
  correlation::write_samples(study, posterior, to);
  say_written(to.string());
  if (writes_report) {
    workers_of_study.end();
    if (const int code = write_report_of_run(study, as_read, journal, language); code != kDone)
      return code;
  } else {
    say("latsch report {} draws the samples beside the linear intervals.\n", study.file.string());
  }
  return posterior.is_mixed() ? kDone : kFailed;
}

void add_sample(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand(
      "sample", "Draws samples of the variables' posterior density around the fit");
  verb.footer(
      "Example:\n  latsch sample studies/race_tire_mf/study.toml --workers 2\n\n"
      "Needs a finished latsch run. A surrogate of all residuals learns from the journal and from "
      "up to 50\n"
      "further trials, and ten of them check it. The samples, and bands of "
      "computed\nvalues from them, are written beside the study. "
      "[posterior] in the\n"
      "study sets their number. The trials stay in the journal; interrupted, even killed, the same "
      "command\n"
      "goes on.");
  auto file = std::make_shared<std::string>();
  auto workers = std::make_shared<int>(0);
  auto output = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.add_option("--workers", *workers, "Worker processes, instead of the study's")
      .between(1, 1024);
  verb.add_option("-o,--output", *output, "CSV file of the samples; beside the study unless given")
      .written_as("CSV", {".csv"});
  verb.callback([=, &program] {
    program.exit_code = sample(*file, program.language, {*workers, *output});
  });
}

}  // namespace latsch::cli
