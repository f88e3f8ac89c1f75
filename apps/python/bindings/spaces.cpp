// SPDX-License-Identifier: Apache-2.0
// Design spaces: variables with bounds and scales, linear constraints, the unit cube.
#include <pybind11/operators.h>

#include <limits>

#include "base/units.h"
#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "optimization/problem/design_space.h"

namespace latsch::python {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Scale scale_of(const std::string& name) {
  if (name == "linear") return Scale::linear;
  if (name == "logarithmic") return Scale::logarithmic;
  throw InputError("scale is \"" + name + "\", expected linear or logarithmic");
}

DesignVariable variable(const std::string& name,
                        double lower,
                        double upper,
                        double initial,
                        const std::string& scale,
                        const std::string& unit) {
  return {.name = name,
          .lower = lower,
          .upper = upper,
          .initial = initial,
          .scale = scale_of(scale),
          .unit = unit};
}

/// Applies a function to every row of an array of shape (k, n), or to a single point of shape (n,).
template <class Of>
Array of_rows(const Array& values, int variables, const Of& of) {
  if (values.ndim() == 1) return array(of(point(values, variables)));
  if (values.ndim() != 2 || values.shape(1) != variables) point(values, variables);  // throws
  Array all({values.shape(0), values.shape(1)});
  for (py::ssize_t row = 0; row < values.shape(0); ++row) {
    const std::vector<double> found =
        of(DesignPoint{{values.data(row), values.data(row) + variables}});
    std::copy(found.begin(), found.end(), all.mutable_data(row));
  }
  return all;
}

void bind_variables(py::module_& module) {
  py::class_<DesignVariable>(
      module, "Variable", "A variable of a search: a name, bounds, an initial value, a scale.")
      .def(py::init(&variable),
           py::arg("name"),
           py::kw_only(),
           py::arg("lower") = 0.0,
           py::arg("upper") = 1.0,
           py::arg("initial") = 0.5,
           py::arg("scale") = "linear",
           py::arg("unit") = "1")
      .def_readonly("name", &DesignVariable::name)
      .def_readonly(
          "lower", &DesignVariable::lower, "The lower bound in SI, as are upper and initial.")
      .def_readonly("upper", &DesignVariable::upper)
      .def_readonly("initial", &DesignVariable::initial)
      .def_property_readonly("scale",
                             [](const DesignVariable& v) {
                               return v.scale == Scale::linear ? "linear" : "logarithmic";
                             })
      .def_readonly("unit", &DesignVariable::unit, "The unit for display.")
      .def_readonly("paths",
                    &DesignVariable::paths,
                    "Paths of the numbers of the model that are set to its value.")
      .def(
          "text",
          [](const DesignVariable& v, double value) { return format_quantity(value, v.unit, 4); },
          py::arg("value"),
          "Returns a value, given in SI, with the unit for display: \"22 kN/mm\".")
      .def("__repr__", [](const DesignVariable& v) {
        return py::str("Variable({!r}, lower={!r}, upper={!r}, initial={!r}, scale={!r})")
            .format(v.name,
                    v.lower,
                    v.upper,
                    v.initial,
                    v.scale == Scale::linear ? "linear" : "logarithmic");
      });
  py::class_<LinearConstraint>(module,
                               "LinearConstraint",
                               "lower <= sum of coefficients * values <= upper; equal bounds make "
                               "an equation.")
      .def(py::init([](const std::string& name,
                       const std::vector<double>& coefficients,
                       double lower,
                       double upper) {
             return LinearConstraint{
                 .name = name, .coefficients = coefficients, .lower = lower, .upper = upper};
           }),
           py::arg("name"),
           py::arg("coefficients"),
           py::kw_only(),
           py::arg("lower") = -kInfinite,
           py::arg("upper") = kInfinite)
      .def_readonly("name", &LinearConstraint::name)
      .def_property_readonly("coefficients",
                             [](const LinearConstraint& c) { return array(c.coefficients); })
      .def_readonly("lower", &LinearConstraint::lower)
      .def_readonly("upper", &LinearConstraint::upper);
}

}  // namespace

void bind_spaces(py::module_& module) {
  bind_variables(module);
  const auto of_variables = [](double DesignVariable::*member) {
    return [member](const DesignSpace& space) {
      std::vector<double> values;
      for (const DesignVariable& v : space.variables()) values.push_back(v.*member);
      return array(values);
    };
  };
  py::class_<DesignSpace>(
      module, "DesignSpace", "Variables with their bounds, and linear constraints on them.")
      .def(py::init<std::vector<DesignVariable>, std::vector<LinearConstraint>>(),
           py::arg("variables"),
           py::arg("constraints") = std::vector<LinearConstraint>{})
      .def("__len__", &DesignSpace::size)
      .def("__getitem__",
           [](const DesignSpace& space, int i) {
             if (i < 0) i += space.size();
             if (i < 0 || i >= space.size()) throw py::index_error();
             return space[i];
           })
      .def_property_readonly("variables", &DesignSpace::variables)
      .def_property_readonly("constraints", &DesignSpace::constraints)
      .def_property_readonly("names",
                             [](const DesignSpace& space) {
                               std::vector<std::string> names;
                               for (const auto& v : space.variables()) names.push_back(v.name);
                               return names;
                             })
      .def_property_readonly("lower", of_variables(&DesignVariable::lower), "Array (n,).")
      .def_property_readonly("upper", of_variables(&DesignVariable::upper), "Array (n,).")
      .def_property_readonly(
          "initial",
          [](const DesignSpace& space) { return array(space.initial().values); },
          "Array (n,).")
      .def(
          "contains",
          [](const DesignSpace& space, const Array& at) {
            return space.contains(point(at, space.size()));
          },
          py::arg("point"),
          "True if a point (n,) is inside the bounds and the constraints.")
      .def(
          "to_unit",
          [](const DesignSpace& space, const Array& at) {
            return of_rows(at, space.size(), [&](const DesignPoint& p) {
              if (!space.place(p))
                throw InputError(
                    "a value of the point is not finite, or not positive on a logarithmic scale");
              return space.to_unit(p);
            });
          },
          py::arg("points"),
          "Maps points (n,) or (k, n) into the unit cube and clamps them to it.")
      .def(
          "from_unit",
          [](const DesignSpace& space, const Array& u) {
            return of_rows(u, space.size(), [&](const DesignPoint& p) {
              return space.from_unit(p.values).values;
            });
          },
          py::arg("u"),
          "The inverse of to_unit, for an array (n,) or (k, n).")
      .def(
          "starting_at",
          [](const DesignSpace& space, const Array& at) {
            return space.starting_at(point_within(space, at));
          },
          py::arg("point"),
          "Returns the same space with this initial point.")
      .def(
          "tightened",
          [](const DesignSpace& space, const Array& at, double factor) {
            return space.tightened(point(at, space.size()), factor);
          },
          py::arg("point"),
          py::arg("factor"),
          "Returns the space with bounds `factor` (0..1) times as wide around a point, inside the "
          "old ones.");
}

}  // namespace latsch::python
