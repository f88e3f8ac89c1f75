// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch::benchmarks {
namespace {

const std::vector<Option> kKnown = {{"CARS", "", "how many"},
                                    {"--draws", "N", "how often"},
                                    {"SEED", "", "of chance"},
                                    {"--alone", "", "without the program"}};

Options parsed(const std::vector<std::string>& arguments) {
  return Options("bench_example", arguments, kKnown);
}

std::string complaint(const std::vector<std::string>& arguments) {
  try {
    parsed(arguments);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(BenchmarkOptions, KnowSmokeWithoutBeingToldOfIt) {
  EXPECT_TRUE(Options("bench_example", {"--smoke"}).is_smoke());
  EXPECT_EQ(Options("bench_example", {"--smoke"}).size(100, 2), 2);
  EXPECT_EQ(Options("bench_example", {}).size(100, 2), 100);
}

TEST(BenchmarkOptions, ReadValuesByNameAndByPlaceInAnyOrder) {
  const Options options = parsed({"--draws", "5", "1000", "--alone", "7"});
  EXPECT_EQ(options.integer("CARS", 0), 1000);
  EXPECT_EQ(options.integer("SEED", 0), 7);
  EXPECT_EQ(options.integer("--draws", 0), 5);
  EXPECT_TRUE(options.has("--alone"));
  EXPECT_FALSE(options.is_smoke());
  EXPECT_EQ(parsed({}).text("CARS", "none"), "none");
  EXPECT_EQ(parsed({"1e3"}).number("CARS", 0.0), 1000.0);
}

TEST(BenchmarkOptions, NameWhatTheyDoNotKnowAndWhatThereIs) {
  EXPECT_NE(complaint({"--smok"}).find("\"--smok\" is not known"), std::string::npos);
  EXPECT_NE(complaint({"--smok"}).find("--smoke"), std::string::npos);
  EXPECT_NE(complaint({"1", "2", "3"}).find("\"3\" is not known"), std::string::npos);
  EXPECT_NE(complaint({"--draws"}).find("--draws needs N"), std::string::npos);
}

TEST(BenchmarkOptions, RefuseWhatIsNoNumber) {
  EXPECT_THROW(parsed({"many"}).integer("CARS", 0), InputError);
  EXPECT_THROW(parsed({"-3"}).integer("CARS", 0), InputError);
  EXPECT_THROW(parsed({"3.5"}).integer("CARS", 0), InputError);
  EXPECT_THROW(parsed({"nan"}).number("CARS", 0.0), InputError);
}

TEST(RunBenchmark, SaysInWordsWhatStoppedItAndEndsWith2) {
  char program[] = "bench_example", smoke[] = "--smoke", wrong[] = "--wrong";
  char* good[] = {program, smoke};
  char* bad[] = {program, wrong};
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_benchmark(2,
                          good,
                          {},
                          [](const Options&) -> int {
                            throw std::runtime_error("study.toml:3: no variable");
                          }),
            2);
  EXPECT_EQ(run_benchmark(2, bad, {}, [](const Options&) { return 0; }), 2);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("study.toml:3: no variable"), std::string::npos);
  EXPECT_NE(said.find("--wrong"), std::string::npos);
  EXPECT_EQ(run_benchmark(2, good, {}, [](const Options& o) { return o.is_smoke() ? 1 : 0; }), 1);
}

}  // namespace
}  // namespace latsch::benchmarks
