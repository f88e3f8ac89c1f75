// SPDX-License-Identifier: Apache-2.0
// Slopes of a study's residuals: trials record them if the model knows them exactly, for every
// fitted experiment in every variable. They are complete or absent, because a search cannot use a
// Jacobian with gaps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// Returns the reason, for a person, why trials record no slopes; nullopt if they do.
std::optional<std::string> reason_without_slopes(const Study& study);

/// True if the search uses slopes; otherwise they would only fill the journal.
bool asks_slopes(const Study& study);

/// The numbers of the model that its variables move.
class MovedNumbers {
 public:
  explicit MovedNumbers(const DesignSpace& space);

  const std::vector<std::string>& paths() const { return paths_; }
  /// Returns what a test has to compute: slopes of all channels that fitted experiments compare, in
  /// all of these numbers.
  experiment::Asked asked_of(const Study& study, const StudyTest& test) const;
  /// Converts slopes in the numbers into slopes in the variables: dy/dv = sum factor dy/dnumber,
  /// over all numbers that follow a variable.
  std::vector<double> in_variables(const std::vector<double>& slopes) const;

 private:
  struct Moved {
    std::size_t variable;
    double factor;
  };
  void add(const std::string& path, const Moved& by);

  std::vector<std::string> paths_;
  std::vector<Moved> moved_;  // one entry for each path
  std::size_t variables_;
};

}  // namespace latsch::correlation
