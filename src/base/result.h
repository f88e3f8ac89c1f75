// SPDX-License-Identifier: Apache-2.0
// A simulation that does not succeed returns a value, not an exception: a Result if success gives a
// value, a Status if it gives none. tools/layers.py refuses other spellings.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace latsch {

/// Origin of a failure. It decides whether the same point is tried again.
enum class Cause : std::uint8_t {
  /// The simulation failed, crashed or threw an exception: it would do so again.
  point,
  timeout,     // the simulation exceeded its time limit
  bad_output,  // the result is missing, cannot be read or holds numbers that are not finite
  /// The worker was killed from outside or cannot be reached: the point may be good.
  transient,
  /// The worker was lost before it began: nothing was tried. This cause is never recorded.
  not_begun,
};

/// Says why a simulation gave no result: one sentence naming the step, the residual, the position
/// and a hint.
struct Failure {
  std::string reason;          // one sentence
  Cause cause = Cause::point;  // decides whether the point is tried again
};

/// A T, or the Failure that occurred instead.
template <class T>
class [[nodiscard]] Result {
 public:
  /// A success.
  Result(T value) : value_(std::move(value)) {}
  /// A failure.
  Result(Failure failure) : value_(std::move(failure)) {}

  /// True if there is a value.
  bool ok() const { return std::holds_alternative<T>(value_); }
  /// True if there is a value.
  explicit operator bool() const { return ok(); }

  /// The value. Requires ok().
  const T& operator*() const& { return get(); }
  /// The value. Requires ok().
  T& operator*() & { return const_cast<T&>(std::as_const(*this).get()); }
  /// The value, to be moved from. Requires ok().
  T&& operator*() && { return std::move(const_cast<T&>(get())); }
  /// A member of the value. Requires ok().
  const T* operator->() const { return &get(); }
  /// A member of the value. Requires ok().
  T* operator->() { return &**this; }

  /// The failure. Requires !ok().
  const Failure& failure() const {
    assert(!ok());
    return std::get<Failure>(value_);
  }

 private:
  const T& get() const {
    assert(ok());
    return std::get<T>(value_);
  }
  std::variant<T, Failure> value_;
};

/// Success, or the Failure that occurred instead; `return {};` reports success. A Status does not
/// convert to bool, so that it is never mistaken for an optional Failure, whose *true* means the
/// opposite: write `!status` or `status.ok()`.
class [[nodiscard]] Status {
 public:
  Status() = default;  // a success
  /// A failure.
  Status(Failure failure) : failure_(std::move(failure)) {}

  /// True for a success.
  bool ok() const { return !failure_; }
  /// True for a failure.
  bool operator!() const { return !ok(); }

  /// The failure. Requires !ok().
  const Failure& failure() const {
    assert(!ok());
    return *failure_;
  }

 private:
  std::optional<Failure> failure_;
};

}  // namespace latsch
