// SPDX-License-Identifier: Apache-2.0
// Decides whether the trials of a study record derivatives: they do if the model computes them
// exactly for every fitted experiment and every variable. A search cannot use a Jacobian with gaps,
// so derivatives are complete or absent.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// Returns a sentence on why trials record no derivatives; nullopt if they do.
std::optional<std::string> reason_without_slopes(const Study& study);

/// True if the search uses derivatives; otherwise they would only enlarge the journal.
bool asks_slopes(const Study& study);

/// The parameters of the model that the variables of a study change.
class MovedNumbers {
 public:
  explicit MovedNumbers(const DesignSpace& space);

  const std::vector<std::string>& paths() const { return paths_; }
  /// Returns what a test has to compute: the derivatives of all channels that fitted experiments
  /// compare, by all of these parameters.
  experiment::Asked asked_of(const Study& study, const StudyTest& test) const;
  /// Converts derivatives by parameters to derivatives by variables: dy/dv = sum factor
  /// dy/dparameter, over all parameters that follow the variable v.
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
