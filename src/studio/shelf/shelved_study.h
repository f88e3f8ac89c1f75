// SPDX-License-Identifier: Apache-2.0
// The current state of one study of a folder: its file, read again when it or its model changes,
// its trials, and the process that runs it. Every call is safe from any thread.
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
  broken,   // unreadable file, see `error`
  fresh,    // never run
  running,
  stopped,  // has trials; no process runs it and its search has not ended
  ended
};
std::string name(StudyState state);

class ShelvedStudy {
 public:
  /// `id` is the path below the folder, used in requests.
  ShelvedStudy(std::string id, std::filesystem::path file, const experiment::Language& language);

  const std::string& id() const { return id_; }
  const std::filesystem::path& file() const { return file_; }

  struct Changes {
    bool of_study = false, of_trials = false, of_state = false;
    bool any() const { return of_study || of_trials || of_state; }
  };
  /// Checks the files and reads at most this many new trials.
  Changes refresh(long most_trials);
  /// Counts the study as not running from now on, for a report at the end of its own run.
  void ignore_runs() { ignores_runs_ = true; }
  /// True if refresh() has not read everything yet.
  bool has_more() const;
  /// Replays the search on the journal, if that has grown since the last replay, to determine
  /// whether and how it has ended. May take seconds, during which no other call waits.
  Changes find_ending();

  /// The current state, held constant: the table does not change while `look` runs.
  struct Sight {
    StudyState state;
    std::string error;          // error of the file, or of the journal
    long of_another_study = 0;  // number of trials of the journal if none belongs to the study
    // reason why no trial is the best of the study as it stands; empty: one is, or none has
    // succeeded
    std::string no_best;
    std::shared_ptr<const correlation::Study>
        study;                // the study in the stage that is shown; nullptr: broken
    const TrialTable* table;  // nullptr: broken
    std::optional<JournalHolder> holder;
    std::filesystem::file_time_type changed;  // later one of file and journal
    /// Duration and number of rows since the present run was first seen.
    double run_seconds = 0.0;
    long run_trials = 0;
    std::string ending;                // why the search ended; empty: it has not, or unknown
    std::vector<std::string> spoiled;  // faults of the result, in words
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
  std::string error_;          // error of the file
  std::string journal_fault_;  // why the journal does not belong to the study: none of it is shown
  long of_another_study_ = 0;  // number of trials of such a journal
  std::string journal_error_;  // why the rest of the journal cannot be read
  std::map<std::filesystem::path, std::filesystem::file_time_type> read_at_;  // at last reading
  std::filesystem::file_time_type changed_ = std::filesystem::file_time_type::min();
  std::shared_ptr<const correlation::Study> whole_;  // study as written in the file
  std::shared_ptr<const correlation::Study> study_;  // stage that is shown, with its noise
  std::unique_ptr<TrialTable> table_;
  std::optional<JournalHolder> holder_;
  double run_seen_at_ = 0.0;  // s, on the steady clock
  long run_seen_rows_ = 0;
  struct Ending {
    std::size_t rows = 0;  // rows of the table at the replay
    int edition = 0;
    bool has_ended = false;
    std::string words;
    std::vector<std::string> spoiled;
  };
  std::optional<Ending> ending_;
};

}  // namespace latsch::studio
