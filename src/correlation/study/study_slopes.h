// SPDX-License-Identifier: Apache-2.0
// Whether the trials of a study bring the slopes of all its residuals: of every fitted experiment
// in every variable, exact, from a model that knows them. Complete or none: a Jacobian with gaps is
// of no use to a search.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// Why they do not, for a person; nullopt where they do.
std::optional<std::string> reason_without_slopes(const Study& study);

/// Whether its search makes use of them; else they would only fill the journal.
bool asks_slopes(const Study& study);

/// The numbers of the model that its variables move.
class MovedNumbers {
 public:
  explicit MovedNumbers(const DesignSpace& space);

  const std::vector<std::string>& paths() const { return paths_; }
  /// What a test shall tell: the slopes of all channels that fitted experiments compare, in all of
  /// these numbers.
  experiment::Asked asked_of(const Study& study, const StudyTest& test) const;
  /// Such slopes as those in the variables: dy/dv = sum factor dy/dnumber, over all numbers that
  /// follow a variable.
  std::vector<double> in_variables(const std::vector<double>& slopes) const;

 private:
  struct Moved {
    std::size_t variable;
    double factor;
  };
  void add(const std::string& path, const Moved& by);

  std::vector<std::string> paths_;
  std::vector<Moved> moved_;  // by path
  std::size_t variables_;
};

}  // namespace latsch::correlation
