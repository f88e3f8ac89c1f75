// SPDX-License-Identifier: Apache-2.0
// A few threads for what takes time, and a line before them that has an end.
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
  /// Forgets what waits, waits for what is under way.
  ~HandlerPool();
  HandlerPool(const HandlerPool&) = delete;
  HandlerPool& operator=(const HandlerPool&) = delete;

  /// `work` throws nothing. False where too many wait: then it is not done.
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
