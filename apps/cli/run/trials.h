// SPDX-License-Identifier: Apache-2.0
// Common parts of run, resume and doe: the worker processes of a study, its progress on the
// terminal, its report.
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

/// Returns a text that differs for studies whose trials may differ.
std::string identity_key(const correlation::Study& study);

/// Returns the settings that start this program as `latsch worker STUDY`. The workers refuse a
/// study whose files have changed.
ProcessOptions worker_processes(const correlation::Study& study);

/// Opens the journal of the study. Trials that failed at a limit which has been raised since are
/// tried again; with `retries_failed` all failed trials are.
Journal open_for_trials(const correlation::Study& study, bool retries_failed);

/// Removes files that killed workers of an outside program left behind. The journal is locked
/// meanwhile.
void clear_scratch(const correlation::Study& study);

/// Explains why the journal uses a slower log than on a local disk, if it does.
void say_kind_of_journal(const correlation::Study& study);

/// Reports on standard error that nothing succeeded, why the first trial failed, and what to try.
void print_no_success(const correlation::Study& study,
                      const Journal& journal,
                      const std::string& reason);

/// Returns options that print progress on standard error and stop on interrupts. An ETA requires
/// the number of points, which is known for a design of experiments but not for an optimizer.
RunOptions run_options(const correlation::Study& study, bool length_known);

/// Says why a run with on_failure = "abort" has ended.
void print_aborted(const correlation::Study& study,
                   const DesignPoint& point,
                   const Failure& failure);

/// Returns the options of a run without target: counts the trials, described by `what`.
RunOptions counting_options(const correlation::Study& study, const std::string& what);

/// Runs the trial of the study's refined model, if it has one, in a worker of its own; `result`
/// then contains the shift of its numbers. Returns false if that was interrupted.
bool take_refined(const correlation::Study& study, correlation::Identifiability& result);

/// Writes the report and names it; returns the exit code. `output` is its file; empty: beside the
/// study. Throws InputError if that folder is not writable.
int write_report(const correlation::Study& study,
                 const Journal& journal,
                 const experiment::Language& language,
                 experiment::Thoroughness thoroughness = experiment::Thoroughness::seconds,
                 const std::filesystem::path& output = {});

/// Writes the report of a run that read `as_read` at its beginning. If the files of the study have
/// changed meanwhile, it says so, writes a report of what the run has read, without the views that
/// would read the files again, and returns the exit code of a failure.
int write_report_of_run(const correlation::Study& study,
                        const correlation::Study& as_read,
                        const Journal& journal,
                        const experiment::Language& language,
                        const std::filesystem::path& output = {});

}  // namespace latsch::cli
