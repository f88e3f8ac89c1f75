// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/stated_share.h"

#include <cctype>
#include <optional>

#include "base/document_record.h"
#include "base/error.h"
#include "base/text.h"

namespace latsch::correlation {
namespace {

/// Returns the text that the key has; nothing if its value is a number.
std::optional<std::string> text_at(const Node& table, const std::string& key) {
  try {
    return table.text(key);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool has_no_unit(const std::string& written) {
  const std::string_view text = trimmed(written);
  return text.empty() || std::isdigit(static_cast<unsigned char>(text.back())) ||
         text.back() == '.';
}

}  // namespace

void expect_stated_share(const Node& table,
                         const std::string& key,
                         const std::string& written,
                         double share,
                         const std::string& unit) {
  if (!(share > 1.0) || !has_no_unit(written)) return;
  const std::string number = format_number(share);
  std::string expected = "\"" + number + " %\"";
  if (unit != "1") expected += " or \"" + number + " " + unit + "\"";
  const std::string percent = format_number(100.0 * share) + " %";
  // A share above 1 may be meant as a share without unit if it is no noise; a noise is never larger
  // than the value itself.
  if (unit == "1") expected += ", or \"" + percent + "\" if that is meant";
  table.reject(key,
               "is " + number + " without a unit, which is " + percent + "; expected " + expected);
}

double read_share(const Node& table, const std::string& key, Range range, const std::string& unit) {
  DocumentRecord::expects(table, key, R"(a share such as "3 %"; without a unit at most 1)");
  // read first, because the last type that is read is recorded for the key
  const auto text = text_at(table, key);
  const double share = table.quantity(key, "1", range);
  expect_stated_share(table, key, text.value_or(""), share, unit);
  return share;
}

bool is_percentage(const Node& table, const std::string& key) {
  try {
    return table.text(key).ends_with('%');
  } catch (const InputError&) {
    return false;  // a plain number
  }
}

}  // namespace latsch::correlation
