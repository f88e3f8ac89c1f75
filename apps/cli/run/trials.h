// SPDX-License-Identifier: Apache-2.0
// Common parts of the verbs run, resume and doe: the worker processes of a study, its progress on
// the terminal, its report.
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

/// Returns a text that identifies the trials of a study: it differs for two studies if their trials
/// may differ.
std::string identity_key(const correlation::Study& study);

/// Returns settings that start this program as `latsch worker STUDY`. Such a worker refuses a study
/// whose files have changed.
ProcessOptions worker_processes(const correlation::Study& study);

/// Opens the journal of the study. Trials that failed because of a limit that has been raised since
/// are run again; if `retries_failed`, all failed trials are.
Journal open_for_trials(const correlation::Study& study, bool retries_failed);

/// Removes files that killed workers of an outside program left behind. The journal must be locked
/// during the removal, so that no other run uses the files.
void clear_scratch(const correlation::Study& study);

/// If the journal lies on a network file system, says that its log is of another kind than on a
/// local disk, and why it is slower.
void say_kind_of_journal(const correlation::Study& study);

/// Reports on standard error that no trial succeeded, why the first one failed, and what to try.
void print_no_success(const correlation::Study& study,
                      const Journal& journal,
                      const std::string& reason);

/// Returns options of a run that print its progress on standard error and stop it if a signal
/// arrives. The remaining time is shown if `length_known`: the number of points is known for a
/// design of experiments but not for an optimizer.
RunOptions run_options(const correlation::Study& study, bool length_known);

/// Reports why a run with on_failure = "abort" has ended.
void print_aborted(const correlation::Study& study,
                   const DesignPoint& point,
                   const Failure& failure);

/// Returns the options of a run that has no target: its progress counts the trials, which `what`
/// describes.
RunOptions counting_options(const correlation::Study& study, const std::string& what);

/// Runs one trial on the study's refined model, if the study has one, in a separate worker, and
/// stores in `result` how the refinement shifts the values. Returns false if a signal interrupted
/// it.
bool take_refined(const correlation::Study& study, correlation::Identifiability& result);

/// Writes the report and prints the name of its file, `output`, or a file beside the study if
/// `output` is empty. Returns the exit code. Throws InputError if the folder is not writable.
int write_report(const correlation::Study& study,
                 const Journal& journal,
                 const experiment::Language& language,
                 experiment::Thoroughness thoroughness = experiment::Thoroughness::seconds,
                 const std::filesystem::path& output = {});

/// Writes the report of a run; `as_read` is the study as read at the beginning of the run. If the
/// files of the study have changed since, it reports this, writes a report of the study as read,
/// without the views that would read the files again, and returns the exit code of a failure.
int write_report_of_run(const correlation::Study& study,
                        const correlation::Study& as_read,
                        const Journal& journal,
                        const experiment::Language& language,
                        const std::filesystem::path& output = {});

}  // namespace latsch::cli
