// SPDX-License-Identifier: Apache-2.0
// A value of a document as a number: "2.6 bar", 0.49, or 310 in {unit = "mm", values = [310]}.
#pragma once

#include <optional>

#include "base/document_tree.h"
#include "base/units.h"

namespace latsch {

struct DocumentNumber {
  Unit unit;
  double si = 0.0;
};

/// Nothing where the value does not stand for a finite number.
std::optional<DocumentNumber> number_of(const DocumentValue& value);

/// Writes the SI value in the unit the file has.
void set_number(DocumentValue& value, double si);

}  // namespace latsch
