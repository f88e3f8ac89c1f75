// SPDX-License-Identifier: Apache-2.0
// A few threads for work that takes time, with a queue of limited length.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace latsch::studio {

class HandlerPool {
 public:
  HandlerPool(int threads, std::size_t most_waiting);
  /// Drops waiting work and waits until running work has ended.
  ~HandlerPool();
  HandlerPool(const HandlerPool&) = delete;
  HandlerPool& operator=(const HandlerPool&) = delete;

  /// Queues `work`, which must not throw. Returns false, and does not run it, if too much work is
  /// waiting.
  bool submit(std::function<void()> work);

 private:
  void work();

  std::size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable has_work_;
  std::deque<std::function<void()>> waiting_;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace latsch::studio
