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
constexpr std::size_t kSmallestKept = 2 * kPage;         // less is the allocator's own to keep
constexpr std::size_t kMostKept = std::size_t{1} << 28;  // bytes in all
constexpr std::size_t kMostWasted = 2;  // times what is asked for: larger memory is not given

struct Memory {
  void* start;
  std::size_t bytes;
};

/// What was given back, the oldest first.
class Kept {
 public:
  /// The smallest that has at least `bytes`, and not far more; {nullptr, 0} where there is none.
  Memory take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    auto best = all_.end();
    for (auto memory = all_.begin(); memory != all_.end(); ++memory) {
      const bool fits = memory->bytes >= bytes && memory->bytes / kMostWasted <= bytes;
      if (fits && (best == all_.end() || memory->bytes < best->bytes)) best = memory;
    }
    if (best == all_.end()) return {nullptr, 0};
    const Memory found = *best;
    all_.erase(best);
    bytes_ -= found.bytes;
    return found;
  }

  void put(const Memory& memory) {
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
  std::vector<Memory> all_;
  std::size_t bytes_ = 0;
};

/// Never destroyed: static objects may give back after it would be.
Kept& kept() {
  static Kept* const all = new Kept;
  return *all;
}

}  // namespace

void* large_memory(std::size_t& bytes) {
  if (bytes >= kSmallestKept) {
    if (const Memory found = kept().take(bytes); found.start != nullptr) {
      bytes = found.bytes;
      return found.start;
    }
  }
  const std::size_t step = bytes >= kSmallestKept ? kPage : kLine;
  bytes = (bytes + step) / step * step;
  void* memory = std::aligned_alloc(step, bytes);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (step == kPage) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish
#endif
  return memory;
}

void FreeLargeArray::operator()(void* memory) const {
  if (bytes >= kSmallestKept) {
    kept().put({memory, bytes});
  } else {
    std::free(memory);
  }
}

}  // namespace latsch::numerics
