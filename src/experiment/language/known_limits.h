// SPDX-License-Identifier: Apache-2.0
// Limits of a tire model in a test, which are reported with the test's result and before a study
// runs it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/language/specimen.h"
#include "experiment/rigs/cleat.h"
#include "models/tire/rolls.h"

namespace latsch::experiment {

/// Motion that a test demands of a wheel before anything is simulated: the least and the greatest
/// value, SI, of Fz, kappa, alpha, gamma, p and speed; a quantity that the test does not set is
/// missing.
using DrivenWheel = std::map<std::string, std::pair<double, double>>;

/// A specimen that knows limits of its model.
struct KnowsLimits : MeetsLimits {
  /// Returns a sentence for every limit that matters on this cleat; empty if none does.
  virtual std::vector<std::string> limits_on(const Cleat&) const { return {}; }
  /// Returns a sentence for every limit that matters on a road whose height differs across the
  /// width of the tire; empty if none does.
  virtual std::vector<std::string> limits_across() const { return {}; }
  /// Returns a sentence for every limit that matters if the tire rolls both forward and backward;
  /// empty if none does.
  virtual std::vector<std::string> limits_backward() const { return {}; }
  /// Returns a sentence for every limit of the specimen that matters if the wheel is cambered,
  /// while it rolls (argument true) or stands (false).
  virtual std::vector<std::string> limits_at_camber(bool /*rolls*/) const { return {}; }
  /// Returns half of the width, m, over which the tire model follows the road; 0: it follows a
  /// single line.
  virtual double felt_half_width() const { return 0.0; }
  /// Returns half of the width, m, of a real tread of this size; nullopt if the specimen's file
  /// does not say.
  virtual std::optional<double> tread_half_width() const { return std::nullopt; }
  /// Stores a sentence of a test about its run, unless it is empty or already stored.
  void record(const std::string& sentence);
  /// Returns the sentences that were recorded.
  const std::vector<std::string>& recorded() const { return recorded_; }
  /// Records a load, N, under which the specimen stood in a test.
  virtual void stood_under(double /*load*/) {}
  /// Returns a sentence on why the specimen has no stiffness in a direction of the test
  /// static_stiffness ("vertical", "longitudinal", "lateral", "torsional"); empty if it has one.
  virtual std::string no_stiffness(const std::string& /*direction*/) const { return ""; }
  /// Returns a sentence on the value assumed for such a stiffness; empty if none is assumed.
  virtual std::string assumed_stiffness(const std::string& /*direction*/) const { return ""; }
  /// Returns the height of the section, m; nullopt if the specimen's file does not say.
  virtual std::optional<double> section_height() const { return std::nullopt; }
  /// Returns a sentence for every limit of the specimen's file that a wheel driven like this
  /// leaves; empty if there is none.
  virtual std::vector<std::string> limits_when_driven(const DrivenWheel&) const { return {}; }
  /// True if the number of the model at this path is itself such a limit, so that a study which
  /// varies it moves the limit.
  virtual bool is_limit(const std::string& /*path*/) const { return false; }

 private:
  std::vector<std::string> recorded_;
};

/// A test that knows which limits of a specimen matter in it.
struct TellsLimits {
  virtual ~TellsLimits() = default;
  /// Returns a sentence for every limit of the specimen that matters in this test, without running
  /// it.
  virtual std::vector<std::string> limits(Specimen& specimen) const = 0;
};

/// Angle of a cleat, rad, below which it acts like a straight cleat over the tire's width.
constexpr double kStraightCleat = 0.02;

/// Returns the limits of a specimen on a test's cleat; empty if the specimen knows no limits or the
/// test has no cleat.
inline std::vector<std::string> limits_of(Specimen& specimen, const std::optional<Cleat>& cleat) {
  const auto* knows = specimen.find<KnowsLimits>();
  return knows && cleat ? knows->limits_on(*cleat) : std::vector<std::string>();
}

/// Returns the limits of a specimen at the camber of a test, rad; empty if the wheel is upright or
/// the specimen knows no limits.
inline std::vector<std::string> limits_of_camber(Specimen& specimen, double camber, bool rolls) {
  const auto* knows = specimen.find<KnowsLimits>();
  return knows && camber != 0.0 ? knows->limits_at_camber(rolls) : std::vector<std::string>();
}

/// Returns the limits that a wheel driven like this leaves; empty if the specimen knows none.
inline std::vector<std::string> limits_of_driven(Specimen& specimen, const DrivenWheel& driven) {
  const auto* knows = specimen.find<KnowsLimits>();
  return knows ? knows->limits_when_driven(driven) : std::vector<std::string>();
}

/// Returns the limits that a specimen has met and the sentences that its tests have recorded; empty
/// if it knows none.
std::vector<std::string> limits_met(Specimen& specimen);

/// Stores a sentence of a test about its run in the specimen, if the specimen knows limits.
void record_limit(Specimen& specimen, const std::string& sentence);

/// Passes the loads, N, under which a specimen stood to the specimen, if it knows limits.
void stood_under(Specimen& specimen, const std::vector<double>& loads);

/// Throws InputError if a cleat is at least as high as the section of the specimen, so that the rim
/// would hit it.
void refuse_high_cleat(Specimen& specimen, const std::optional<Cleat>& cleat);

}  // namespace latsch::experiment
