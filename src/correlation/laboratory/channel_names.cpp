// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/channel_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "base/units.h"

namespace latsch::correlation {
namespace {

struct Synonym {
  std::string_view ours, unit, theirs;
};

constexpr std::array kSynonyms = {Synonym{"time", "s", "ET"},
                                  Synonym{"time", "s", "RUNTIME"},
                                  Synonym{"Vx", "m/s", "V"},
                                  Synonym{"Vx", "m/s", "LONGVEL"},
                                  Synonym{"omega", "rad/s", "N"},
                                  Synonym{"omega", "rad/s", "WHROTSPD"},
                                  Synonym{"alpha", "rad", "SA"},
                                  Synonym{"alpha", "rad", "SLIPANGL"},
                                  Synonym{"gamma", "rad", "IA"},
                                  Synonym{"gamma", "rad", "INCLANGL"},
                                  Synonym{"kappa", "1", "SR"},
                                  Synonym{"kappa", "1", "LONGSLIP"},
                                  Synonym{"p", "Pa", "P"},
                                  Synonym{"p", "Pa", "INFLPRES"},
                                  Synonym{"loaded_radius", "m", "RL"},
                                  Synonym{"loaded_radius", "m", "DSTGRWHC"},
                                  Synonym{"loaded_radius", "m", "R_l"},
                                  Synonym{"R_e", "m", "RE"},
                                  Synonym{"tread", "K", "TRDTEMP"},
                                  Synonym{"tread_inner", "K", "TSTI"},
                                  Synonym{"tread_center", "K", "TSTC"},
                                  Synonym{"tread_outer", "K", "TSTO"},
                                  Synonym{"road", "K", "RST"},
                                  Synonym{"road", "K", "TRCKTEMP"},
                                  Synonym{"ambient", "K", "AMBTMP"},
                                  Synonym{"ambient", "K", "AMBITEMP"}};

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

/// "FYW" -> "FyW"; empty for what is no force or moment.
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

/// In whatever unit.
std::string synonym_of(const std::string& name) {
  for (const Synonym& synonym : kSynonyms)
    if (synonym.theirs == name) return std::string(synonym.ours);
  return name;
}

}  // namespace

std::string our_name(const std::string& name, const std::string& unit) {
  const auto dimension = Unit::of(unit).dimension();
  const auto has = [&](std::string_view other) { return Unit::of(other).dimension() == dimension; };
  for (const Synonym& synonym : kSynonyms) {
    // One letter means much: as it stands.
    const bool meant = name.size() > 1 ? same(synonym.theirs, name) : synonym.theirs == name;
    if (meant && has(synonym.unit)) return std::string(synonym.ours);
  }
  const std::string force = force_or_moment(name);
  if (!force.empty() && has(force[0] == 'F' ? "N" : "N m")) return force;
  return name;
}

std::string force_without_frame(const std::string& name) {
  return force_or_moment(name).substr(0, 2);
}

NamedChannel find_named(const std::vector<std::string>& names, const std::string& wanted) {
  for (const std::string& one : {wanted, synonym_of(wanted)})
    if (std::find(names.begin(), names.end(), one) != names.end()) return {one, ""};
  for (const std::string& name : names)
    for (const char* frame : {"W", "H", "C"})
      if (same(name, wanted + frame)) return {name, frame};
  return {};
}

}  // namespace latsch::correlation
