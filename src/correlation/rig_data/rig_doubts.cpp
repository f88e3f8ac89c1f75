// SPDX-License-Identifier: Apache-2.0
#include "correlation/rig_data/rig_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "measurement/meaning/wheel_load.h"

namespace latsch::correlation {
namespace {

constexpr double kSameTurn = 0.02;     // relative difference of stated and found circumference
constexpr double kSameHit = 0.8;       // strength of a shorter period over that of the found one
constexpr double kShortestHit = 0.05;  // s, least time between two hits
// largest distance of the road, m, between two samples; the footprint is this long, so a larger
// distance misses hits
constexpr double kLongestSample = 0.1;
constexpr double kMostLeftOut = 0.5;  // share of the passages

std::string name_of(const ProcessedRun& run, const ProcessedPlateau& p) {
  return "run " + run.name + " at " + format_quantity(p.plateau.target, "km/h", 4);
}

void judge_circumference(const RigFile& rig,
                         const std::string& name,
                         double found,
                         std::vector<std::string>& doubts) {
  if (!rig.circumference || std::abs(found / *rig.circumference - 1.0) <= kSameTurn) return;
  doubts.push_back(fmt::format(
      "{}: by the speed and the period of the passages the drum has a circumference of {:.4g} m "
      "(diameter {:.4g} m), not {:.4g} m; is the speed that of its surface, is there one cleat?",
      name,
      found,
      found / std::numbers::pi,
      *rig.circumference));
}

/// Checks whether the found period contains several hits. If the stated circumference is twice the
/// true one, the search around it also finds twice the true period.
void judge_hits(const RigFile& rig,
                const ProcessedRun& run,
                const ProcessedPlateau& p,
                std::vector<std::string>& doubts) {
  if (!rig.circumference) return;  // without a stated circumference the shortest period was found
  const auto force = run.record.channel(rig.force).subspan(p.plateau.first, p.plateau.samples());
  const auto shorter = find_period(force, kShortestHit * run.record.rate, 0.6 * p.period.samples);
  if (!shorter || shorter->strength < kSameHit * p.period.strength) return;
  const double hits = p.period.samples / shorter->samples;
  if (std::abs(hits - std::round(hits)) > kSameTurn * hits) return;
  doubts.push_back(fmt::format(
      "{}: each passage has {:.0f} hits, {:.4g} m apart: is the circumference {:.4g} m, or are "
      "there {:.0f} cleats?",
      name_of(run, p),
      std::round(hits),
      p.plateau.mean * shorter->samples / run.record.rate,
      p.plateau.mean * shorter->samples / run.record.rate,
      std::round(hits)));
}

void judge_plateau(const RigFile& rig,
                   const ProcessedRun& run,
                   const ProcessedPlateau& p,
                   std::vector<std::string>& doubts) {
  const double turn = p.period.samples / run.record.rate;
  judge_circumference(rig, name_of(run, p), p.plateau.mean * turn, doubts);
  judge_hits(rig, run, p, doubts);
  const auto all = p.passages.left_out + static_cast<int>(p.passages.starts.size());
  if (p.passages.left_out > kMostLeftOut * all)
    doubts.push_back(fmt::format(
        "{}: {} of {} passages are not alike and are left out: is the margin of the speed too "
        "wide, is the cleat fixed?",
        name_of(run, p),
        p.passages.left_out,
        all));
  if (const double road = p.plateau.mean / run.record.rate; road > kLongestSample)
    doubts.push_back(fmt::format(
        "{}: there is one sample in {:.0f} mm of road, so a hit lasts hardly one sample; period "
        "and diameter are not reliable: record at {:.0f} Hz or more",
        name_of(run, p),
        1e3 * road,
        10.0 * p.plateau.mean / kLongestSample));
  if (rig.segment && *rig.segment > turn)
    doubts.push_back(fmt::format(
        "{}: spectrum.segment is {:g} s, longer than the passage of {:.4g} s, which is taken",
        name_of(run, p),
        *rig.segment,
        turn));
}

void judge_spectrum(const RigFile& rig, const ProcessedRun& run, std::vector<std::string>& doubts) {
  const double highest = 0.5 * run.record.rate;
  if (rig.band.upper > highest)
    doubts.push_back(fmt::format(
        "run {}: {:g} samples a second contain nothing above {:g} Hz; the levels of spectrum.band "
        "end there, not at {:g} Hz",
        run.name,
        run.record.rate,
        highest,
        rig.band.upper));
  if (rig.segment && *rig.segment * rig.band.lower < 1.0)
    doubts.push_back(fmt::format(
        "run {}: the lines of spectrum.segment = {:g} s are {:.4g} Hz apart, so levels below are "
        "those of the mean of a line; expected {:.4g} s at least for {:g} Hz",
        run.name,
        *rig.segment,
        1.0 / *rig.segment,
        1.0 / rig.band.lower,
        rig.band.lower));
  if (rig.passages.align_below >= highest)
    doubts.push_back(fmt::format(
        "run {}: passages.align_below is {:g} Hz, above half the rate of {:g} Hz, so nothing is "
        "filtered for the alignment",
        run.name,
        rig.passages.align_below,
        run.record.rate));
}

/// Checks whether the real rim and the dummy have the same recording, so that their filter is 1.
void judge_rims(const CaseRow& row, std::vector<std::string>& doubts) {
  constexpr double kSame = 1e-6;  // difference over the signal: less than any noise of a recording
  double square = 0.0;
  for (const double force : row.real) square += force * force;
  const double signal = std::sqrt(square / std::max<std::size_t>(1, row.real.size()));
  if (row.dummy.time <= kSame * signal)
    doubts.push_back("case " + row.name +
                     ": the dummy and the real rim have the same force, so the filter is told "
                     "nothing by it: do both runs name the same recording?");
}

}  // namespace

std::vector<std::string> doubts_of(const RigFile& rig, const RigResults& results) {
  std::vector<std::string> doubts;
  for (const ProcessedRun& run : results.runs) {
    if (const auto reason = negative_load(rig.force, run.record.channel(rig.force)))
      doubts.push_back("run " + run.name + ": " + rig.force + " " + *reason +
                       " The tables keep the signs of the file");
    if (const auto reason = unlike_load(rig.force, run.record.channel(rig.force), std::nullopt))
      doubts.push_back("run " + run.name + ": " + rig.force + " " + *reason);
    judge_spectrum(rig, run, doubts);
    for (const ProcessedPlateau& plateau : run.plateaus) judge_plateau(rig, run, plateau, doubts);
  }
  if (results.compensation)
    for (const CaseRow& row : results.compensation->cases) judge_rims(row, doubts);
  return doubts;
}

}  // namespace latsch::correlation
