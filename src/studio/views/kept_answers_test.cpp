// SPDX-License-Identifier: Apache-2.0
#include "studio/views/kept_answers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

namespace latsch::studio {
namespace {

TEST(KeptAnswers, AreFoundOnceAndTheOldestGoes) {
  KeptAnswers<std::string, int> kept(2);
  int found = 0;
  const auto ask = [&](const std::string& question) {
    return *kept.get(question, [&] { return ++found; });
  };
  EXPECT_EQ(ask("a"), 1);
  EXPECT_EQ(ask("b"), 2);
  EXPECT_EQ(ask("a"), 1);
  EXPECT_EQ(ask("c"), 3);
  EXPECT_EQ(ask("b"), 2);
  EXPECT_EQ(ask("a"), 4);
}

TEST(KeptAnswers, ATroubleIsThrownAndNotKept) {
  KeptAnswers<int, int> kept(2);
  EXPECT_THROW(kept.get(1, []() -> int { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_EQ(*kept.get(1, [] { return 5; }), 5);
}

// One thread is kept busy computing an answer. A request for another answer does not wait; a
// request for the same answer receives the result of that computation.
TEST(KeptAnswers, OneThatTakesLongHoldsUpNoOther) {
  KeptAnswers<int, int> kept(4);
  std::promise<void> begun, go_on;
  std::atomic<int> found = 0;
  std::thread slow([&] {
    kept.get(1, [&] {
      begun.set_value();
      go_on.get_future().wait();
      return ++found;
    });
  });
  begun.get_future().wait();
  EXPECT_EQ(*kept.get(2, [] { return 7; }), 7);
  int same = 0;
  std::thread waiting([&] { same = *kept.get(1, [&] { return ++found; }); });
  go_on.set_value();
  slow.join();
  waiting.join();
  EXPECT_EQ(same, 1);
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace latsch::studio
