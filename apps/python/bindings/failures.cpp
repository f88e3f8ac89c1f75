// SPDX-License-Identifier: Apache-2.0
#include "bindings/failures.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"

namespace latsch::python {

namespace py = pybind11;

namespace {

constexpr std::array<std::string_view, 5> kCauses{// names in the order of the values of Cause
                                                  "point",
                                                  "timeout",
                                                  "bad_output",
                                                  "transient",
                                                  "not_begun"};

py::object failure_class() { return py::module_::import("latsch._errors").attr("Failure"); }

}  // namespace

py::object failure_value(const Failure& failure) {
  return failure_class()(failure.reason, kCauses[static_cast<std::size_t>(failure.cause)]);
}

void raise(const Failure& failure) {
  PyErr_SetObject(failure_class().ptr(), failure_value(failure).ptr());
  throw py::error_already_set();
}

bool is_failure(const py::handle& value) { return py::isinstance(value, failure_class()); }

Failure failure_of(const py::handle& value) {
  const auto cause = value.attr("cause").cast<std::string>();
  const auto found = std::find(kCauses.begin(), kCauses.end(), cause);
  if (found == kCauses.end())
    throw InputError("the cause of a Failure is \"" + cause +
                     "\", expected point, timeout, bad_output, transient or not_begun");
  return {value.attr("reason").cast<std::string>(), static_cast<Cause>(found - kCauses.begin())};
}

}  // namespace latsch::python
