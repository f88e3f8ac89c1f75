// SPDX-License-Identifier: Apache-2.0
#include "cli/run/trials.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/progress.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/tables.h"
#include "cli/run/interrupt.h"
#include "cli/run/live_script.h"
#include "cli/verbs/verbs.h"
#include "correlation/analysis/refined_shift.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/search/study_change.h"
#include "correlation/study_report/study_report.h"
#include "correlation/target/failed_trials.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/journal/local_file_system.h"
#include "evaluation/journal/readable_journal.h"
#include "evaluation/schedule/retried_failures.h"
#include "evaluation/trial/encoding.h"
#include "report/live_page.h"
#include "studio/report_answers.h"

namespace latsch::cli {

std::string identity_key(const correlation::Study& study) {
  std::uint64_t state = kHashStart;
  for (const IdentityPart& part : correlation::identity(study))
    state = hash(part.text, hash(part.name, state));
  return fmt::format("{:016x}", state);
}

ProcessOptions worker_processes(const correlation::Study& study) {
  ProcessOptions options;
  options.arguments = {std::filesystem::read_symlink("/proc/self/exe").string(),
                       "worker",
                       std::filesystem::absolute(study.file).string()};
  if (!study.stage.empty()) {
    options.arguments.emplace_back("--stage");
    options.arguments.push_back(study.stage);
  }
  if (study.asks_slopes) options.arguments.emplace_back("--slopes");
  options.arguments.emplace_back("--identity");
  options.arguments.push_back(identity_key(study));
  options.workers = study.run.workers;
  options.timeout = study.run.timeout;
  options.memory_limit = study.run.memory;
  return options;
}

Journal open_for_trials(const correlation::Study& study, bool retries_failed) {
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  correlation::mark_target(study, journal);
  const TrialLimits limits{.timeout = study.run.timeout,
                           .program_timeout = study.specimens->own_timeout(),
                           .memory = study.run.memory};
  if (const long again = retry_what_limits_forbade(journal, limits)) {
    say("{} points that failed at a limit which is now higher are tried again\n", again);
  }
  if (retries_failed) say("{} failed points are tried again\n", retry_failures(journal));
  return journal;
}

void clear_scratch(const correlation::Study& study) {
  const std::filesystem::path folder = study.specimens->leftovers();
  std::error_code ignored;
  if (!folder.empty()) std::filesystem::remove_all(folder, ignored);
}

void say_kind_of_journal(const correlation::Study& study) {
  const auto shared = shared_file_system(study.run.journal);
  if (!shared) return;
  say("{} lies on {}: a rollback log, safe there and slower than the write-ahead log of a local "
      "disk\n",
      study.run.journal.string(),
      *shared);
}

namespace {

/// Returns the count of unexpected events as text: ", 2 failed, 1 repeated; 1 slow, the longest for
/// 12 s".
std::string troubles(const RunProgress& progress) {
  std::string text = fmt::format("{} failed", progress.failed);
  const auto add = [&](long number, const char* what) {
    if (number > 0) text += fmt::format(", {} {}", number, what);
  };
  add(progress.repeated, "repeated");
  add(progress.copied, "slow started twice");
  add(progress.stopped, "slow stopped");
  if (progress.straggling > 0) {
    text +=
        fmt::format(", {} slow now: {}", progress.straggling, format_duration(progress.slowest));
  }
  return text;
}

}  // namespace

RunOptions run_options(const correlation::Study& study, bool length_known) {
  RunOptions options;
  options.max_steps = study.max_steps;
  options.on_failure = study.run.on_failure;
  options.straggler_factor = study.run.straggler_factor;
  options.look_ahead = study.run.look_ahead;
  options.stop_requested = interrupted;
  auto bar = std::make_shared<RunningNote>();
  options.on_progress = [bar, length_known](const RunProgress& progress) {
    std::string note;
    if (progress.best) note = fmt::format("best target {:.3f} %, ", *progress.best * 100.0);
    note += troubles(progress);
    bar->update(progress.known, length_known ? progress.planned : 0, note);
  };
  return options;
}

void print_aborted(const correlation::Study& study,
                   const DesignPoint& point,
                   const Failure& failure) {
  say("Aborted, as {} requires if a trial fails: {}\nIt failed at\n",
      study.file.string(),
      failure.reason);
  print_point(study.space, point);
  say("The evaluated trials are in {}; with on_failure = \"proceed\", latsch resume continues "
      "the run.\n",
      study.run.journal.string());
}

void print_no_success(const correlation::Study& study,
                      const Journal& journal,
                      const std::string& reason) {
  const std::string how = study.specimens->how_to_see_more();
  complain(
      fmt::format("no trial succeeded, of {} in {}; the first failed because: {}\n"
                  "See how one fails: latsch simulate {}{}",
                  journal.size(),
                  study.run.journal.string(),
                  reason,
                  study.file.string(),
                  how.empty() ? "" : "; " + how));
}

RunOptions counting_options(const correlation::Study& study, const std::string& what) {
  RunOptions options = run_options(study, /*length_known=*/false);
  auto bar = std::make_shared<RunningNote>();
  options.on_progress = [bar, what](const RunProgress& progress) {
    bar->update(progress.known,
                progress.planned,
                (progress.work.empty() ? what : progress.work) + ", " + troubles(progress));
  };
  return options;
}

bool take_refined(const correlation::Study& study, correlation::Identifiability& result) {
  if (!study.refinement) return true;
  ProcessOptions options = worker_processes(study);
  options.arguments.emplace_back("--refined");
  options.workers = 1;
  // The study's limit of the time of a trial is meant for the coarse model, not for the refined
  // one.
  options.timeout = std::numeric_limits<double>::infinity();
  try {
    ProcessExecutor executor(options);
    if (!correlation::evaluate_refined(
            study, result.point, executor, counting_options(study, "the refined model")))
      return false;
  } catch (const InputError& error) {  // a file of the study has changed since it was read
    warn("the refined model is not evaluated: " + std::string(error.what()));
    return true;
  }
  result.refined_shift = correlation::refined_shift(study, result.identification);
  return true;
}

namespace {

/// Prints the error of the mesh, because a fit shifts the values of the variables to compensate for
/// it.
void print_mesh_error(const report::StudyReport& page) {
  const report::DiscretizationError* worst = nullptr;
  double sum = 0.0;
  for (const auto& row : page.discretization) {
    if (!worst || std::abs(row.error) > std::abs(worst->error)) worst = &row;
    sum += std::abs(row.error);
  }
  if (!worst) return;
  say("\nMesh against the converged tire: {:.1f} % on average, worst {:+.1f} % ({})\n",
      100.0 * sum / static_cast<double>(page.discretization.size()),
      100.0 * worst->error,
      worst->quantity);
}

/// Prints every experiment's error in its own measure, and beside it the least error of an earlier
/// stage.
void print_errors(const report::StudyReport& page) {
  if (page.experiments.empty()) return;
  say("\nErrors by experiment\n");
  for (const report::ExperimentRow& row : page.experiments) {
    const bool counts = row.fitted && row.weight > 0.0;
    const std::string use = !row.fitted         ? "predicted"
                            : page.is_of_design ? "compared"
                            : row.weight > 0.0  ? "fitted"
                                                : "weight 0";
    say("  {:<{}} {:<9} {} {:.3g} %, largest {:.3g} %{}{}\n",
        row.name,
        name_width(page.experiments),
        use,
        row.measure,
        100.0 * row.error,
        100.0 * row.largest_error,
        row.whole.empty() ? "" : " of " + row.whole,
        row.own_stage.empty()
            ? ""
            : fmt::format(
                  "; {:.3g} % at the end of stage {}", 100.0 * row.own_stage_error, row.own_stage));
    Json one{{"name", row.name},
             {"fitted", row.fitted},
             {"counts", counts},
             {"measure", row.measure},
             {"error", row.error},
             {"mean_error", row.mean_error},
             {"largest_error", row.largest_error},
             {"of", row.whole}};
    if (!row.own_stage.empty()) {
      one["own_stage"] = {{"name", row.own_stage}, {"error", row.own_stage_error}};
      one["worse_than_own_stage"] = row.is_spoiled;
    }
    answer()["experiments"].push_back(std::move(one));
  }
  for (const report::ExperimentRow& row : page.experiments)
    if (row.is_spoiled)
      warn(
          fmt::format("{} is worse than after an earlier stage: {} {:.3g} %, but {:.3g} % at the "
                      "end of stage {}. noise = \"own_stage\" in every experiment preserves "
                      "the errors of the earlier stages",
                      row.name,
                      row.measure,
                      100.0 * row.error,
                      100.0 * row.own_stage_error,
                      row.own_stage));
}

}  // namespace

namespace {

/// Returns the page of the report. It includes the views of the studio if the program contains the
/// studio's page.
std::string report_page(const correlation::Study& study,
                        const report::StudyReport& page,
                        const experiment::Language& language) {
  const LiveScript live = live_script();
  if (live.script.empty()) return report::html(page);
  const report::LivePage views{
      studio::report_answers(study.file, language, page), live.script, live.style};
  return report::html(page, &views);
}

}  // namespace

namespace {

/// Prints why trials failed; as a warning if the failures decide the result.
void print_failures(const correlation::FailedTrials& failures) {
  for (const auto& [reason, trials] : failures.reasons)
    answer()["failures"].push_back({{"reason", reason}, {"trials", trials}});
  const std::string words = correlation::in_words(failures);
  if (failures.is_doubtful())
    warn(words);
  else if (!words.empty())
    say("{}\n", words);
}

/// Writes the report. `change` says how the study's files have changed since they were read; empty:
/// not at all.
int write_page(const correlation::Study& study,
               const correlation::Study& as_read,
               const Journal& journal,
               const experiment::Language& language,
               experiment::Thoroughness thoroughness,
               const std::filesystem::path& file,
               const std::string& change) {
  const correlation::Study weighted = correlation::with_estimated_noise(study, journal);
  auto page = correlation::study_report(weighted, journal, thoroughness, &as_read);
  if (!page) {
    complain(page.failure().reason);
    return kFailed;
  }
  if (!change.empty()) page->remarks.insert(page->remarks.begin(), change);
  print_errors(*page);
  print_mesh_error(*page);
  write_text_file(file, change.empty() ? report_page(study, *page, language) : report::html(*page));
  answer()["target"] = page->target;
  answer()["report"] = file.string();
  const correlation::TrialCounts counts = correlation::count_trials(weighted, journal);
  answer_counts(counts);
  say("\nReport: {}\nJournal: {}, {}\n",
      file.string(),
      journal.file().string(),
      correlation::in_words_below_result(counts));
  print_failures(correlation::failed_trials(weighted, journal));
  return kDone;
}

std::filesystem::path report_file(const correlation::Study& study) {
  return std::filesystem::path(study.run.journal).replace_extension(".html");
}

/// Returns the file of the report. Throws InputError if the study's folder may not be written.
std::filesystem::path writable_report(const correlation::Study& study,
                                      const std::filesystem::path& output) {
  const auto file = output.empty() ? report_file(study) : output;
  if (output.empty() && !may_be_written(file))
    throw InputError({file.string(), 0},
                     "may not be written here: latsch report " + study.file.string() +
                         " -o FILE writes the report elsewhere");
  return file;
}

}  // namespace

int write_report(const correlation::Study& study,
                 const Journal& journal,
                 const experiment::Language& language,
                 experiment::Thoroughness thoroughness,
                 const std::filesystem::path& output) {
  const auto file = writable_report(study, output);
  return write_page(study, study, journal, language, thoroughness, file, "");
}

int write_report_of_run(const correlation::Study& study,
                        const correlation::Study& as_read,
                        const Journal& journal,
                        const experiment::Language& language,
                        const std::filesystem::path& output) {
  using experiment::Thoroughness;
  const auto change = correlation::change_since_read(as_read, language);
  if (!change) {
    const auto file = writable_report(study, output);
    return write_page(study, as_read, journal, language, Thoroughness::seconds, file, "");
  }
  const std::string sentence = fmt::format(
      "The files of the study have changed while this run went on: {}. The result and "
      "the report are of the study as it was read at the beginning",
      *change);
  const auto file = output.empty() ? report_file(study) : output;
  const int exit_code =
      write_page(study, as_read, journal, language, Thoroughness::seconds, file, sentence + ".");
  complain(sentence + ". Next: restore the files, or latsch run " + study.file.string() +
               " for the changed ones",
           {study.file.string(), 0});
  return exit_code == kDone ? kFailed : exit_code;
}

}  // namespace latsch::cli
