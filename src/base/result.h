// SPDX-License-Identifier: Apache-2.0
// A simulation that does not succeed is a value, not an exception.
#pragma once

#include <cassert>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace latsch {

/// Whose fault a failure is. It decides whether the same point is worth another try.
enum class Cause : std::uint8_t {
  point,       // the simulation says no, crashes or throws: again the same if repeated
  timeout,     // it took longer than it was allowed
  bad_output,  // its answer is missing, cannot be read or holds numbers that are not finite
  transient,   // its worker was killed from outside or is out of reach: nothing about the point
  not_begun,   // its worker was lost before it began: nothing was tried; never kept
};

/// Why a simulation gave no result: one sentence naming the step, the residual, the place and a
/// hint.
struct Failure {
  std::string reason;
  Cause cause = Cause::point;
};

/// A T, or the Failure that came instead.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Failure failure) : value_(std::move(failure)) {}

  bool ok() const { return std::holds_alternative<T>(value_); }
  explicit operator bool() const { return ok(); }

  const T& operator*() const& { return get(); }
  T& operator*() & { return const_cast<T&>(std::as_const(*this).get()); }
  T&& operator*() && { return std::move(const_cast<T&>(get())); }
  const T* operator->() const { return &get(); }
  T* operator->() { return &**this; }

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

}  // namespace latsch
