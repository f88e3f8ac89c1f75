// SPDX-License-Identifier: Apache-2.0
// The studies of a folder and of those below it, watched by a thread of its own: what is running or
// was looked at lately several times a second, all else now and then. A second thread finds out
// which searches have ended, which takes as long as their optimizers need.
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
  /// Called from the thread that watches; a study of "" is the list itself.
  using Notice = std::function<void(const std::string& id, const ShelvedStudy::Changes& changes)>;

  /// `root`: a folder, or one study's file.
  Shelf(std::filesystem::path root, const experiment::Language& language, Notice notice);
  ~Shelf();
  Shelf(const Shelf&) = delete;
  Shelf& operator=(const Shelf&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  /// By their ids.
  std::vector<std::shared_ptr<ShelvedStudy>> studies() const;
  /// nullptr where there is none of that id.
  std::shared_ptr<ShelvedStudy> find(const std::string& id) const;
  /// The same; it is looked at often from now on for a while, and read now if it was not yet.
  std::shared_ptr<ShelvedStudy> open(const std::string& id);
  /// How many were read so far, of how many.
  std::pair<int, int> read_so_far() const;
  /// Soon, for a study that has just been started or changed.
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
  std::map<std::string, double> looked_at_;  // s, of the steady clock
  std::set<std::string> untold_;             // read by who opened them, not told to the others
  std::thread watching_, replaying_;
};

/// The study files of a folder and of those below it, few levels deep; what is hidden and folders
/// of builds and packages are passed by. A file that cannot be read as TOML is one where its name
/// is study.toml: so that a typo does not make it vanish.
std::vector<std::filesystem::path> find_studies(const std::filesystem::path& folder);

}  // namespace latsch::studio
