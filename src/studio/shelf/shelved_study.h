// SPDX-License-Identifier: Apache-2.0
// One study of a folder as it is now: its file, read anew when it or its model changes, its
// trials, who runs it. Every call is safe from any thread.
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
  reading,  // not looked at yet
  broken,   // its file cannot be read: `error`
  fresh,    // never run
  running,
  stopped,  // has trials; nobody runs it and its search has not ended
  ended
};
std::string name(StudyState state);

class ShelvedStudy {
 public:
  /// `id`: its path below the folder, as requests name it.
  ShelvedStudy(std::string id, std::filesystem::path file, const experiment::Language& language);

  const std::string& id() const { return id_; }
  const std::filesystem::path& file() const { return file_; }

  struct Changes {
    bool of_study = false, of_trials = false, of_state = false;
    bool any() const { return of_study || of_trials || of_state; }
  };
  /// Looks at the files and reads at most so many new trials.
  Changes refresh(long most_trials);
  /// From now on it counts as run by nobody: for a report at the end of its own run.
  void ignore_runs() { ignores_runs_ = true; }
  /// Whether refresh() has read less than there is.
  bool has_more() const;
  /// Replays the search on the journal, where nobody has since it last grew: whether it has ended,
  /// and how. May take seconds, during which nothing else waits.
  Changes find_ending();

  /// What is known now, held still: the table does not move while `look` runs.
  struct Sight {
    StudyState state;
    std::string error;  // of the file, or of the journal
    std::shared_ptr<const correlation::Study>
        study;                // as the stage that is shown has it; nullptr: broken
    const TrialTable* table;  // nullptr: broken
    std::optional<JournalHolder> holder;
    std::filesystem::file_time_type changed;  // of file and journal the later
    /// Since the run that goes on was first seen; rows of it.
    double run_seconds = 0.0;
    long run_trials = 0;
    std::string ending;                // why its search ended; empty: it has not, or unknown
    std::vector<std::string> spoiled;  // what is wrong with the result, in words
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
  Sight sight() const;

  std::string id_;
  std::filesystem::path file_;
  const experiment::Language& language_;

  mutable std::mutex mutex_;
  bool is_read_ = false, ignores_runs_ = false;
  std::string error_;          // of the file
  std::string journal_fault_;  // why the journal is not that of the study: none of it is shown
  std::string journal_error_;  // why no more of it can be read
  std::map<std::filesystem::path, std::filesystem::file_time_type> read_at_;  // what was read when
  std::filesystem::file_time_type changed_ = std::filesystem::file_time_type::min();
  std::shared_ptr<const correlation::Study> whole_;  // as its file says
  std::shared_ptr<const correlation::Study> study_;  // the stage that is shown, with its noise
  std::unique_ptr<TrialTable> table_;
  std::optional<JournalHolder> holder_;
  double run_seen_at_ = 0.0;  // s, of the steady clock
  long run_seen_rows_ = 0;
  struct Ending {
    std::size_t rows = 0;  // of the table it was found with
    int edition = 0;
    bool has_ended = false;
    std::string words;
    std::vector<std::string> spoiled;
  };
  std::optional<Ending> ending_;
};

}  // namespace latsch::studio
