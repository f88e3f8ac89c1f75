// SPDX-License-Identifier: Apache-2.0
#include "numerics/kernels/kernel_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch {
namespace {

std::string refusal(const char* forced) {
  try {
    chosen_kernel_set(forced);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(KernelSet, TheBestThereIsOrTheOneAskedFor) {
  EXPECT_EQ(kernel_sets().front(), KernelSet::baseline);
  EXPECT_EQ(chosen_kernel_set(nullptr), kernel_sets().back());
  EXPECT_EQ(chosen_kernel_set(""), kernel_sets().back());
  for (const KernelSet set : kernel_sets())
    EXPECT_EQ(chosen_kernel_set(std::string(name(set)).c_str()), set);
}

TEST(KernelSet, AnUnknownNameIsRefusedWithTheNamesThereAre) {
  EXPECT_THAT(refusal("avx"),
              testing::HasSubstr("LATSCH_KERNELS is \"avx\", expected one of: base"));
  EXPECT_THAT(refusal("AVX2"), testing::HasSubstr("\"AVX2\""));
}

TEST(KernelSet, ASetTheProcessorLacksIsRefusedWithItsName) {
  if (kernel_sets().back() == KernelSet::avx512) GTEST_SKIP() << "this processor has all sets";
  EXPECT_THAT(refusal("avx512"), testing::HasSubstr("does not have"));
  EXPECT_THAT(refusal("avx512"), testing::HasSubstr(processor_name()));
}

TEST(KernelSet, AnotherSetForAWhile) {
  const KernelSet before = kernel_set();
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    EXPECT_EQ(kernel_set(), set);
  }
  EXPECT_EQ(kernel_set(), before);
}

}  // namespace
}  // namespace latsch
