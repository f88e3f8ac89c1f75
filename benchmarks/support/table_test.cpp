// SPDX-License-Identifier: Apache-2.0
#include "table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "numerics/kernels/kernel_set.h"

namespace latsch::benchmarks {
namespace {

TEST(BenchmarkTable, FailsWhereOneRowFallsShort) {
  Table table("example");
  table.row("first", "0.1 %", "<= 0.2 %", true);
  EXPECT_EQ(table.exit_code(), 0);
  table.row("second", "0.3 %", "<= 0.2 %", false);
  table.row("third", "0.1 %", "<= 0.2 %", true);
  EXPECT_EQ(table.exit_code(), 1);
}

TEST(BenchmarkTable, FailsWhereNothingWasMeasured) {
  Table table("example");
  table.note("date", "today");
  EXPECT_EQ(table.exit_code(), 1);
}

TEST(BenchmarkTable, PrintsOneLineARowWithFourColumns) {
  testing::internal::CaptureStdout();
  Table table("example");
  table.row("contact \xC3\xA4rea", "1 %", "<= 2 %", true);
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_NE(printed.find("contact \xC3\xA4rea" + std::string(46, ' ') + " | 1 %"),
            std::string::npos);
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 4);
}

TEST(BenchmarkTable, BeginsWithTheProcessorAndTheKernelSet) {
  testing::internal::CaptureStdout();
  Table table("example");
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(printed.starts_with("example on " + processor_name() + ", kernels " +
                                  std::string(name(kernel_set())) + "\n"))
      << printed;
}

TEST(GuardedBenchmark, SaysInWordsWhatStoppedItAndEndsWith2) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(guarded([]() -> int { throw std::runtime_error("study.toml:3: no variable"); }), 2);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("study.toml:3: no variable"),
            std::string::npos);
  EXPECT_EQ(guarded([] { return 1; }), 1);
}

}  // namespace
}  // namespace latsch::benchmarks
