// SPDX-License-Identifier: Apache-2.0
#include "studio/http/event_queue.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace latsch::studio {

std::string event_text(std::string_view event, std::string_view data) {
  assert(event.find_first_of("\r\n") == event.npos);
  std::string text = "event: " + std::string(event) + "\n";
  for (;;) {
    const std::size_t end = std::min(data.find_first_of("\r\n"), data.size());
    text.append("data: ").append(data.substr(0, end)) += '\n';
    if (end == data.size()) break;
    data.remove_prefix(end + 1);
  }
  return text + '\n';
}

bool EventQueue::push(EventText text) {
  if (!waiting_.empty() && *waiting_.back() == *text) return true;
  if (bytes_ + text->size() > most_bytes_) return false;
  bytes_ += text->size();
  waiting_.push_back(std::move(text));
  return true;
}

std::vector<EventText> EventQueue::take() {
  std::vector<EventText> all(waiting_.begin(), waiting_.end());
  waiting_.clear();
  bytes_ = 0;
  return all;
}

bool EventOutbox::put(Event event) {
  const std::lock_guard lock(mutex_);
  const bool was_empty = content_.events.empty() && !content_.has_overrun;
  if (bytes_ + event.text->size() > most_bytes_) {
    content_.has_overrun = true;
    return was_empty;
  }
  bytes_ += event.text->size();
  content_.events.push_back(std::move(event));
  return was_empty;
}

EventOutbox::Content EventOutbox::take() {
  const std::lock_guard lock(mutex_);
  bytes_ = 0;
  return std::exchange(content_, {});
}

}  // namespace latsch::studio
