// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/large_array.h"

#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace latsch::numerics {

void* large_memory(std::size_t bytes) {
  constexpr std::size_t kPage = std::size_t{1} << 21, kLine = 64;
  const std::size_t step = bytes >= 2 * kPage ? kPage : kLine;
  const std::size_t size = (bytes + step) / step * step;
  void* memory = std::aligned_alloc(step, size);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (step == kPage) madvise(memory, size, MADV_HUGEPAGE);  // a wish
#endif
  return memory;
}

void FreeLargeArray::operator()(void* memory) const { std::free(memory); }

}  // namespace latsch::numerics
