// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/drum_cleat.h"

#include <fmt/format.h>

#include <cmath>

#include "base/units.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/test_words.h"
#include "experiment/rigs/fe_rolling/cleat_rig.h"
#include "experiment/rigs/sampling.h"
#include "experiment/rigs/slip/lift_watch.h"
#include "experiment/rigs/wheel_scheme.h"
#include "experiment/tests/drum_convergence.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {

std::string DrumCleatTest::in_words() const {
  const DrumTest& test = test_;
  std::string text =
      fmt::format("drum, {:.4g} km/h, {}{}{}",
                  test.speed * 3.6,
                  test.load ? format_quantity(*test.load, "N", 4)
                            : format_quantity(test.deflection.value_or(0.0), "mm", 4),
                  cambered(test.camber),
                  inflated(test.pressure));
  if (!test.cleat) return text + ", no cleat";
  text += fmt::format(
      ", cleat {:.3g} mm x {:.3g} mm", test.cleat->height * 1e3, test.cleat->length * 1e3);
  if (test.cleat->angle != 0.0) text += fmt::format(" at {}", degrees(test.cleat->angle));
  if (test.passages > 1) text += fmt::format(", {} passages", test.passages);
  if (test.frames != DrumTest().frames) text += ", axes " + names_of(test.frames);
  return text;
}

std::vector<ChannelInfo> DrumCleatTest::channels() const {
  std::vector<ChannelInfo> channels = {{"time", "s"}};
  for (ChannelInfo& force : force_channels(test_.frames)) channels.push_back(std::move(force));
  channels.push_back({"speed", "m/s"});
  channels.push_back({"wheel_speed", "rad/s"});
  return channels;
}

std::vector<std::string> DrumCleatTest::needs() const { return kDrumCleatTest.needs; }

std::optional<Reach> DrumCleatTest::reach(const std::string& channel) const {
  if (channel != "time") return std::nullopt;
  // The first sample is one sample step after the beginning, as in drum_rig.cpp.
  const auto steps = [&](double time) { return std::lround(time / test_.step); };
  const long every = steps(test_.sample_step), lead = steps(test_.lead);
  const long last = steps(test_.duration - test_.lead);
  const auto time = [&](long i) { return static_cast<double>(i) * test_.step; };
  return Reach{time(every - lead), time((last + lead) / every * every - lead)};
}

Result<Channels> DrumCleatTest::run(Specimen& specimen) const {
  if (auto* elements = specimen.find<IsFeTire>()) {
    std::vector<std::string> remarks;
    auto record = elements->drive(
        [&](TireRig& rig, fe_tire::TireSlopes*) { return cross_cleat(rig, test_, remarks); },
        test_.pressure.has_value(),
        {});
    for (const std::string& remark : remarks) record_limit(specimen, remark);
    return record;
  }
  refuse_high_cleat(specimen, test_.cleat);
  LiftLog lifts;
  auto record =
      experiment::run(*watched(specimen.find<Rolls>()->tire(test_.pressure), lifts), test_);
  if (record) record_limit(specimen, lifts.sentence());
  return record;
}

namespace {

/// Returns the radius of the unloaded tire, m.
double free_radius(Specimen& specimen, const DrumTest& test) {
  if (const auto* rolls = specimen.find<Rolls>()) return rolls->tire(test.pressure)->free_radius();
  double radius = 0.0;
  (void)specimen.find<IsFeTire>()->drive(
      [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
        radius = rig.tire().mesh().outer_radius();
        return Channels();
      },
      true,
      {});
  return radius;
}

/// Returns the remarks of a finite-element tire on the test.
std::vector<std::string> remarks(IsFeTire& tire, const DrumTest& test) {
  std::vector<std::string> sentences;
  (void)tire.drive(
      [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
        sentences = remarks_on_cleat(rig, test);
        return Channels();
      },
      true,
      {});
  return sentences;
}

/// Returns a sentence if the record, or even the simulation, does not contain the whole passage
/// over the cleat; empty if it does.
std::string cut_passage(Specimen& specimen, const DrumTest& test) {
  const auto* knows = specimen.find<KnowsLimits>();
  const double radius = free_radius(specimen, test);
  const double reach = reach_of_cleat(test, radius, knows ? knows->felt_half_width() : 0.0);
  const double time = reach / test.speed, before = test.lead, after = test.duration - test.lead;
  if (time <= before && time <= after) return "";
  const char* lost = time > test.run_in + test.lead ? "the tire starts on the cleat"
                     : time > before && time > after
                         ? "the record holds neither the beginning nor the end of the passage"
                     : time > before ? "the record does not hold the beginning of the passage"
                                     : "the record does not hold the end of the passage";
  return fmt::format(
      "the tire touches the cleat from some {0:.3g} ms before it is below the axle to {0:.3g} ms "
      "after it ({1:.3g} m at {2:.3g} km/h), but {3}: {4:.3g} ms are run before, of which {5:.3g} "
      "ms are recorded, and {6:.3g} ms after it; expected a longer run_in, lead or duration",
      1e3 * time,
      reach,
      3.6 * test.speed,
      lost,
      1e3 * (test.run_in + test.lead),
      1e3 * before,
      1e3 * after);
}

}  // namespace

std::vector<std::string> DrumCleatTest::limits_of_model(Specimen& specimen) const {
  std::vector<std::string> limits = limits_of(specimen, test_.cleat);
  if (auto* elements = specimen.find<IsFeTire>()) limits = remarks(*elements, test_);
  for (std::string& limit : limits_of_camber(specimen, test_.camber, /*rolls=*/true))
    limits.push_back(std::move(limit));
  if (!test_.cleat) return limits;
  if (std::string note = cut_passage(specimen, test_); !note.empty())
    limits.push_back(std::move(note));
  if (std::string note = note_on_samples(test_.sample_step, test_.speed); !note.empty())
    limits.push_back(std::move(note));
  return limits;
}

std::vector<std::string> DrumCleatTest::limits(Specimen& specimen) const {
  std::vector<std::string> limits = limits_of_model(specimen);
  if (!test_.load) return limits;  // the tire decides then how far it is pressed
  DrivenWheel driven = {{"Fz", {*test_.load, *test_.load}},
                        {"gamma", {test_.camber, test_.camber}},
                        {"speed", {test_.speed, test_.speed}}};
  if (test_.pressure) driven["p"] = {*test_.pressure, *test_.pressure};
  for (std::string& limit : limits_of_driven(specimen, driven)) limits.push_back(std::move(limit));
  return limits;
}

Result<std::vector<std::string>> DrumCleatTest::run_in_blocks(
    Specimen& specimen, const std::function<void(const Channels&)>& tell) const {
  if (auto* elements = specimen.find<IsFeTire>()) {
    std::vector<std::string> remarks;
    const auto done = elements->drive(
        [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
          const Status crossed = cross_cleat(rig, test_, tell, remarks);
          if (!crossed) return crossed.failure();
          return Channels();
        },
        test_.pressure.has_value(),
        {});
    if (!done) return done.failure();
    for (std::string& limit : limits_of_model(specimen)) remarks.push_back(std::move(limit));
    return remarks;
  }
  const auto notes = Test::run_in_blocks(specimen, tell);
  if (!notes) return notes;
  return limits_of_model(specimen);
}

std::optional<Result<std::vector<ChannelConvergence>>> DrumCleatTest::convergence(
    const SpecimenKind& kind, const Document& numbers) const {
  return drum_convergence(kind, numbers, test_);
}

namespace {

std::unique_ptr<Test> read_drum(const Node& root, const TestSource& source) {
  return std::make_unique<DrumCleatTest>(read_drum_test(root, source.measured));
}

}  // namespace

DrumTest read_drum_cleat(const std::filesystem::path& file) {
  const Document document = Document::read(file);
  document.root().choice("kind", {"drum_cleat"});
  return read_drum_test(document.root());
}

const KeySection& drum_cleat_keys();

const TestKind kDrumCleatTest = {"drum_cleat",
                                 "rolls over a cleat on the drum",
                                 {Rolls::kName, IsFeTire::kName},
                                 read_drum,
                                 drum_cleat_keys,
                                 kWheelScheme};

}  // namespace latsch::experiment
