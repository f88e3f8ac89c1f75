// SPDX-License-Identifier: Apache-2.0
// Compares single values of a channel with measured ones that are stated in the study itself: a
// stiffness, the length of a footprint, a characteristic number of a suspension.
//
// The error is d_i = (y_i^mea - y_i^sim) / scale_i, where scale_i is the size of the measured value
// unless stated. If several modes have the stated name, the lowest one is compared; a missing mode
// counts as 0, an error of 100 %. Frequencies of modes of one n that are too close to be
// distinguished by their names are compared in ascending order (close_modes.h). The keys are in
// correlation/observable/keys/values_keys.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/observable/known_channels.h"
#include "correlation/observable/observable.h"

namespace latsch::correlation {

class Values : public Observable {
 public:
  struct Measurement {
    std::string channel, unit, shown;  // unit: SI; shown: the unit people read
    std::string of;  // selects one value of the channel, such as "largest"; empty: every value
    std::vector<std::string> modes;      // labels of modes whose values are compared; empty: none
    std::vector<double> values, scales;  // SI
  };
  explicit Values(Measurement measured);

  const Measurement& measured() const { return m_; }
  /// Returns one value for each measured one. Fails if the channel has more or fewer.
  Result<SimulatedValues> simulated(const Channels& trial) const;

  Result<Comparison> compare(const Channels& trial,
                             const ObjectiveSettings& settings) const override;
  /// Writes nothing if the values are stated in the study.
  std::vector<std::filesystem::path> write(const Channels& trial,
                                           const MeasurementFiles& files) const override;
  void draw(const ShownExperiment& shown, report::StudyReport& page) const override;
  std::string table(const Channels& trial, const Comparison& comparison) const override;
  std::vector<std::string> remarks(const Comparison& comparison) const override;
  std::pair<std::string, nlohmann::ordered_json> answer(
      const Channels& trial, const Comparison& comparison) const override;

 private:
  SimulatedValues of_modes(const Channels& trial) const;
  std::vector<ModeRecord> named_modes() const;

  Measurement m_;
};

/// Throws InputError if there is no such channel or the values have another dimension. Without a
/// measurement the values are stated in the table.
std::shared_ptr<const Values> read_values(const Node& table,
                                          const std::vector<KnownChannel>& channels,
                                          const Measurement* measurement = nullptr);

}  // namespace latsch::correlation
