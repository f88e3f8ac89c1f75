// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_keys.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr const char* kDescribesTheFile = "describes the file";
constexpr const char* kSteps = "belongs to the time steps of another program";
constexpr const char* kRoadSearch = "belongs to another program's search for the road";
constexpr const char* kDeflection =
    "belongs to the deflection of PAC2002, which is VERTICAL_STIFFNESS or the curve here";
constexpr const char* kContact =
    "belongs to another program's contact with obstacles; the rigid ring here has two cams";
constexpr const char* kGyroscopic =
    "belongs to the gyroscopic couple, which this model does not have";

struct Unused {
  const char* reason;
  bool told;
};

const std::map<std::string, Unused, std::less<>>& unused_keys() {
  static const std::map<std::string, Unused, std::less<>> keys = {
      {"FILE_TYPE", {kDescribesTheFile, false}},
      {"FILE_VERSION", {kDescribesTheFile, false}},
      {"FILE_FORMAT", {kDescribesTheFile, false}},
      {"FUNCTION_NAME", {kDescribesTheFile, false}},
      {"USER_SUB_ID", {kDescribesTheFile, false}},
      {"N_TIRE_STATES", {kDescribesTheFile, false}},
      {"TYPE", {kDescribesTheFile, false}},
      {"MANUFACTURER", {kDescribesTheFile, false}},
      {"NOM_SECTION_WIDTH", {kDescribesTheFile, false}},
      {"ASPECT_RATIO", {kDescribesTheFile, false}},
      {"RIM_WIDTH", {kDescribesTheFile, false}},
      {"MESSAGES", {"belongs to another program's messages", false}},
      {"HMAX_LOCAL", {kSteps, false}},
      {"TIME_SWITCH_INTEG", {kSteps, false}},
      {"SWITCH_INTEG", {kSteps, false}},
      {"ROAD_INCREMENT", {kRoadSearch, false}},
      {"ROAD_DIRECTION", {kRoadSearch, false}},
      {"ELLIPS_MAX_STEP", {kRoadSearch, false}},
      {"ELLIPS_NLENGTH", {kContact, false}},
      {"ENV_C1", {kContact, false}},
      {"ENV_C2", {kContact, false}},
      {"CONTACT_MODEL", {kContact, false}},
      {"Q_CAM", {"belongs to a deflection of MF 6 that Q_CAM1 to Q_CAM3 have replaced", true}},
      {"MASS", {"the mass of the wheel is given in the study, not in the tire's file", false}},
      {"IXX", {"the inertia of the wheel is given in the study, not in the tire's file", false}},
      {"IYY", {"the inertia of the wheel is given in the study, not in the tire's file", false}},
      {"MC_CONTOUR_A", {"belongs to the contour of a motorcycle tire", true}},
      {"MC_CONTOUR_B", {"belongs to the contour of a motorcycle tire", true}},
      {"LGYR", {kGyroscopic, false}},
      {"QTZ1", {kGyroscopic, true}},
      {"MBELT", {kGyroscopic, true}},
      {"BELT_DYNAMICS", {"belongs to the belt of PAC2002, which this model does not have", true}},
      {"FE_METHOD",
       {"the friction ellipse is not computed; slips act on each other by the coefficients R...",
        true}},
      {"MFSAFE1", {"belongs to another program's checks of the coefficients", false}},
      {"MFSAFE2", {"belongs to another program's checks of the coefficients", false}},
      {"MFSAFE3", {"belongs to another program's checks of the coefficients", false}},
      {"PTX4", {"damping at low speed is DAMP_VLOW here", true}},
      {"PTY3", {"damping at low speed is DAMP_VLOW here", true}},
      {"QFZ1", {kDeflection, true}},
      {"QFZ2", {kDeflection, true}},
      {"QFZ3", {kDeflection, true}},
      {"QFCG1", {kDeflection, true}},
      {"BOTTOMING_RADIUS", {"the tire bottoms by BOTTOM_OFFST and BOTTOM_STIFF here", true}},
      {"DYNAMIC_STIFFNESS", {"the vertical force has no dynamic stiffening here", true}},
      {"DYNAMIC_DAMPING", {"the vertical force has no dynamic stiffening here", true}},
  };
  return keys;
}

/// True for 0, 'NO', 'OFF', 'DEFAULT' and an empty text.
bool says_off(std::string_view value) {
  const auto number = parse_number(value);
  if (number) return *number == 0.0;
  const std::string word = capitals(trimmed(value));
  return word.empty() || word == "NO" || word == "OFF" || word == "DEFAULT";
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::optional<TirReason> reason_unused(std::string_view key, std::string_view value) {
  const auto found = unused_keys().find(key);
  if (found == unused_keys().end()) return std::nullopt;
  return TirReason{found->second.reason, found->second.told && !says_off(value)};
}

std::string_view acts_only(std::string_view name) {
  if (name.starts_with("BELT_") || name.starts_with("FREQ_") || name.starts_with("Q_BV") ||
      name.starts_with("ELLIPS_") || name == "GRAVITY" ||
      (name.starts_with("DAMP_") && name != "DAMP_VLOW"))
    return "acts in the rigid ring";
  if (is_one_of(name,
                {"PDXP1",
                 "PDXP2",
                 "PDXP3",
                 "PKYP1",
                 "PDYP1",
                 "PDYP2",
                 "PDYP3",
                 "PDYP4",
                 "PHYP1",
                 "PHYP2",
                 "PHYP3",
                 "PHYP4",
                 "PECP1",
                 "PECP2",
                 "QDTP1",
                 "QCRP2",
                 "QBRP1",
                 "QDRP1"}))
    return "acts in turn slip (USE_MODE 5, turn_slip = \"on\")";
  if (is_one_of(name, {"QCRP1", "YAW_STIFFNESS", "PCMZ1", "DAMP_VLOW"}))
    return "acts at a standstill and in turn slip";
  if (is_one_of(name, {"VERTICAL_DAMPING", "BOTTOM_OFFST", "BOTTOM_STIFF"}))
    return "acts in a rolling tire, not in steady states";
  return "";
}

std::vector<std::string> keys_with_reason() {
  std::vector<std::string> keys;
  for (const auto& [key, unused] : unused_keys()) keys.push_back(key);
  return keys;
}

}  // namespace latsch::formats
