// SPDX-License-Identifier: Apache-2.0
// kind = "axle_kc": both wheels of a car's axle on the rig for kinematics and compliance, the
// chassis held.
//
//   kind = "axle_kc"
//   axle = "front"                       # or "rear"
//   mode = "parallel"                    # default; or "opposed", "single": what the right wheel
//                                        # gets
//   springs = "free"                     # default; or "locked": bars in their place
//   at = "contact_patch"                 # default; or "wheel_center": of loads and of dx, dy, dz
//   Fx = ["0 N", "1 kN"]                 # of the left wheel: Fx, Fy, Fz, Mx, My, Mz, of every
//   Mz = "100 N m"                       # state or one for all of them; none: zero
//   travel = ["-30 mm", "30 mm"]         # of the left wheel center, by a pad; none: free
//   rack = "5 mm"                        # to the left; default 0
//
// Its channels are what is stated, rack, and of both wheels dx, dy, dz, camber, toe, caster
// (dx_L .. caster_R; signs as in test kc), the springs' extension and the
// pads' force. `latsch test --details FILE` writes the 12 x 12 compliance matrix of every state and
// the classical compliances, in phase and out of phase.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "experiment/language/capabilities.h"
#include "experiment/language/test.h"
#include "experiment/rigs/car/axle_kc_rig.h"
#include "experiment/rigs/suspension/kc_senses.h"

namespace latsch::experiment {

extern const TestKind kAxleKc;
namespace {

constexpr std::array<const char*, 3> kModes = {"parallel", "opposed", "single"};

class AxleKc : public Test {
 public:
  explicit AxleKc(AxleKcTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    std::vector<std::string> stated;
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i]) stated.emplace_back(AxleKcTest::kLoads[i]);
    if (test_.travel) stated.emplace_back("travel");
    if (stated.empty()) stated.emplace_back("rack");
    return fmt::format("K&C rig, {} axle, {}, {}, springs {}, {} states",
                       test_.front ? "front" : "rear",
                       kModes[static_cast<std::size_t>(test_.mode)],
                       fmt::join(stated, ", "),
                       test_.springs_locked ? "locked" : "free",
                       test_.states());
  }
  std::string identity() const override {
    const auto loads = test_.loads.reshaped();
    std::string text = fmt::format("axle_kc {} {} {} {} loads {} rack {}",
                                   test_.front,
                                   static_cast<int>(test_.mode),
                                   test_.springs_locked,
                                   test_.at_wheel_center,
                                   fmt::join(loads.begin(), loads.end(), " "),
                                   fmt::join(test_.rack, " "));
    if (test_.travel) text += fmt::format(" travel {}", fmt::join(*test_.travel, " "));
    for (const bool stated : test_.stated) text += stated ? " 1" : " 0";
    return text;
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (const auto& [name, unit] : axle_kc_channels(test_)) channels.push_back({name, unit});
    return channels;
  }
  std::vector<std::string> needs() const override { return kAxleKc.needs; }
  std::optional<Reach> reach(const std::string& channel) const override {
    const auto of = [](const auto& values) {
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      return Reach{*low, *high};
    };
    if (channel == "travel" && test_.travel) return of(*test_.travel);
    if (channel == "rack") return of(test_.rack);
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i] && channel == AxleKcTest::kLoads[i]) {
        const auto row = test_.loads.row(static_cast<Eigen::Index>(i));
        return Reach{row.minCoeff(), row.maxCoeff()};
      }
    return std::nullopt;
  }
  std::optional<long> samples() const override { return test_.states(); }
  Result<Channels> run(Specimen& specimen) const override {
    const auto car = specimen.find<Drives>()->car({});
    return car ? experiment::run(**car, test_) : car.failure();
  }
  Result<Details> details(Specimen& specimen) const override {
    const auto car = specimen.find<Drives>()->car({});
    if (!car) return car.failure();
    auto matrices = axle_compliance(**car, test_);
    if (!matrices) return matrices.failure();
    return Details{{}, std::move(*matrices)};
  }
  std::optional<suspension::SignSense> sense(const std::string& channel) const override {
    return kc_sense(channel);
  }

 private:
  AxleKcTest test_;
};

std::unique_ptr<Test> read_axle_kc(const Node& root, const TestSource&) {
  AxleKcTest test;
  test.front = root.choice("axle", {"front", "rear"}) == "front";
  const std::string mode = root.choice("mode", {kModes.begin(), kModes.end()}, "parallel");
  test.mode =
      static_cast<AxleKcTest::Mode>(std::find(kModes.begin(), kModes.end(), mode) - kModes.begin());
  test.springs_locked = root.choice("springs", {"free", "locked"}, "free") == "locked";
  test.at_wheel_center =
      root.choice("at", {"contact_patch", "wheel_center"}, "contact_patch") == "wheel_center";
  std::map<std::string, std::vector<double>> stated;
  for (std::size_t i = 0; i < 6; ++i)
    if (const char* name = AxleKcTest::kLoads[i]; root.has(name)) {
      stated[name] = root.one_or_more(name, i < 3 ? "N" : "N m");
      test.stated[i] = true;
    }
  if (root.has("travel")) stated["travel"] = root.one_or_more("travel", "m");
  if (root.has("rack")) stated["rack"] = root.one_or_more("rack", "m");
  if (stated.empty()) {
    root.close();                 // a typo in the only key that states something
    root.one_or_more("Fz", "N");  // where it is not there, what was probably meant is named
  }
  std::size_t states = 1;
  for (const auto& [name, values] : stated) states = std::max(states, values.size());
  for (auto& [name, values] : stated) {
    if (values.size() != 1 && values.size() != states)
      root.reject(
          name,
          fmt::format(
              "has {} values, expected one or {} as the others have", values.size(), states));
    if (values.size() == 1) values.assign(states, values[0]);
  }
  test.loads.setZero(6, static_cast<Eigen::Index>(states));
  for (std::size_t i = 0; i < 6; ++i)
    if (test.stated[i])
      for (std::size_t k = 0; k < states; ++k)
        test.loads(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            stated[AxleKcTest::kLoads[i]][k];
  if (stated.contains("travel")) test.travel = stated["travel"];
  test.rack = stated.contains("rack") ? stated["rack"] : std::vector<double>(states, 0.0);
  return std::make_unique<AxleKc>(std::move(test));
}

}  // namespace

const TestKind kAxleKc = {"axle_kc",
                          "an axle on a K&C rig: both wheels, springs and bars",
                          {Drives::kName},
                          read_axle_kc};

}  // namespace latsch::experiment
