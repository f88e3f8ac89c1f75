// SPDX-License-Identifier: Apache-2.0
// Failures on their way between the languages: latsch.Failure is an exception that may stand in a
// list as a value.
#pragma once

#include <pybind11/pybind11.h>

#include "base/result.h"

namespace latsch::python {

/// An instance of latsch.Failure.
pybind11::object failure_value(const Failure& failure);
/// Raises it.
[[noreturn]] void raise(const Failure& failure);
bool is_failure(const pybind11::handle& value);
/// Of an instance of latsch.Failure.
Failure failure_of(const pybind11::handle& value);

}  // namespace latsch::python
