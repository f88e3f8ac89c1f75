// SPDX-License-Identifier: Apache-2.0
// kind = "kc": a corner on the rig for kinematics and compliance, its chassis and the inboard end
// of its push-rod held.
//
// Its channels are the loads and dx, dy, dz, camber, toe, caster relative to the unloaded corner: x
// forward, y left, z up; camber with the top outboard, toe with the front inboard, caster with the
// top of the kingpin rearward. `latsch test --details FILE` writes the compliance matrix of every
// state: dx_by_Fx ... about_z_by_Mz; `--html FILE` draws the loops.
//
// The keys are in experiment/tests/keys/kc_keys.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/language/capabilities.h"
#include "experiment/rigs/kc_rig.h"
#include "experiment/rigs/suspension/kc_senses.h"
#include "experiment/tests/films/rig_film.h"
#include "experiment/tests/kc_histories.h"
#include "experiment/tests/pictures/kc_pictures.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
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

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i]) channels.push_back({KcTest::kLoads[i], i < 3 ? "N" : "N m"});
    for (std::size_t i = 0; i < 6; ++i)
      channels.push_back({KcTest::kMoved[i], i < 3 ? "m" : "rad"});
    if (test_.slopes) {
      for (std::size_t i = 0; i < 6; ++i)
        channels.push_back(slope_of(KcTest::kMoved[i], i < 3 ? "m" : "rad", *test_.slopes));
    }
    return channels;
  }

  std::vector<std::string> needs() const override { return kKcTest.needs; }
  std::optional<long> samples() const override { return test_.loads.cols(); }

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
    const auto recorded = run(specimen);
    if (!recorded) return recorded.failure();
    std::vector<std::string> loads;
    for (std::size_t i = 0; i < 6; ++i)
      if (test_.stated[i]) loads.emplace_back(KcTest::kLoads[i]);
    return Details{loop_pictures(*recorded, loads, {""}, test_.slopes), std::move(*matrices)};
  }
  bool has_film() const override { return true; }
  Status film(Specimen& specimen, int most_steps, report::Scene& scene) const override {
    // index of the load that serves as abscissa: the first that varies, or the first that is stated
    std::size_t along = 0;
    for (std::size_t i = 6; i-- > 0;)
      if (test_.stated[i]) along = i;
    for (std::size_t i = 6; i-- > 0;)
      if (const auto row = test_.loads.row(static_cast<Eigen::Index>(i));
          row.maxCoeff() > row.minCoeff())
        along = i;
    const auto row = test_.loads.row(static_cast<Eigen::Index>(along));
    RigFilm film({KcTest::kLoads[along], along < 3 ? "N" : "N m", {row.begin(), row.end()}},
                 most_steps);
    const auto done = specimen.find<IsLoaded>()->watch(test_, film.watcher());
    if (!done) return done.failure();
    film.add_to(scene, in_words());
    return {};
  }
  bool tells_slopes(const SpecimenKind&, const std::string&) const override { return true; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<IsLoaded>()->load(test_, asked);
  }
  std::optional<suspension::SignSense> sense(const std::string& channel) const override {
    return kc_sense(channel);
  }

 private:
  KcTest test_;
};

/// Returns the loads that a K&C rig may prescribe, in the axes of the road, at the point of action
/// that `frame` states.
std::vector<Prescribed> kc_loads(const std::string& frame) {
  std::vector<Prescribed> loads;
  for (std::size_t i = 0; i < 6; ++i)
    loads.push_back({KcTest::kLoads[i], i < 3 ? "N" : "N m", frame});
  return loads;
}

std::unique_ptr<Test> read_kc(const Node& root, const TestSource& source) {
  KcTest test;
  test.at_wheel_center =
      root.choice("at", {"contact_patch", "wheel_center"}, "contact_patch") == "wheel_center";
  const Histories histories(root, source, kc_loads(test.at_wheel_center ? "H" : "W"), {}, "Fz");
  test.loads.setZero(6, static_cast<Eigen::Index>(histories.states()));
  for (std::size_t i = 0; i < 6; ++i)
    if (const std::vector<double>* load = histories.find(KcTest::kLoads[i])) {
      test.stated[i] = true;
      for (std::size_t k = 0; k < load->size(); ++k)
        test.loads(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = (*load)[k];
    }
  test.slopes = histories.slopes(root);
  return std::make_unique<KcTestOfCorner>(std::move(test));
}

}  // namespace

const KeySection& kc_keys();

const TestKind kKcTest = {"kc",
                          "is loaded on a K&C rig: travel, camber, toe, caster",
                          {IsLoaded::kName},
                          read_kc,
                          kc_keys};

}  // namespace latsch::experiment
