// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/duration_limit.h"

#include <gtest/gtest.h>

#include <regex>

#include "base/error.h"
#include "experiment/language.h"
#include "experiment/language/key_section.h"

namespace latsch::experiment {
namespace {

std::string complaint_about_test(const std::string& keys) {
  try {
    language().read_test(Document::parse(keys, "test.toml").root(), {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Reads each sample of each kind of test with the times of `which` set to `time`, one at a time,
/// and expects that none is accepted. Samples that name files are left out.
void expect_refused(const std::regex& which, const std::string& time, std::size_t least) {
  std::size_t tried = 0;
  for (const TestKind* kind : language().tests) {
    if (!kind->keys) continue;
    for (const std::string& sample : kind->keys().samples) {
      if (!complaint_about_test(sample).empty()) continue;
      for (std::sregex_iterator at(sample.begin(), sample.end(), which), end; at != end; ++at) {
        const auto begin = static_cast<std::size_t>(at->position());
        const auto behind = begin + static_cast<std::size_t>(at->length());
        const std::string whole =
            sample.substr(0, begin) + at->str(1) + " = \"" + time + "\"\n" + sample.substr(behind);
        EXPECT_NE(complaint_about_test(whole), "") << kind->name << ":\n" << whole;
        ++tried;
      }
    }
  }
  EXPECT_GE(tried, least);
}

// A slip_sweep with run_in = "1e17 s" once ran without it, and with such a duration it recorded
// nothing: the steps of both are no 64-bit integer.
TEST(DurationLimit, NoTestTakesATimeThatDoesNotEnd) {
  const std::regex any(R"(\b(\w+) = "[\d.]+ m?s"\n)");
  for (const char* time : {"1e9 s", "1e17 s", "1e300 s"}) expect_refused(any, time, 10);
}

TEST(DurationLimit, NoTestTakesAStepThatDoesNotMoveOn) {
  const std::regex steps(R"(\b(step|sample_step|duration) = "[\d.]+ m?s"\n)");
  for (const char* time : {"1e-17 s", "1e-300 s"}) expect_refused(steps, time, 8);
}

TEST(DurationLimit, SaysHowManyStepsAreAsked) {
  const std::string said = complaint_about_test(
      "kind = \"slip_sweep\"\nspeed = \"20 m/s\"\nload = \"4 kN\"\nalpha = [\"0 deg\", \"5 deg\"]\n"
      "duration = \"11 h\"\nstep = \"1 ms\"\n");
  EXPECT_NE(said.find("duration makes the test last 3.96e+04 s, which is 3.96e+07 steps of 1 ms"),
            said.npos)
      << said;
}

}  // namespace
}  // namespace latsch::experiment
