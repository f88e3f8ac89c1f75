// SPDX-License-Identifier: Apache-2.0
#include "studio/views/kept_identifiability.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "correlation/analysis/refit_trials.h"
#include "correlation/target/predictions.h"

namespace latsch::studio {
namespace {

KeptIdentifiability computed(const std::string& id,
                             const std::shared_ptr<const correlation::Study>& study,
                             const std::string& error) {
  if (!study) return {nullptr, nullptr, id + " cannot be read: " + error};
  if (!error.empty()) return {study, nullptr, error};
  if (!std::filesystem::exists(study->run.journal))
    return {study, nullptr, "no trial has been run yet"};
  auto what = correlation::recorded_identifiability(*study, Journal::read(study->run.journal));
  if (!what)
    return {study,
            nullptr,
            "the trials around the best point are missing: identify runs two to six of them a "
            "variable"};
  return {study, std::make_shared<const correlation::Identifiability>(std::move(*what)), ""};
}

/// Returns a text that changes when the journal grows.
std::string state_of_journal(const std::string& journal) {
  std::string state;
  for (const char* of : {"", "-wal"}) {  // "-wal" is the write-ahead log of SQLite
    std::error_code none;
    const auto size = std::filesystem::file_size(journal + of, none);
    const auto written = std::filesystem::last_write_time(journal + of, none);
    state += fmt::format("{} {} ", size, written.time_since_epoch().count());
  }
  return state;
}

/// State of a study; an answer that was computed for it stays valid as long as the state does not
/// change.
struct State {
  std::shared_ptr<const correlation::Study> study;
  int edition = 0;
  std::size_t rows = 0;
  // state of the file that is stored beside the journal and contains the trials of likelihood
  // profiles
  std::string refits;
  std::string error;
  bool is_running = false;

  /// A result needs the whole journal. During a run the result of the first request therefore stays
  /// valid.
  bool holds_for(const State& now) const {
    return study == now.study && edition == now.edition && error == now.error &&
           ((rows == now.rows && refits == now.refits) || now.is_running);
  }
};

struct Kept {
  std::mutex mutex;  // one for each study, so that requests for other studies do not wait
  std::optional<State> from;
  KeptIdentifiability result;
};

std::shared_ptr<Kept> kept_of(const std::filesystem::path& file) {
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::shared_ptr<Kept>> all;
  const std::lock_guard lock(mutex);
  auto& kept = all[file];
  if (!kept) kept = std::make_shared<Kept>();
  return kept;
}

}  // namespace

std::string KeptIdentifiability::why_not_at(const DesignPoint& point) const {
  if (!what) return why_not;
  return what->best == point ? "" : "they are known at another point than this one";
}

std::string state_of_predictions(const correlation::Study& study) {
  if (!correlation::has_predictions(study)) return "";
  return state_of_journal(correlation::with_predictions(study).run.journal.string());
}

KeptIdentifiability kept_identifiability(const ShelvedStudy& shelved) {
  const auto kept = kept_of(shelved.file());
  const std::lock_guard lock(kept->mutex);
  State now = shelved.look([](const ShelvedStudy::Sight& sight) {
    return State{
        sight.study,
        sight.table ? sight.table->edition() : 0,
        sight.table ? sight.table->rows().size() : 0,
        sight.study
            ? state_of_journal(correlation::RefitTrials::file(sight.study->run.journal).string())
            : std::string(),
        sight.error,
        sight.state == StudyState::running};
  });
  if (kept->from && kept->from->holds_for(now)) return kept->result;
  kept->result = computed(shelved.id(), now.study, now.error);
  kept->from = std::move(now);
  return kept->result;
}

}  // namespace latsch::studio
