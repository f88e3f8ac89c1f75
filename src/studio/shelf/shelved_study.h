// SPDX-License-Identifier: Apache-2.0
// The current state of one study of a folder: its file, which is read again when it or its model
// changes, its trials, and the process that runs it. Any thread may call any function.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "correlation/study/study.h"
#include "evaluation/journal/journal_lock.h"
#include "studio/shelf/trial_table.h"

namespace latsch::studio {

enum class StudyState {
  reading,  // not read yet
  broken,   // the file cannot be read, see `error`
  fresh,    // never run
  running,
  stopped,  // has trials; no process runs it, and its search has not ended
  ended
};
std::string name(StudyState state);

class ShelvedStudy {
 public:
  /// `id` is the path of the file below the folder; requests use it.
  ShelvedStudy(std::string id, std::filesystem::path file, const experiment::Language& language);

  const std::string& id() const { return id_; }
  const std::filesystem::path& file() const { return file_; }

  struct Changes {
    bool of_study = false, of_trials = false, of_state = false;
    bool any() const { return of_study || of_trials || of_state; }
  };
  /// Checks the files for changes and reads at most `most_trials` new trials.
  Changes refresh(long most_trials);
  /// Makes the study count as not running from now on. A run uses this for the report at its own
  /// end.
  void ignore_runs() { ignores_runs_ = true; }
  /// True if refresh() has not read all trials yet.
  bool has_more() const;
  /// Replays the search on the journal, if the journal has grown since the last replay, and
  /// determines whether and why the search has ended. May take seconds, during which other calls do
  /// not wait.
  Changes find_ending();

  /// The current state, which stays unchanged while the function given to look() runs.
  struct Sight {
    StudyState state;
    std::string error;          // error in the file or in the journal
    long of_another_study = 0;  // number of trials in the journal if it belongs to another study
    // Reason why no trial is the best of the present study; empty if one is, or if none has
    // succeeded.
    std::string no_best;
    std::shared_ptr<const correlation::Study>
        study;                // the study in the stage that is shown; nullptr if its file is broken
    const TrialTable* table;  // nullptr: broken
    std::optional<JournalHolder> holder;
    std::filesystem::file_time_type changed;  // time of the last change of file or journal
    /// Time, s, since the present run was first seen, and number of trials of the run.
    double run_seconds = 0.0;
    long run_trials = 0;
    // reason why the search ended; empty: it has not ended, or this is not known
    std::string ending;
    std::vector<std::string> tests;    // tests of the ending with their numbers, in words
    std::vector<std::string> spoiled;  // faults of the result, in sentences
  };
  template <class Look>
  auto look(Look&& look) const {
    const std::lock_guard lock(mutex_);
    return look(sight());
  }

 private:
  bool is_out_of_date() const;
  void read_files();
  void show_stage();
  void check_journal();
  bool look_at_run();
  std::string error() const;
  std::string why_no_best() const;
  Sight sight() const;

  std::string id_;
  std::filesystem::path file_;
  const experiment::Language& language_;

  mutable std::mutex mutex_;
  bool is_read_ = false, ignores_runs_ = false;
  std::string error_;  // error in the study's file
  /// reason why the journal does not belong to the study, in which case none of its trials is shown
  std::string journal_fault_;
  long of_another_study_ = 0;  // number of trials in such a journal
  std::string journal_error_;  // reason why the rest of the journal cannot be read
  /// time of last change of each file when it was read
  std::map<std::filesystem::path, std::filesystem::file_time_type> read_at_;
  std::filesystem::file_time_type changed_ = std::filesystem::file_time_type::min();
  std::shared_ptr<const correlation::Study> whole_;  // the study as written in its file
  /// the stage that is shown, with its estimated noise
  std::shared_ptr<const correlation::Study> study_;
  std::unique_ptr<TrialTable> table_;
  std::optional<JournalHolder> holder_;
  double run_seen_at_ = 0.0;  // s, time of the steady clock at which the present run was first seen
  long run_seen_rows_ = 0;
  struct Ending {
    std::size_t rows = 0;  // number of rows of the table at the last replay
    int edition = 0;
    bool has_ended = false;
    std::string words;
    std::vector<std::string> tests, spoiled;
  };
  std::optional<Ending> ending_;
};

}  // namespace latsch::studio
