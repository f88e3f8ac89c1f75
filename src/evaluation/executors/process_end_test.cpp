// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/process_end.h"

#include <gtest/gtest.h>

#include <csignal>

namespace latsch {
namespace {

constexpr int exited(int code) { return code << 8; }  // exit status as encoded by Linux

TEST(ProcessEnd, TellsCodeSignalAndTheLastLinePrinted) {
  EXPECT_EQ(how_it_ended(exited(0), ""), "exited with code 0");
  EXPECT_EQ(how_it_ended(exited(3), " \n\r\n"), "exited with code 3");
  EXPECT_EQ(how_it_ended(exited(3), "one\n  two \r\n\n"),
            "exited with code 3; it last printed \"two\"");
  EXPECT_EQ(how_it_ended(exited(3), "one"), "exited with code 3; it last printed \"one\"");
  EXPECT_EQ(how_it_ended(SIGKILL, "one\n"),
            "was killed by signal 9 (Killed); it last printed \"one\"");
}

}  // namespace
}  // namespace latsch
