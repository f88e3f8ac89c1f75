// SPDX-License-Identifier: Apache-2.0
// Compares forces over deflections or loaded radii of a load-deflection test:
//   dF_j = (F_j^mea - F_j^sim) / F_j^mea, or the same for their roots (objective.h)
#pragma once

#include "correlation/observable/observable.h"
#include "measurement/load_deflection.h"

namespace latsch::correlation {

class ForceCurve : public Observable {
 public:
  /// The test `test` must record "deflection", "loaded_radius", "force" and the contact patch at
  /// the measured positions. The measured curve may still lack its forces, to be written by a twin.
  ForceCurve(std::string test, LoadDeflectionCurve measured);

  /// Returns positions in m, forces in N.
  const LoadDeflectionCurve& measured() const { return measured_; }

  std::string compared(const ObjectiveSettings& settings) const override;
  std::vector<double> deviations(const MeasurementNoise& noise,
                                 const ObjectiveSettings& settings) const override;
  Result<Comparison> compare(const Channels& trial,
                             const ObjectiveSettings& settings) const override;
  std::vector<std::filesystem::path> write(const Channels& trial,
                                           const MeasurementFiles& files) const override;
  void draw(const ShownExperiment& shown, report::StudyReport& page) const override;
  std::string table(const Channels& trial, const Comparison& comparison) const override;
  std::pair<std::string, nlohmann::ordered_json> answer(
      const Channels& trial, const Comparison& comparison) const override;

 private:
  const std::vector<double>& channel(const Channels& trial, const char* name) const;

  std::string test_;
  LoadDeflectionCurve measured_;
};

/// Reads columns deflection or loaded_radius, force or Fz, and spread if there is one. Throws
/// InputError naming the sample if they make no curve.
LoadDeflectionCurve force_curve_of(const Measurement& measurement);

}  // namespace latsch::correlation
