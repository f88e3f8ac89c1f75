// SPDX-License-Identifier: Apache-2.0
// kind = "kc": a corner on the rig for kinematics and compliance, its chassis and the inboard end
// of its push-rod held.
//
//   kind = "kc"
//   Fz = ["0 N", "2.5 kN", "5 kN"]       # of the ground on the tire: Fx, Fy, Fz, Mx, My, Mz,
//   Mz = "100 N m"                       # of every state, or one for all of them
//   loads = {from = "measurement.rig"}   # or those it recorded
//   at = "contact_patch"                 # or "wheel_center": where they act and what dx, dy, dz
//                                        # are of
//   slopes_by = "Fz"                     # adds dz_by_Fz, toe_by_Fz ...: slopes of a regression
//   window = ["1 kN", "4 kN"]            # over the states where Fz is in there
//
// Its channels are the loads and dx, dy, dz, camber, toe, caster from the unloaded corner: x
// forward, y left, z up; camber with the top outboard, toe with the front inboard, caster with the
// top of the kingpin rearward. `latsch test --details FILE` writes the compliance matrix of every
// state: dx_by_Fx ... about_z_by_Mz.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/test.h"
#include "experiment/rigs/kc_rig.h"
#include "experiment/rigs/suspension/kc_senses.h"

namespace latsch::experiment {

extern const TestKind kKc;
namespace {

class KcTestOfCorner : public Test {
 public:
  explicit KcTestOfCorner(KcTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    std::vector<std::string> stated;
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i]) stated.emplace_back(KcTest::kLoads[i]);
    return fmt::format("K&C rig, {} at the {}, {} states",
                       fmt::join(stated, ", "),
                       test_.at_wheel_center ? "wheel center" : "contact patch",
                       test_.loads.cols());
  }

  std::string identity() const override {
    const auto all = test_.loads.reshaped();
    std::string text = fmt::format("kc at {} loads {}",
                                   test_.at_wheel_center ? "wheel_center" : "contact_patch",
                                   fmt::join(all.begin(), all.end(), " "));
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i]) text += fmt::format(" {}", KcTest::kLoads[i]);
    if (test_.slopes_by)
      text += fmt::format(
          " slopes by {} in {} {}", *test_.slopes_by, test_.window.first, test_.window.second);
    return text;
  }

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i]) channels.push_back({KcTest::kLoads[i], i < 3 ? "N" : "N m"});
    for (std::size_t i = 0; i < 6; ++i)
      channels.push_back({KcTest::kMoved[i], i < 3 ? "m" : "rad"});
    if (test_.slopes_by)
      for (int i = 0; i < 6; ++i) channels.push_back({test_.slope_name(i), test_.slope_unit(i)});
    return channels;
  }

  std::vector<std::string> needs() const override { return kKc.needs; }

  std::optional<Reach> reach(const std::string& channel) const override {
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i] && channel == KcTest::kLoads[i]) {
        const auto row = test_.loads.row(static_cast<Eigen::Index>(i));
        return Reach{row.minCoeff(), row.maxCoeff()};
      }
    return std::nullopt;
  }

  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<IsLoaded>()->load(test_, {});
  }
  Result<Details> details(Specimen& specimen) const override {
    auto matrices = specimen.find<IsLoaded>()->compliance(test_);
    if (!matrices) return matrices.failure();
    return Details{{}, std::move(*matrices)};
  }
  bool tells_slopes() const override { return true; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<IsLoaded>()->load(test_, asked);
  }
  std::optional<suspension::SignSense> sense(const std::string& channel) const override {
    return kc_sense(channel);
  }

 private:
  KcTest test_;
};

using Histories = std::array<std::vector<double>, 6>;

Histories recorded(const Node& table, const TestSource& source) {
  std::vector<MeasuredCondition> conditions;
  for (std::size_t i = 0; i < 6; ++i)
    conditions.push_back({KcTest::kLoads[i], i < 3 ? "N" : "N m"});
  const Channels channels = take_measured(table, conditions, source.measured);
  Histories loads;
  for (std::size_t i = 0; i < 6; ++i)
    if (const Channel* channel = channels.find(KcTest::kLoads[i])) loads[i] = channel->values;
  return loads;
}

Histories stated(const Node& root) {
  Histories loads;
  if (root.has("Fx")) loads[0] = root.one_or_more("Fx", "N");
  if (root.has("Fy")) loads[1] = root.one_or_more("Fy", "N");
  if (root.has("Fz")) loads[2] = root.one_or_more("Fz", "N");
  if (root.has("Mx")) loads[3] = root.one_or_more("Mx", "N m");
  if (root.has("My")) loads[4] = root.one_or_more("My", "N m");
  if (root.has("Mz")) loads[5] = root.one_or_more("Mz", "N m");
  return loads;
}

void read_slopes(const Node& root, KcTest& test) {
  if (!root.has("slopes_by")) {
    if (root.has("window")) root.reject("window", "is that of slopes_by, which is not there");
    return;
  }
  const std::string by = root.choice("slopes_by", {KcTest::kLoads.begin(), KcTest::kLoads.end()});
  test.slopes_by = static_cast<int>(std::find(KcTest::kLoads.begin(), KcTest::kLoads.end(), by) -
                                    KcTest::kLoads.begin());
  if (root.has("window")) {
    const auto window = root.quantities("window", *test.slopes_by < 3 ? "N" : "N m");
    if (window.size() != 2 || !(window[0] < window[1]))
      root.reject("window", "is no window, expected two values that rise");
    test.window = {window[0], window[1]};
  }
  if (test.slope_weights().size() == 0)
    root.reject("slopes_by",
                "is " + by + ", which does not vary" +
                    (root.has("window") ? " in the window" : "") + ": there is no slope by it");
}

std::unique_ptr<Test> read_kc(const Node& root, const TestSource& source) {
  KcTest test;
  test.at_wheel_center =
      root.choice("at", {"contact_patch", "wheel_center"}, "contact_patch") == "wheel_center";
  const auto from = find_measured(root, "loads");
  const Histories loads = from ? recorded(*from, source) : stated(root);
  std::size_t states = 0;
  for (const auto& load : loads) states = std::max(states, load.size());
  if (states == 0) {
    if (from) root.reject("loads", "has none of Fx, Fy, Fz, Mx, My, Mz: no load was recorded");
    root.one_or_more("Fz", "N");  // where it is not there, what was probably meant is named
    root.reject("Fz", "is empty, expected the loads of one state at least");
  }
  test.loads.setZero(6, static_cast<Eigen::Index>(states));
  for (std::size_t i = 0; i < 6; ++i) {
    const std::vector<double>& load = loads[i];
    if (load.empty()) continue;
    if (load.size() != 1 && load.size() != states)
      root.reject(
          KcTest::kLoads[i],
          fmt::format("has {} values, expected one or {} as the others have", load.size(), states));
    test.stated[i] = true;
    for (std::size_t k = 0; k < states; ++k)
      test.loads(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          load.size() == 1 ? load[0] : load[k];
  }
  if (!test.loads.allFinite()) root.reject("loads", "has values that are no numbers");
  read_slopes(root, test);
  return std::make_unique<KcTestOfCorner>(std::move(test));
}

}  // namespace

const TestKind kKc = {
    "kc", "is loaded on a K&C rig: travel, camber, toe, caster", {IsLoaded::kName}, read_kc};

}  // namespace latsch::experiment
