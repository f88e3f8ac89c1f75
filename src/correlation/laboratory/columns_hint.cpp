// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/columns_hint.h"

#include <algorithm>
#include <cctype>

#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::correlation {
namespace {

/// Returns a string of TOML with its quotes: single ones if it contains a quote or a backslash.
std::string toml_text(const std::string& text) {
  const bool is_literal = text.find_first_of("\"\\") != text.npos;
  const char* quote = is_literal ? "'" : "\"";
  return quote + text + quote;
}

}  // namespace

std::string toml_key(const std::string& key) {
  const bool is_bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return (c < 0x80 && std::isalnum(c)) || c == '_' || c == '-';
  });
  return is_bare ? key : toml_text(key);
}

std::string columns_hint(std::map<std::string, StatedColumn> stated,
                         const std::string& channel,
                         StatedColumn column) {
  std::erase_if(stated, [&](const auto& one) { return one.second.column == column.column; });
  stated[channel] = std::move(column);
  std::string text;
  for (const auto& [ours, theirs] : stated) {
    const std::string sign = theirs.sign < 0.0 ? "-" : "";
    const std::string unit = theirs.unit.empty() ? "" : " [" + theirs.unit + "]";
    text += (text.empty() ? "" : ", ") + toml_key(ours) + " = " +
            toml_text(sign + theirs.column + unit);
  }
  return "columns = {" + text + "}";
}

std::string key_for(const std::string& channel, const std::string& column) {
  const auto known = recognized(column);
  if (known && !known->keeps_name && same_channel(known->meaning->name, channel))
    return known->channel;
  const auto wanted = recognized(channel);
  return wanted && !wanted->keeps_name ? wanted->channel : channel;
}

StatedColumn with_natural_unit(StatedColumn column, const std::string& unit) {
  if (column.unit.empty() && unit != "1") column.unit = natural_unit(unit);
  return column;
}

}  // namespace latsch::correlation
