// SPDX-License-Identifier: Apache-2.0
#include "bindings/posteriors.h"

#include <cmath>
#include <limits>

#include "bindings/arrays.h"

namespace latsch::python {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::quiet_NaN();

/// Returns the ends in SI, 2 values; NaN for an end that is open or lies beyond a bound.
Eigen::RowVector2d ends_of(const correlation::Study& study,
                           const correlation::Posterior& posterior,
                           std::size_t axis,
                           const Interval& interval) {
  const auto value = [&](double u) {
    const bool is_inside = std::isfinite(u) && u >= 0.0 && u <= 1.0;
    return is_inside ? posterior.value_at(study.space, axis, u) : kNoEnd;
  };
  return {value(interval.lower), value(interval.upper)};
}

}  // namespace

py::dict as_dict(const correlation::Study& study, const correlation::Posterior& posterior) {
  const std::vector<std::string> names = correlation::axis_names(study, posterior);
  const auto count = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd intervals(count, 2), linear(count, 2);
  std::vector<double> medians, rhat, effective;
  py::list shapes;
  for (std::size_t a = 0; a < names.size(); ++a) {
    const PosteriorShape& shape = posterior.shapes[a];
    const auto row = static_cast<Eigen::Index>(a);
    medians.push_back(posterior.value_at(study.space, a, shape.median));
    intervals.row(row) = ends_of(study, posterior, a, {shape.lower, shape.upper});
    linear.row(row) = ends_of(study, posterior, a, posterior.linear[a]);
    const ChainDiagnostics& d = posterior.samples.diagnostics[a];
    rhat.push_back(d.rhat);
    effective.push_back(std::min(d.bulk, d.tail));
    shapes.append(posterior.is_mixed() ? py::object(py::str(in_words(shape, names))) : py::none());
  }
  std::vector<DesignPoint> points;
  for (Eigen::Index k = 0; k < posterior.samples.size(); ++k)
    points.push_back(posterior.point(study.space, k));
  const std::vector<int>& walkers = posterior.samples.chain;
  py::array_t<int> chains(static_cast<py::ssize_t>(walkers.size()), walkers.data());
  py::dict all;
  all["points"] = array(points, study.space.size());
  all["log_densities"] = array(posterior.samples.log_density);
  all["chains"] = chains;
  all["center"] = array(posterior.center.values);
  all["names"] = names;
  all["medians"] = array(medians);
  all["intervals"] = array(intervals);
  all["linear"] = array(linear);
  all["shapes"] = shapes;
  all["rhat"] = array(rhat);
  all["effective"] = array(effective);
  all["mixed"] = posterior.is_mixed();
  all["verdict"] = name(posterior.check.verdict);
  all["method"] = correlation::name(posterior.method);
  all["deviation"] =
      posterior.check.verdict == SurrogateVerdict::unchecked ? kNoEnd : posterior.check.deviation;
  all["verdict_text"] = correlation::verdict_text(posterior);
  all["remarks"] = posterior.remarks;
  all["trials"] = posterior.trials;
  all["failed"] = posterior.failed;
  return all;
}

}  // namespace latsch::python
