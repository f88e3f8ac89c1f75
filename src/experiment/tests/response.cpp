// SPDX-License-Identifier: Apache-2.0
// kind = "response": frequency responses of a tire at rest, in the air or standing on the ground.
//
// Channels: those of rigs/fe_tire/response_rig.h. The keys are in
// experiment/tests/keys/response_keys.cpp.
#include <fmt/format.h>

#include <algorithm>

#include "base/document_record.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/language/test_words.h"
#include "experiment/rigs/fe_tire/response_rig.h"
#include "experiment/tests/load_deflection.h"
#include "experiment/tests/modes.h"
#include "experiment/tests/response_frequencies.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

// Highest frequency, Hz. The shipped meshes carry some ten waves around, whose frequencies are near
// 300 Hz; a response to 500 Hz takes a minute and a half.
constexpr double kHighestFrequency = 500.0;

std::string input_in_words(const ResponseTest& test) {
  std::string direction = test.direction;
  std::ranges::replace(direction, '_', ' ');
  switch (test.input) {
    case ResponseInput::ground:
      return "motion of the ground, " + direction;
    case ResponseInput::wheel:
      return "motion of the wheel, " + direction;
    case ResponseInput::hub:
      return (test.direction.starts_with("about") ? "moment on the rim, " : "force on the rim, ") +
             direction;
    case ResponseInput::point:
      return "force on the tire, " + direction;
  }
  return "";
}

class ResponseOfTire : public Test, public TellsLimits {
 public:
  explicit ResponseOfTire(ResponseTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    const std::string conditions = conditions_in_words(test_.stand.pressure, test_.stand.ground);
    return fmt::format("response to {}, {:g} to {:g} Hz, {}{}{}",
                       input_in_words(test_),
                       test_.frequencies.front(),
                       test_.frequencies.back(),
                       conditions,
                       conditions.empty() ? "" : ", ",
                       state_in_words(test_.stand));
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels = {{"frequency", "Hz"}};
    for (const auto& [name, unit] : response_outputs(test_)) {
      for (const char* part : {"re_", "im_", "tf_"}) channels.push_back({part + name, unit});
      channels.push_back({"phase_" + name, "rad"});
    }
    if (test_.stand.loaded()) {
      channels.push_back({"deflection", "m"});
      channels.push_back({"loaded_radius", "m"});
      channels.push_back({"force", "N"});
    }
    return channels;
  }
  std::vector<std::string> needs() const override { return kResponseTest.needs; }
  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "frequency") return std::nullopt;
    return Reach{test_.frequencies.front(), test_.frequencies.back()};
  }
  std::optional<long> samples() const override { return std::ssize(test_.frequencies); }
  std::optional<long> samples_of(const std::string& channel) const override {
    for (const char* one : {"deflection", "loaded_radius", "force"})
      if (channel == one) return 1;
    return samples();
  }
  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<IsFeTire>()->drive(
        [this](TireRig& rig, fe_tire::TireSlopes*) { return respond(rig, test_); },
        test_.stand.pressure.has_value(),
        {});
  }
  std::vector<std::string> limits(Specimen& specimen) const override {
    std::vector<std::string> said;
    if (!has_losses(specimen))
      said.emplace_back(
          "response: the tire's file states neither prony nor loss_factor of a rubber or a layer, "
          "so nothing damps the tire and its resonances are infinitely high");
    said.emplace_back(
        "response: the air in the tire has its pressure and neither mass nor waves; the first wave "
        "around a car tire's cavity is near 200 Hz");
    return said;
  }
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    auto notes = Test::run_in_blocks(specimen, tell);
    if (!notes) return notes;
    for (std::string& limit : limits(specimen)) notes->push_back(std::move(limit));
    return notes;
  }

 private:
  ResponseTest test_;
};

fe_tire::RimMotion read_rim(const Node& root) {
  const std::string rim = root.choice("rim", {"held", "rigid", "free"}, "held");
  return rim == "held"    ? fe_tire::RimMotion::held
         : rim == "rigid" ? fe_tire::RimMotion::rigid
                          : fe_tire::RimMotion::free;
}

/// Reads what drives the tire. Throws InputError for what the state or the rim does not allow.
void read_input(const Node& root, ResponseTest& test) {
  const std::string input = root.choice("input", {"ground", "wheel", "hub", "point"});
  test.input = input == "ground"  ? ResponseInput::ground
               : input == "wheel" ? ResponseInput::wheel
               : input == "hub"   ? ResponseInput::hub
                                  : ResponseInput::point;
  const bool rim_is_held = test.stand.rim == fe_tire::RimMotion::held;
  if (test.input == ResponseInput::ground && !test.stand.loaded())
    root.reject("input",
                "is \"ground\" for a tire in the air, expected load or deflection beside it, or "
                "another input");
  if (test.input == ResponseInput::wheel && !rim_is_held)
    root.reject(
        "input",
        "is \"wheel\", a motion that is imposed, beside a rim that moves by itself; expected "
        "\"hub\", a force on the rim, or rim = \"held\"");
  if (test.input == ResponseInput::hub && rim_is_held)
    root.reject(
        "input",
        "is \"hub\", a force on a rim that is held and does not move; expected \"wheel\", a "
        "motion of the wheel, or rim = \"free\" or \"rigid\"");
  test.direction = root.choice("direction", response_directions(test.input), "z");
  if (test.input == ResponseInput::point) {
    const std::vector<double> at = root.quantities("at", "m");
    if (at.size() != 3)
      root.reject("at",
                  fmt::format("has {} values, expected x, y, z of a point on the tire", at.size()));
    test.at = Eigen::Vector3d::Map(at.data());
  }
}

void read_state(const Node& root, const TestSource& source, ModalTest& stand) {
  stand.pressure = read_pressure(root, source.measured);
  stand.ground = read_ground(root);
  if (root.has("load")) stand.load = root.quantity("load", "N", Range::positive());
  if (root.has("deflection"))
    stand.deflection = root.quantity("deflection", "m", Range::positive());
  if (stand.load && stand.deflection)
    root.reject("deflection", "is given beside load, expected one of them or none");
  if (stand.ground.mu != 0.0 && !stand.loaded())
    root.reject("friction",
                "is given without load and deflection, expected none, because the tire is in the "
                "air; state load or deflection for a tire that stands");
  stand.rim = read_rim(root);
}

std::unique_ptr<Test> read_response(const Node& root, const TestSource& source) {
  root.choice("kind", {"response"});
  ResponseTest test;
  read_state(root, source, test.stand);
  read_input(root, test);
  test.frequencies = read_frequencies(
      root, source, kHighestFrequency, "shorter waves than a mesh of a tire carries");
  if (const auto from = find_measured(root, "points"))
    test.points = measured_points(*from, source.measured);
  else if (root.has("points"))
    test.points = rows_as_points(root.rows("points", {"m", "m", "m"}));
  const std::string motion =
      root.choice("motion", {"displacement", "velocity", "acceleration"}, "displacement");
  test.motion = motion == "displacement" ? MotionAs::displacement
                : motion == "velocity"   ? MotionAs::velocity
                                         : MotionAs::acceleration;
  return std::make_unique<ResponseOfTire>(std::move(test));
}

}  // namespace

const KeySection& response_keys();

const TestKind kResponseTest = {"response",
                                "responds to vibration: transfer functions of hub, patch, points",
                                {IsFeTire::kName},
                                read_response,
                                response_keys};

}  // namespace latsch::experiment
