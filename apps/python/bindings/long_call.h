// SPDX-License-Identifier: Apache-2.0
// Runs a call that may take minutes in a separate thread, without the lock of the Python
// interpreter, while the calling thread watches for signals. So other Python threads continue, and
// Ctrl-C has an immediate effect although a simulation cannot be stopped: the simulation runs to
// its end, and its result is dropped. A recording that is computed in blocks ends after the current
// block. The data that `work` uses must be captured by value and contain no Python objects.
//
// If the process ends while such a call still computes, it ends by _exit after Python has been
// closed, so that no destructor frees memory that the call uses.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>

namespace latsch::python {

/// Thrown within a call as soon as it notices that no caller waits for its result any more.
struct Abandoned {};

class Abandonment {
 public:
  /// Throws Abandoned if nobody waits for the call any more.
  void check() const {
    if (abandoned_) throw Abandoned{};
  }
  void give_up() { abandoned_ = true; }

 private:
  std::atomic<bool> abandoned_ = false;
};

namespace detail {
/// Runs `work` as described above; call it with the interpreter's lock held. Returns when `work`
/// has returned, or raises KeyboardInterrupt.
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
