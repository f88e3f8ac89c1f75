// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/document_record.h"
#include "base/units.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/test_words.h"
#include "experiment/rigs/fe_tire/spin_speed.h"
#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/tests/load_deflection.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {

namespace {

std::string rim_in_words(fe_tire::RimMotion rim) {
  switch (rim) {
    case fe_tire::RimMotion::held:
      return "";
    case fe_tire::RimMotion::rigid:
      return ", rim on its springs";
    case fe_tire::RimMotion::free:
      return ", rim free";
  }
  return "";
}

}  // namespace

std::string state_in_words(const ModalTest& test) {
  std::string state = "unloaded";
  if (test.speed) state += ", spinning at " + speed_in_words(*test.speed);
  state += rim_in_words(test.rim);
  if (test.deflection) state = "pressed " + format_quantity(*test.deflection, "mm", 4);
  if (test.load) state = "under " + format_quantity(*test.load, "N", 5);
  return state + cambered(test.camber);
}

std::string ModesTest::in_words() const {
  const std::string conditions = conditions_in_words(test_.pressure, test_.ground);
  return fmt::format("modes{}{}, {}, {} lowest simulated, {}",
                     test_.pressure       ? " at "
                     : conditions.empty() ? ""
                                          : ", ",
                     conditions,
                     state_in_words(test_),
                     test_.count,
                     test_.points.cols() > 0
                         ? fmt::format("shapes at {} points", test_.points.cols())
                         : "no shapes: paired by label");
}

std::string ModesTest::conditions() const {
  const std::string conditions = conditions_in_words(test_.pressure, test_.ground);
  return conditions + (conditions.empty() ? "" : ", ") + state_in_words(test_);
}

std::vector<ChannelInfo> ModesTest::channels() const {
  if (!test_.moves())
    return {{"frequency", "Hz"}, {"n", "1"}, {"type", "1"}, {"phase", "1"}, {"damping", "1"}};
  std::vector<ChannelInfo> channels = {{"frequency", "Hz"},
                                       {"n", "1"},
                                       {"type", "1"},
                                       {"phase", "1"},
                                       {"sense", "1"},
                                       {"frequency_on_tire", "Hz"},
                                       {"spin", "rad/s"},
                                       {"outer_radius", "m"}};
  if (test_.is_damped) channels.push_back({"damping", "1"});
  if (test_.standing_wave) {
    channels.push_back({"standing_wave_speed", "rad/s"});
    channels.push_back({"standing_wave_n", "1"});
  }
  return channels;
}

std::vector<std::string> ModesTest::needs() const {
  if (test_.moves() || test_.is_damped) return {IsFeTire::kName};
  if (test_.ground.mu > 0.0 || test_.points.cols() > 0) return {TakesConditions::kName};
  return kModesTest.needs;
}

std::shared_ptr<const Test> ModesTest::with_points(const Eigen::Matrix3Xd& points) const {
  ModalTest test = test_;
  test.points = points;
  return std::make_shared<ModesTest>(std::move(test));
}

Result<Channels> ModesTest::run(Specimen& specimen) const { return run_with_slopes(specimen, {}); }

Result<Channels> ModesTest::run_with_slopes(Specimen& specimen, const Asked& asked) const {
  return specimen.find<Vibrates>()->vibrate(test_, asked);
}

bool has_losses(Specimen& specimen) {
  auto* tire = specimen.find<IsFeTire>();
  if (!tire) return false;
  bool is_elastic = true;
  (void)tire->drive(
      [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
        is_elastic = rig.losses().is_elastic();
        return Channels();
      },
      true,
      {});
  return !is_elastic;
}

std::vector<std::string> ModesTest::limits(Specimen& specimen) const {
  if (!specimen.find<IsFeTire>()) return {};
  std::vector<std::string> limits;
  if (test_.loaded()) limits = limits_of_standing(specimen, test_.ground.mu);
  if (test_.is_damped || !has_losses(specimen)) return limits;
  limits.emplace_back(
      "modes: frequencies are those of the relaxed moduli of rubber and layers; damping = true in "
      "the test counts their losses and their moduli at each frequency");
  return limits;
}

namespace {

/// Says that modes have more waves around than the sectors of a finite-element tire carry; empty if
/// none has.
std::string words_on_waves(Specimen& specimen, double most_waves) {
  auto* tire = specimen.find<IsFeTire>();
  if (!tire) return "";
  int sectors = 0;
  (void)tire->drive(
      [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
        sectors = rig.tire().mesh().sectors;
        return Channels();
      },
      true,
      {});
  const double carried = sectors / (2.0 * std::numbers::pi);  // n times a sector's angle is 1
  if (!(most_waves > carried)) return "";
  return fmt::format(
      "modes: frequencies of more than {:.0f} waves around are not exact: {} sectors carry no "
      "shorter waves, of which there are up to {:.0f}; expected finer sectors (mesh.sectors), or "
      "fewer modes",
      std::floor(carried),
      sectors,
      most_waves);
}

}  // namespace

Result<std::vector<std::string>> ModesTest::run_in_blocks(
    Specimen& specimen, const std::function<void(const Channels&)>& tell) const {
  double most_waves = 0.0;
  const auto watched = [&](const Channels& block) {
    if (const Channel* n = block.find("n"))
      for (const double waves : n->values) most_waves = std::max(most_waves, waves);
    tell(block);
  };
  auto notes = Test::run_in_blocks(specimen, watched);
  if (!notes) return notes;
  for (std::string& limit : limits(specimen)) notes->push_back(std::move(limit));
  if (std::string words = words_on_waves(specimen, most_waves); !words.empty())
    notes->push_back(std::move(words));
  return notes;
}

Eigen::Matrix3Xd rows_as_points(const std::vector<std::vector<double>>& rows) {
  Eigen::Matrix3Xd points(3, std::ssize(rows));
  for (std::size_t i = 0; i < rows.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3d::Map(rows[i].data());
  return points;
}

namespace {

constexpr long kMost = 200;  // modes

/// Throws InputError for conditions that a tire in motion cannot have. `key` is the key that states
/// the motion.
void check_moving(const Node& root, const ModalTest& test, const char* key) {
  if (test.loaded())
    root.reject(key,
                fmt::format("is given beside {}, expected a tire in the air, because modes of a "
                            "tire that rolls under load are not computed",
                            test.load ? "load" : "deflection"));
  if (test.camber != 0.0)
    root.reject(key, "is given beside camber, expected none, because the tire is in the air");
  if (test.ground.mu != 0.0)
    root.reject(key, "is given beside friction, expected none, because the tire is in the air");
}

/// Reads the keys of a tire that spins or whose rim moves.
void read_motion(const Node& root, ModalTest& test) {
  if (root.has("speed")) {
    test.speed = read_spin_speed(root);
    check_moving(root, test, "speed");
  }
  if (root.has("rim")) {
    const std::string rim = root.choice("rim", {"held", "rigid", "free"});
    test.rim = rim == "held"    ? fe_tire::RimMotion::held
               : rim == "rigid" ? fe_tire::RimMotion::rigid
                                : fe_tire::RimMotion::free;
    if (rim != "held") check_moving(root, test, "rim");
  }
  if (root.has("standing_wave")) {
    test.standing_wave = root.flag("standing_wave", false);
    if (test.standing_wave) check_moving(root, test, "standing_wave");
  }
}

std::unique_ptr<Test> read_modes_test(const Node& root, const TestSource& source) {
  ModalTest test;
  test.pressure = read_pressure(root, source.measured);
  test.ground = read_ground(root);
  const auto load = find_measured(root, "load");
  if (root.has("load"))
    test.load = load ? measured_mean(*load, {"Fz", "N", true, "W"}, source.measured)
                     : root.quantity("load", "N", Range::positive());
  if (root.has("deflection")) test.deflection = root.quantity("deflection", "m", Range::positive());
  if (test.load && test.deflection)
    root.reject("deflection", "is given beside load, expected one of them or none");
  test.camber = root.quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  if (test.camber != 0.0 && !test.loaded())
    root.reject("camber",
                "is given without load and deflection, expected none, because the tire is in the "
                "air; state load or deflection for a tire that stands");
  if (test.ground.mu != 0.0 && !test.loaded())
    root.reject("friction",
                "is given without load and deflection, expected none, because the tire is in the "
                "air; state load or deflection for a tire that stands");
  if (const auto from = find_measured(root, "count")) {
    const long measured = measured_count(*from, {"frequency", "Hz"}, source.measured);
    test.count = static_cast<int>(std::min(kMost, measured + kMoreModesThanMeasured));
    DocumentRecord::stands_for(*from, std::to_string(test.count));
  } else {
    test.count = static_cast<int>(root.integer("count", 1, kMost, test.count));
  }
  read_motion(root, test);
  test.is_damped = root.flag("damping", false);
  if (const auto from = find_measured(root, "points"))
    test.points = measured_points(*from, source.measured);
  else if (root.has("points"))
    test.points = rows_as_points(root.rows("points", {"m", "m", "m"}));
  return std::make_unique<ModesTest>(std::move(test));
}

/// Returns points in the format of the key `points`.
std::string canonical_rows(const Eigen::Matrix3Xd& points) {
  std::vector<std::vector<double>> rows;
  for (const auto& point : points.colwise()) rows.push_back({point.x(), point.y(), point.z()});
  return canonical(rows, {"m", "m", "m"});
}

std::unique_ptr<Test> modes_as_measured(const Node& experiment,
                                        const MeasuredAbscissa& measured,
                                        DocumentRecord& keys) {
  const Node& table = keys.node();
  ModalTest test;
  test.pressure = read_pressure(table);
  test.ground = read_ground(table);
  if (table.has("deflection") && table.has("load"))
    table.reject("load", "is given beside deflection, expected one of them");
  if (table.has("deflection"))
    test.deflection = table.quantity("deflection", "m", Range::positive());
  if (table.has("load")) test.load = table.quantity("load", "N", Range::positive());
  keys.put("camber", canonical(test.camber, "rad"));
  test.points = measured.points;
  if (test.points.cols() > 0) keys.put("points", canonical_rows(test.points));
  const long few = std::min(kMost, measured.modes + kMoreModesThanMeasured);
  test.count = static_cast<int>(experiment.integer("simulated_modes", measured.modes, kMost, few));
  keys.put("count", std::to_string(test.count));
  return std::make_unique<ModesTest>(std::move(test));
}

}  // namespace

const KeySection& modes_keys();

const TestKind kModesTest = {"modes",
                             "vibrates with its rim held",
                             {Vibrates::kName},
                             read_modes_test,
                             modes_keys,
                             "",
                             modes_as_measured};

}  // namespace latsch::experiment
