// SPDX-License-Identifier: Apache-2.0
// kind = "axle_kc": both wheels of a car's axle on the rig for kinematics and compliance, the
// chassis held.
//
// Loads and travels of the right wheel are equal to those of the left in mode "parallel" (Fy, Mx
// and Mz mirrored) and opposite in mode "opposed"; in mode "single" there is no load, and the pad
// holds the wheel at its initial height.
//
// The channels are the stated quantities, rack, and for both wheels dx, dy, dz, camber, toe, caster
// (dx_L .. caster_R; signs as in test kc), the springs' extension and the pads' force.
// `latsch test --details FILE` writes the 12 x 12 compliance matrix of every state and the
// classical compliances, in phase and out of phase; `--html FILE` draws the loops.
//
// The keys are in experiment/tests/keys/axle_kc_keys.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/language/capabilities.h"
#include "experiment/rigs/car/axle_kc_rig.h"
#include "experiment/rigs/suspension/kc_senses.h"
#include "experiment/tests/films/rig_film.h"
#include "experiment/tests/kc_histories.h"
#include "experiment/tests/pictures/kc_pictures.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

constexpr std::array<const char*, 3> kModes = {"parallel", "opposed", "single"};

class AxleKc : public Test {
 public:
  AxleKc(AxleKcTest test, std::string mode) : test_(std::move(test)), mode_(std::move(mode)) {}

  std::string in_words() const override {
    std::vector<std::string> prescribed = names();
    if (prescribed.size() > 1) std::erase(prescribed, "rack");
    return fmt::format("K&C rig, {} axle, {}, {}, springs {}, {} states",
                       test_.front ? "front" : "rear",
                       mode_,
                       fmt::join(prescribed, ", "),
                       test_.springs_locked ? "locked" : "free",
                       test_.states());
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (const Channel& one : test_.prescribed) channels.push_back({one.name, one.unit});
    const auto moved = axle_kc_moved(test_);
    for (const auto& [name, unit] : moved) channels.push_back({name, unit});
    if (test_.slopes)
      for (const auto& [name, unit] : moved)
        channels.push_back(slope_of(name, unit, *test_.slopes));
    return channels;
  }
  std::vector<std::string> needs() const override { return kAxleKcTest.needs; }
  std::optional<Reach> reach(const std::string& channel) const override {
    for (const Channel& one : test_.prescribed)
      if (one.name == channel) {
        const auto [low, high] = std::minmax_element(one.values.begin(), one.values.end());
        return Reach{*low, *high};
      }
    return std::nullopt;
  }
  std::optional<long> samples() const override { return test_.states(); }
  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<HasAxles>()->load(test_, {});
  }
  Result<Details> details(Specimen& specimen) const override {
    auto matrices = specimen.find<HasAxles>()->compliance(test_);
    if (!matrices) return matrices.failure();
    const auto recorded = run(specimen);
    if (!recorded) return recorded.failure();
    return Details{loop_pictures(*recorded, names(), {"_L", "_R"}, test_.slopes),
                   std::move(*matrices)};
  }
  bool has_film() const override { return true; }
  Status film(Specimen& specimen, int most_steps, report::Scene& scene) const override {
    const auto varies = [](const Channel& one) {
      const auto [low, high] = std::minmax_element(one.values.begin(), one.values.end());
      return *high > *low;
    };
    auto along = std::find_if(test_.prescribed.begin(), test_.prescribed.end(), varies);
    if (along == test_.prescribed.end()) along = test_.prescribed.begin();
    RigFilm film(*along, most_steps);
    const auto done = specimen.find<HasAxles>()->watch(test_, film.watcher());
    if (!done) return done.failure();
    film.add_to(scene, in_words());
    return {};
  }
  bool tells_slopes(const SpecimenKind&, const std::string&) const override {
    return !test_.travel;
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<HasAxles>()->load(test_, test_.travel ? Asked{} : asked);
  }
  std::optional<suspension::SignSense> sense(const std::string& channel) const override {
    return kc_sense(channel);
  }

 private:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Channel& one : test_.prescribed) names.push_back(one.name);
    return names;
  }

  AxleKcTest test_;
  std::string mode_;
};

/// Returns the loads Fx ... Mz of the axle, Fx_L ... Mz_L and Fx_R ... Mz_R, at the point of action
/// that `frame` states.
std::vector<Prescribed> axle_loads(const std::string& frame) {
  std::vector<Prescribed> loads;
  for (const char* of : {"", "_L", "_R"})
    for (std::size_t i = 0; i < 6; ++i)
      loads.push_back({std::string(KcTest::kLoads[i]) + of, i < 3 ? "N" : "N m", frame});
  return loads;
}

bool is_of_one_wheel(const std::string& name) {
  return name.ends_with("_L") || name.ends_with("_R");
}

/// Factor of the right wheel's loads relative to the mirror image of the left wheel's: +1, -1 or 0.
double share_of_right(const std::string& mode) {
  return mode == "parallel" ? 1.0 : mode == "opposed" ? -1.0 : 0.0;
}

/// Returns the mode in words; rejects a mode if each wheel has its own loads.
std::string read_mode(const Node& root, const Histories& histories) {
  std::string of_one, of_both;
  for (const Prescribed& one : histories.stated())
    if (one.name != "rack") (is_of_one_wheel(one.name) ? of_one : of_both) = one.name;
  if (of_one.empty()) return root.choice("mode", {kModes.begin(), kModes.end()}, kModes[0]);
  if (!of_both.empty())
    root.reject(root.has(of_both) ? of_both : "loads",
                fmt::format("states {} beside {}, expected all of each wheel or all of the left "
                            "one and a mode",
                            of_both,
                            of_one));
  if (root.has("mode")) root.reject("mode", "is given beside " + of_one + ", which leaves no mode");
  return "each wheel";
}

void prescribe_loads(const Histories& histories, double right, AxleKcTest& test) {
  constexpr std::array<double, 6> kMirror = {1.0, -1.0, 1.0, -1.0, 1.0, -1.0};
  test.loads.setZero(12, static_cast<Eigen::Index>(histories.states()));
  const auto add = [&](const std::string& name, std::size_t row, double factor) {
    const std::vector<double>* load = histories.find(name);
    for (std::size_t k = 0; load && k < load->size(); ++k)
      test.loads(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(k)) +=
          factor * (*load)[k];
  };
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string name = KcTest::kLoads[i];
    add(name, i, 1.0);
    add(name, i + 6, right * kMirror[i]);
    add(name + "_L", i, 1.0);
    add(name + "_R", i + 6, 1.0);
  }
}

void prescribe_travel(const Histories& histories, double right, AxleKcTest& test) {
  std::array<std::vector<double>, 2> travel;
  travel.fill(std::vector<double>(histories.states(), 0.0));
  const auto add = [&](const std::string& name, std::size_t side, double factor) {
    const std::vector<double>* values = histories.find(name);
    if (!values) return;
    if (!test.travel) test.travel = travel;
    for (std::size_t k = 0; k < values->size(); ++k)
      (*test.travel)[side][k] += factor * (*values)[k];
  };
  add("travel", 0, 1.0);
  add("travel", 1, right);
  add("travel_L", 0, 1.0);
  add("travel_R", 1, 1.0);
}

std::unique_ptr<Test> read_axle_kc(const Node& root, const TestSource& source) {
  AxleKcTest test;
  test.front = root.choice("axle", {"front", "rear"}) == "front";
  test.springs_locked = root.choice("springs", {"free", "locked"}, "free") == "locked";
  test.at_wheel_center =
      root.choice("at", {"contact_patch", "wheel_center"}, "contact_patch") == "wheel_center";
  const Histories histories(root,
                            source,
                            axle_loads(test.at_wheel_center ? "H" : "W"),
                            {{"travel", "m"}, {"travel_L", "m"}, {"travel_R", "m"}, {"rack", "m"}},
                            "Fz");
  const std::string mode = read_mode(root, histories);
  prescribe_loads(histories, share_of_right(mode), test);
  prescribe_travel(histories, share_of_right(mode), test);
  test.rack.assign(histories.states(), 0.0);
  for (const Prescribed& one : histories.stated()) {
    if (one.name == "rack") continue;
    test.prescribed.push_back({one.name, one.unit, *histories.find(one.name)});
  }
  if (const std::vector<double>* rack = histories.find("rack")) test.rack = *rack;
  const bool turns = std::ranges::any_of(test.rack, [](double x) { return x != 0.0; });
  if (turns && !test.front)
    root.reject("rack",
                "is given, but the rear axle of a car has no rack; expected axle = \"front\"");
  test.prescribed.push_back({"rack", "m", test.rack});
  test.slopes = histories.slopes(root);
  return std::make_unique<AxleKc>(std::move(test), mode);
}

}  // namespace

const KeySection& axle_kc_keys();

const TestKind kAxleKcTest = {"axle_kc",
                              "an axle on a K&C rig: both wheels, springs and bars",
                              {HasAxles::kName},
                              read_axle_kc,
                              axle_kc_keys};

}  // namespace latsch::experiment
