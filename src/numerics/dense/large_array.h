// SPDX-License-Identifier: Apache-2.0
// Memory of many megabytes that is written before it is read: not filled with zeros, and on large
// pages where the system gives them (Linux: it is asked), so that walking through it does not end
// at every fourth kilobyte.
#pragma once

#include <cstddef>
#include <memory>

namespace latsch::numerics {

struct FreeLargeArray {
  void operator()(void* memory) const;
};

template <class Number>
using LargeArray = std::unique_ptr<Number[], FreeLargeArray>;

void* large_memory(std::size_t bytes);

template <class Number>
LargeArray<Number> large_array(std::size_t size) {
  return LargeArray<Number>(static_cast<Number*>(large_memory(size * sizeof(Number))));
}

}  // namespace latsch::numerics
