// SPDX-License-Identifier: Apache-2.0
// Test support: springs with dampers (spring_testing.h) that are shaken in addition to being
// pulled.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "correlation/study/spring_testing.h"

namespace latsch::correlation {

inline constexpr double kShakenRate = 1000.0, kShakenLength = 0.5;          // Hz, s
inline constexpr std::array<double, 5> kShakenTones = {4, 10, 20, 40, 80};  // Hz
inline constexpr double kShakenAmplitude = 1e-3;                            // m, each tone

/// Test kind = "shake": the motion is a sum of sines whose frequencies are lines of the spectrum of
/// half a second.
class ShakeTest : public experiment::Test {
 public:
  std::string in_words() const override { return "shaken"; }
  std::vector<experiment::ChannelInfo> channels() const override {
    return {{"time", "s"}, {"force", "N"}};
  }
  std::vector<std::string> needs() const override { return {experiment::Spring::kName}; }
  Result<Channels> run(experiment::Specimen& specimen) const override {
    Channel time{"time", "s", {}}, force{"force", "N", {}};
    for (int i = 0; i < static_cast<int>(kShakenLength * kShakenRate); ++i) {
      const double t = i / kShakenRate;
      double x = 0.0, v = 0.0;
      for (const double f : kShakenTones) {
        const double w = 2.0 * std::numbers::pi * f;
        x += kShakenAmplitude * std::sin(w * t);
        v += kShakenAmplitude * w * std::cos(w * t);
      }
      time.values.push_back(t);
      force.values.push_back(specimen.find<experiment::Spring>()->force(x, v));
    }
    Channels channels;
    channels.add(std::move(time));
    channels.add(std::move(force));
    return channels;
  }
};

inline const experiment::Language& shaken_springs() {
  static const experiment::TestKind shake = {
      "shake",
      "is shaken",
      {experiment::Spring::kName},
      [](const Node&, const experiment::TestSource&) {
        return std::unique_ptr<experiment::Test>(std::make_unique<ShakeTest>());
      }};
  static const experiment::Language language = [] {
    experiment::Language all = experiment::spring_language();
    all.tests.push_back(&shake);
    return all;
  }();
  return language;
}

inline std::string spring_file(double k, double c) {
  return fmt::format(
      "kind = \"spring\"\nstiffness = \"{:.17g} N/m\"\ndamping = \"{:.17g} N s/m\"\n", k, c);
}

}  // namespace latsch::correlation
