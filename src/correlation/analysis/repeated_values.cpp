// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/repeated_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/text.h"

namespace latsch::correlation {
namespace {

using experiment::Finding;
using experiment::written_at;

/// Returns the channels of an experiment as its measurement names them, without the test.
std::vector<std::string> columns_of(const StudyExperiment& experiment) {
  std::vector<std::string> names;
  for (const std::string& asked : experiment.observable->asks()) {
    const std::string channel = asked.substr(asked.find('/') + 1);
    names.push_back(experiment.read_from->has(channel) ? experiment.read_from->name_of(channel)
                                                       : channel);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Returns how many samples of one file two experiments compare that take the same columns from
/// different [measurement.NAME].
std::size_t samples_in_common(const StudyExperiment& a, const StudyExperiment& b) {
  if (!a.read_from || !b.read_from || a.read_from == b.read_from) return 0;
  if (a.read_from->files() != b.read_from->files() || columns_of(a) != columns_of(b)) return 0;
  std::vector<double> one = a.read_from->numbers(), other = b.read_from->numbers(), both;
  std::sort(one.begin(), one.end());
  std::sort(other.begin(), other.end());
  std::set_intersection(
      one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(both));
  return both.size();
}

}  // namespace

std::vector<Finding> repeated_values(const Study& study, const Document& file) {
  std::vector<Finding> found;
  for (std::size_t i = 0; i < study.experiments.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const StudyExperiment &a = study.experiments[j], &b = study.experiments[i];
      const bool other_columns =
          (a.observable->kind() == "curve" || a.observable->kind() == "values") &&
          (a.observable->asks() != b.observable->asks() ||
           a.observable->compared(a.objective) != b.observable->compared(b.objective));
      if (a.measurement_file.empty()) continue;  // the study itself states the values
      const bool repeats = a.fitted && b.fitted && a.measurement_file == b.measurement_file &&
                           a.measurement == b.measurement && !other_columns;
      const std::size_t common = !repeats && counts(a) && counts(b) ? samples_in_common(a, b) : 0;
      if (common > 0)
        found.push_back(
            {written_at(file, "experiment." + b.name + ".measurement").place,
             fmt::format("experiments {} and {} compare the same file {}: {} of its samples count "
                         "twice, and intervals are narrower than these values allow. Select "
                         "different samples, or fit one of both",
                         in_quotes(a.name),
                         in_quotes(b.name),
                         in_quotes(b.measurement_file.filename().string()),
                         common),
             false,
             true});
      if (!repeats) continue;
      found.push_back(
          {written_at(file, "experiment." + b.name + ".measurement").place,
           fmt::format("experiment.{}.measurement is {}, which experiment {} is fitted to already: "
                       "it counts twice. If that is intended, use weight = 2",
                       b.name,
                       in_quotes(b.measurement_file.filename().string()),
                       in_quotes(a.name)),
           false});
    }
  }
  return found;
}

}  // namespace latsch::correlation
