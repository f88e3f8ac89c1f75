// SPDX-License-Identifier: Apache-2.0
// A call that may take minutes: it runs in a thread of its own, without the interpreter's lock,
// while the calling thread looks for signals. So other threads of Python continue, and Ctrl-C has
// an immediate effect although a simulation cannot be stopped: the simulation runs to its end, and
// its result is dropped. A recording in blocks ends with the next block. The data that `work` uses
// must be its own (captured by value) and no Python objects.
//
// A process that ends while such a call still computes does so by _exit, once Python is closed: no
// destructor then frees memory that the call uses.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>

namespace latsch::python {

/// Thrown by a call that detects that nobody waits for it any more.
struct Abandoned {};

class Abandonment {
 public:
  /// Throws Abandoned if the call was abandoned.
  void check() const {
    if (abandoned_) throw Abandoned{};
  }
  void give_up() { abandoned_ = true; }

 private:
  std::atomic<bool> abandoned_ = false;
};

namespace detail {
/// Called with the interpreter's lock held: returns when `work` has returned, or raises
/// KeyboardInterrupt.
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
