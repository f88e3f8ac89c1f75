// SPDX-License-Identifier: Apache-2.0
// The studies of a folder and its subfolders, watched by a thread: running and recently opened
// studies several times a second, the others every few seconds. A second thread determines which
// searches have ended, which takes as long as their optimizers need to repeat them from the
// journal.
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
  /// Called by the watching thread after a change; the id "" stands for the list of studies.
  using Notice = std::function<void(const std::string& id, const ShelvedStudy::Changes& changes)>;

  /// `root` is a folder, or the file of one study.
  Shelf(std::filesystem::path root, const experiment::Language& language, Notice notice);
  ~Shelf();
  Shelf(const Shelf&) = delete;
  Shelf& operator=(const Shelf&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  /// Returns the studies in the order of their ids.
  std::vector<std::shared_ptr<ShelvedStudy>> studies() const;
  /// Returns the study with this id; nullptr if there is none.
  std::shared_ptr<ShelvedStudy> find(const std::string& id) const;
  /// Returns the study like find(). From now on the study is checked often for a while; if it was
  /// never read, it is read now.
  std::shared_ptr<ShelvedStudy> open(const std::string& id);
  /// Returns the number of studies that have been read so far, and the total number.
  std::pair<int, int> read_so_far() const;
  /// Makes the watching thread check early, because a study has just been started or changed.
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
  /// s, time of the steady clock at which each study was last opened
  std::map<std::string, double> looked_at_;
  /// studies that a request has read, of which other clients are not notified yet
  std::set<std::string> untold_;
  std::thread watching_, replaying_;
};

/// Returns the study files of a folder and its subfolders, a few levels deep. Hidden entries and
/// folders of builds and packages are skipped. An unreadable TOML file counts as a study if its
/// name is study.toml, so that a typing error does not make the study disappear.
std::vector<std::filesystem::path> find_studies(const std::filesystem::path& folder);

}  // namespace latsch::studio
