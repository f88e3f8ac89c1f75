// SPDX-License-Identifier: Apache-2.0
// Converts recordings to the signs of another convention, for output only: recordings, measurements
// and fits use the signs of ISO 8855 (models/suspension/sign_views.h has the factors). Only signs
// change: dy remains the column dy, and is positive to the right if the convention's y is.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/test.h"

namespace latsch::experiment {

/// Returns "iso", "sae", "adams".
const std::vector<std::string>& sign_view_names();
/// Returns the sign convention (view) with one of these names.
suspension::SignView sign_view(const std::string& name);

/// True if a test states the positive directions of its channels.
bool has_sign_views(const Test& test);
/// Converts values and derivatives; a channel whose positive direction the test does not state is
/// unchanged.
Channels in_signs(const Channels& recorded, const Test& test, suspension::SignView view);

}  // namespace latsch::experiment
