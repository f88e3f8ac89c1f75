// SPDX-License-Identifier: Apache-2.0
#include "table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/kernels/kernel_set.h"

namespace latsch::benchmarks {
namespace {

Options full_run() { return Options("bench_example", {}); }
Options smoke_run() { return Options("bench_example", {"--smoke"}); }

TEST(BenchmarkTable, FailsWhereOneRowFallsShort) {
  Table table("example", full_run());
  table.row("first", "0.1 %", "<= 0.2 %", true);
  EXPECT_EQ(table.exit_code(), 0);
  table.row("second", "0.3 %", "<= 0.2 %", false);
  table.row("third", "0.1 %", "<= 0.2 %", true);
  EXPECT_EQ(table.exit_code(), 1);
}

TEST(BenchmarkTable, FailsWhereNothingWasMeasured) {
  Table table("example", full_run());
  table.note("date", "today");
  EXPECT_EQ(table.exit_code(), 1);
}

TEST(BenchmarkTable, PrintsOneLineARowWithFourColumns) {
  testing::internal::CaptureStdout();
  Table table("example", full_run());
  table.row("contact \xC3\xA4rea", "1 %", "<= 2 %", true);
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_NE(printed.find("contact \xC3\xA4rea" + std::string(46, ' ') + " | 1 %"),
            std::string::npos);
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 4);
}

TEST(BenchmarkTable, BeginsWithTheProcessorAndTheKernelSet) {
  testing::internal::CaptureStdout();
  Table table("example", full_run());
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(printed.starts_with("example on " + processor_name() + ", kernels " +
                                  std::string(name(kernel_set())) + "\n"))
      << printed;
}

TEST(BenchmarkTable, JudgesTimesInTheFullRunAlone) {
  for (const bool is_smoke : {false, true}) {
    Table table("example", is_smoke ? smoke_run() : full_run());
    table.full_row("time", "3 s", "<= 2 s", false);
    EXPECT_EQ(table.exit_code(), is_smoke ? 0 : 1);
    table.row("bits", "differ", "same", false);
    EXPECT_EQ(table.exit_code(), 1);
  }
}

TEST(BenchmarkTable, TellsWhatIsSkippedFromWhatFails) {
  Table smoke("example", smoke_run()), full("example", full_run());
  for (Table* table : {&smoke, &full}) {
    table->row("decks", "0.1 %", "<= 0.2 %", true);
    table->skip("CalculiX", "no ccx on the path");
  }
  EXPECT_EQ(smoke.exit_code(), Table::kSkipped);
  EXPECT_EQ(full.exit_code(), 1);
  smoke.row("decks", "0.3 %", "<= 0.2 %", false);
  EXPECT_EQ(smoke.exit_code(), 1);
}

TEST(BenchmarkTable, NamesASmokeRun) {
  testing::internal::CaptureStdout();
  Table table("example", smoke_run());
  EXPECT_TRUE(testing::internal::GetCapturedStdout().starts_with("example, smoke run on "));
}

}  // namespace
}  // namespace latsch::benchmarks
