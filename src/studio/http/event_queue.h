// SPDX-License-Identifier: Apache-2.0
// Events waiting for a client, and the outbox in which other threads leave events for the thread of
// the sockets. Texts are shared by all clients, so two hundred slow clients cost as much as one.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::studio {

/// Returns the format of server-sent events [HTML, 9.2.5]: a line for the event, one for each line
/// of its data.
std::string event_text(std::string_view event, std::string_view data);

using EventText = std::shared_ptr<const std::string>;

/// Queue of one client.
class EventQueue {
 public:
  explicit EventQueue(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Drops an event equal to the last one waiting. Returns false if too much is waiting.
  bool push(EventText text);
  bool empty() const { return waiting_.empty(); }
  /// Returns all waiting events in order and empties the queue.
  std::vector<EventText> take();

 private:
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::deque<EventText> waiting_;
};

/// Any thread may fill the outbox; the thread of the sockets empties it.
class EventOutbox {
 public:
  struct Event {
    std::string topic;
    EventText text;
  };
  struct Content {
    std::vector<Event> events;
    bool has_overrun = false;  // true if events were lost since the last call
  };

  explicit EventOutbox(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Returns true if the outbox was empty, in which case the reader has to be woken.
  bool put(Event event);
  Content take();

 private:
  std::size_t most_bytes_;
  std::mutex mutex_;
  std::size_t bytes_ = 0;
  Content content_;
};

}  // namespace latsch::studio
