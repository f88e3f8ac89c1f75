// SPDX-License-Identifier: Apache-2.0
// Storage of finished trials: the journal, or the memory of a simulated world.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>

#include "evaluation/trial/trial.h"

namespace latsch {

/// Reports that trials cannot be stored or that stored trials are damaged: the disk is full, or a
/// row does not agree with its hash.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class TrialStore {
 public:
  virtual ~TrialStore() = default;

  /// Stores all trials permanently before it returns. If this is not possible it stores none of
  /// them and throws JournalError; earlier trials stay.
  virtual void append(std::span<const Trial> trials) = 0;

  /// Visits every trial in the order of storage. Throws JournalError if one is damaged.
  virtual void for_each(const std::function<void(const Trial&)>& visit) const = 0;

  /// Starts recording which trials were requested (asked_trials.h).
  virtual void begin_asking() {}
  /// Records that the outcomes of these points (DesignPoint::bits) were used. All other trials so
  /// far were speculation.
  virtual void keep_asked(const std::set<std::string>& /*points*/) {}
};

}  // namespace latsch
