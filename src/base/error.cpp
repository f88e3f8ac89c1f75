// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

namespace latsch {

std::string Place::text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }

InputError::InputError(const Place& place, const std::string& message)
    : std::runtime_error(place.file.empty() ? message : place.text() + ": " + message),
      place_(place) {}

InputError::InputError(const std::string& message) : std::runtime_error(message) {}

}  // namespace latsch
