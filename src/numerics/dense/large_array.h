// SPDX-License-Identifier: Apache-2.0
// Memory of many megabytes that is written before it is read. It is not filled with zeros. It is on
// large pages if the system grants them (requested on Linux), so that reading through it does not
// cause a page miss every four kilobytes.
//
// Freed memory is kept for the next request, up to a limit: the system would fill every page with
// zeros again, which costs as much as using it once.
#pragma once

#include <cstddef>
#include <memory>

namespace latsch::numerics {

struct FreeLargeArray {
  std::size_t bytes = 0;
  void operator()(void* memory) const;
};

template <class Number>
using LargeArray = std::unique_ptr<Number[], FreeLargeArray>;

struct LargeMemory {
  void* start;
  std::size_t bytes;  // actual size
};
/// Returns memory of at least `bytes`.
LargeMemory large_memory(std::size_t bytes);

template <class Number>
LargeArray<Number> large_array(std::size_t size) {
  const auto [start, bytes] = large_memory(size * sizeof(Number));
  return LargeArray<Number>(static_cast<Number*>(start), FreeLargeArray{bytes});
}

}  // namespace latsch::numerics
