// SPDX-License-Identifier: Apache-2.0
// Cache of the last answers to questions that take a trial's time or a reading of the journal. A
// thread that requests an answer under computation waits for that answer, and for no other.
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

  /// Returns the stored answer, or the result of `find()`; may be called by any thread. All threads
  /// waiting for an answer receive the exception that `find()` throws; the next request computes it
  /// again.
  template <class Find>
  std::shared_ptr<const Answer> get(const Question& question, Find&& find) {
    std::promise<std::shared_ptr<const Answer>> promise;
    // another answer may have replaced the entry meanwhile
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
