// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/ring_doubts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "models/magic_formula/magic_formula.h"
#include "models/rigid_ring/ring_constants.h"
#include "models/rigid_ring/tandem_cams.h"

namespace latsch::rigid_ring {
namespace {

using magic_formula::MagicFormula;
using magic_formula::Parameters;
using magic_formula::SteadyState;

/// A number of the cams with the values that cams have. Published tires have a shift of 0.8, a
/// length of 1.0 to 1.5, a height of 0.9 to 1.2 and an order of 1.8.
struct CamNumber {
  const char *name, *meaning;
  double Parameters::*member;
  double from, to;
};
constexpr CamNumber kCamNumbers[] = {
    {"ELLIPS_SHIFT",
     "the distance of the cams over the length of the patch",
     &Parameters::ELLIPS_SHIFT,
     0.05,
     3.0},
    {"ELLIPS_LENGTH",
     "the half length of a cam over UNLOADED_RADIUS",
     &Parameters::ELLIPS_LENGTH,
     0.1,
     5.0},
    {"ELLIPS_HEIGHT",
     "the half height of a cam over UNLOADED_RADIUS",
     &Parameters::ELLIPS_HEIGHT,
     0.1,
     5.0},
    {"ELLIPS_ORDER", "the order of the outline of a cam", &Parameters::ELLIPS_ORDER, 1.0, 10.0}};

SteadyState at_nominal_load(const Parameters& p) {
  return MagicFormula(p).evaluate({p.FNOMIN, 0.0, 0.0, 0.0, 0.0, p.LONGVL, p.NOMPRES});
}

void add_assumed(const std::function<bool(std::string_view)>& is_given,
                 std::vector<std::string>& sentences) {
  const Parameters usual;
  std::vector<std::string> cams, dampings;
  for (const CamNumber& one : kCamNumbers)
    if (!is_given(one.name)) cams.push_back(fmt::format("{} = {:g}", one.name, usual.*one.member));
  if (!is_given("ELLIPS_NWIDTH"))
    cams.push_back(fmt::format("ELLIPS_NWIDTH = {:g}", usual.ELLIPS_NWIDTH));
  if (!cams.empty())
    sentences.push_back(
        fmt::format("{} {} assumed, the cams of a usual tire, because the file does not state {}: "
                    "forces over obstacles depend on {}",
                    fmt::join(cams, ", "),
                    cams.size() == 1 ? "is" : "are",
                    cams.size() == 1 ? "it" : "them",
                    cams.size() == 1 ? "it" : "them"));
  for (const char* name : {"DAMP_LONG", "DAMP_LAT", "DAMP_YAW", "DAMP_WINDUP", "DAMP_RESIDUAL"})
    if (!is_given(name)) dampings.emplace_back(name);
  if (!dampings.empty())
    sentences.push_back(fmt::format("there is no {}; taken as 0: the belt vibrates undamped",
                                    fmt::join(dampings, ", no ")));
}

}  // namespace

Status check_cams(const Parameters& p) {
  for (const CamNumber& one : kCamNumbers) {
    const double value = p.*one.member;
    if (value >= one.from && value <= one.to) continue;
    return Failure{fmt::format(
        "{} is {:g}, expected {:g} to {:g}: {}", one.name, value, one.from, one.to, one.meaning)};
  }
  const double a = at_nominal_load(p).a;
  if (a >= 0.0 && a < p.UNLOADED_RADIUS) return {};
  const char* names = p.version == magic_formula::Version::mf52 ? "Q_A1 and Q_A2" : "Q_RA1, Q_RA2";
  return Failure{fmt::format(
      "{} give a patch of {:.4g} mm half length at FNOMIN, expected less than UNLOADED_RADIUS, "
      "{:.4g} mm",
      names,
      1e3 * a,
      1e3 * p.UNLOADED_RADIUS)};
}

std::vector<std::string> ring_doubts(const Parameters& p,
                                     const std::function<bool(std::string_view)>& is_given) {
  std::vector<std::string> sentences;
  add_assumed(is_given, sentences);
  if (p.GRAVITY > 0.0)
    sentences.push_back(fmt::format(
        "GRAVITY is {:g} m/s^2, expected a negative number: z points up, so the belt weighs upward",
        p.GRAVITY));
  const int tracks = TandemCams(p).tracks();
  if (p.ELLIPS_NWIDTH != tracks)
    sentences.push_back(
        fmt::format("ELLIPS_NWIDTH is {:g}; {} pairs of cams are used", p.ELLIPS_NWIDTH, tracks));
  const auto ring = ring_constants(p, at_nominal_load(p).R_l);
  if (!ring) return sentences;  // the tire is refused with the same reason
  for (std::string& one : contradictions(*ring)) sentences.push_back(std::move(one));
  return sentences;
}

}  // namespace latsch::rigid_ring
