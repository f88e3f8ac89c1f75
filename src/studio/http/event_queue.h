// SPDX-License-Identifier: Apache-2.0
// What a client of events has not been sent yet, and the outbox in which other threads leave events
// for the thread of the sockets. Texts are shared by all clients: two hundred that lag behind cost
// as much as one.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::studio {

/// As server-sent events write it [HTML, 9.2.5]: a line of the event, one a line of its data.
std::string event_text(std::string_view event, std::string_view data);

using EventText = std::shared_ptr<const std::string>;

/// Of one client.
class EventQueue {
 public:
  explicit EventQueue(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// What says the same as the last that waits is left out. False where too much waits.
  bool push(EventText text);
  bool empty() const { return waiting_.empty(); }
  /// All that waits, in order; nothing waits then.
  std::vector<EventText> take();

 private:
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::deque<EventText> waiting_;
};

/// Filled by any thread, emptied by that of the sockets.
class EventOutbox {
 public:
  struct Event {
    std::string topic;
    EventText text;
  };
  struct Content {
    std::vector<Event> events;
    bool has_overrun = false;  // some were lost since the last time
  };

  explicit EventOutbox(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// True where it was empty: then somebody has to be told.
  bool put(Event event);
  Content take();

 private:
  std::size_t most_bytes_;
  std::mutex mutex_;
  std::size_t bytes_ = 0;
  Content content_;
};

}  // namespace latsch::studio
