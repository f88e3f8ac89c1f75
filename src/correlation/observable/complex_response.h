// SPDX-License-Identifier: Apache-2.0
// Compares a frequency response with a measured one: real and imaginary parts together.
//
// The errors at the measured frequency f_i are, part by part,
//
//   d_i = (H_i^mea - H^sim(f_i)) / |H_i^mea|
//
// with the parts of the simulated response linear between its frequencies. A response that is the
// mean of N averages with the coherence gamma^2 has in each part the random error
//
//   sigma_i = |H_i| sqrt((1 - gamma_i^2)/(2 N gamma_i^2))
//
// [Bendat & Piersol, Random Data, chapter 9: random error of a gain factor estimate], which is
// added to the stated noise by squares, so that frequencies with little coherence count little. The
// keys are in correlation/observable/keys/complex_response_keys.cpp.
#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/observable/known_channels.h"
#include "correlation/observable/observable.h"

namespace latsch::correlation {

class ComplexResponse : public Observable {
 public:
  struct Measured {
    std::string test, output;                    // "shaken", "hub_Fz"
    std::string unit;                            // SI
    std::vector<double> frequencies;             // Hz
    std::vector<std::complex<double>> response;  // SI
    /// Random error of each part by the coherence, relative to |H|; empty: not known.
    std::vector<double> random = {};
    double scale = 0.0;  // size of an error of 100 %; 0: |H_i|
  };
  explicit ComplexResponse(Measured measured);

  const Measured& measured() const { return m_; }
  /// Returns the real and then the imaginary parts at the measured frequencies. Fails if channels
  /// are missing or if the measurement extends beyond the simulation.
  Result<SimulatedValues> simulated(const Channels& trial) const;

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
  std::string channel(const std::string& prefix) const {
    return m_.test + "/" + prefix + m_.output;
  }

  Measured m_;
};

/// Throws InputError if there is no such output, or the measurement lacks these columns or has a
/// coherence outside of 0 ... 1.
std::shared_ptr<const ComplexResponse> read_complex_response(
    const Node& table, const std::vector<KnownChannel>& channels, const Measurement& measurement);

}  // namespace latsch::correlation
