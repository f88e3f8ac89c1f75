// SPDX-License-Identifier: Apache-2.0
// Opens a journal's file for reading, also while another process writes it.
//
// SQLite reads a file with a write-ahead log only if it can create the memory that readers and
// writers share, which is a file beside it. A journal in a read-only folder is therefore opened
// differently: without a log, as a file that never changes; with a log left by a process that ended
// early, as a copy in the folder for temporary files.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>

namespace latsch {

/// Opens the file for reading. `patience` is the time to wait for a writer, ms. Throws
/// SQLite::Exception.
std::unique_ptr<SQLite::Database> open_for_reading(const std::filesystem::path& file, int patience);

/// True if this process may write the journal: both the file and its folder, which holds the logs.
bool may_be_written(const std::filesystem::path& file);

}  // namespace latsch
