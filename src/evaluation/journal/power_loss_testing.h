// SPDX-License-Identifier: Apache-2.0
// Test support: simulates a disk under SQLite whose power fails. Data that was written but not
// synced may be lost, in parts and out of order.
//
// SQLite accesses files through a VFS [sqlite.org/vfs.html]. This VFS passes all calls on to the
// usual one but records every write since the last sync of its file. When the power fails, all
// calls fail. When it returns, a file contains the synced data and a random choice of the sectors
// (512 bytes) written since, a few of them only up to a byte in the middle. A file whose folder was
// never synced may not exist; a file that was removed without a sync may exist again. Syncs do not
// wait for anything.
//
// A disk that acknowledges a sync falsely, and changes of neighboring sectors, are not simulated.
#pragma once

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"

namespace latsch {

class PowerLoss {
 public:
  /// While the object exists, it acts as the file system of all databases that are opened. The
  /// power fails at the operation with number `fails_at`, counted from 1; writes, truncations,
  /// syncs and removals count as operations.
  PowerLoss(std::uint64_t seed, long fails_at)
      : random_(seed, 7), fails_at_(fails_at), usual_(sqlite3_vfs_find(nullptr)), vfs_(*usual_) {
    vfs_.zName = "power_loss";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + usual_->szOsFile;
    vfs_.pAppData = this;
    vfs_.pNext = nullptr;
    vfs_.xOpen = open;
    vfs_.xDelete = remove;
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~PowerLoss() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(usual_, 1);
  }
  PowerLoss(const PowerLoss&) = delete;
  PowerLoss& operator=(const PowerLoss&) = delete;

  /// Makes the power fail now.
  void fail() { failed_ = true; }
  bool failed() const { return failed_; }
  long operations() const { return operations_; }
  /// Returns the number of sectors that were lost when the power failed last.
  long sectors_lost() const { return sectors_lost_; }

  /// Reduces the files to the data that the disk has kept. Must be called when no database is open
  /// any more.
  void come_back() {
    for (auto& [path, image] : images_) {
      std::filesystem::remove(path + "-shm");  // file that SQLite uses as shared memory
      const bool exists =
          image.removed ? random_.uniform() < 0.5 : image.entered || random_.uniform() < 0.5;
      if (!exists) {
        std::filesystem::remove(path);
        continue;
      }
      const std::string kept = survivors(image);
      std::ofstream(path, std::ios::binary | std::ios::trunc).write(kept.data(), std::ssize(kept));
    }
    images_.clear();
  }

 private:
  static constexpr long kSector = 512;

  struct Change {
    long offset;
    std::string bytes;
    bool is_end = false;  // true if the file ends at `offset`
  };
  struct Image {
    std::string synced;
    std::vector<Change> since;
    bool entered = false;  // true if the folder was synced after the file was created
    bool removed = false;
  };
  /// SQLite's handle of an open file. The handle of the usual VFS follows it in memory.
  struct File {
    sqlite3_file base;
    PowerLoss* disk;
    Image* image;  // nullptr for a temporary file, which is not simulated
    sqlite3_file* usual() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };

  static File& file_of(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }
  static sqlite3_file* usual(sqlite3_file* file) { return file_of(file).usual(); }

  /// Counts an operation. Returns false if the power has failed.
  bool counted() {
    if (++operations_ >= fails_at_) failed_ = true;
    return !failed_;
  }

  void synced(Image& image) {
    for (const Change& change : image.since) apply(image.synced, change);
    image.since.clear();
    for (auto entry = images_.begin(); entry != images_.end();) {
      entry->second.entered = true;
      entry = entry->second.removed ? images_.erase(entry) : std::next(entry);
    }
  }

  static void apply(std::string& content, const Change& change) {
    if (change.is_end) return content.resize(static_cast<std::size_t>(change.offset));
    const auto end = static_cast<std::size_t>(change.offset) + change.bytes.size();
    if (content.size() < end) content.resize(end);
    content.replace(static_cast<std::size_t>(change.offset), change.bytes.size(), change.bytes);
  }

  std::string survivors(const Image& image) {
    constexpr double kTorn = 0.05;
    const double share = std::clamp(2.0 * random_.uniform() - 0.5, 0.0, 1.0);  // all, none, some
    std::string content = image.synced;
    for (const Change& change : image.since) {
      if (change.is_end) {
        if (random_.uniform() < share) apply(content, change);
        continue;
      }
      const long size = std::ssize(change.bytes);
      for (long at = 0; at < size;) {
        const long length = std::min(kSector - (change.offset + at) % kSector, size - at);
        const bool torn = random_.uniform() < kTorn;
        const long kept = random_.uniform() >= share ? 0
                          : torn
                              ? static_cast<long>(random_.below(static_cast<std::uint64_t>(length)))
                              : length;
        sectors_lost_ += kept < length;
        if (kept > 0) apply(content, {change.offset + at, change.bytes.substr(at, kept)});
        at += length;
      }
    }
    return content;
  }

  static int open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out) {
    auto& disk = *static_cast<PowerLoss*>(vfs->pAppData);
    File& opened = file_of(file);
    /// SQLite does not close a file without methods.
    opened.base.pMethods = nullptr;
    if (disk.failed_) return SQLITE_CANTOPEN;
    const bool is_new = !name || !std::filesystem::exists(name);
    opened.disk = &disk;
    const int result = disk.usual_->xOpen(disk.usual_, name, opened.usual(), flags, out);
    if (result != SQLITE_OK) return result;
    opened.image = nullptr;
    if (name) {
      const auto [entry, first] = disk.images_.try_emplace(name);
      opened.image = &entry->second;
      if (opened.image->removed) *opened.image = {};
      if (first && !is_new) {
        std::ifstream content(name, std::ios::binary);
        opened.image->synced = std::string{std::istreambuf_iterator<char>(content), {}};
        opened.image->entered = true;
      }
    }
    opened.base.pMethods = &kMethods;
    return SQLITE_OK;
  }

  static int remove(sqlite3_vfs* vfs, const char* name, int sync_folder) {
    auto& disk = *static_cast<PowerLoss*>(vfs->pAppData);
    if (!disk.counted()) return SQLITE_IOERR_DELETE;
    const auto entry = disk.images_.find(name);
    if (entry != disk.images_.end()) {
      entry->second.removed = true;
      entry->second.since.clear();
      if (sync_folder) disk.images_.erase(entry);
    }
    return disk.usual_->xDelete(disk.usual_, name, 0);
  }

  static int close(sqlite3_file* file) { return usual(file)->pMethods->xClose(usual(file)); }
  static int read(sqlite3_file* file, void* to, int size, sqlite3_int64 offset) {
    if (file_of(file).disk->failed_) return SQLITE_IOERR_READ;
    return usual(file)->pMethods->xRead(usual(file), to, size, offset);
  }
  static int write(sqlite3_file* file, const void* from, int size, sqlite3_int64 offset) {
    File& f = file_of(file);
    const bool powered = !f.disk->failed_;
    const bool done = f.disk->counted();
    if (powered && f.image) {  // includes the write during which the power fails
      f.image->since.push_back(
          {offset, std::string(static_cast<const char*>(from), static_cast<std::size_t>(size))});
    }
    if (!done) return SQLITE_IOERR_WRITE;
    return usual(file)->pMethods->xWrite(usual(file), from, size, offset);
  }
  static int truncate(sqlite3_file* file, sqlite3_int64 size) {
    File& f = file_of(file);
    if (!f.disk->counted()) return SQLITE_IOERR_TRUNCATE;
    if (f.image) f.image->since.push_back({size, {}, true});
    return usual(file)->pMethods->xTruncate(usual(file), size);
  }
  static int sync(sqlite3_file* file, int) {
    File& f = file_of(file);
    if (!f.disk->counted()) return SQLITE_IOERR_FSYNC;
    if (f.image) f.disk->synced(*f.image);
    return SQLITE_OK;
  }
  static int size(sqlite3_file* file, sqlite3_int64* size) {
    return usual(file)->pMethods->xFileSize(usual(file), size);
  }
  static int lock(sqlite3_file* file, int kind) {
    return usual(file)->pMethods->xLock(usual(file), kind);
  }
  static int unlock(sqlite3_file* file, int kind) {
    return usual(file)->pMethods->xUnlock(usual(file), kind);
  }
  static int check_lock(sqlite3_file* file, int* out) {
    return usual(file)->pMethods->xCheckReservedLock(usual(file), out);
  }
  static int control(sqlite3_file* file, int what, void* argument) {
    return usual(file)->pMethods->xFileControl(usual(file), what, argument);
  }
  static int sector_size(sqlite3_file* file) {
    return usual(file)->pMethods->xSectorSize(usual(file));
  }
  static int characteristics(sqlite3_file* file) {
    return usual(file)->pMethods->xDeviceCharacteristics(usual(file));
  }
  static int map(sqlite3_file* file, int page, int size, int extend, void volatile** to) {
    return usual(file)->pMethods->xShmMap(usual(file), page, size, extend, to);
  }
  static int map_lock(sqlite3_file* file, int offset, int count, int flags) {
    return usual(file)->pMethods->xShmLock(usual(file), offset, count, flags);
  }
  static void barrier(sqlite3_file* file) { usual(file)->pMethods->xShmBarrier(usual(file)); }
  static int unmap(sqlite3_file* file, int remove) {
    return usual(file)->pMethods->xShmUnmap(usual(file), remove);
  }
  static const sqlite3_io_methods kMethods;

  RandomStream random_;
  long fails_at_;
  sqlite3_vfs* usual_;
  sqlite3_vfs vfs_;
  bool failed_ = false;
  long operations_ = 0;
  long sectors_lost_ = 0;
  std::map<std::string, Image> images_;  // synced data and later writes of each path
};

// There are no methods for mapped files, because writes to mapped memory would not be noticed.
inline const sqlite3_io_methods PowerLoss::kMethods{2,
                                                    close,
                                                    read,
                                                    write,
                                                    truncate,
                                                    sync,
                                                    size,
                                                    lock,
                                                    unlock,
                                                    check_lock,
                                                    control,
                                                    sector_size,
                                                    characteristics,
                                                    map,
                                                    map_lock,
                                                    barrier,
                                                    unmap,
                                                    nullptr,
                                                    nullptr};

}  // namespace latsch
