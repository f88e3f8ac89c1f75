// SPDX-License-Identifier: Apache-2.0
// A journal's file opened for reading, whoever may write it.
//
// SQLite reads a file with a write-ahead log only if it can make the memory that readers and
// writers share, which is a file beside it. So a journal in a folder that may not be written is
// opened otherwise: if it has no log, as a file that never changes; if the process that wrote it
// ended before the log was taken in, as a copy in the folder for temporary files.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>

namespace latsch {

/// `patience`: ms, for which a writer is waited for. Throws SQLite::Exception.
std::unique_ptr<SQLite::Database> open_for_reading(const std::filesystem::path& file, int patience);

/// Whether this process may write the journal: the file, and its folder, where its logs stand.
bool may_be_written(const std::filesystem::path& file);

}  // namespace latsch
