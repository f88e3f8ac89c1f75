// SPDX-License-Identifier: Apache-2.0
// A call that may take minutes: it runs in a thread of its own, without the interpreter's lock,
// while the calling thread looks for signals. So other threads of Python go on, and Ctrl-C is
// answered at once although a simulation knows no way to stop: it is left to its end, and its
// result is dropped. A recording that comes in blocks ends with the next of them. What `work`
// touches has to be its own (captured by value), and no object of Python.
//
// A process that ends while such a leftover still computes does so by _exit, once Python is closed:
// no destructor pulls memory away from under it.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>

namespace latsch::python {

/// Thrown by a call that finds out that nobody waits for it any more.
struct Abandoned {};

class Abandonment {
 public:
  /// Throws Abandoned where that is so.
  void check() const {
    if (abandoned_) throw Abandoned{};
  }
  void give_up() { abandoned_ = true; }

 private:
  std::atomic<bool> abandoned_ = false;
};

namespace detail {
/// With the interpreter's lock held: returns when `work` has, or raises KeyboardInterrupt.
void run_long(std::function<void(const Abandonment&)> work);
}  // namespace detail

template <class T>
T long_call(std::function<T(const Abandonment&)> work) {
  struct Outcome {
    std::optional<T> value;
    std::exception_ptr error;
  };
  const auto outcome = std::make_shared<Outcome>();
  detail::run_long([outcome, work = std::move(work)](const Abandonment& abandonment) {
    try {
      outcome->value.emplace(work(abandonment));
    } catch (...) {
      outcome->error = std::current_exception();
    }
  });
  if (outcome->error) std::rethrow_exception(outcome->error);
  return std::move(*outcome->value);
}

}  // namespace latsch::python
