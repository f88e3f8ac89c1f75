// SPDX-License-Identifier: Apache-2.0
// Samples of a study's posterior density for Python.
#pragma once

#include <pybind11/pybind11.h>

#include "correlation/posterior/posterior.h"

namespace latsch::python {

/// Returns the fields of latsch.Posterior as a dict of arrays, texts and numbers; values are in SI.
/// `study` is the study in the stage whose fit was sampled.
pybind11::dict as_dict(const correlation::Study& study, const correlation::Posterior& posterior);

}  // namespace latsch::python
