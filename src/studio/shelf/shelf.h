// SPDX-License-Identifier: Apache-2.0
// The studies of a folder and its subfolders, watched by a thread: running and recently opened
// studies several times a second, the others now and then. A second thread determines which
// searches have ended, which takes as long as their optimizers need.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "studio/shelf/shelved_study.h"

namespace latsch::studio {

class Shelf {
 public:
  /// Called by the watching thread; the study "" means the list itself.
  using Notice = std::function<void(const std::string& id, const ShelvedStudy::Changes& changes)>;

  /// `root` is a folder, or one study's file.
  Shelf(std::filesystem::path root, const experiment::Language& language, Notice notice);
  ~Shelf();
  Shelf(const Shelf&) = delete;
  Shelf& operator=(const Shelf&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  /// Returns the studies sorted by their ids.
  std::vector<std::shared_ptr<ShelvedStudy>> studies() const;
  /// Returns nullptr if there is none with that id.
  std::shared_ptr<ShelvedStudy> find(const std::string& id) const;
  /// Returns the study as find() does. The study is checked often for a while, and read now if it
  /// was not read yet.
  std::shared_ptr<ShelvedStudy> open(const std::string& id);
  /// Returns the number of studies read so far and the total number.
  std::pair<int, int> read_so_far() const;
  /// Triggers an early check, for a study that has just been started or changed.
  void look_again();

 private:
  void watch();
  void find_endings();
  bool ends() const;
  bool search();
  void refresh(ShelvedStudy& study);

  std::filesystem::path root_, folder_;
  const experiment::Language& language_;
  Notice notice_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false, hurries_ = false;
  std::map<std::string, std::shared_ptr<ShelvedStudy>> studies_;
  std::map<std::string, double> looked_at_;  // s, on the steady clock
  std::set<std::string> untold_;             // read by a request, other clients not yet notified
  std::thread watching_, replaying_;
};

/// Returns the study files of a folder and its subfolders, a few levels deep. Hidden entries and
/// folders of builds and packages are skipped. An unreadable TOML file counts as a study if its
/// name is study.toml, so that a typo does not make it vanish.
std::vector<std::filesystem::path> find_studies(const std::filesystem::path& folder);

}  // namespace latsch::studio
