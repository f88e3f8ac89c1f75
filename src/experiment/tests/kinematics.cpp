// SPDX-License-Identifier: Apache-2.0
// kind = "kinematics": a corner as rigid links with its chassis held, and the axle of the corner
// and its mirror image.
//
// A wheelbase adds steer_inner, steer_outer and ackermann if the rack is stated. Channels are those
// of the wheel in the file and of the axle; names that begin with other_ belong to the other wheel.
// Their signs: docs/suspension.md.
//
// The keys are in experiment/tests/keys/kinematics_keys.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/language/capabilities.h"
#include "experiment/language/sign_view.h"
#include "experiment/tests/pictures/kinematics_pictures.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

constexpr std::array<const char*, 3> kAxleModes = {"parallel", "opposed", "single"};

const char* axle_mode(const KinematicsTest& test) {
  return kAxleModes[static_cast<std::size_t>(test.mode)];
}

class KinematicsTestOfAxle : public Test {
 public:
  explicit KinematicsTestOfAxle(KinematicsTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    const auto [lowest, highest] = std::minmax_element(test_.travel.begin(), test_.travel.end());
    const auto [right, left] = std::minmax_element(test_.rack.begin(), test_.rack.end());
    return fmt::format(
        "kinematics, {} travel {:.4g} to {:.4g} mm, rack {:.4g} to {:.4g} mm, {} "
        "states",
        axle_mode(test_),
        1e3 * *lowest,
        1e3 * *highest,
        1e3 * *right,
        1e3 * *left,
        test_.travel.size());
  }

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (const KinematicChannel& channel : kinematic_channels(test_))
      channels.push_back({channel.name, channel.unit});
    return channels;
  }

  std::vector<std::string> needs() const override { return kKinematicsTest.needs; }
  std::optional<long> samples() const override { return std::ssize(test_.travel); }
  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "travel" && channel != "rack") return std::nullopt;
    const auto& values = channel == "travel" ? test_.travel : test_.rack;
    const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
    return Reach{*lower, *upper};
  }

  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<MovesAsLinkage>()->move(test_);
  }
  Result<Details> details(Specimen& specimen) const override {
    return details_in(suspension::SignView::iso, specimen);
  }
  Result<Details> details_in(suspension::SignView view, Specimen& specimen) const override {
    const auto recorded = run(specimen);
    if (!recorded) return recorded.failure();
    return kinematics_details(in_signs(*recorded, *this, view), view);
  }
  std::optional<suspension::SignSense> sense(const std::string& channel) const override {
    for (const KinematicChannel& one : kinematic_channels(test_))
      if (one.name == channel) return suspension::SignSense{one.of, one.by};
    return std::nullopt;
  }

 private:
  KinematicsTest test_;
};

std::vector<double> read_travel(const Node& root) {
  if (!root.has("from")) return root.one_or_more("travel", "m");
  if (root.has("travel"))
    root.reject("travel", "is stated, and from as well: expected one of them");
  const double from = root.quantity("from", "m"), to = root.quantity("to", "m");
  const long points = root.integer("points", 2, 100000);
  if (!(from < to)) root.reject("to", "is not above from");
  std::vector<double> travel;
  for (long i = 0; i < points; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(points - 1);
    travel.push_back(from * (1.0 - t) + to * t);
  }
  return travel;
}

void read_states(const Node& root, KinematicsTest& test) {
  test.rack = {0.0};
  if (root.has("rack")) test.rack = root.one_or_more("rack", "m");
  test.travel = {0.0};
  if (root.has("travel") || root.has("from") || !root.has("rack")) test.travel = read_travel(root);
  if (test.travel.empty()) root.reject("travel", "is empty, expected one state at least");
  if (test.rack.empty()) root.reject("rack", "is empty, expected one state at least");
  const std::size_t states = std::max(test.travel.size(), test.rack.size());
  if (test.travel.size() == 1) test.travel.resize(states, test.travel[0]);
  if (test.rack.size() == 1) test.rack.resize(states, test.rack[0]);
  if (test.travel.size() != test.rack.size())
    root.reject("rack",
                fmt::format("has {} values, expected one or {} as travel has",
                            test.rack.size(),
                            test.travel.size()));
}

void read_vehicle(const Node& root, KinematicsTest& test) {
  if (!root.has("cg_height")) {
    for (const char* key : {"axle", "brake_share", "drive_share", "brakes"})
      if (root.has(key)) root.reject(key, "is for anti-dive, which needs cg_height");
    if (!root.has("wheelbase")) return;
    if (!root.has("rack")) root.reject("wheelbase", "is for Ackermann, which needs rack");
    test.wheelbase = root.quantity("wheelbase", "m", Range::positive());
    return;
  }
  test.vehicle = {.wheelbase = root.quantity("wheelbase", "m", Range::positive()),
                  .cg_height = root.quantity("cg_height", "m", Range::positive()),
                  .is_front = root.choice("axle", {"front", "rear"}) == "front",
                  .brake_share = root.quantity("brake_share", "1", Range::between(0.0, 1.0)),
                  .drive_share = root.quantity("drive_share", "1", Range::between(0.0, 1.0), 0.0),
                  .has_outboard_brakes =
                      root.choice("brakes", {"outboard", "inboard"}, "outboard") == "outboard"};
  if (root.has("rack")) test.wheelbase = test.vehicle->wheelbase;
}

std::unique_ptr<Test> read_kinematics(const Node& root, const TestSource&) {
  KinematicsTest test;
  read_states(root, test);
  const std::string mode = root.choice("mode", {"parallel", "opposed", "single"}, "parallel");
  test.mode = static_cast<KinematicsTest::Mode>(
      std::find(kAxleModes.begin(), kAxleModes.end(), mode) - kAxleModes.begin());
  test.at = root.choice("at", {"contact_patch", "wheel_center"}, "contact_patch") == "wheel_center"
                ? suspension::TravelOf::wheel_center
                : suspension::TravelOf::contact;
  test.with_rates = root.flag("rates", false);
  test.with_anti_roll_bar = root.flag("anti_roll_bar", false);
  test.outer_share = root.quantity("outer_share", "1", Range::between(0.0, 1.0), 0.5);
  if (root.has("rack_per_turn"))
    test.rack_per_turn = root.quantity("rack_per_turn", "m", Range::positive());
  read_vehicle(root, test);
  return std::make_unique<KinematicsTestOfAxle>(std::move(test));
}

}  // namespace

const KeySection& kinematics_keys();

const TestKind kKinematicsTest = {"kinematics",
                                  "is moved as rigid links: toe, camber, roll center, motion ratio",
                                  {MovesAsLinkage::kName},
                                  read_kinematics,
                                  kinematics_keys};

}  // namespace latsch::experiment
