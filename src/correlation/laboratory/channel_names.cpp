// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/channel_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "base/units.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/suspension_checks.h"

namespace latsch::correlation {
namespace {

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

/// Returns the end of a name that names a wheel, such as "_L"; empty if there is none.
std::string wheel_of(const std::string& name) {
  for (const std::string& end : wheel_ends())
    if (name.ends_with(end)) return end;
  return "";
}

/// Returns "FyW" for "FYW"; empty if the name is not that of a force or moment.
std::string force_or_moment(const std::string& name) {
  std::string upper = name;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto among = [&](std::size_t i, std::string_view letters) {
    return letters.find(upper[i]) != letters.npos;
  };
  const bool framed = upper.size() == 3 && among(2, "WHC");
  if (!(upper.size() == 2 || framed) || !among(0, "FM") || !among(1, "XYZ")) return "";
  upper[1] = static_cast<char>(std::tolower(upper[1]));
  return upper;
}

}  // namespace

std::string our_name(const std::string& name, const std::string& unit) {
  const auto found = recognized(name);
  if (!found || found->keeps_name) return name;
  const bool is_of_dimension = Unit::of(unit).same_dimension(Unit::of(found->meaning->unit));
  return is_of_dimension ? found->channel : name;
}

std::string dimension_of_name(const std::string& name) {
  constexpr std::array<std::string_view, 8> kOfTires = {
      "time", "Vx", "omega", "alpha", "gamma", "kappa", "loaded_radius", "R_e"};
  const auto found = recognized(name);
  if (!found || name.size() < 2 || found->keeps_name) return "";
  // The word "road" means a temperature in tire tests and a height elsewhere.
  const bool is_ours = find_meaning(name) != nullptr && force_or_moment(name).empty();
  if (is_ours && std::find(kOfTires.begin(), kOfTires.end(), name) == kOfTires.end()) return "";
  return std::string(found->meaning->unit);
}

std::string force_without_frame(const std::string& name) {
  const std::string wheel = wheel_of(name);
  const std::string force = force_or_moment(name.substr(0, name.size() - wheel.size()));
  return force.empty() ? "" : force.substr(0, 2) + wheel;
}

NamedChannel find_named(const std::vector<std::string>& names, const std::string& wanted) {
  if (std::find(names.begin(), names.end(), wanted) != names.end()) return {wanted, ""};
  const auto found = recognized(wanted);
  const std::string ours = found ? found->channel : wanted;
  if (found) {
    if (std::find(names.begin(), names.end(), ours) != names.end()) return {ours, ""};
    for (const std::string& name : names)
      if (same_channel(name, ours)) return {name, ""};
  }
  const std::string wheel = wheel_of(ours);
  const std::string force = ours.substr(0, ours.size() - wheel.size());
  for (const std::string& name : names)
    for (const char* frame : {"W", "H", "C"})
      if (same(name, force + frame + wheel)) return {name, frame};
  return {};
}

}  // namespace latsch::correlation
