// SPDX-License-Identifier: Apache-2.0
#include "studio/http/event_queue.h"

#include <gtest/gtest.h>

namespace latsch::studio {
namespace {

EventText text(std::string_view letters) { return std::make_shared<const std::string>(letters); }

std::string all(EventQueue& queue) {
  std::string result;
  for (const EventText& each : queue.take()) result += *each;
  return result;
}

// In server-sent events [HTML, 9.2.5] a line ends with CR, LF or both, and an empty line ends the
// event.
TEST(EventText, HasOneDataLineALineOfData) {
  EXPECT_EQ(event_text("alive", "{}"), "event: alive\ndata: {}\n\n");
  EXPECT_EQ(event_text("run", "{\n}"), "event: run\ndata: {\ndata: }\n\n");
  EXPECT_EQ(event_text("run", "a\r\rdata"), "event: run\ndata: a\ndata: \ndata: data\n\n");
  EXPECT_EQ(event_text("home", ""), "event: home\ndata: \n\n");
}

TEST(EventQueue, KeepsTheOrderAndLeavesOutRepetitions) {
  EventQueue queue(100);
  for (const char* letters : {"a", "a", "b", "a", "a"}) EXPECT_TRUE(queue.push(text(letters)));
  EXPECT_EQ(all(queue), "aba");
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.push(text("a")));
  EXPECT_EQ(all(queue), "a");
}

TEST(EventQueue, HasAnEnd) {
  EventQueue queue(3);
  EXPECT_TRUE(queue.push(text("ab")));
  EXPECT_FALSE(queue.push(text("cd")));
  EXPECT_TRUE(queue.push(text("e")));
  EXPECT_EQ(all(queue), "abe");
  EXPECT_TRUE(queue.push(text("fgh")));
}

TEST(EventOutbox, SaysWhenItIsNoLongerEmptyAndWhenItHasLost) {
  EventOutbox outbox(2);
  EXPECT_TRUE(outbox.put({"t", text("a")}));
  EXPECT_FALSE(outbox.put({"t", text("b")}));
  EXPECT_FALSE(outbox.put({"t", text("c")}));
  const EventOutbox::Content content = outbox.take();
  EXPECT_EQ(content.events.size(), 2u);
  EXPECT_TRUE(content.has_overrun);
  EXPECT_FALSE(outbox.take().has_overrun);
  EXPECT_TRUE(outbox.put({"t", text("far too long")}));
  EXPECT_TRUE(outbox.take().has_overrun);
}

}  // namespace
}  // namespace latsch::studio
