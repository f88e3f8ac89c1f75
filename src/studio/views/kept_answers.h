// SPDX-License-Identifier: Apache-2.0
// Cache of the last answers to questions that take the time of a trial or a pass over the journal.
// A thread whose answer is just being computed by another thread waits for it, but for no other
// answer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace latsch::studio {

template <class Question, class Answer>
class KeptAnswers {
 public:
  explicit KeptAnswers(std::size_t most) : most_(most) {}

  /// Returns the stored answer to the question, or the result of `find()`; may be called by any
  /// thread. If `find()` throws, all threads that wait for the answer receive the exception, and
  /// the next request computes the answer again.
  template <class Find>
  std::shared_ptr<const Answer> get(const Question& question, Find&& find) {
    std::promise<std::shared_ptr<const Answer>> promise;
    // identifies this computation, because another computation may replace the entry in the
    // meantime
    const auto mine = std::make_shared<int>();
    {
      std::unique_lock lock(mutex_);
      for (const Kept& one : kept_) {
        if (!(one.question == question)) continue;
        const auto answer = one.answer;
        lock.unlock();
        return answer.get();
      }
      if (kept_.size() == most_) kept_.erase(kept_.begin());
      kept_.push_back({question, promise.get_future().share(), mine});
    }
    try {
      auto answer = std::make_shared<const Answer>(find());
      promise.set_value(answer);
      return answer;
    } catch (...) {
      promise.set_exception(std::current_exception());
      const std::lock_guard lock(mutex_);
      std::erase_if(kept_, [&](const Kept& one) { return one.by == mine; });
      throw;
    }
  }

 private:
  struct Kept {
    Question question;
    std::shared_future<std::shared_ptr<const Answer>> answer;
    std::shared_ptr<int> by;
  };
  std::size_t most_;
  std::mutex mutex_;
  std::vector<Kept> kept_;
};

}  // namespace latsch::studio
