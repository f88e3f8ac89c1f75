// SPDX-License-Identifier: Apache-2.0
// Where finished trials are kept: the journal, or the memory of a simulated world.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>

#include "evaluation/trial/trial.h"

namespace latsch {

/// Trials cannot be kept or what is kept is damaged: the disk is full, a row does not agree with
/// its hash.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class TrialStore {
 public:
  virtual ~TrialStore() = default;

  /// Keeps all of them, for good when it returns, or none of them: then it throws JournalError, and
  /// what was kept before stays.
  virtual void append(std::span<const Trial> trials) = 0;

  /// Every trial in the order they were kept. Throws JournalError where one is damaged.
  virtual void for_each(const std::function<void(const Trial&)>& visit) const = 0;

  /// From here on it is kept what was asked for (asked_trials.h).
  virtual void begin_asking() {}
  /// These points (DesignPoint::bits) were answered to whoever asked; what else was evaluated so
  /// far was speculation.
  virtual void keep_asked(const std::set<std::string>& /*points*/) {}
};

}  // namespace latsch
