// SPDX-License-Identifier: Apache-2.0
// Functions that define the parts of the Python extension module, each in a file of its own.
#pragma once

#include <pybind11/pybind11.h>

namespace latsch::python {

void bind_spaces(pybind11::module_& module);           // variables, bounds, linear constraints
void bind_designs(pybind11::module_& module);          // designs of experiments
void bind_optimizers(pybind11::module_& module);       // optimizers with ask and tell
void bind_identifiability(pybind11::module_& module);  // confidence, profiles
void bind_models(pybind11::module_& module);           // models and their tests
void bind_studies(pybind11::module_& module);          // studies and their journals

}  // namespace latsch::python
