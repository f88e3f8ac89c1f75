// SPDX-License-Identifier: Apache-2.0
// kind = "four_post": a car on four posts that move its wheels up and down.
//
// Its channels: time, forces of the push-rods (pushrod_FL ..., compression positive), of the road
// on the tires (Fz_FL ...), accelerations of hubs and body upward, spring travel, heave, roll and
// pitch, heights of the posts (post_FL ...). Over frequency: densities psd_pushrod_FL ..., transfer
// functions tf_pushrod_FL ..., their phases and coherences. Signs and units: docs/car.md.
//
// The keys are in experiment/tests/keys/four_post_keys.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/car/car_record.h"
#include "experiment/rigs/car/four_post_rig.h"
#include "experiment/rigs/car/held_band.h"
#include "experiment/rigs/car/post_notes.h"
#include "experiment/rigs/car/post_spectra.h"
#include "experiment/rigs/duration_limit.h"
#include "experiment/rigs/sampling.h"
#include "experiment/tests/films/car_film.h"
#include "experiment/tests/pictures/four_post_pictures.h"
#include "experiment/tests/test_kinds.h"
#include "formats/tables/csv_table.h"
#include "formats/text/letter_case.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::experiment {
namespace {

/// The mode to whose signal transfer functions refer, and the settings of the spectra, which are
/// set even if only a page needs them.
struct Frequencies {
  PostMode mode = PostMode::heave;
  PostSpectra settings;
  bool are_recorded = false;
  // reason why the recorded motion of the posts narrowed the band; else empty
  std::string note = {};
};

class FourPost : public Test {
 public:
  /// `sweep` is the sweep that the heights follow; nullopt if the heights were recorded.
  FourPost(FourPostTest test,
           Frequencies frequencies,
           std::string words,
           std::optional<PostSweep> sweep = std::nullopt)
      : test_(std::move(test)),
        frequencies_(std::move(frequencies)),
        words_(std::move(words)),
        sweep_(sweep) {}

  std::string in_words() const override { return words_; }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (const auto& [name, unit] : car_channels(false)) channels.push_back({name, unit});
    for (const std::string& name : of_corners("post")) channels.push_back({name, "m"});
    if (frequencies_.are_recorded)
      for (const auto& [name, unit] : spectra_channels()) channels.push_back({name, unit});
    return channels;
  }
  std::vector<std::string> needs() const override { return kFourPostTest.needs; }
  std::vector<Ledger> ledgers(const std::string& by) const override {
    std::vector<Ledger> ledgers = ledgers_;
    for (Ledger& ledger : ledgers)
      for (LedgerRow& row : ledger.rows)
        if (!row.taken_as.empty()) Ledger::use(row, by);
    return ledgers;
  }
  /// Records the ledgers of the files that were read; `begin` is the first time of the record, s.
  void reads(std::vector<Ledger> ledgers, double begin) {
    ledgers_ = std::move(ledgers);
    begin_ = begin;
  }
  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "time") return std::nullopt;
    return Reach{test_.times.front(), test_.times.back()};
  }
  Result<Channels> run(Specimen& specimen) const override {
    auto record = driven(specimen);
    if (!record) return record;
    for (const std::string& note : notes_of(*record)) record_limit(specimen, note);
    return record;
  }
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    const auto record = run(specimen);
    if (!record) return record.failure();
    tell(*record);
    std::vector<std::string> notes;
    if (begin_ != 0.0)
      notes.push_back(
          fmt::format("the record of the posts begins at {:.6g} s: the time of the "
                      "result is counted from there, as 0",
                      begin_));
    if (frequencies_.are_recorded && !frequencies_.note.empty()) notes.push_back(frequencies_.note);
    return notes;
  }
  Result<Details> details(Specimen& specimen) const override {
    auto car = specimen.find<Drives>()->car({});
    if (!car) return car.failure();
    const auto runs = run_both_ways(**car, test_);
    if (!runs) return runs.failure();
    return four_post_details(as_posts_moved(runs->up), over_frequency(*runs));
  }
  bool has_film() const override { return true; }
  Status film(Specimen& specimen, int most_steps, report::Scene& scene) const override {
    auto car = specimen.find<Drives>()->car({});
    if (!car) return car.failure();
    CarFilm film(CarFilm::On::posts);
    const auto done = experiment::run(**car, test_, film.watcher());
    if (!done) return done.failure();
    film.add_to(scene, in_words(), most_steps);
    return {};
  }

 private:
  Result<Channels> driven(Specimen& specimen) const {
    auto car = specimen.find<Drives>()->car({});
    if (!car) return car.failure();
    if (!frequencies_.are_recorded) return experiment::run(**car, test_);
    const auto runs = run_both_ways(**car, test_);
    if (!runs) return runs.failure();
    Channels all = as_posts_moved(runs->up);
    const Channels more = over_frequency(*runs);
    for (const Channel& channel : more.all()) all.add(channel);
    return all;
  }
  /// Returns sentences on the tires that left their posts, and on frequencies at which the spectra
  /// are not reliable.
  std::vector<std::string> notes_of(const Channels& record) const {
    std::vector<std::string> notes = notes_of_lift(record, [&](double time) {
      return sweep_ ? fmt::format("{:.3g} s ({:.3g} Hz)", time, frequency_at(*sweep_, time))
                    : fmt::format("{:.3g} s", time);
    });
    if (!frequencies_.are_recorded) return notes;
    for (std::string& note : notes_of_coherence(record)) notes.push_back(std::move(note));
    return notes;
  }
  /// Returns the record without its end, in which the posts are at rest.
  Channels as_posts_moved(const Channels& record) const {
    const auto count = static_cast<std::size_t>(
        std::lround((test_.times.back() - test_.times.front()) / test_.sample_step) + 1);
    Channels cut;
    for (Channel channel : record.all()) {
      channel.values.resize(std::min(count, channel.values.size()));
      cut.add(std::move(channel));
    }
    return cut;
  }
  Channels over_frequency(const BothWays& runs) const {
    return spectra(runs, frequencies_.mode, 1.0 / test_.sample_step, frequencies_.settings);
  }

  FourPostTest test_;
  Frequencies frequencies_;
  std::string words_;
  std::optional<PostSweep> sweep_;
  double begin_ = 0.0;           // s, in the record of the posts
  std::vector<Ledger> ledgers_;  // ledger of a table of heights, in which no users are noted yet
};

void read_steps(const Node& root, FourPostTest& test) {
  test.step = root.quantity("step", "s", Range::between(1e-6, 1e-2), test.step);
  test.sample_step = root.quantity("sample_step", "s", Range::positive(), test.sample_step);
  const double ratio = test.sample_step / test.step;
  if (std::abs(ratio - std::round(ratio)) > 1e-6 * ratio || ratio < 0.5)
    root.reject("sample_step", "is no multiple of step");
}

/// Returns the column of a table that is the channel: of its name in any case and with blanks or
/// hyphens, or of a usual name of the time; the channel's name if there is none.
std::string column_of(const formats::CsvTable& table, const std::string& channel) {
  const auto columns = table.columns();
  if (std::find(columns.begin(), columns.end(), channel) != columns.end()) return channel;
  for (const std::string& column : columns) {
    std::string plain = formats::lower(column);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
    if (same_channel(column, channel) || plain == formats::lower(channel)) return column;
  }
  return channel;
}

/// Lists the columns of a table and marks those in `taken` as used.
Ledger ledger_of_heights(const formats::CsvTable& table,
                         const std::vector<MeasuredCondition>& taken) {
  Ledger ledger{table.file()};
  for (const formats::TableColumn& column : table.header()) {
    LedgerRow row;
    row.written = column.name;
    row.line = column.line;
    row.column = column.place;
    row.unit_written = column.unit;
    for (const MeasuredCondition& one : taken) {
      if (column.name != column_of(table, one.channel)) continue;
      row.taken_as = one.channel;
      row.unit = one.unit;
      row.meaning = one.channel == "time" ? "time" : "height of a post, upward";
      if (const auto unit = Unit::find(column.unit)) {
        row.offset = unit->to_si(0.0L);
        row.factor = unit->to_si(1.0L) - row.offset;
      }
    }
    ledger.rows.push_back(std::move(row));
  }
  return ledger;
}

/// Reads the heights from a measurement of the study, or from a table beside the file.
Channels heights_of(const Node& root, const TestSource& source, std::vector<Ledger>& ledgers) {
  std::vector<MeasuredCondition> conditions = {{.channel = "time", .unit = "s", .is_needed = true}};
  for (const std::string& name : of_corners("post"))
    conditions.push_back({.channel = name, .unit = "m", .is_needed = true});
  if (const auto table = find_measured(root, "posts"))
    return take_measured(*table, conditions, source.measured);
  const auto table = formats::CsvTable::read(source.file(root, "posts"));
  Channels channels;
  for (const MeasuredCondition& one : conditions)
    channels.add({one.channel, one.unit, table.numbers(column_of(table, one.channel), one.unit)});
  ledgers.push_back(ledger_of_heights(table, conditions));
  return channels;
}

/// Throws if the times are not equidistant, naming the interval that differs most from the usual
/// one.
void refuse_uneven(const Node& root, const std::vector<double>& times) {
  constexpr double kEven = 0.01;  // share of a step by which a time may deviate
  const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  bool is_even = mean > 0.0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double off = times[i] - times[0] - mean * static_cast<double>(i);
    is_even = is_even && std::abs(off) <= kEven * mean;
    steps.push_back(times[i] - times[i - 1]);
  }
  if (is_even) return;
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual = *middle;
  double most = 0.0;
  for (const double step : steps) most = std::max(most, std::abs(step - usual));
  const auto first = std::find_if(
      steps.begin(), steps.end(), [&](double step) { return std::abs(step - usual) > 0.5 * most; });
  const auto at = first == steps.end() ? steps.begin() : first;
  root.reject("posts",
              fmt::format("is not even in time at sample {}: it follows {:.6g} s after the sample "
                          "before it, while {:.6g} s are usual; expected a record without gaps",
                          at - steps.begin() + 2,
                          *at,
                          usual));
}

/// Sets `begin` to the first time of the record, s; the times of the test are counted from it.
FourPostTest recorded_posts(const Node& root,
                            const TestSource& source,
                            std::vector<Ledger>& ledgers,
                            double& begin) {
  const Channels channels = heights_of(root, source, ledgers);
  FourPostTest test;
  test.times = channels["time"];
  for (std::size_t i = 0; i < 4; ++i) test.heights[i] = channels[of_corners("post")[i]];
  if (test.times.size() < 2) root.reject("posts", "has fewer than two samples");
  refuse_uneven(root, test.times);
  begin = test.times.front();
  for (double& time : test.times) time -= begin;
  return test;
}

constexpr std::array<const char*, 4> kPostModes = {"heave", "pitch", "roll", "warp"};

// least number of periods of the lowest frequency in a record; with fewer periods the transfer
// function is unreliable
constexpr double kFewestPeriods = 2.0;

/// Throws for frequencies that the recorded motion of the posts does not contain: a transfer
/// function there would consist of rounding errors.
void refuse_beyond(const Node& root,
                   const FourPostTest& test,
                   const PostSweep* sweep,
                   const PostSpectra& band) {
  constexpr double kNear = 1e-9;
  const double lowest = kFewestPeriods / test.times.back();
  const auto reject = [&](const std::string& why) { root.reject("band", why); };
  if (band.from < lowest * (1.0 - kNear))
    reject(fmt::format(
        "begins at {:.4g} Hz, but a record of {:.4g} s holds no two periods below {:.4g} Hz: a "
        "longer one or a higher band is needed",
        band.from,
        test.times.back(),
        lowest));
  if (!sweep) return;
  if (band.from < sweep->from * (1.0 - kNear) || band.to > sweep->to * (1.0 + kNear))
    reject(fmt::format(
        "is {:.4g} to {:.4g} Hz, but the sweep goes from {:.4g} to {:.4g} Hz and holds nothing "
        "beyond: expected a band inside of it, or another from and to",
        band.from,
        band.to,
        sweep->from,
        sweep->to));
}

/// If the user states a band of frequencies, the recorded heights of the posts must contain it;
/// otherwise the band that they contain is used.
void take_what_is_held(const Node& root, const FourPostTest& test, Frequencies& read) {
  PostSpectra& band = read.settings;
  const double line = 1.0 / band.segment;
  const auto held = held_band(test, read.mode, 0.5 * line);
  const std::string mode = kPostModes[static_cast<std::size_t>(read.mode)];
  if (!held)
    root.reject(root.has("mode") ? "mode" : "posts",
                "the recorded posts do not move in " + mode + ": expected another mode");
  const std::string words = fmt::format(
      "the recorded posts move in {} only from {:.3g} to {:.3g} Hz", mode, held->from, held->to);
  if (band.from >= held->from - line && band.to <= held->to + line) return;
  if (root.has("band"))
    root.reject("band",
                fmt::format("is {:.4g} to {:.4g} Hz, but {}: expected a band inside of that",
                            band.from,
                            band.to,
                            words));
  band.from = std::max(band.from, held->from);
  band.to = std::min(band.to, held->to);
  read.note = fmt::format(
      "{}: the channels over frequency go from {:.3g} to {:.3g} Hz", words, band.from, band.to);
}

/// The record must contain the band that the user states; if none is stated, the band of the record
/// is used. Recorded posts must not move faster than the samples show, because spectra would show
/// that motion at other frequencies.
void take_what_is_sampled(const Node& root,
                          const FourPostTest& test,
                          bool is_sweep,
                          Frequencies& read) {
  constexpr double kRounding = 1e-9;
  const double highest = 0.5 / test.sample_step;
  PostSpectra& settings = read.settings;
  if (settings.to > highest * (1.0 + kRounding)) {
    const std::string words = fmt::format(
        "a sample every {:.4g} ms holds frequencies to {:.4g} Hz", 1e3 * test.sample_step, highest);
    if (root.has("band"))
      root.reject("band",
                  fmt::format("ends at {:.4g} Hz, but {}: expected a lower end or a shorter "
                              "sample_step",
                              settings.to,
                              words));
    settings.to = highest;
    if (read.are_recorded)
      read.note += fmt::format(
          "{}{}: the channels over frequency end there", read.note.empty() ? "" : "; ", words);
  }
  if (!read.are_recorded || is_sweep) return;
  constexpr double kMost = 0.01;  // share of the power of the posts' velocity
  for (std::size_t mode = 0; mode < kPostModes.size(); ++mode) {
    const double share = share_above(test, static_cast<PostMode>(mode), highest);
    if (share <= kMost) continue;
    root.reject("sample_step",
                fmt::format("is {:.4g} ms, which holds frequencies to {:.4g} Hz, but {:.2g} % of "
                            "the power of the recorded posts' velocity in {} lies above, which "
                            "spectra would show at other frequencies: expected a shorter one, or "
                            "posts that were low-passed",
                            1e3 * test.sample_step,
                            highest,
                            100.0 * share,
                            kPostModes[mode]));
  }
}

/// Reads the settings. `from` and `to` are the default ends of the band, Hz. `sweep` is the sweep
/// that the posts follow; nullptr: none.
Frequencies read_frequencies(const Node& root,
                             PostMode mode,
                             const FourPostTest& test,
                             double from,
                             double to,
                             const PostSweep* sweep = nullptr) {
  Frequencies read{.mode = mode, .settings = {.from = from, .to = to}};
  read.are_recorded = root.flag("spectra", false);
  // A record contains a limited band of frequencies; a sweep states its band itself.
  if (!sweep) read.settings.from = std::max(from, kFewestPeriods / test.times.back());
  read.settings.moving = test.times.back();
  PostSpectra& settings = read.settings;
  const double lasts = test.times.back();
  settings.segment =
      root.quantity("segment", "s", Range::positive(), std::min(settings.segment, lasts));
  if (settings.segment > lasts)
    root.reject("segment", fmt::format("is longer than the record, {:.4g} s", lasts));
  if (root.has("band")) {
    const auto band = root.quantities("band", "Hz");
    if (band.size() != 2 || !(band[0] >= 0.0 && band[1] > band[0]))
      root.reject("band", "expected a lower and a higher frequency");
    settings.from = band[0];
    settings.to = band[1];
  }
  if (read.are_recorded) {
    refuse_beyond(root, test, sweep, settings);
    if (!sweep) take_what_is_held(root, test, read);
  }
  take_what_is_sampled(root, test, sweep != nullptr, read);
  if (std::floor(settings.to * settings.segment) < std::ceil(settings.from * settings.segment))
    root.reject("band", "holds no line: a longer segment has them closer together");
  for (const char* key : {"segment", "band"})
    if (root.has(key) && !read.are_recorded)
      root.reject(key, "belongs to the spectra, which are not recorded: expected spectra = true");
  return read;
}

/// Throws for a sweep that ends before its lowest frequency has moved the posts.
void refuse_short(const Node& root, const PostSweep& sweep) {
  constexpr double kNear = 1e-9;
  const double least = 1.0 / sweep.from;
  if (sweep.duration >= least * (1.0 - kNear)) return;
  root.reject("duration",
              fmt::format("is {:.4g} s, which holds {:.3g} periods of the lowest frequency, {:.4g} "
                          "Hz; expected one at least: {:.4g} s or more, or a higher from",
                          sweep.duration,
                          sweep.duration * sweep.from,
                          sweep.from,
                          least));
}

std::unique_ptr<Test> read_four_post(const Node& root, const TestSource& source) {
  FourPostTest test;
  read_steps(root, test);
  const std::vector<std::string> modes(kPostModes.begin(), kPostModes.end());
  const std::string mode = root.choice("mode", modes, "heave");
  const auto which =
      static_cast<PostMode>(std::find(modes.begin(), modes.end(), mode) - modes.begin());
  if (root.has("posts")) {
    const FourPostTest steps = test;
    std::vector<Ledger> ledgers;
    double begin = 0.0;
    test = recorded_posts(root, source, ledgers, begin);
    test.step = steps.step;
    test.sample_step = steps.sample_step;
    check_duration(root, "posts", test.times.back() - test.times.front(), test.step);
    const PostSpectra usual;
    auto recorded = std::make_unique<FourPost>(
        test,
        read_frequencies(root, which, test, usual.from, usual.to),
        fmt::format("four posts as recorded, {:.4g} s", test.times.back()));
    recorded->reads(std::move(ledgers), begin);
    return recorded;
  }
  PostSweep sweep{.mode = which};
  sweep.from = root.quantity("from", "Hz", Range::positive(), sweep.from);
  sweep.to = root.quantity("to", "Hz", Range::positive(), sweep.to);
  if (!(sweep.to > sweep.from)) root.reject("to", "is not above from: a sweep rises");
  sweep.duration = root.quantity("duration", "s", Range::positive(), sweep.duration);
  check_duration(root, "duration", sweep.duration, test.step);
  sweep.amplitude = root.quantity("amplitude", "m", Range::positive(), sweep.amplitude);
  sweep.velocity = root.quantity("velocity", "m/s", Range::positive(), sweep.velocity);
  const FourPostTest made = sweep_test(sweep, test.sample_step);
  test.times = made.times;
  test.heights = made.heights;
  if (test.times.size() < 2)
    root.reject("duration", "is shorter than sample_step: expected a longer sweep");
  const Frequencies frequencies = read_frequencies(root, which, test, sweep.from, sweep.to, &sweep);
  refuse_coarse_samples(root, "to", sweep.to, test.sample_step);
  refuse_short(root, sweep);
  return std::make_unique<FourPost>(
      test,
      frequencies,
      fmt::format("four posts, {} from {:.3g} to {:.3g} Hz, {:.3g} mm",
                  mode,
                  sweep.from,
                  sweep.to,
                  1e3 * sweep.amplitude),
      sweep);
}

}  // namespace

const KeySection& four_post_keys();

const TestKind kFourPostTest = {"four_post",
                                "stands on four posts that move it",
                                {Drives::kName},
                                read_four_post,
                                four_post_keys,
                                "sweeps begin below their band; responses of two runs"};

}  // namespace latsch::experiment
