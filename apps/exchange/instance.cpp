// SPDX-License-Identifier: Apache-2.0
#include "exchange/instance.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <utility>

#include "exchange/own_arithmetic.h"

namespace latsch::exchange {
namespace {

// Allowed difference between the start of a communication step and the end of the one before, as a
// share of the step.
constexpr double kTimeSlack = 1e-6;

}  // namespace

Instance::Instance(std::unique_ptr<ExchangedModel> unit, Log log) : log_(std::move(log)) {
  now_.unit = std::move(unit);
  pristine_ = now_.copy();
}

CallStatus Instance::say(CallStatus status, const std::string& message) {
  const char* category = status == CallStatus::discard   ? kLogDiscard
                         : status == CallStatus::warning ? kLogWarning
                                                         : kLogError;
  if (log_) log_(status, category, message);
  return status;
}

CallStatus Instance::refuse(const std::string& what) { return say(CallStatus::error, what); }

CallStatus Instance::guarded(const std::function<CallStatus()>& work) {
  const OwnArithmetic own;
  try {
    return work();
  } catch (const std::exception& error) {
    return refuse(error.what());
  } catch (...) {
    return refuse("an unknown failure");
  }
}

std::optional<std::size_t> Instance::variable_of(unsigned reference) const {
  static_assert(kTimeReference == 0 && reference_of(0) == 1);
  const std::size_t count = now_.unit->variables().size();
  if (reference == kTimeReference || reference > count) return std::nullopt;
  return reference - 1;
}

CallStatus Instance::set_up(double start, std::optional<double> stop) {
  if (now_.stage != Stage::instantiated)
    return refuse("the experiment can be set up only before initialization");
  if (!std::isfinite(start) || (stop && !(*stop >= start)))
    return refuse(
        fmt::format("the experiment begins at {} s: expected a finite time, and an end "
                    "that is not before it",
                    start));
  now_.time = start;
  now_.stop = stop;
  return CallStatus::ok;
}

CallStatus Instance::begin_initialization() {
  if (now_.stage != Stage::instantiated) return refuse("is initialized already: reset it first");
  now_.stage = Stage::initializing;
  return CallStatus::ok;
}

CallStatus Instance::begin() {
  if (now_.begun) return CallStatus::ok;
  return guarded([&] {
    if (const auto started = now_.unit->start(now_.time); !started)
      return refuse(started.failure().reason);
    now_.begun = true;
    return CallStatus::ok;
  });
}

CallStatus Instance::end_initialization() {
  if (now_.stage != Stage::initializing) return refuse("is not being initialized");
  if (const CallStatus status = begin(); status != CallStatus::ok) return status;
  now_.stage = Stage::stepping;
  return guarded([&] { return tell_first_limit(); });
}

CallStatus Instance::tell_first_limit() {
  if (first_limit_told_) return CallStatus::ok;
  const std::string limit = now_.unit->first_limit();
  if (limit.empty()) return CallStatus::ok;
  first_limit_told_ = true;
  return say(CallStatus::warning, limit);
}

CallStatus Instance::terminate() {
  if (now_.stage != Stage::stepping) return refuse("does not run: there is nothing to terminate");
  now_.stage = Stage::terminated;
  return guarded([&] {
    const std::vector<std::string> limits = now_.unit->limits_met();
    for (const std::string& limit : limits) say(CallStatus::warning, limit);
    return limits.empty() ? CallStatus::ok : CallStatus::warning;
  });
}

CallStatus Instance::reset() {
  return guarded([&] {
    now_ = pristine_.copy();
    first_limit_told_ = false;
    return CallStatus::ok;
  });
}

CallStatus Instance::get(const unsigned* references, std::size_t count, double* values) {
  return guarded([&] {
    for (std::size_t i = 0; i < count; ++i) {
      if (references[i] == kTimeReference) {
        values[i] = now_.time;
        continue;
      }
      const auto variable = variable_of(references[i]);
      if (!variable) return refuse(fmt::format("has no value reference {}", references[i]));
      const ExchangedVariable& asked = now_.unit->variables()[*variable];
      if (asked.causality == Causality::output) {
        if (now_.stage == Stage::instantiated)
          return refuse(asked.name + " is not known before initialization");
        if (const CallStatus status = begin(); status != CallStatus::ok) return status;
      }
      values[i] = now_.unit->value(*variable);
    }
    return CallStatus::ok;
  });
}

CallStatus Instance::set(const unsigned* references, std::size_t count, const double* values) {
  return guarded([&] {
    for (std::size_t i = 0; i < count; ++i) {
      const auto variable = variable_of(references[i]);
      if (!variable)
        return refuse(fmt::format("has no value reference {} that can be set", references[i]));
      const ExchangedVariable& given = now_.unit->variables()[*variable];
      if (given.causality == Causality::output)
        return refuse(given.name + " is an output and cannot be set");
      if (now_.stage == Stage::terminated)
        return refuse(given.name + " cannot be set: the unit is terminated");
      if (given.causality == Causality::parameter && now_.stage == Stage::stepping)
        return refuse(given.name + " is fixed: it can be set only before the unit runs");
      if (!std::isfinite(values[i]))
        return say(CallStatus::discard,
                   fmt::format("{} = {}: expected a finite number", given.name, values[i]));
    }
    for (std::size_t i = 0; i < count; ++i) now_.unit->set(references[i] - 1, values[i]);
    if (count > 0 && now_.stage != Stage::stepping) now_.begun = false;
    return CallStatus::ok;
  });
}

CallStatus Instance::step(double time, double step) {
  return guarded([&] {
    if (now_.stage != Stage::stepping) return refuse("does not run: it is not initialized");
    if (!(step > 0.0) || !std::isfinite(step))
      return refuse(fmt::format("the step is {} s: expected more than 0", step));
    const double slack = kTimeSlack * step + 1e-12 * std::abs(now_.time);
    if (!(std::abs(time - now_.time) <= slack))
      return refuse(fmt::format(
          "the step begins at {} s: expected {} s, where the last one ended", time, now_.time));
    if (now_.stop && time + step > *now_.stop + slack)
      return refuse(fmt::format("the step ends at {} s, after the end of the experiment at {} s",
                                time + step,
                                *now_.stop));
    if (const auto done = now_.unit->step(time, step); !done)
      return say(CallStatus::discard, done.failure().reason);
    now_.time = time + step;
    return tell_first_limit();
  });
}

CallStatus Instance::copy_state(void** state) {
  return guarded([&] {
    if (!state) return refuse("was given no place for its state");
    auto copy = std::make_unique<State>(now_.copy());
    if (*state) {  // the caller passes an existing copy, which is overwritten
      *static_cast<State*>(*state) = std::move(*copy);
    } else {
      *state = copy.release();
    }
    return CallStatus::ok;
  });
}

CallStatus Instance::restore_state(void* state) {
  return guarded([&] {
    if (!state) return refuse("was given no state to go back to");
    now_ = static_cast<const State*>(state)->copy();
    return CallStatus::ok;
  });
}

void Instance::free_state(void** state) {
  if (!state) return;
  delete static_cast<State*>(*state);
  *state = nullptr;
}

}  // namespace latsch::exchange
