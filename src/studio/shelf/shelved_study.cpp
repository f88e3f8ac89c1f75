// SPDX-License-Identifier: Apache-2.0
#include "studio/shelf/shelved_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/clock.h"
#include "base/document_record.h"
#include "base/error.h"
#include "correlation/analysis/beyond_data.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/study/study_stages.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/estimated_noise.h"

namespace latsch::studio {

namespace fs = std::filesystem;
using correlation::Study;

std::string name(StudyState state) {
  switch (state) {
    case StudyState::reading:
      return "reading";
    case StudyState::broken:
      return "broken";
    case StudyState::fresh:
      return "new";
    case StudyState::running:
      return "running";
    case StudyState::stopped:
      return "stopped";
    case StudyState::ended:
      return "ended";
  }
  return "";
}

namespace {

fs::file_time_type time_of(const fs::path& file) {
  std::error_code none;
  const auto time = fs::last_write_time(file, none);
  return none ? fs::file_time_type::min() : time;
}

/// Adds the files that a model's file names, such as the suspensions and tires of a car, and the
/// files that these name in turn.
void add_named_files(const fs::path& file, int deepest, std::vector<fs::path>& files) {
  if (deepest == 0 || file.extension() != ".toml") return;
  const std::string text = canonical_text(Document::read(file));
  for (std::size_t begin = text.find('"'); begin != std::string::npos;) {
    const std::size_t end = text.find_first_of("\"\n", begin + 1);
    if (end == std::string::npos) return;
    const fs::path named = file.parent_path() / text.substr(begin + 1, end - begin - 1);
    std::error_code none;
    if (named != file.parent_path() / "" && fs::is_regular_file(named, none)) {
      files.push_back(named);
      add_named_files(named, deepest - 1, files);
    }
    begin = text.find('"', end + 1);
  }
}

/// Returns the files from which a study was read.
std::vector<fs::path> files_of(const Study& study) {
  std::vector<fs::path> files{study.file};
  if (!study.model_file.empty()) {
    constexpr int kDeepest = 4;  // number of levels: car, suspension, bushing and one more
    files.push_back(study.model_file);
    add_named_files(study.model_file, kDeepest, files);
  }
  for (const auto& test : study.tests)
    files.insert(files.end(), test.files.begin(), test.files.end());
  for (const auto& experiment : study.experiments) {
    if (!experiment.measurement_file.empty()) files.push_back(experiment.measurement_file);
    if (!experiment.shapes_file.empty()) files.push_back(experiment.shapes_file);
  }
  return files;
}

/// Returns the reason why the trials of a journal do not belong to the study, and sets `trials` to
/// their number; empty if they belong to it.
std::string journal_fault(const Study& study, long& trials) {
  trials = 0;
  try {
    if (!fs::exists(study.run.journal)) return "";
    trials = Journal::read(study.run.journal).size();
    Journal::read(study.run.journal, correlation::identity(study));
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

/// True if the search of the study may have a step in its journal. For a journal that has only a
/// large design of experiments this avoids a replay of a second.
bool may_be_begun(const Study& study, const std::vector<TableRow>& rows) {
  if (!study.stages.empty() || correlation::estimates_noise(study)) return true;
  try {
    const auto first = correlation::first_point(study);
    return !first || std::any_of(rows.begin(), rows.end(), [&](const TableRow& row) {
      return row.point == *first;
    });
  } catch (const std::exception&) {
    return true;  // the replay reports the reason
  }
}

/// True if both studies have the same last stage: the same weights, estimated noise and variables
/// held constant.
bool have_same_last_stage(const Study& a, const Study& b) {
  if (a.free != b.free || a.held_at != b.held_at) return false;
  for (std::size_t e = 0; e < a.experiments.size(); ++e) {
    if (a.experiments[e].objective.weight != b.experiments[e].objective.weight) return false;
    const auto &one = a.experiments[e].noise, &other = b.experiments[e].noise;
    if (!a.experiments[e].estimates_noise) continue;
    if (one.has_value() != other.has_value() || (one && one->relative != other->relative))
      return false;
  }
  return true;
}

}  // namespace

ShelvedStudy::ShelvedStudy(std::string id, fs::path file, const experiment::Language& language)
    : id_(std::move(id)), file_(std::move(file)), language_(language) {}

bool ShelvedStudy::is_out_of_date() const {
  if (!is_read_) return true;
  return std::any_of(read_at_.begin(), read_at_.end(), [](const auto& one) {
    return time_of(one.first) != one.second;
  });
}

void ShelvedStudy::read_files() {
  is_read_ = true;
  // The times are taken before the files are read, so that a change during reading is noticed
  // later.
  read_at_ = {{file_, time_of(file_)}};
  const fs::path folder = file_.parent_path();
  const auto folder_was = time_of(folder);
  whole_.reset();
  study_.reset();
  table_.reset();
  ending_.reset();
  error_.clear();
  journal_fault_.clear();
  journal_error_.clear();
  try {
    whole_ = std::make_shared<const Study>(correlation::read_study(file_, language_));
    for (const fs::path& file : files_of(*whole_)) read_at_.emplace(file, time_of(file));
    show_stage();
  } catch (const std::exception& error) {
    error_ = error.what();
    whole_.reset();
    // A file that the study names may appear or be corrected while the study's own file stays
    // unchanged, so its folder is watched too.
    read_at_.emplace(folder, folder_was);
    const auto* wrong = dynamic_cast<const InputError*>(&error);
    if (wrong && !wrong->place().file.empty())
      read_at_.emplace(wrong->place().file, time_of(wrong->place().file));
  }
}

void ShelvedStudy::show_stage() {
  Study shown = correlation::begun_stage(*whole_);
  journal_fault_ = journal_fault(shown, of_another_study_);
  journal_error_.clear();
  const bool is_last = !whole_->stages.empty() && shown.stage == whole_->stages.back().name;
  if ((is_last || correlation::estimates_noise(*whole_)) && fs::exists(whole_->run.journal) &&
      journal_fault_.empty())
    correlation::take_stage(
        correlation::with_estimated_noise(*whole_, Journal::read(whole_->run.journal)), shown);
  // This member is set first, because an exception in a later line must not leave the study without
  // a table of trials.
  table_ = std::make_unique<TrialTable>(shown);
  study_ = std::make_shared<const Study>(std::move(shown));
}

/// Checks whether the journal belongs to the study: before its first trial is read, and again as
/// long as it belongs to another study. Points of another design space do not fit into the table of
/// trials.
void ShelvedStudy::check_journal() {
  const bool was_another = !journal_fault_.empty();
  if (!was_another && !table_->rows().empty()) return;
  ending_.reset();
  journal_fault_ = journal_fault(*study_, of_another_study_);
  if (was_another && journal_fault_.empty()) show_stage();
}

std::string ShelvedStudy::error() const {
  if (!error_.empty()) return error_;
  return journal_fault_.empty() ? journal_error_ : journal_fault_;
}

ShelvedStudy::Changes ShelvedStudy::refresh(long most_trials) {
  const std::lock_guard lock(mutex_);
  Changes changes;
  if (is_out_of_date()) {
    read_files();
    changes.of_study = true;
  }
  if (!study_) return changes;
  const std::string error_before = error();
  try {
    const bool has_next_begun =
        !whole_->stages.empty() &&
        correlation::begun_stage(*whole_).run.journal != study_->run.journal;
    if (has_next_begun) {
      show_stage();
      changes.of_study = true;
    }
    changes.of_state = look_at_run();
    check_journal();
    changes.of_trials = journal_fault_.empty() && table_->follow(most_trials);
    journal_error_.clear();
  } catch (const std::exception& error) {
    journal_error_ = error.what();
  }
  changes.of_state = changes.of_state || error() != error_before;
  return changes;
}

/// Finds out which process runs the study and when it last changed. Returns true if a run has begun
/// or ended.
bool ShelvedStudy::look_at_run() {
  const auto& journal = study_->run.journal;
  changed_ = std::max({time_of(file_), time_of(journal), time_of(journal.string() + "-wal")});
  const auto holder = ignores_runs_ ? std::nullopt : journal_holder(journal);
  const bool is_other = holder.has_value() != holder_.has_value();
  if (holder && (!holder_ || holder->words != holder_->words)) {
    run_seen_at_ = steady_clock()();
    run_seen_rows_ = static_cast<long>(table_->rows().size());
  }
  holder_ = holder;
  return is_other;
}

bool ShelvedStudy::has_more() const {
  const std::lock_guard lock(mutex_);
  return !is_read_ || (table_ && table_->has_more() && error().empty());
}

ShelvedStudy::Changes ShelvedStudy::find_ending() {
  std::shared_ptr<const Study> whole;
  Ending found;
  bool is_begun = true;
  {
    const std::lock_guard lock(mutex_);
    if (!whole_ || holder_ || !error().empty() || table_->rows().empty()) return {};
    if (ending_ && ending_->rows == table_->rows().size() && ending_->edition == table_->edition())
      return {};
    whole = whole_;
    found.rows = table_->rows().size();
    found.edition = table_->edition();
    is_begun = may_be_begun(*whole, table_->rows());
  }
  correlation::StagesRun stages{*whole};
  try {
    if (is_begun) stages = correlation::recorded_stages(*whole, Journal::read(whole->run.journal));
    // the journal contains only a design of experiments
    found.has_ended = stages.has_ended || stages.fits.empty();
    if (stages.has_ended) {
      found.words = stages.fits.back().run.ending;
      found.tests = tests_in_words(stages.fits.back().run.claims);
      const Journal journal = Journal::read(whole->run.journal);
      found.spoiled = correlation::spoiled_experiments(stages, journal);
      if (const auto best = correlation::best_trial(stages.study, journal))
        for (std::string& words : correlation::faults_beyond_data(stages.study, best->point))
          found.spoiled.push_back(std::move(words));
    }
  } catch (const std::exception&) {  // a stage is missing or has changed
  }
  const std::lock_guard lock(mutex_);
  if (whole != whole_) return {};
  const bool is_of_now = found.rows == table_->rows().size() && found.edition == table_->edition();
  ending_ = std::move(found);
  if (!is_of_now || have_same_last_stage(stages.study, *study_)) return {.of_state = true};
  // Trials that were added since the study was read have changed the estimated noise.
  Study shown = *study_;
  correlation::take_stage(stages.study, shown);
  std::unique_ptr<TrialTable> table;
  try {
    table = std::make_unique<TrialTable>(shown);
    while (table->follow(std::numeric_limits<int>::max()) && table->has_more()) {
    }
  } catch (const std::exception&) {
    return {.of_state = true};  // refresh() reports the reason
  }
  study_ = std::make_shared<const Study>(std::move(shown));
  table_ = std::move(table);
  return {.of_study = true, .of_state = true};
}

/// Returns the reason why no trial is the best point of the present study.
std::string ShelvedStudy::why_no_best() const {
  const bool was_replayed = ending_ && ending_->rows == table_->rows().size();
  return correlation::why_no_best(*study_,
                                  table_->counts_read(),
                                  table_->ownership(),
                                  holder_ || !was_replayed || ending_->has_ended);
}

ShelvedStudy::Sight ShelvedStudy::sight() const {
  StudyState state = StudyState::stopped;
  if (!is_read_) {
    state = StudyState::reading;
  } else if (!study_) {
    state = StudyState::broken;
  } else if (holder_) {
    state = StudyState::running;
  } else if (table_->total() == 0 && journal_fault_.empty()) {
    state = StudyState::fresh;
  } else if (ending_ && ending_->has_ended) {
    state = StudyState::ended;
  }
  Sight sight{.state = state,
              .error = error(),
              .of_another_study = journal_fault_.empty() ? 0 : of_another_study_,
              .no_best = study_ ? why_no_best() : "",
              .study = study_,
              .table = table_.get(),
              .holder = holder_,
              .changed = changed_,
              .ending = ending_ ? ending_->words : "",
              .tests = ending_ ? ending_->tests : std::vector<std::string>{},
              .spoiled = ending_ ? ending_->spoiled : std::vector<std::string>{}};
  if (holder_) {
    sight.run_seconds = steady_clock()() - run_seen_at_;
    sight.run_trials = static_cast<long>(table_->rows().size()) - run_seen_rows_;
  }
  return sight;
}

}  // namespace latsch::studio
