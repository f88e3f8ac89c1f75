// SPDX-License-Identifier: Apache-2.0
// Identifiability for Python: how well residuals and their Jacobian determine the variables, as
// arrays. Ends of intervals are in the units of the variables and may lie beyond their ranges.
#include <cmath>
#include <memory>

#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "bindings/failures.h"
#include "optimization/identifiability/identification.h"

namespace latsch::python {
namespace {

/// Returns the value of a variable at the coordinate u, in units of its range, without limiting it
/// to the range, unlike from_unit.
double beyond_bounds(const DesignVariable& v, double u) {
  if (v.scale == Scale::linear) return v.lower + u * (v.upper - v.lower);
  return v.lower * std::pow(v.upper / v.lower, u);  // infinite u give 0 and infinity
}

Array intervals(const DesignSpace& space, const std::vector<Interval>& of) {
  Array rows({static_cast<py::ssize_t>(of.size()), static_cast<py::ssize_t>(2)});
  for (std::size_t i = 0; i < of.size(); ++i) {
    const auto& v = space[static_cast<int>(i)];
    rows.mutable_at(i, 0) = beyond_bounds(v, of[i].lower);
    rows.mutable_at(i, 1) = beyond_bounds(v, of[i].upper);
  }
  return rows;
}

struct SpacedConfidence {
  DesignSpace space;
  Confidence found;
};

struct SpacedProfile {
  DesignSpace space;
  TargetProfile found;
};

ConfidenceOptions options(const std::optional<double>& sigma,
                          double level,
                          const std::vector<double>& deviations,
                          const std::vector<int>& curves,
                          const std::vector<int>& groups = {}) {
  if (sigma && !(*sigma > 0.0)) throw InputError("sigma: expected a positive number or None");
  if (!(level > 0.0 && level < 1.0)) throw InputError("level: expected a number in 0 .. 1");
  return {.sigma = sigma,
          .level = level,
          .traits = {.deviations = deviations, .curves = curves, .groups = groups}};
}

void check_traits(const ResidualTraits& traits, std::size_t residuals) {
  const auto check = [&](std::size_t found, const char* what) {
    if (found == 0 || found == residuals) return;
    throw InputError(std::string(what) + " has " + std::to_string(found) +
                     " values, expected one for each of " + std::to_string(residuals) +
                     " residuals");
  };
  check(traits.deviations.size(), "deviations");
  check(traits.curves.size(), "curves");
  check(traits.groups.size(), "groups");
}

/// Returns the robust loss with this name. Its scale is in units of the standard deviation of a
/// residual.
RobustLoss robust_loss(const std::string& name, const std::optional<double>& scale) {
  if (name == "squares") {
    if (scale) throw InputError("loss_scale: a loss of \"squares\" has no scale");
    return {};
  }
  if (name != "huber" && name != "cauchy")
    throw InputError("loss: expected \"squares\", \"huber\" or \"cauchy\", found \"" + name + "\"");
  if (!scale || !(*scale > 0.0) || !std::isfinite(*scale))
    throw InputError("loss_scale: expected a positive number, in units of a residual's deviation");
  return {name == "huber" ? Loss::huber : Loss::cauchy, *scale};
}

/// Applies a robust loss to residuals and Jacobian, and records it in the traits of the problem.
void limit(RobustLoss loss, ResidualTraits& traits, Linearization& linear) {
  if (loss.loss == Loss::squares) return;
  for (Eigen::Index k = 0; k < linear.r.size(); ++k) {
    RobustLoss own = loss;
    if (!traits.deviations.empty()) own.scale *= traits.deviations[static_cast<std::size_t>(k)];
    linear.J.row(k) *= own.slope(linear.r[k]);
    linear.r[k] = own(linear.r[k]);
    traits.losses.push_back(own);
  }
}

Score score_of(const Array& residuals, const Array& jacobian, int variables) {
  if (residuals.ndim() != 1 || residuals.size() == 0)
    throw InputError("residuals: expected an array (m,) of one value at least");
  matrix(jacobian, residuals.size(), variables, "jacobian");
  return {.residuals = vector(residuals), .jacobian = vector(jacobian)};
}

SpacedConfidence confidence_at(const DesignSpace& space,
                               const Array& at,
                               const Array& residuals,
                               const Array& jacobian,
                               const std::optional<double>& sigma,
                               double level,
                               const std::vector<double>& deviations,
                               const std::vector<int>& curves,
                               const std::vector<int>& groups,
                               const std::string& loss,
                               const std::optional<double>& loss_scale) {
  const DesignPoint center = point_within(space, at);
  const Score score = score_of(residuals, jacobian, space.size());
  if (sigma && !groups.empty())
    throw InputError("groups: their spreads are estimated, so sigma has to be None");
  ConfidenceOptions asked = options(sigma, level, deviations, curves, groups);
  check_traits(asked.traits, score.residuals.size());
  Linearization linear;
  const std::vector<double> u = space.to_unit(center);
  linear.u = Eigen::Map<const Eigen::VectorXd>(u.data(), space.size());
  linear.r = Eigen::Map<const Eigen::VectorXd>(score.residuals.data(),
                                               static_cast<Eigen::Index>(score.residuals.size()));
  linear.J = space.unit_jacobian(center, score);
  linear.is_exact = true;
  if (linear.J.size() == 0 || !linear.r.allFinite())
    throw InputError("residuals and jacobian: expected finite numbers");
  limit(robust_loss(loss, loss_scale), asked.traits, linear);
  const py::gil_scoped_release others;
  return {space, confidence(linear, asked)};
}

/// Converts what the Python function returned: residuals, (residuals, jacobian) or a Failure.
Result<Evaluated> evaluated(const DesignSpace& space,
                            const DesignPoint& at,
                            const py::handle& told) {
  if (is_failure(told)) return failure_of(told);
  Array r;
  py::object slopes = py::none();
  if (py::isinstance<py::tuple>(told)) {
    const auto pair = told.cast<py::tuple>();
    if (pair.size() != 2) throw InputError("expected a pair of residuals and jacobian");
    r = pair[0].cast<Array>();
    slopes = pair[1];
  } else {
    r = told.cast<Array>();
  }
  if (r.ndim() != 1 || r.size() == 0)
    throw InputError("residuals: expected an array (m,) of one value at least");
  Eigen::VectorXd residuals = Eigen::Map<const Eigen::VectorXd>(r.data(), r.size());
  if (slopes.is_none()) return Evaluated(std::move(residuals));
  const Score score = score_of(r, slopes.cast<Array>(), space.size());
  return Evaluated(std::move(residuals), space.unit_jacobian(at, score));
}

class SpacedIdentification {
 public:
  SpacedIdentification(const DesignSpace& space,
                       const DesignPoint& center,
                       const IdentificationOptions& options)
      : space_(space), found_(space, center, options) {}

  void observe(const py::sequence& outcomes) {
    const auto& wanted = found_.wanted();
    std::vector<Result<Evaluated>> told;
    for (std::size_t k = 0; k < std::min(outcomes.size(), wanted.size()); ++k)
      told.push_back(evaluated(space_, wanted[k], outcomes[k]));
    for (const auto& one : told)
      if (one) expect_same_count(one->r.size());
    const bool is_first_enough = !told.empty() && found_.is_enough(told.front());
    if (outcomes.size() != wanted.size() && !(outcomes.size() == 1 && is_first_enough))
      throw InputError("observe: " + std::to_string(wanted.size()) +
                       " points are requested, found the outcomes of " +
                       std::to_string(outcomes.size()));
    if (is_first_enough) told.resize(1, told.front());
    const py::gil_scoped_release others;
    found_.observe(told);
  }
  const Identification& found() const {
    if (!found_.status()) raise(found_.status().failure());
    if (!found_.is_linearized())
      throw InputError(
          "there are no results yet: pass the outcomes of the points in `wanted` to observe()");
    return found_;
  }
  const Identification& now() const { return found_; }
  const DesignSpace& space() const { return space_; }

 private:
  /// Throws InputError unless this number of residuals is equal to that at the other points of the
  /// problem.
  void expect_same_count(Eigen::Index count) {
    if (!count_) count_ = count;
    if (count != *count_)
      throw InputError("residuals: found " + std::to_string(count) + " values, but " +
                       std::to_string(*count_) +
                       " at the first point: expected equally many at every point, or a Failure");
  }

  DesignSpace space_;
  Identification found_;
  std::optional<Eigen::Index> count_;  // number of residuals, once it is known
};

void bind_confidence(py::module_& module) {
  using C = SpacedConfidence;
  py::class_<C>(
      module,
      "Confidence",
      "Confidence in the variables at a fitted point, in linear approximation. Variables are in "
      "their own\nunits in `intervals`, and in shares of their ranges (the unit cube) elsewhere.")
      .def_property_readonly(
          "intervals",
          [](const C& c) { return intervals(c.space, c.found.intervals); },
          "Array (n, 2): lower and upper end; infinite (0 on a logarithmic scale) if the data give "
          "no limit.")
      .def_property_readonly(
          "sigma",
          [](const C& c) { return c.found.sigma; },
          "Standard deviation of a residual; NaN if there are not enough residuals to estimate it.")
      .def_property_readonly(
          "t", [](const C& c) { return c.found.t; }, "Student's quantile, two-sided.")
      .def_property_readonly(
          "excess",
          [](const C& c) { return c.found.excess; },
          "The spread of the residuals over a stated sigma if chance does not explain it; "
          "otherwise 1.")
      .def_property_readonly(
          "beyond",
          [](const C& c) { return c.found.beyond; },
          "Number of residuals beyond the corner of their robust loss.")
      .def_property_readonly(
          "covariance",
          [](const C& c) { return array(c.found.covariance); },
          "Array (n, n), in shares of the ranges; 0 for held variables.")
      .def_property_readonly(
          "correlation", [](const C& c) { return array(c.found.correlation); }, "Array (n, n).")
      .def_property_readonly(
          "singular_values",
          [](const C& c) { return array(c.found.singular_values); },
          "Array (n,), descending: singular values of the Jacobian in the unit cube; a small one "
          "means that the\ndata hardly determine its direction.")
      .def_property_readonly(
          "directions",
          [](const C& c) { return array(c.found.directions); },
          "Array (n, n): one direction in the unit cube in each column.")
      .def_property_readonly(
          "deviations",
          [](const C& c) { return array(c.found.direction_deviations); },
          "Array (n,): standard deviation along each direction, in shares of the ranges; infinite "
          "for a direction\nwithout effect.")
      .def_property_readonly(
          "thresholds",
          [](const C& c) { return array(c.found.thresholds); },
          "Array (n,): the rise of the sum of squares at the ends of each interval.")
      .def_property_readonly(
          "held",
          [](const C& c) {
            std::vector<std::string> names;
            for (const Bound at : c.found.held)
              names.emplace_back(at == Bound::none ? "" : at == Bound::lower ? "lower" : "upper");
            return names;
          },
          "The bound that keeps a variable from a better fit: \"\", \"lower\" or \"upper\".");
  module.def(
      "confidence",
      &confidence_at,
      py::arg("space"),
      py::arg("point"),
      py::arg("residuals"),
      py::arg("jacobian"),
      py::kw_only(),
      py::arg("sigma") = py::none(),
      py::arg("level") = 0.95,
      py::arg("deviations") = std::vector<double>{},
      py::arg("curves") = std::vector<int>{},
      py::arg("groups") = std::vector<int>{},
      py::arg("loss") = "squares",
      py::arg("loss_scale") = py::none(),
      "Confidence from residuals (m,) and their derivatives (m, n) with respect to the values of a "
      "fitted\npoint (n,).\n\nsigma: standard deviation of a residual if it is known. deviations "
      "(m,): standard deviation of each\nresidual in units of sigma. curves (m,): number of the "
      "curve to which a residual belongs; the noise of\nneighbors on one curve may be correlated. "
      "groups (m,): number of the group of a residual, if every group has a spread of its own that "
      "is\nestimated, sigma is not known, and the residuals were divided by earlier estimates of "
      "these spreads. loss: \"squares\", or \"huber\" or \"cauchy\" beyond loss_scale, in\nunits "
      "of a residual's "
      "deviation, if the fit minimized that loss; residuals and jacobian are those before\nthe "
      "loss.");
}

void bind_profile(py::module_& module) {
  using P = SpacedProfile;
  py::class_<P>(module,
                "Profile",
                "The rise of the sum of squares over values at which one variable is held.")
      .def_property_readonly("variable", [](const P& p) { return p.space[p.found.variable].name; })
      .def_property_readonly(
          "verdict",
          [](const P& p) { return name(p.found.verdict); },
          "\"identifiable\", \"one-sided\", \"flat\", \"several minima\" or \"not evaluable "
          "beyond\".")
      .def_property_readonly("in_words", [](const P& p) { return in_words(p.found); })
      .def_property_readonly(
          "interval",
          [](const P& p) {
            const auto& v = p.space[p.found.variable];
            return py::make_tuple(beyond_bounds(v, p.found.interval.lower),
                                  beyond_bounds(v, p.found.interval.upper));
          },
          "(lower, upper), infinite if the data give no limit.")
      .def_property_readonly(
          "values",
          [](const P& p) {
            std::vector<double> x;
            for (const auto& at : p.found.points)
              x.push_back(beyond_bounds(p.space[p.found.variable], at.u[p.found.variable]));
            return array(x);
          },
          "Array (k,): values of the variable, ascending.")
      .def_property_readonly(
          "rise",
          [](const P& p) {
            std::vector<double> rise;
            for (const auto& at : p.found.points) rise.push_back(at.S - p.found.least);
            return array(rise);
          },
          "Array (k,): the sum of squares minus its least value.")
      .def_property_readonly("threshold", [](const P& p) { return p.found.threshold; });
}

}  // namespace

void bind_identifiability(py::module_& module) {
  bind_confidence(module);
  bind_profile(module);
  using I = SpacedIdentification;
  py::class_<I>(module,
                "Identification",
                "Confidence intervals and profiles around a fitted point, by ask and tell in "
                "rounds: each round\nevaluates all points of `wanted`.\n\nsigma, level, "
                "deviations, curves: as for confidence(). profiles=False: only intervals. step: "
                "length of\nthe differences, in shares of the ranges.")
      .def(py::init([](const DesignSpace& space,
                       const Array& at,
                       const std::optional<double>& sigma,
                       double level,
                       bool profiles,
                       double step,
                       const std::vector<double>& deviations,
                       const std::vector<int>& curves) {
             const DesignPoint center = point(at, space.size());
             if (!space.contains(center))
               throw InputError("the point lies outside of the bounds or constraints");
             if (!(step > 0.0 && step <= 0.5)) throw InputError("step: expected 0 < step <= 0.5");
             return std::make_unique<I>(
                 space,
                 center,
                 IdentificationOptions{.confidence = options(sigma, level, deviations, curves),
                                       .profiles = profiles,
                                       .step = step});
           }),
           py::arg("space"),
           py::arg("point"),
           py::kw_only(),
           py::arg("sigma") = py::none(),
           py::arg("level") = 0.95,
           py::arg("profiles") = true,
           py::arg("step") = 0.01,
           py::arg("deviations") = std::vector<double>{},
           py::arg("curves") = std::vector<int>{})
      .def_property_readonly(
          "wanted",
          [](const I& i) { return array(i.now().wanted(), i.space().size()); },
          "Points to evaluate, array (k, n); k is 0 at the end.")
      .def("observe",
           &I::observe,
           py::arg("outcomes"),
           "Records the outcomes of the points in `wanted`, in their order: residuals (m,), a pair "
           "of residuals\nand jacobian (m, n), or a Failure. In the first round the first outcome "
           "is enough if it has a jacobian.")
      .def_property_readonly(
          "point",
          [](const I& i) { return array(i.now().center().values); },
          "The point to which the results belong: the given one, or a better one found since. "
          "Array (n,).")
      .def_property_readonly("confidence",
                             [](const I& i) {
                               return SpacedConfidence{i.space(), i.found().confidence()};
                             })
      .def_property_readonly(
          "profiles",
          [](const I& i) {
            std::vector<SpacedProfile> all;
            for (const TargetProfile& p : i.found().profiles()) all.push_back({i.space(), p});
            return all;
          },
          "A list with one Profile for each variable, at the end, if profiles were requested.");
}

}  // namespace latsch::python
