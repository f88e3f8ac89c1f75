// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_missing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "base/text.h"

namespace latsch::formats {
namespace {

using magic_formula::Parameters;
using magic_formula::ParameterUnit;

/// Returns the SI unit behind a number, with a blank before it; "" for a plain number.
std::string unit_behind(ParameterUnit unit) {
  switch (unit) {
    case ParameterUnit::pressure:
      return " Pa";
    case ParameterUnit::velocity:
      return " m/s";
    case ParameterUnit::length:
      return " m";
    case ParameterUnit::force:
      return " N";
    case ParameterUnit::stiffness:
      return " N/m";
    default:
      return "";
  }
}

/// Reports missing coefficients of combined slip (R...): without them a force is not reduced by the
/// other slip.
void report_combined_slip(const Parameters& p,
                          const std::function<void(const std::string&)>& note) {
  if (p.PDX1 == 0.0 || p.PDY1 == 0.0) return;
  if (p.RBX1 == 0.0 && p.RBY1 == 0.0)
    return note(
        "there is no combined slip: RBX1 and RBY1 are 0 or missing, so that braking and steering "
        "do not diminish each other's forces");
  const auto is_whole = [&](const char* name, double value, const char* without) {
    if (value == 0.0) note(std::string(name) + " is 0 or missing, so that " + without);
    return value != 0.0;
  };
  const char* const fx = "steering does not diminish the longitudinal force";
  const char* const fy = "braking does not diminish the side force";
  if (is_whole("RBX1", p.RBX1, fx)) is_whole("RCX1", p.RCX1, fx);
  if (is_whole("RBY1", p.RBY1, fy)) is_whole("RCY1", p.RCY1, fy);
}

/// Coefficients that belong together.
struct Group {
  std::vector<std::string> names;
  std::string without;  // the quantity that is missing without them; may be empty
};

std::vector<Group> needed_by(const Parameters& p) {
  std::vector<Group> groups = {{{"PCX1", "PDX1", "PKX1"}, "longitudinal force"},
                               {{"PCY1", "PDY1", "PKY1"}, "side force"},
                               {{"PKY2"}, ""},
                               {{"QBZ1", "QCZ1", "QDZ1"}, "aligning moment of the trail"},
                               {{"LONGVL"}, ""}};
  if (p.version == magic_formula::Version::mf52) return groups;
  groups.push_back({{"Q_RA1"}, ""});
  groups.push_back({{"Q_RB1"}, ""});
  if (p.QSY1 != 0.0) groups.push_back({{"QSY7"}, "rolling resistance that grows with the load"});
  groups.push_back({{"LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS"}, ""});
  groups.push_back({{"NOMPRES"}, ""});
  return groups;
}

}  // namespace

void report_missing(const Parameters& parameters,
                    const std::function<bool(std::string_view)>& is_given,
                    const std::function<void(const std::string&)>& note) {
  report_combined_slip(parameters, note);
  for (const Group& group : needed_by(parameters)) {
    std::vector<std::string> missing;
    for (const std::string& name : group.names)
      if (!is_given(name)) missing.push_back(name);
    if (missing.empty()) continue;
    const magic_formula::ParameterField* field = magic_formula::find_parameter(missing.front());
    note(fmt::format("there is no {}; taken as {}{}{}",
                     fmt::join(missing, ", "),
                     format_number(parameters.*field->member),
                     unit_behind(field->unit),
                     group.without.empty() ? "" : ": the tire has no " + group.without));
  }
}

}  // namespace latsch::formats
