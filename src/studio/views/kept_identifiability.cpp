// SPDX-License-Identifier: Apache-2.0
#include "studio/views/kept_identifiability.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <utility>

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

}  // namespace

KeptIdentifiability kept_identifiability(const ShelvedStudy& shelved) {
  struct State {
    std::shared_ptr<const correlation::Study> study;
    std::size_t rows = 0;
    int edition = 0;
    std::string error;
    bool operator==(const State&) const = default;
  };
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::pair<State, KeptIdentifiability>> kept;
  const State now = shelved.look([](const ShelvedStudy::Sight& sight) {
    return State{sight.study,
                 sight.table ? sight.table->rows().size() : 0,
                 sight.table ? sight.table->edition() : 0,
                 sight.error};
  });
  const std::lock_guard lock(mutex);
  const auto found = kept.find(shelved.file());
  if (found != kept.end() && found->second.first == now) return found->second.second;
  auto result = computed(shelved.id(), now.study, now.error);
  kept.insert_or_assign(shelved.file(), std::pair(now, result));
  return result;
}

}  // namespace latsch::studio
