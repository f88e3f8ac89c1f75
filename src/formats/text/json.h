// SPDX-License-Identifier: Apache-2.0
// The JSON type of the program's answers: its keys keep the order in which they were written.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace latsch {

using Json = nlohmann::ordered_json;

}  // namespace latsch
