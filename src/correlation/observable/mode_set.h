// SPDX-License-Identifier: Apache-2.0
// Compares frequencies of vibration modes of a modal test, paired by shape or label
// (mode_pairing.h):
//   df_i = (f_i^mea - f_i^sim) / f_i^mea
#pragma once

#include "correlation/observable/observable.h"

namespace latsch::correlation {

class ModeSet : public Observable {
 public:
  /// The test `test` records modes as described in experiment/rigs/mode_record.h. For a twin,
  /// `count` is the number of modes that the laboratory would measure, and `points` are its sensors
  /// (m, wheel frame).
  ModeSet(std::string test,
          std::vector<ModeRecord> measured,
          std::size_t count = 0,
          Eigen::Matrix3Xd points = {});

  const std::vector<ModeRecord>& measured() const { return measured_; }

  Result<Comparison> compare(const Channels& trial,
                             const ObjectiveSettings& settings) const override;
  std::vector<std::filesystem::path> write(const Channels& trial,
                                           const MeasurementFiles& files) const override;
  void draw(const ShownExperiment& shown, report::StudyReport& page) const override;
  std::string table(const Channels& trial, const Comparison& comparison) const override;
  std::vector<std::string> remarks(const Comparison& comparison) const override;
  std::pair<std::string, nlohmann::ordered_json> answer(
      const Channels& trial, const Comparison& comparison) const override;

 private:
  std::vector<ModeRecord> simulated(const Channels& trial) const;

  std::string test_;
  std::vector<ModeRecord> measured_;
  std::size_t count_;
  Eigen::Matrix3Xd points_;
};

}  // namespace latsch::correlation
