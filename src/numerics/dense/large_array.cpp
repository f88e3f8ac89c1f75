// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/large_array.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace latsch::numerics {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21, kLine = 64;
// Bytes; smaller arrays come from the allocator.
constexpr std::size_t kSmallestKept = 2 * kPage;
constexpr std::size_t kMostKept = std::size_t{1} << 28;  // largest total size of kept blocks, bytes
constexpr std::size_t kMostWasted = 2;  // largest ratio of kept to requested size for reuse

/// Blocks of memory that were freed and are kept for reuse, the oldest first.
class Kept {
 public:
  /// Takes the smallest kept block that has at least `bytes` and is not much larger; returns
  /// {nullptr, 0} if there is none.
  LargeMemory take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    auto best = all_.end();
    for (auto memory = all_.begin(); memory != all_.end(); ++memory) {
      const bool fits = memory->bytes >= bytes && memory->bytes / kMostWasted <= bytes;
      if (fits && (best == all_.end() || memory->bytes < best->bytes)) best = memory;
    }
    if (best == all_.end()) return {nullptr, 0};
    const LargeMemory found = *best;
    all_.erase(best);
    bytes_ -= found.bytes;
    return found;
  }

  void put(const LargeMemory& memory) {
    const std::lock_guard lock(mutex_);
    all_.push_back(memory);
    bytes_ += memory.bytes;
    while (bytes_ > kMostKept) {
      std::free(all_.front().start);
      bytes_ -= all_.front().bytes;
      all_.erase(all_.begin());
    }
  }

 private:
  std::mutex mutex_;
  std::vector<LargeMemory> all_;
  std::size_t bytes_ = 0;
};

/// The list of kept memory is never destroyed, because other static objects may free memory while
/// the program ends.
Kept& kept() {
  static Kept* const all = new Kept;
  return *all;
}

}  // namespace

LargeMemory large_memory(std::size_t bytes) {
  if (bytes >= kSmallestKept) {
    const LargeMemory found = kept().take(bytes);
    if (found.start != nullptr) return found;
  }
  const std::size_t step = bytes >= kSmallestKept ? kPage : kLine;
  const std::size_t size = (bytes + step) / step * step;
  void* memory = std::aligned_alloc(step, size);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (step == kPage) madvise(memory, size, MADV_HUGEPAGE);  // only a hint: a failure does no harm
#endif
  return {memory, size};
}

void FreeLargeArray::operator()(void* memory) const {
  if (bytes >= kSmallestKept) {
    kept().put({memory, bytes});
  } else {
    std::free(memory);
  }
}

}  // namespace latsch::numerics
