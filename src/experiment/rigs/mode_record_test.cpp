// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/mode_record.h"

#include <gtest/gtest.h>

namespace latsch::experiment {
namespace {

using fe_tire::ModeType;

TEST(ModeRecord, SurvivesTheWayThroughChannels) {
  std::vector<ModeRecord> modes(3);
  modes[0] = {32.2, 0, ModeType::torsional, 's', Eigen::VectorXd::LinSpaced(6, 0.0, 1.0)};
  modes[1] = {39.4, std::nullopt, std::nullopt, ' ', Eigen::VectorXd::LinSpaced(6, 1.0, 3.0)};
  modes[2] = {40.1, 1, ModeType::lateral, 'a', Eigen::VectorXd::LinSpaced(6, -1.0, 0.0)};

  const auto back = mode_records(to_channels(modes));
  ASSERT_EQ(back.size(), modes.size());
  for (size_t i = 0; i < modes.size(); ++i) {
    EXPECT_EQ(back[i].frequency, modes[i].frequency);
    EXPECT_EQ(back[i].n, modes[i].n);
    EXPECT_EQ(back[i].type, modes[i].type);
    EXPECT_EQ(back[i].phase, modes[i].phase);
    EXPECT_EQ(back[i].shape, modes[i].shape);
  }
}

TEST(ModeRecord, WithoutShapesHasNoShapeChannel) {
  const Channels channels = to_channels({{32.2, 0, ModeType::torsional, ' ', {}}});
  EXPECT_EQ(channels.find("shape"), nullptr);
  EXPECT_EQ(mode_records(channels)[0].shape.size(), 0);
}

TEST(ModeRecord, LabelSaysWhatIsNotKnown) {
  EXPECT_EQ((ModeRecord{80.0, 2, std::nullopt, 'a', {}}).label(), "? n=2 a");
}

TEST(ModeRecord, IsFoundByItsLabel) {
  for (const char* label : {"radial n=2", "torsional n=0", "lateral n=12 s", "lateral n=1 a"}) {
    const auto mode = mode_of_label(label);
    ASSERT_TRUE(mode) << label;
    EXPECT_EQ(mode->label(), label);
  }
  for (const char* wrong : {"radial",
                            "radial n=",
                            "radial n=1.5",
                            "radial n=-1",
                            "axial n=1",
                            "radial n=1 t",
                            "radial n=1 s ",
                            "? n=2",
                            ""})
    EXPECT_FALSE(mode_of_label(wrong)) << wrong;
}

}  // namespace
}  // namespace latsch::experiment
