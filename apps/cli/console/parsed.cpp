// SPDX-License-Identifier: Apache-2.0
#include "cli/console/parsed.h"

#include "base/text.h"
#include "base/toml/toml_text.h"

namespace latsch::cli {

double parse_option(const std::string& option,
                    const std::string& text,
                    const std::string& unit,
                    Range range) {
  const bool plain = unit == "1" && parse_number(text);
  const Document line =
      Document::parse(toml_key(option) + " = " + (plain ? text : toml_text(text)), "");
  return line.root().quantity(option, unit, range);
}

double parse_share_option(const std::string& option, const std::string& text) {
  const double share = parse_option(option, text, "1");
  if (share > 1.0 && parse_number(text))
    throw InputError(option + " " + text + ": without a unit this is " +
                     format_number(100.0 * share) + " %; expected \"" + format_number(share) +
                     " %\", or \"" + format_number(100.0 * share) + " %\" if that is meant");
  return share;
}

void set_variable(const DesignSpace& space, const std::string& assignment, DesignPoint& point) {
  const size_t equal = assignment.find('=');
  if (equal == std::string::npos) {
    throw InputError("--set " + in_quotes(assignment) +
                     ": expected name=value, such as \"matrix=12 N/mm^2\"");
  }
  const std::string name(trimmed(assignment.substr(0, equal)));
  std::vector<std::string> names;
  for (int i = 0; i < space.size(); ++i) {
    const DesignVariable& variable = space[i];
    names.push_back(variable.name);
    if (variable.name != name) continue;
    point.values[i] = parse_option(name,
                                   std::string(trimmed(assignment.substr(equal + 1))),
                                   variable.unit,
                                   Range::between(variable.lower, variable.upper));
    return;
  }
  throw InputError("--set: no variable " + in_quotes(name) + did_you_mean(name, names) +
                   "; expected " + list_of(names));
}

}  // namespace latsch::cli
