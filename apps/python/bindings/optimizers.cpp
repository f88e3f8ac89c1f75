// SPDX-License-Identifier: Apache-2.0
// Optimizers with ask and tell for Python. Only one thread at a time may call an optimizer, which
// has its own lock besides the interpreter's; other Python threads run meanwhile.
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/document.h"
#include "base/text.h"
#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "bindings/failures.h"
#include "correlation/study/study_optimizer.h"
#include "optimization/strategy/cascade.h"
#include "optimization/strategy/multi_start.h"

namespace latsch::python {
namespace {

constexpr const char* kOptions = "options of the optimizer";

class AskTell {
 public:
  AskTell(DesignSpace space, std::unique_ptr<Optimizer> optimizer, MethodChoice choice)
      : space_(std::move(space)), optimizer_(std::move(optimizer)), choice_(std::move(choice)) {}

  std::vector<DesignPoint> propose(int count) {
    if (count < 1) throw InputError("propose: expected at least one point");
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    return optimizer_->propose(count);
  }
  void observe(const DesignPoint& point, const Result<Score>& outcome) {
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    if (outcome) expect_same_counts(*outcome);
    optimizer_->observe(point, outcome);
    if (outcome && (!best_ || is_better(*outcome, best_->second))) best_.emplace(point, *outcome);
  }
  /// Returns the best outcome so far and its point; nullopt if none has succeeded.
  std::optional<std::pair<DesignPoint, Score>> best() {
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    return best_;
  }
  bool converged() {
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    return optimizer_->converged();
  }
  std::vector<EndingClaim> claims() {
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    return optimizer_->claims();
  }
  std::vector<FoundBasin> basins() {
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    return optimizer_->basins();
  }
  std::string ending() {
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    return optimizer_->ending();
  }

  const DesignSpace& space() const { return space_; }
  const MethodChoice& choice() const { return choice_; }

 private:
  struct Counts {
    std::size_t residuals, constraints, equations;
  };

  /// Throws InputError unless an outcome has as many entries as that of the first point: the method
  /// compares the outcomes of points entry by entry.
  void expect_same_counts(const Score& score) {
    const Counts now{score.residuals.size(), score.constraints.size(), score.equations.size()};
    if (!first_) first_ = now;
    const auto expect = [](const char* what, std::size_t found, std::size_t expected) {
      if (found != expected)
        throw InputError("outcome with " + std::to_string(found) + " " + what + ", but that of " +
                         "the first point has " + std::to_string(expected) +
                         ": expected equally many at every point, or a Failure");
    };
    expect("residuals", now.residuals, first_->residuals);
    expect("constraints", now.constraints, first_->constraints);
    expect("equations", now.equations, first_->equations);
  }

  DesignSpace space_;
  std::unique_ptr<Optimizer> optimizer_;
  MethodChoice choice_;
  std::mutex mutex_;
  std::optional<Counts> first_;  // counts at the first point that did not fail
  std::optional<std::pair<DesignPoint, Score>> best_;
};

/// Reads a point of the design space at which a search may evaluate the objective: it is finite
/// and, up to rounding, inside the bounds.
DesignPoint point_of_search(const Array& at, const DesignSpace& space) {
  constexpr double kRounding = 1e-9;  // share of the range
  const DesignPoint read = point(at, space.size());
  for (int i = 0; i < space.size(); ++i) {
    const DesignVariable& v = space[i];
    const double x = read.values[static_cast<std::size_t>(i)];
    const double slack = kRounding * (v.upper - v.lower);
    if (!(x >= v.lower - slack && x <= v.upper + slack))
      throw InputError(v.name + " is " + format_number(x) +
                       ", expected a value within its bounds " + format_number(v.lower) + " to " +
                       format_number(v.upper));
  }
  return read;
}

/// An optimization method with its options, chosen as in a study: with the same keys and the same
/// error messages.
struct Chosen {
  Method method;
  OptimizerSettings settings;
  ProblemTraits traits;
  std::string reason;
};

Chosen chosen(const DesignSpace& space,
              const std::string& method,
              const std::string& options,
              ProblemTraits traits) {
  traits.variables = space.size();
  traits.has_linear_constraints = !space.constraints().empty();
  OptimizerSettings named;
  named.method = method;
  if (method != "ensemble") {
    const MethodChoice choice = method_of(named, traits);  // throws InputError for an unknown name
    named.method = name(choice.method);
    const Node table =
        Document::parse("method = \"" + named.method + "\"\n" + options, kOptions).root();
    named = correlation::read_optimizer(table, space, traits.has_nonlinear_constraints);
    table.close();
    const std::string reason = method == "auto" ? choice.reason : "as asked for";
    return {choice.method, std::move(named), traits, reason};
  }
  const Node table = Document::parse("method = \"ensemble\"\n" + options, kOptions).root();
  named = correlation::read_optimizer(table, space, traits.has_nonlinear_constraints);
  table.close();
  return {Method::ensemble, named, traits, method_of(named, traits).reason};
}

std::unique_ptr<AskTell> made(const DesignSpace& space, const Chosen& of) {
  return std::make_unique<AskTell>(space,
                                   make_optimizer(of.method, space, of.settings, of.traits),
                                   MethodChoice{of.method, of.reason});
}

auto maker(const Chosen& of) {
  return [of](const DesignSpace& space) {
    return make_optimizer(of.method, space, of.settings, of.traits);
  };
}

ProblemTraits traits(bool residuals, bool jacobian, bool constraints, double failed, int basins) {
  return {.has_residuals = residuals || jacobian,
          .has_jacobian = jacobian,
          .failed_share = failed,
          .basins = basins,
          .has_nonlinear_constraints = constraints};
}

Score score(const py::object& value,
            const py::object& residuals,
            const py::object& jacobian,
            const std::vector<double>& constraints,
            const std::vector<double>& equations,
            int stand_ins) {
  Score made{.stand_ins = stand_ins, .constraints = constraints, .equations = equations};
  if (!residuals.is_none()) {
    const auto r = residuals.cast<Array>();
    if (r.ndim() != 1) throw InputError("residuals: expected an array (m,)");
    made.residuals = vector(r);
  }
  if (!jacobian.is_none()) {
    const auto J = jacobian.cast<Array>();
    const auto rows = static_cast<py::ssize_t>(made.residuals.size());
    if (J.ndim() != 2 || J.shape(0) != rows)
      throw InputError("jacobian: expected an array (m, n) with a row for each of " +
                       std::to_string(rows) + " residuals, found " +
                       py::str(J.attr("shape")).cast<std::string>());
    made.jacobian = vector(J);
  }
  if (!value.is_none()) {
    if (!py::isinstance<py::float_>(value) && !py::hasattr(value, "__float__"))
      throw InputError("value: expected a number, found " + py::repr(value).cast<std::string>());
    made.value = py::float_(value).cast<double>();
  } else if (!residuals.is_none()) {
    for (const double r : made.residuals) made.value += r * r;
  } else {
    throw InputError("a score has a value, residuals or both");
  }
  return made;
}

bool is_finite(const Score& score) {
  const auto all = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  };
  return std::isfinite(score.value) && all(score.residuals) && all(score.constraints) &&
         all(score.equations);
}

/// Converts the outcome that Python tells an optimizer: a number, a Score or a Failure. A number
/// that is not finite becomes a failure, as in a study, with a Python warning.
Result<Score> outcome_of(const py::handle& told, int variables) {
  const auto checked = [](Score score) -> Result<Score> {
    if (is_finite(score)) return score;
    // Throws the warning if the caller has made warnings errors.
    if (PyErr_WarnEx(
            PyExc_RuntimeWarning,
            "the outcome holds a number that is not finite, so it counts as a failed trial; "
            "tell a failure as latsch.Failure(\"reason\")",
            1) != 0)
      throw py::error_already_set();
    return Failure{"the outcome holds a number that is not finite", Cause::bad_output};
  };
  if (PyFloat_Check(told.ptr())) return checked({.value = PyFloat_AS_DOUBLE(told.ptr())});
  if (py::isinstance<Score>(told)) {
    const auto& score = told.cast<const Score&>();
    const std::size_t columns = static_cast<std::size_t>(variables);
    if (!score.jacobian.empty() && score.jacobian.size() != score.residuals.size() * columns)
      throw InputError(
          "jacobian has " + std::to_string(score.jacobian.size() / score.residuals.size()) +
          " columns, expected one for each of " + std::to_string(variables) + " variables");
    return checked(score);
  }
  if (is_failure(told)) return failure_of(told);
  if (PyNumber_Check(told.ptr())) return checked({.value = told.cast<double>()});
  throw InputError("an outcome is a number, a Score or a Failure, found " +
                   py::repr(py::type::of(told)).cast<std::string>());
}

py::list list_of(const std::vector<EndingClaim>& claims) {
  py::list all;
  for (const EndingClaim& claim : claims) {
    py::list numbers;
    for (const ClaimNumber& number : claim.numbers) {
      py::dict one;
      one["name"] = number.name;
      one["value"] = number.value;
      one["unit"] = number.unit;
      one["at_most"] = number.at_most;
      one["at_least"] = number.at_least;
      numbers.append(one);
    }
    py::dict one;
    one["statement"] = claim.statement;
    one["variables"] = claim.variables;
    one["test"] = claim.test;
    one["numbers"] = numbers;
    all.append(one);
  }
  return all;
}

py::list list_of(const std::vector<FoundBasin>& basins, const DesignSpace& space) {
  py::list all;
  for (const FoundBasin& basin : basins) {
    py::dict place;
    for (int i = 0; i < space.size(); ++i)
      place[py::str(space[i].name)] = basin.minimum.values[static_cast<std::size_t>(i)];
    py::dict one;
    one["place"] = place;
    one["value"] = basin.value;
    one["times_found"] = basin.hits;
    one["searched_to_its_end"] = basin.has_ended;
    all.append(one);
  }
  return all;
}

void bind_score(py::module_& module) {
  py::class_<Score>(module,
                    "Score",
                    "The outcome of a point, to be minimized.\n\nvalue: the target; the sum of "
                    "squares of the residuals unless given.\nresiduals (m,); jacobian (m, n): "
                    "their derivatives with respect to the values of the point.\nconstraints c <= "
                    "0 and equations h = 0, scaled so that 1 is a large violation.")
      .def(py::init(&score),
           py::arg("value") = py::none(),
           py::kw_only(),
           py::arg("residuals") = py::none(),
           py::arg("jacobian") = py::none(),
           py::arg("constraints") = std::vector<double>{},
           py::arg("equations") = std::vector<double>{},
           py::arg("stand_ins") = 0)
      .def_readonly("value", &Score::value)
      .def_property_readonly(
          "residuals", [](const Score& s) { return array(s.residuals); }, "Array (m,).")
      .def_property_readonly(
          "jacobian",
          [](const Score& s) -> py::object {
            if (s.jacobian.empty()) return py::none();
            const auto rows = static_cast<py::ssize_t>(s.residuals.size());
            const auto columns = static_cast<py::ssize_t>(s.jacobian.size()) / rows;
            return Array({rows, columns}, s.jacobian.data());
          },
          "Array (m, n); None if it is not known.")
      .def_property_readonly("constraints", [](const Score& s) { return array(s.constraints); })
      .def_property_readonly("equations", [](const Score& s) { return array(s.equations); })
      .def_property_readonly(
          "violation",
          [](const Score& s) { return violation(s); },
          "The largest of c and |h|; 0 if all are fulfilled.")
      .def(
          "is_better_than",
          [](const Score& a, const Score& b) { return is_better(a, b); },
          py::arg("other"))
      .def(py::pickle(  // so that a Score can be passed between processes
          [](const Score& s) {
            return py::make_tuple(
                s.value, s.residuals, s.jacobian, s.stand_ins, s.constraints, s.equations);
          },
          [](const py::tuple& t) {
            return Score{t[0].cast<double>(),
                         t[1].cast<std::vector<double>>(),
                         t[2].cast<std::vector<double>>(),
                         t[3].cast<int>(),
                         t[4].cast<std::vector<double>>(),
                         t[5].cast<std::vector<double>>()};
          }))
      .def("__repr__", [](const Score& s) {
        return py::str("Score({!r}, {} residuals)").format(s.value, s.residuals.size());
      });
}

void bind_makers(py::module_& module) {
  module.def("_optimizer",
             [](const DesignSpace& space,
                const std::string& method,
                const std::string& options,
                bool residuals,
                bool jacobian,
                bool constraints,
                double failed,
                int basins) {
               const auto known = traits(residuals, jacobian, constraints, failed, basins);
               return made(space, chosen(space, method, options, known));
             });
  module.def(
      "_cascade",
      [](const DesignSpace& space,
         const std::string& method,
         const std::string& options,
         int stages,
         double tightening) {
        const auto of = chosen(space, method, options, {.has_residuals = true});
        return std::make_unique<AskTell>(
            space,
            std::make_unique<Cascade>(
                space, CascadeOptions{.stages = stages, .tightening = tightening}, maker(of)),
            MethodChoice{of.method, of.reason});
      });
  module.def("_multi_start",
             [](const DesignSpace& space,
                const Array& starts,
                const std::string& method,
                const std::string& options) {
               const auto of = chosen(space, method, options, {.has_residuals = true});
               if (starts.ndim() != 2) throw InputError("starts: expected an array (k, n)");
               const Eigen::MatrixXd rows = matrix(starts, starts.shape(0), space.size(), "starts");
               std::vector<DesignPoint> points;
               for (Eigen::Index k = 0; k < rows.rows(); ++k) {
                 const Eigen::VectorXd row = rows.row(k);
                 points.push_back({{row.begin(), row.end()}});
               }
               return std::make_unique<AskTell>(
                   space,
                   std::make_unique<MultiStart>(space, std::move(points), maker(of)),
                   MethodChoice{of.method, of.reason});
             });
}

}  // namespace

void bind_optimizers(py::module_& module) {
  bind_score(module);
  py::class_<AskTell>(module, "Optimizer", "Proposes points and receives their outcomes.")
      .def(
          "propose",
          [](AskTell& of, int count) { return array(of.propose(count), of.space().size()); },
          py::arg("count") = 1,
          "Returns at most `count` different points in the order of their priority; none only if "
          "the search has\nconverged. Array (k, n). Evaluate as many as there are workers, observe "
          "the first, then propose again.")
      .def(
          "observe",
          [](AskTell& of, const Array& at, const py::object& outcome) {
            const int n = of.space().size();
            of.observe(point_of_search(at, of.space()), outcome_of(outcome, n));
          },
          py::arg("point"),
          py::arg("outcome"),
          "Records the outcome of a point (n,): the target, a Score or a Failure. The point need "
          "not have been\nproposed, but it lies within the bounds. A number that is not finite "
          "counts as a failure, with a Python\nwarning. Raises InputError if the number "
          "of residuals or constraints\ndiffers from that of the first point.")
      .def_property_readonly(
          "best",
          [](AskTell& of) -> py::object {
            const auto best = of.best();
            if (!best) return py::none();
            return py::make_tuple(array(best->first.values), best->second);
          },
          "The best point observed so far (n,) and its Score, as a pair; None if none has "
          "succeeded. A point that\nviolates constraints less is better than one that violates "
          "them more, whatever their targets.")
      .def_property_readonly("converged", &AskTell::converged)
      .def_property_readonly("ending",
                             &AskTell::ending,
                             "The reason for the convergence, as the end of a sentence; empty if "
                             "the method states none.")
      .def_property_readonly(
          "claims",
          [](AskTell& of) { return list_of(of.claims()); },
          "The statements of `ending`, each a dictionary of statement, variables (names; none: the "
          "whole search), test and\nnumbers: a list of dictionaries of name, value, unit, at_most "
          "and at_least, the limits that the test has or None.")
      .def_property_readonly(
          "minima",
          [](AskTell& of) { return list_of(of.basins(), of.space()); },
          "The minima that global_=\"basins\" has found by now, lowest first, each a dictionary of "
          "place (value by name of the\nvariable, in the units of the points), value, times_found "
          "(points that belong to it) and searched_to_its_end;\nempty for other searches.")
      .def_property_readonly("space", &AskTell::space)
      .def_property_readonly(
          "method", [](const AskTell& of) { return std::string(name(of.choice().method)); })
      .def_property_readonly(
          "reason",
          [](const AskTell& of) { return of.choice().reason; },
          "The reason for the choice of this method.");
  bind_makers(module);
  module.def("method_names", &method_names, "The names of all methods, and \"auto\".");
}

}  // namespace latsch::python
