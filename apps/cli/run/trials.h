// SPDX-License-Identifier: Apache-2.0
// What run, resume and doe share: the worker processes of a study, its progress on the terminal,
// its report.
#pragma once

#include <string>

#include "correlation/analysis/identifiability.h"
#include "correlation/study/study.h"
#include "evaluation/executors/process_executor.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"
#include "experiment/language.h"
#include "experiment/language/specimen.h"

namespace latsch::cli {

/// This program as `latsch worker STUDY`.
ProcessOptions worker_processes(const correlation::Study& study);

/// The journal of the study. What failed for a limit that is raised now is tried again, with
/// `retries_failed` all that failed.
Journal open_for_trials(const correlation::Study& study, bool retries_failed);

/// Removes what killed workers of an outside program left behind. The journal is held meanwhile.
void clear_scratch(const correlation::Study& study);

/// Why the journal keeps a slower log than on a local disk, where it does.
void say_kind_of_journal(const correlation::Study& study);

/// On standard error: nothing succeeded, why the first trial did not, and what to try.
void print_no_success(const correlation::Study& study,
                      const Journal& journal,
                      const std::string& reason);

/// Progress on standard error and an end when interrupted. An ETA needs to know how many points
/// there will be: a design of experiments does, an optimizer does not.
RunOptions run_options(const correlation::Study& study, bool length_known);

/// Why a run that on_failure = "abort" ended has ended.
void print_aborted(const correlation::Study& study,
                   const DesignPoint& point,
                   const Failure& failure);

/// The same without a target: counts the trials, described by `what`.
RunOptions counting_options(const correlation::Study& study, const std::string& what);

/// The trial of the study's refined model, where it has one, in a worker of its own; the shift of
/// its numbers is then known to `result`. False where that was interrupted.
bool take_refined(const correlation::Study& study, correlation::Identifiability& result);

/// Writes the report and names it; returns the exit code. `output`: its file; empty: beside the
/// study. InputError where that folder may not be written.
int write_report(const correlation::Study& study,
                 const Journal& journal,
                 const experiment::Language& language,
                 experiment::Thoroughness thoroughness = experiment::Thoroughness::seconds,
                 const std::filesystem::path& output = {});

}  // namespace latsch::cli
