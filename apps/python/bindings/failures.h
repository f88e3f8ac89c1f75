// SPDX-License-Identifier: Apache-2.0
// Converts failures between C++ and Python. latsch.Failure is a Python exception that may also be a
// value in a list.
#pragma once

#include <pybind11/pybind11.h>

#include "base/result.h"

namespace latsch::python {

/// Returns an instance of latsch.Failure for the failure.
pybind11::object failure_value(const Failure& failure);
/// Raises the failure as a Python exception.
[[noreturn]] void raise(const Failure& failure);
bool is_failure(const pybind11::handle& value);
/// Converts an instance of latsch.Failure to a C++ Failure.
Failure failure_of(const pybind11::handle& value);

}  // namespace latsch::python
