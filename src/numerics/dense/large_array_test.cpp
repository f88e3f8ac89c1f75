// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/large_array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>

namespace latsch::numerics {
namespace {

TEST(LargeArray, HoldsWhatIsWrittenAndStandsWhereVectorsCanBeLoaded) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, std::size_t{3} << 20}) {
    const LargeArray<double> array = large_array<double>(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.get()) % 64, 0u);
    array[0] = 1.0;
    array[size - 1] = 2.0;
    EXPECT_EQ(array[size - 1], 2.0);
    EXPECT_EQ(array[0], size == 1 ? 2.0 : 1.0);
  }
}

TEST(LargeArray, GivesAgainWhatWasGivenBackToWhomItFits) {
  const std::size_t size = std::size_t{17} << 20;
  const void* const first = large_array<float>(size).get();
  const LargeArray<float> same = large_array<float>(size - 1000);
  EXPECT_EQ(same.get(), first);
  const LargeArray<float> other = large_array<float>(size);
  EXPECT_NE(other.get(), first);
}

TEST(LargeArray, SaysThatThereIsNoSuchMemory) {
  EXPECT_THROW(large_memory(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

}  // namespace
}  // namespace latsch::numerics
