// SPDX-License-Identifier: Apache-2.0
// Runs studies as separate processes: `latsch run STUDY` as a user would start it, in a new
// session, so that the run continues when the page and its server end. The output goes to
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

/// The commands that a page may start. All others are refused.
enum class RunVerb { run, resume, doe, identify };
std::optional<RunVerb> run_verb(const std::string& name);

class StudyRuns {
 public:
  /// `program` is the path of the program latsch.
  explicit StudyRuns(std::filesystem::path program) : program_(std::move(program)) {}

  struct Asked {
    RunVerb verb = RunVerb::run;
    int workers = 0;  // number of worker processes; 0: as the study states
    bool anew = false;
  };
  /// Throws InputError if a process already runs the study or if the process cannot be started.
  void start(const ShelvedStudy& study, const Asked& asked);
  /// Requests the running process to stop, as Ctrl-C does: running trials are abandoned, finished
  /// ones stay in the journal. Throws InputError if no process runs the study, or if one on another
  /// machine does.
  void stop(const ShelvedStudy& study);

  struct Run {
    bool is_ours = false;  // true: the page started the run
    bool is_alive = false;
    std::optional<int> exit_code;
    // true: the run was stopped on request, so its exit code is no failure
    bool was_stopped = false;
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
  std::map<std::string, Process> started_;  // the last process started for each study
};

/// Returns the file with the output of a run that a page started.
std::filesystem::path run_log(const std::filesystem::path& study);

}  // namespace latsch::studio
