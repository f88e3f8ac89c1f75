// SPDX-License-Identifier: Apache-2.0
// Where finished trials are kept: the journal, or the memory of a simulated world.
#pragma once

#include <functional>
#include <span>
#include <stdexcept>

#include "evaluation/trial.h"

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
};

}  // namespace latsch
