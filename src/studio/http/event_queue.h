// SPDX-License-Identifier: Apache-2.0
// Queues of events: one for each client, and an outbox in which other threads leave events for the
// thread of the sockets. Clients share the texts, so two hundred slow clients need as much memory
// as one.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::studio {

/// Returns an event in the format of server-sent events [HTML, 9.2.5]: a line with its name and one
/// for each line of its data.
std::string event_text(std::string_view event, std::string_view data);

using EventText = std::shared_ptr<const std::string>;

/// The events that wait to be sent to one client.
class EventQueue {
 public:
  explicit EventQueue(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Adds an event, unless it equals the last one that waits. Returns false if too much is waiting.
  bool push(EventText text);
  bool empty() const { return waiting_.empty(); }
  /// Returns all waiting events in their order and empties the queue.
  std::vector<EventText> take();

 private:
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::deque<EventText> waiting_;
};

/// Events that any thread may put in and the thread of the sockets takes out.
class EventOutbox {
 public:
  struct Event {
    std::string topic;
    EventText text;
  };
  struct Content {
    std::vector<Event> events;
    bool has_overrun = false;  // true if events were lost since the last take()
  };

  explicit EventOutbox(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Adds an event. Returns true if the outbox was empty, because the thread of the sockets then
  /// has to be woken.
  bool put(Event event);
  Content take();

 private:
  std::size_t most_bytes_;
  std::mutex mutex_;
  std::size_t bytes_ = 0;
  Content content_;
};

}  // namespace latsch::studio
