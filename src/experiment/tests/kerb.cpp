// SPDX-License-Identifier: Apache-2.0
// kind = "kerb": a car drives straight over a kerb.
//
// Its channels are those of a four-post rig, speed, line, loader_1 .. loader_3, and for areas mean
// and standard deviation from time 0 on, area_mean_FL ..., area_spread_FL ..., area_mean,
// area_spread. The part of the push-rod forces that the loaders cannot reproduce is in
// `unreachable`.
//
// The keys are in experiment/tests/keys/kerb_keys.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/document_record.h"
#include "base/error.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/car/car_record.h"
#include "experiment/rigs/car/kerb_rig.h"
#include "experiment/rigs/car/kerb_way.h"
#include "experiment/rigs/car/post_notes.h"
#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/sampling.h"
#include "experiment/tests/films/car_film.h"
#include "experiment/tests/pictures/kerb_pictures.h"
#include "experiment/tests/test_kinds.h"
#include "formats/road/road_file.h"
#include "models/car/air_watch.h"
#include "models/road/road_reader.h"

namespace latsch::experiment {
namespace {

/// Returns a sentence if a wheel would have to rise, within a length of its radius, by more than
/// the section height of its tire, so that its rim would hit the kerb; else an empty text.
/// `section` is the height that the tires' files state, m.
std::string too_high(const KerbWay& way, std::optional<double> section) {
  // share of the radius; for a tire whose file states no section height
  constexpr double kDeepest = 0.6;
  const double most = section ? *section : kDeepest * way.radius;
  if (!(way.rise > most)) return "";
  return fmt::format(
      "no car drives over this road: at x = {:.4g} m wheel {} would have to rise {:.4g} mm within "
      "its radius of {:.4g} mm, but {} {:.4g} mm high; expected a lower kerb, a longer pitch or "
      "another line",
      way.place,
      car::kCornerNames[static_cast<std::size_t>(way.corner)],
      1e3 * way.rise,
      1e3 * way.radius,
      section ? "the section of its tire is" : "no section of such a tire is more than",
      1e3 * most);
}

std::optional<double> section_of(Specimen& specimen) {
  const auto* knows = specimen.find<KnowsLimits>();
  return knows ? knows->section_height() : std::nullopt;
}

TreadWidth width_of(Specimen& specimen) {
  const auto* knows = specimen.find<KnowsLimits>();
  TreadWidth width;
  if (!knows) return width;
  width.felt = knows->felt_half_width();
  width.tread = knows->tread_half_width().value_or(std::max(width.tread, width.felt));
  return width;
}

/// Returns a sentence on where a real tread would stand on something that the tires' model misses;
/// empty if there is no such position.
std::string beside_tread(const KerbWay& way, const TreadWidth& width) {
  const Unfelt& unfelt = way.unfelt;
  if (unfelt.rise == 0.0) return "";
  return fmt::format(
      "at x = {:.4g} m the contact point of tire {} passes {:.3g} mm beside something {:.3g} mm "
      "high, on which a tread {:.4g} mm wide would stand: this tire feels {} and does not meet it",
      unfelt.place,
      car::kCornerNames[static_cast<std::size_t>(unfelt.corner)],
      1e3 * unfelt.beside,
      1e3 * unfelt.rise,
      2e3 * width.tread,
      width.felt > 0.0 ? fmt::format("{:.4g} mm of the width", 2e3 * width.felt)
                       : std::string("the line below its contact point alone"));
}

/// Returns the highest speed, m/s.
double fastest_of(const KerbTest& test) {
  return *std::max_element(test.speed.values.begin(), test.speed.values.end());
}

class KerbRunTest : public Test, public TellsLimits {
 public:
  explicit KerbRunTest(KerbTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    std::string words = fmt::format("{:.4g} m/s", test_.speed.at(0.0));
    if (test_.kerb)
      words += fmt::format(" over a kerb of {:.3g} mm every {:.4g} mm",
                           1e3 * test_.kerb->height,
                           1e3 * test_.kerb->pitch);
    if (test_.filed) words += " on " + test_.filed->file.filename().string();
    if (test_.line.at(0.0) != 0.0)
      words += fmt::format(", line {:.3g} mm", 1e3 * test_.line.at(0.0));
    return words;
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (const auto& [name, unit] : car_channels(test_.with_area)) channels.push_back({name, unit});
    channels.push_back({"speed", "m/s"});
    channels.push_back({"line", "m"});
    if (test_.with_area)
      for (const char* of : {"_FL", "_FR", "_RL", "_RR", ""})
        for (const char* what : {"area_mean", "area_spread"})
          channels.push_back({std::string(what) + of, "m^2"});
    if (test_.loaders)
      for (int k = 1; k <= 3; ++k) channels.push_back({fmt::format("loader_{}", k), "N"});
    if (test_.follows_pushrods()) channels.push_back({"unreachable", "N"});
    return channels;
  }
  std::vector<std::string> needs() const override { return kKerbTest.needs; }
  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "time") return std::nullopt;
    return Reach{-test_.run_in, test_.duration};
  }
  Result<Channels> run(Specimen& specimen) const override {
    auto car = specimen.find<Drives>()->car({});
    if (!car) return car.failure();
    const KerbWay way = way_of(test_, **car, width_of(specimen));
    if (const std::string why = too_high(way, section_of(specimen)); !why.empty())
      throw InputError(why);
    car::AirWatch air;
    auto record = experiment::run(
        **car,
        test_,
        [&](const car::Car& of, const car::CarState& state, const road::Road&, double time) {
          air.see(of, state, time);
        });
    if (!record) return record;
    record_limit(specimen, air.sentence());
    for (const std::string& lift : lifts_of(*record, test_.sample_step))
      record_limit(specimen, lift);
    return record;
  }
  std::vector<std::string> limits(Specimen& specimen) const override {
    const auto car = specimen.find<Drives>()->car({});
    if (!car) return {};
    const KerbWay way = way_of(test_, **car, width_of(specimen));
    const auto* knows = specimen.find<KnowsLimits>();
    std::vector<std::string> limits;
    if (knows && way.varies_across) limits = knows->limits_across();
    if (!test_.kerb && !test_.filed) return limits;
    if (std::string why = too_high(way, section_of(specimen)); !why.empty())
      limits.push_back(std::move(why));
    if (fastest_of(test_) == 0.0)
      limits.emplace_back("the car stands: its speed is 0 throughout the test");
    else if (test_.kerb && !way.meets)
      limits.push_back(without_kerb(way));
    if (std::string note = beside_tread(way, width_of(specimen)); !note.empty())
      limits.push_back(std::move(note));
    if (std::string note = note_on_samples(test_.sample_step, fastest_of(test_)); !note.empty())
      limits.push_back(std::move(note));
    return limits;
  }
  /// Returns warnings on effects of this road that the tires' model does not describe, and on parts
  /// of the road that no wheel meets.
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    const auto notes = Test::run_in_blocks(specimen, tell);
    if (!notes) return notes;
    return limits(specimen);
  }
  Result<Details> details(Specimen& specimen) const override {
    auto car = specimen.find<Drives>()->car({});
    if (!car) return car.failure();
    const auto road = road_of(test_, **car);
    KerbFilm film(*road, test_.line.at(0.0) + (*car)->parts().corners[car::kFL].wheel_center.y());
    const auto done = experiment::run(
        **car,
        test_,
        [&](const car::Car& of, const car::CarState& state, const road::Road&, double time) {
          film.see(of, state, time);
        });
    if (!done) return done.failure();
    return film.details();
  }
  bool has_film() const override { return true; }
  Status film(Specimen& specimen, int most_steps, report::Scene& scene) const override {
    auto car = specimen.find<Drives>()->car({});
    if (!car) return car.failure();
    CarFilm film(CarFilm::On::road);
    const auto done = experiment::run(**car, test_, film.watcher());
    if (!done) return done.failure();
    film.add_to(scene, in_words(), most_steps, road_of(test_, **car).get());
    return {};
  }

 private:
  /// Returns a sentence that no wheel meets the kerb, with the positions of both.
  std::string without_kerb(const KerbWay& way) const {
    const road::Kerb& kerb = *test_.kerb;
    return fmt::format(
        "no tire meets the kerb, so the record is that of a level road: the wheels roll from x = "
        "{:.4g} to {:.4g} m on the line y = {:.4g} m, while the kerb begins at x = {:.4g}, y = "
        "{:.4g} m, is {:.4g} m long and {:.4g} m wide; expected another start, width, height, line "
        "or duration",
        way.first,
        way.last,
        test_.line.at(0.0),
        kerb.start.x(),
        kerb.start.y(),
        kerb.count * kerb.pitch,
        kerb.width);
  }

  KerbTest test_;
};

History read_history(const Node& root,
                     const char* key,
                     const char* unit,
                     const TestSource& source,
                     std::optional<double> fallback,
                     Range range) {
  const auto from = find_measured(root, key);
  if (!from)
    return {
        {0.0},
        {fallback ? root.quantity(key, unit, range, *fallback) : root.quantity(key, unit, range)}};
  const Channels channels = take_measured(*from,
                                          {{.channel = "time", .unit = "s", .is_needed = true},
                                           {.channel = key, .unit = unit, .is_needed = true}},
                                          source.measured);
  History history{channels["time"], channels[key]};
  if (history.times.size() < 2) root.reject(key, "has fewer than two samples");
  for (std::size_t i = 1; i < history.times.size(); ++i)
    if (!(history.times[i] > history.times[i - 1]))
      root.reject(key, fmt::format("does not go forward in time at sample {}", i + 1));
  return history;
}

void read_loaders(const Node& node, const TestSource& source, KerbTest& test) {
  car::AeroLoaders loaders;
  const auto points = node.rows("points", {"m", "m"});
  if (points.size() != 3)
    node.reject("points", fmt::format("has {} points, expected three loaders", points.size()));
  for (int i = 0; i < 3; ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    loaders.points.col(i) = Eigen::Vector3d(point[0], point[1], 0.3);
  }
  test.loaders = loaders;
  if (const auto from = find_measured(node, "pushrods")) {
    std::vector<MeasuredCondition> conditions = {
        {.channel = "time", .unit = "s", .is_needed = true}};
    for (const std::string& name : of_corners("pushrod"))
      conditions.push_back({.channel = name, .unit = "N", .is_needed = true});
    const Channels channels = take_measured(*from, conditions, source.measured);
    if (channels["time"].size() < 2) node.reject("pushrods", "has fewer than two samples");
    for (std::size_t i = 0; i < 4; ++i)
      test.pushrods[i] = {channels["time"], channels[of_corners("pushrod")[i]]};
    if (!node.has("stretch")) return;
    const auto stretch = node.quantities("stretch", "s");
    if (stretch.size() != 2 || stretch[0] >= stretch[1])
      node.reject("stretch", "expected two rising times");
    for (History& pushrod : test.pushrods)
      pushrod = {{0.0}, {pushrod.mean(stretch[0], stretch[1])}};
    return;
  }
  const auto forces = node.quantities("downforce", "N");
  if (forces.size() != 3) node.reject("downforce", "expected three forces, one a loader");
  test.downforce = {forces[0], forces[1], forces[2]};
}

void read_wander(const Node& node, KerbTest& test) {
  if (test.speed.values.size() > 1 || test.line.values.size() > 1)
    node.reject("speed", "is given beside a speed or line that is measured, expected one of them");
  Wander wander;
  wander.speed = node.quantity("speed", "m/s", Range::not_negative(), 0.0);
  wander.line = node.quantity("line", "m", Range::not_negative(), 0.0);
  wander.period = node.quantity("period", "s", Range::between(0.1, 1e3), 1.0);
  wander.seed = node.integer("seed", 0, 1'000'000'000, 1);
  const auto with = [&](double asked, double deviation, int stream) {
    return wandering(asked, deviation, wander, stream, test.run_in, test.duration);
  };
  test.speed = with(test.speed.at(0.0), wander.speed, 1);
  test.line = with(test.line.at(0.0), wander.line, 2);
}

FiledRoad read_filed_road(const Node& node, const TestSource& source) {
  FiledRoad filed;
  filed.file = source.file(node, "file");
  filed.road = formats::read_road_file(filed.file).road;
  DocumentRecord::names_files(node, "file", formats::files_of_road(filed.file));
  if (node.has("start")) {
    const auto start = node.quantities("start", "m", Range::between(-1e6, 1e6));
    if (start.size() != 2) node.reject("start", "expected x and y");
    filed.start = {start[0], start[1]};
  }
  filed.heading = node.quantity("heading", "rad", Range::between(-7.0, 7.0), 0.0);
  filed.continues = node.choice("beyond_edge", {"error", "continue"}, "error") == "continue";
  return filed;
}

/// Returns the time step of a test that states none: 0.2 ms or, at a high speed, the fraction of
/// sample_step in which a tire moves no farther than allowed.
double usual_step(double usual, double sample_step, double fastest) {
  if (usual * fastest <= kFarthestStep || sample_step < usual) return usual;
  return sample_step / std::ceil(sample_step * fastest / kFarthestStep);
}

/// Throws for time steps or samples that are too far apart to resolve the shape of the kerb.
void refuse_coarse_steps(const Node& root, const KerbTest& test) {
  constexpr double kSteps = 8.0,
                   kSamples = 4.0;  // least number of samples in a pitch
  const double fastest = fastest_of(test);
  check_step(root, fastest, test.step);
  if (2.0 * test.sample_step > test.run_in + test.duration)
    root.reject("sample_step",
                fmt::format("leaves less than two samples of {:.4g} s: expected a shorter one",
                            test.run_in + test.duration));
  if (!test.kerb || test.kerb->height == 0.0 || fastest == 0.0) return;
  const road::Kerb& kerb = *test.kerb;
  const auto reject =
      [&](const char* key, double step, const char* shape, double length, double n) {
        root.reject(
            key,
            fmt::format("moves the car {:.3g} mm at {:.3g} m/s, but {} of the kerb is {:.4g} mm "
                        "long: expected at most {:.3g} ms, so that {:g} are in it",
                        1e3 * fastest * step,
                        fastest,
                        shape,
                        1e3 * length,
                        1e3 * length / (n * fastest),
                        n));
      };
  constexpr double kRounding = 1.0 + 1e-9;
  if (fastest * test.step * kSteps > kerb.pitch * kRounding)
    reject("step", test.step, "a pitch", kerb.pitch, kSteps);
  if (kerb.shape == road::Kerb::Shape::block && fastest * test.step > kerb.length * kRounding)
    reject("step", test.step, "a bar", kerb.length, 1.0);
  if (fastest * test.sample_step * kSamples > kerb.pitch * kRounding)
    reject("sample_step", test.sample_step, "a pitch", kerb.pitch, kSamples);
}

std::unique_ptr<Test> read_kerb_test(const Node& root, const TestSource& source) {
  KerbTest test;
  test.speed = read_history(root, "speed", "m/s", source, std::nullopt, Range::between(0.0, 150.0));
  test.line = read_history(root, "line", "m", source, 0.0, Range::between(-50.0, 50.0));
  test.run_in = root.quantity("run_in", "s", Range::between(0.0, 20.0), test.run_in);
  test.duration = root.quantity("duration", "s", Range::between(1e-3, 60.0), test.duration);
  test.sample_step = root.quantity("sample_step", "s", Range::positive(), test.sample_step);
  test.step = root.quantity("step",
                            "s",
                            Range::between(1e-6, 2e-3),
                            usual_step(test.step, test.sample_step, fastest_of(test)));
  const double ratio = test.sample_step / test.step;
  if (std::abs(ratio - std::round(ratio)) > 1e-6 * ratio || ratio < 0.5)
    root.reject("sample_step", "is no multiple of step");
  test.with_area = root.flag("area", false);
  if (const auto wander = root.find_table("wander")) read_wander(*wander, test);
  if (const auto kerb = root.find_table("kerb")) test.kerb = road::read_kerb(*kerb);
  if (const auto road = root.find_table("road")) {
    if (test.kerb) root.reject("road", "is stated, and [kerb] as well: expected one of them");
    test.filed = read_filed_road(*road, source);
  }
  if (const auto loaders = root.find_table("loaders")) read_loaders(*loaders, source, test);
  refuse_coarse_steps(root, test);
  return std::make_unique<KerbRunTest>(std::move(test));
}

}  // namespace

const KeySection& kerb_keys();

const TestKind kKerbTest = {
    "kerb", "drives over a kerb", {Drives::kName}, read_kerb_test, kerb_keys};

}  // namespace latsch::experiment
