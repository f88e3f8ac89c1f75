// SPDX-License-Identifier: Apache-2.0
// Runs of studies as processes of their own: `latsch run STUDY` as a person would type it, in a
// session of its own, so that it goes on where the page and its server end. What it prints goes to
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

/// What a page may start; nothing else ever is.
enum class RunVerb { run, resume, doe, identify };
std::optional<RunVerb> run_verb(const std::string& name);

class StudyRuns {
 public:
  /// `program`: of `latsch` itself.
  explicit StudyRuns(std::filesystem::path program) : program_(std::move(program)) {}

  struct Asked {
    RunVerb verb = RunVerb::run;
    int workers = 0;  // 0: as the study says
    bool anew = false;
  };
  /// InputError where it runs already or cannot be started.
  void start(const ShelvedStudy& study, const Asked& asked);
  /// Asks whoever runs it to stop, as Ctrl-C does: running trials are given up, finished ones stay.
  /// InputError where nobody does, or on another machine.
  void stop(const ShelvedStudy& study);

  struct Run {
    bool is_ours = false;  // was started from this page
    bool is_alive = false;
    std::optional<int> exit_code;
    bool was_stopped = false;      // on request: its exit code is no failure
    RunVerb verb = RunVerb::run;   // of one of ours
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
  std::map<std::string, Process> started_;  // by study
};

/// Where a run started from a page writes what it prints.
std::filesystem::path run_log(const std::filesystem::path& study);

}  // namespace latsch::studio
