// SPDX-License-Identifier: Apache-2.0
// Converts a value of a document into a number and a number back into the value's text.
#pragma once

#include <optional>

#include "base/document_tree.h"

namespace latsch {

/// Returns nothing if the value does not stand for a finite number.
std::optional<DocumentNumber> number_of(const DocumentValue& value);

/// Returns the value with another number (SI), written in the unit of the file.
DocumentValue with_number(DocumentValue value, double si);

}  // namespace latsch
