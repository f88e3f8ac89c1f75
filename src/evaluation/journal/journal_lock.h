// SPDX-License-Identifier: Apache-2.0
// One writer a journal: an advisory lock on a file beside it that names the process that holds it.
// The system releases it when that process ends, however it ends.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace latsch {

/// Who writes a journal.
struct JournalHolder {
  std::string words;           // "process 4711 on lab7 since 2026-03-01 10:12:44 UTC"
  std::optional<int> process;  // of this machine; nullopt: of another one, or not told
};

class JournalLock {
 public:
  /// Waits a moment for what a killed process leaves, a child of it that has yet to become another
  /// program. Throws InputError naming the holder, with its machine, where another process (or
  /// another Journal of this one) has it, or the reason where the file system gives no locks.
  explicit JournalLock(const std::filesystem::path& journal);
  ~JournalLock();
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;

 private:
  std::filesystem::path file_;
  int fd_ = -1;
};

/// Looked up without taking the lock even for a moment: who opens the journal meanwhile is not in
/// the way. nullopt where nobody holds it. A holder on another machine is one whose name stands in
/// the file.
std::optional<JournalHolder> journal_holder(const std::filesystem::path& journal);

}  // namespace latsch
