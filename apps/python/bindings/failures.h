// SPDX-License-Identifier: Apache-2.0
// Converts failures between the languages: latsch.Failure is an exception that may also be a value
// in a list.
#pragma once

#include <pybind11/pybind11.h>

#include "base/result.h"

namespace latsch::python {

/// Returns an instance of latsch.Failure.
pybind11::object failure_value(const Failure& failure);
/// Raises the failure.
[[noreturn]] void raise(const Failure& failure);
bool is_failure(const pybind11::handle& value);
/// Converts an instance of latsch.Failure.
Failure failure_of(const pybind11::handle& value);

}  // namespace latsch::python
