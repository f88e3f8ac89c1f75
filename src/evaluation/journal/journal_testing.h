// SPDX-License-Identifier: Apache-2.0
// Test support: a study, trials that are functions of their number, and checks of these trials.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "evaluation/journal/study_identity.h"
#include "evaluation/trial/encoding.h"

namespace latsch {

inline const StudyIdentity kStudy{{"model", "a = 1\nb = 2\n"}, {"variables", "E: layer.E\n"}};

inline Trial trial(int number) {
  Channels channels;
  channels.add({"Fz", "N", {1000.0 + number, -0.0, 1e-310}});
  channels.add({"f", "Hz", std::vector<double>(20, 0.1 * number)});
  return {{{1.0 / 3.0, 1.0 * number}}, {channels, 1.5, 1.25, number % 3}};
}

inline Trial failed_trial(int number) {
  Trial failed = trial(number);
  failed.outcome.result = Failure{"load step 3: no equilibrium, residual 1e3 N"};
  return failed;
}

inline void expect_same(const Trial& a, const Trial& b) {
  EXPECT_EQ(a.point.bits(), b.point.bits());
  EXPECT_EQ(encode(a.outcome), encode(b.outcome));
}

template <class Action>
std::string complaint(Action&& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// Returns a trial like trial(), but long enough to be packed and nearly a multiple of the one
/// before.
inline Trial long_trial(int number) {
  Trial t = trial(number);
  std::vector<double> force;
  for (int i = 0; i < 1200; ++i) force.push_back((1.0 + 0.01 * number) * std::sin(0.1 * i));
  Channels channels = *t.outcome.result;
  channels.add({"Fy", "N", force});
  t.outcome.result = channels;
  return t;
}

}  // namespace latsch
