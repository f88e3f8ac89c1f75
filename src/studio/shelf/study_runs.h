// SPDX-License-Identifier: Apache-2.0
// Runs studies as separate processes: `latsch run STUDY` as a user would type it, in a session of
// its own, so that the run continues when the page and its server end. Its output goes to
// STUDY.run.log beside the study.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "studio/shelf/shelved_study.h"

namespace latsch::studio {

/// The commands that a page may start; there are no others.
enum class RunVerb { run, resume, doe, identify };
std::optional<RunVerb> run_verb(const std::string& name);

class StudyRuns {
 public:
  /// `program` is the executable of `latsch` itself.
  explicit StudyRuns(std::filesystem::path program) : program_(std::move(program)) {}

  struct Asked {
    RunVerb verb = RunVerb::run;
    int workers = 0;  // 0: the number in the study
    bool anew = false;
  };
  /// Throws InputError if the study is running already or cannot be started.
  void start(const ShelvedStudy& study, const Asked& asked);
  /// Requests the running process to stop, as Ctrl-C does: running trials are given up, finished
  /// ones stay. Throws InputError if no process runs the study, or on another machine.
  void stop(const ShelvedStudy& study);

  struct Run {
    bool is_ours = false;  // started from this page
    bool is_alive = false;
    std::optional<int> exit_code;
    bool was_stopped = false;      // the run was stopped on request: its exit code is no failure
    RunVerb verb = RunVerb::run;   // verb of a run that this server started
    std::vector<std::string> log;  // last lines
  };
  Run of(const ShelvedStudy& study);

 private:
  struct Process {
    int id = 0;
    RunVerb verb = RunVerb::run;
    std::optional<int> exit_code = {};
    bool was_stopped = false;
  };
  void reap();

  std::filesystem::path program_;
  std::mutex mutex_;
  std::map<std::string, Process> started_;  // one for each study
};

/// Returns the output file of a run started from a page.
std::filesystem::path run_log(const std::filesystem::path& study);

}  // namespace latsch::studio
