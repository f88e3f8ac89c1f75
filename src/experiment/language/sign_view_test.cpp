// SPDX-License-Identifier: Apache-2.0
// The conversion on output, `latsch test --signs sae`, and that on input, axes = "sae", are inverse
// for every channel that a test records with a positive direction.
#include "experiment/language/sign_view.h"

#include <gtest/gtest.h>

#include "experiment/language.h"
#include "measurement/axes.h"
#include "measurement/meaning/channel_sense.h"

namespace latsch::experiment {
namespace {

std::unique_ptr<Test> test_of(const std::string& keys) {
  return language().read_test(Document::parse("test = " + keys, "keys").root().table("test"), {});
}

TEST(SignView, OutAndInAreInverse) {
  const char* tests[] = {
      "{kind = \"kc\", Fx = [\"0 N\", \"1 kN\"], Fy = [\"0 N\", \"1 kN\"], Fz = [\"1 kN\", \"2 "
      "kN\"], Mx = \"1 N m\", My = \"1 N m\", Mz = \"1 N m\", slopes_by = \"Fy\"}",
      "{kind = \"axle_kc\", axle = \"front\", Fy = [\"0 N\", \"1 kN\"], rack = \"1 mm\", "
      "slopes_by = \"Fy\"}",
      "{kind = \"kinematics\", travel = [\"-10 mm\", \"10 mm\"], rates = true}"};
  std::size_t turned = 0;
  for (const char* keys : tests) {
    const auto test = test_of(keys);
    Channels iso;
    for (const ChannelInfo& channel : test->channels())
      iso.add({channel.name, channel.unit, {1.0, 2.0}});
    const Channels out = in_signs(iso, *test, sign_view("sae"));
    const Channels back = to_iso(out, AxisConvention::sae);
    for (const Channel& channel : iso.all()) {
      EXPECT_EQ(back[channel.name], channel.values) << channel.name << " of " << keys;
      turned += out[channel.name] != channel.values;
    }
  }
  EXPECT_GT(turned, 20u);  // at least that many channels change their sign
}

}  // namespace
}  // namespace latsch::experiment
