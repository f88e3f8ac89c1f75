// SPDX-License-Identifier: Apache-2.0
// A value of a document as a number, from its text and back into it.
#pragma once

#include <optional>

#include "base/document_tree.h"

namespace latsch {

/// Nothing where the value does not stand for a finite number.
std::optional<DocumentNumber> number_of(const DocumentValue& value);

/// The value with another number, SI, written in the unit the file has.
DocumentValue with_number(DocumentValue value, double si);

}  // namespace latsch
