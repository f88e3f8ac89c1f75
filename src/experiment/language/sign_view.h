// SPDX-License-Identifier: Apache-2.0
// What a test records, in the signs of another convention. Only a view on the way out: recordings,
// measurements and fits are in ISO 8855's (models/suspension/sign_views.h has the factors). A sign
// changes, never an axis: dy stays the column dy and is to the right where y is.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/test.h"

namespace latsch::experiment {

/// "iso", "sae", "adams"
const std::vector<std::string>& sign_view_names();
/// By one of these names.
suspension::SignView sign_view(const std::string& name);

/// Whether a test says which way its channels are positive.
bool has_sign_views(const Test& test);
/// With slopes where there are some; a channel of which the test says nothing stays as it is.
Channels in_signs(const Channels& recorded, const Test& test, suspension::SignView view);

}  // namespace latsch::experiment
