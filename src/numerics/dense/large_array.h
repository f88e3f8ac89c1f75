// SPDX-License-Identifier: Apache-2.0
// Memory of many megabytes that is written before it is read: not filled with zeros, and on large
// pages where the system gives them (Linux: it is asked), so that walking through it does not end
// at every fourth kilobyte.
//
// What is given back is kept for whoever asks next, up to a limit: the system would clear every
// page of it again, which costs as much as using it once.
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
  std::size_t bytes;  // what there is of it
};
/// At least `bytes`.
LargeMemory large_memory(std::size_t bytes);

template <class Number>
LargeArray<Number> large_array(std::size_t size) {
  const auto [start, bytes] = large_memory(size * sizeof(Number));
  return LargeArray<Number>(static_cast<Number*>(start), FreeLargeArray{bytes});
}

}  // namespace latsch::numerics
