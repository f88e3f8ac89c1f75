// SPDX-License-Identifier: Apache-2.0
// One writer a journal: an advisory lock on a file beside it that names the process that holds it.
// The system releases it when that process ends, however it ends.
#pragma once

#include <filesystem>

namespace latsch {

class JournalLock {
 public:
  /// Throws InputError naming the holder, with its machine, where another process (or another
  /// Journal of this one) has it, or the reason where the file system gives no locks.
  explicit JournalLock(const std::filesystem::path& journal);
  ~JournalLock();
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;

 private:
  std::filesystem::path file_;
  int fd_ = -1;
};

}  // namespace latsch
