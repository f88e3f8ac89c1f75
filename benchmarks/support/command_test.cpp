// SPDX-License-Identifier: Apache-2.0
#include "command.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace latsch::benchmarks {
namespace {

std::string words_of_failure(const std::string& command) {
  try {
    (void)run_command(command);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it succeeded";
}

TEST(Command, ReturnsWhatItPrintedToBoth) {
  const Printed printed = run_command("echo answer; echo progress >&2");
  EXPECT_EQ(printed.output, "answer\n");
  EXPECT_EQ(printed.errors, "progress\n");
}

TEST(Command, AFailureHasItsExitCodeAndTheProgramsOwnWords) {
  const std::string words =
      words_of_failure("echo '{\"status\": 1}'; echo no room left >&2; exit 3");
  EXPECT_NE(words.find("exit code 3"), std::string::npos) << words;
  EXPECT_NE(words.find("no room left"), std::string::npos) << words;
  EXPECT_NE(words.find("{\"status\": 1}"), std::string::npos) << words;
}

TEST(Command, ASignalAndALongOutputAreToldToo) {
  EXPECT_NE(words_of_failure("kill -9 $$").find("Killed"), std::string::npos);
  const std::string words = words_of_failure("seq 100000 >&2; echo the last line >&2; false");
  EXPECT_NE(words.find("the last line"), std::string::npos);
  EXPECT_LT(words.size(), 5000u);
}

}  // namespace
}  // namespace latsch::benchmarks
