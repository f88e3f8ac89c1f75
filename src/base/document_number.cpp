// SPDX-License-Identifier: Apache-2.0
#include "base/document_number.h"

#include <cassert>
#include <cmath>

namespace latsch {
namespace {

/// Returns the unit that applies to a number written without a unit.
std::optional<Unit> unit_beside(const DocumentValue& value) {
  return Unit::find(value.unit.empty() ? "1" : value.unit);
}

}  // namespace

std::optional<DocumentNumber> number_of(const DocumentValue& value) {
  std::optional<DocumentNumber> number;
  if (value.kind == DocumentValue::Kind::text) {
    if (const auto quantity = parse_quantity(value.text))
      number = DocumentNumber{quantity->unit, quantity->si};
  } else if (value.kind == DocumentValue::Kind::number) {
    const auto unit = unit_beside(value);
    const auto parts = split_number(value.text);
    if (unit && parts) number = DocumentNumber{*unit, unit->to_si(parts->number)};
  }
  if (number && !std::isfinite(number->si)) number.reset();
  return number;
}

DocumentValue with_number(DocumentValue value, double si) {
  assert(value.number && std::isfinite(si));
  std::string digits = value.number->unit.exact_number(si);
  if (value.kind == DocumentValue::Kind::text) {
    const std::string_view old = split_number(value.text)->digits;
    digits += value.text.substr(old.data() + old.size() - value.text.data());
  } else {
    // TOML distinguishes integers from floats: an integer stays an integer while its digits look
    // like one.
    const bool like_integer = digits.find_first_not_of("-0123456789") == digits.npos;
    value.integer = value.integer && like_integer && digits.size() < 16 && digits != "-0";
    if (like_integer && !value.integer) digits += ".0";
  }
  value.text = digits;
  value.number->si = si;
  return value;
}

}  // namespace latsch
