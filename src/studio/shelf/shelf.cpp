// SPDX-License-Identifier: Apache-2.0
#include "studio/shelf/shelf.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "base/clock.h"
#include "base/document.h"

namespace latsch::studio {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLevels = 4;
constexpr std::size_t kMostStudies = 2000;
constexpr auto kOften = std::chrono::milliseconds(150);
constexpr double kSeldom = 3.0;  // s, interval between two checks of all studies
// s; time after it was opened during which a study is checked often
constexpr double kLookedAt = 120.0;
constexpr long kAtOnce = 2000;  // number of trials read before other studies have their turn

bool is_hidden(const fs::path& file) { return file.filename().string().starts_with("."); }

bool is_passed_by(const fs::path& folder) {
  static const std::set<std::string> kNames{"build", "node_modules", "CMakeFiles"};
  return is_hidden(folder) || kNames.count(folder.filename().string()) > 0;
}

bool is_study(const fs::path& file) {
  try {
    const Document document = Document::read(file);
    const Node root = document.root();
    return (root.has("model") || root.has("simulator")) &&
           (root.has("variable") || root.has("experiment"));
  } catch (const std::exception&) {
    return file.filename() == "study.toml";
  }
}

}  // namespace

std::vector<fs::path> find_studies(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (fs::recursive_directory_iterator at(
           folder, fs::directory_options::skip_permission_denied, ignored);
       !ignored && at != fs::recursive_directory_iterator() && found.size() < kMostStudies;
       at.increment(ignored)) {
    std::error_code none;
    if (at->is_directory(none)) {
      if (at.depth() + 1 >= kMostLevels || is_passed_by(at->path())) at.disable_recursion_pending();
    } else if (at->path().extension() == ".toml" && !is_hidden(at->path()) &&
               at->is_regular_file(none) && is_study(at->path())) {
      found.push_back(at->path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

Shelf::Shelf(fs::path root, const experiment::Language& language, Notice notice)
    : root_(std::move(root)),
      folder_(fs::is_directory(root_) ? fs::canonical(root_)
                                      : fs::canonical(fs::absolute(root_).parent_path())),
      language_(language),
      notice_(std::move(notice)) {
  if (!fs::is_directory(root_)) {
    const fs::path file = folder_ / root_.filename();
    const std::string id = file.filename().string();
    studies_.emplace(id, std::make_shared<ShelvedStudy>(id, file, language_));
  }
  search();  // finds the studies, so that they are available to the first request
  watching_ = std::thread([this] { watch(); });
  replaying_ = std::thread([this] { find_endings(); });
}

Shelf::~Shelf() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  watching_.join();
  replaying_.join();
}

std::vector<std::shared_ptr<ShelvedStudy>> Shelf::studies() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<ShelvedStudy>> all;
  for (const auto& [id, study] : studies_) all.push_back(study);
  return all;
}

std::shared_ptr<ShelvedStudy> Shelf::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = studies_.find(id);
  return found == studies_.end() ? nullptr : found->second;
}

std::shared_ptr<ShelvedStudy> Shelf::open(const std::string& id) {
  const auto study = find(id);
  if (!study) return nullptr;
  {
    const std::lock_guard lock(mutex_);
    looked_at_[id] = steady_clock()();
  }
  if (study->look([](const auto& sight) { return sight.state == StudyState::reading; })) {
    const auto changes = study->refresh(kAtOnce);
    const std::lock_guard lock(mutex_);
    if (changes.any()) untold_.insert(id);
  }
  return study;
}

std::pair<int, int> Shelf::read_so_far() const {
  int done = 0;
  const auto all = studies();
  for (const auto& study : all)
    done += study->look([](const auto& sight) { return sight.state != StudyState::reading; });
  return {done, static_cast<int>(all.size())};
}

void Shelf::look_again() {
  const std::lock_guard lock(mutex_);
  hurries_ = true;
  wake_.notify_all();
}

bool Shelf::search() {
  std::error_code none;
  if (!fs::is_directory(root_, none)) return false;
  std::map<std::string, fs::path> found;
  for (const fs::path& file : find_studies(folder_))
    // The names are those of symbolic links, not of the files they point to.
    found.emplace(file.lexically_relative(folder_).generic_string(), file);
  const std::lock_guard lock(mutex_);
  const std::size_t before = studies_.size();
  const auto gone = std::erase_if(studies_, [&](const auto& one) {
    // While an editor writes a file, it is no valid study for a moment, so only a study whose file
    // is gone is removed.
    return !found.count(one.first) && !fs::is_regular_file(one.second->file(), none);
  });
  for (const auto& [id, file] : found) {
    if (!studies_.count(id))
      studies_.emplace(id, std::make_shared<ShelvedStudy>(id, file, language_));
  }
  return gone > 0 || studies_.size() != before;
}

void Shelf::refresh(ShelvedStudy& study) {
  auto changes = study.refresh(kAtOnce);
  {
    const std::lock_guard lock(mutex_);
    if (untold_.erase(study.id()) > 0) changes = {true, true, true};
  }
  if (changes.any()) notice_(study.id(), changes);
}

bool Shelf::ends() const {
  const std::lock_guard lock(mutex_);
  return ends_;
}

void Shelf::find_endings() {
  while (true) {
    for (const auto& study : studies()) {
      if (study->has_more()) continue;
      const auto changes = study->find_ending();
      if (ends()) return;
      if (changes.any()) notice_(study->id(), changes);
    }
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, std::chrono::seconds(1), [&] { return ends_; });
    if (ends_) return;
  }
}

void Shelf::watch() {
  double all_looked_at = -kSeldom;
  while (true) {
    const double now = steady_clock()();
    const bool looks_at_all = now - all_looked_at >= kSeldom;
    if (looks_at_all) {
      all_looked_at = now;
      if (search()) notice_("", {.of_study = true});
    }
    bool has_more = false;
    for (const auto& study : studies()) {
      const bool is_running =
          study->look([](const auto& sight) { return sight.state == StudyState::running; });
      bool is_watched = is_running || looks_at_all || study->has_more();
      if (ends()) return;
      {
        const std::lock_guard lock(mutex_);
        const auto last = looked_at_.find(study->id());
        is_watched = is_watched || (last != looked_at_.end() && now - last->second < kLookedAt);
      }
      if (!is_watched) continue;
      refresh(*study);
      has_more = has_more || study->has_more();
    }
    std::unique_lock lock(mutex_);
    if (!has_more) wake_.wait_for(lock, kOften, [&] { return ends_ || hurries_; });
    hurries_ = false;
    if (ends_) return;
  }
}

}  // namespace latsch::studio
