// SPDX-License-Identifier: Apache-2.0
#include "correlation/rig_data/rig_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "base/unit_reading.h"

namespace latsch::correlation {
namespace {

constexpr double kSameSpeed = 1e-3;  // relative tolerance: "60 km/h" and "16.67 m/s" are equal

void read_channels(const Node& table, RigFile& rig) {
  rig.time = table.text("time", "time");
  rig.speed = table.text("speed", "speed");
  rig.pulses = table.text("pulses", "");
  if (!rig.pulses.empty() && table.has("speed"))
    table.reject("pulses", "is given beside speed, expected one of them");
  if (!rig.pulses.empty())
    // a name that differs from the file's own channel of speed
    rig.speed = "speed of " + rig.pulses;
  rig.force = table.text("force");
  if (table.has("also")) rig.also = table.texts("also");
  for (std::size_t i = 0; i < rig.also.size(); ++i) {
    const bool again =
        std::find(rig.also.begin(), rig.also.begin() + i, rig.also[i]) != rig.also.begin() + i;
    if (again || rig.also[i] == rig.force)
      table.reject("also",
                   "names " + in_quotes(rig.also[i]) +
                       (again ? " twice" : ", which is the force already") +
                       "; expected further channels, each once");
  }
  rig.group = table.text("group", "");
  if (table.has("resample")) rig.resampled = table.quantity("resample", "s", Range::positive());
  if (!rig.group.empty() && rig.resampled > 0.0)
    table.reject("group", "is given beside resample, which joins all groups; expected one of them");
  const auto units = table.find_table("units");
  if (!units) return;
  std::vector<std::string> names{rig.time, rig.speed, rig.force, rig.pulses};
  names.insert(names.end(), rig.also.begin(), rig.also.end());
  for (const std::string& name : names) {
    if (!units->has(name)) continue;
    rig.units[name] = units->text(name);
    const UnitReading reading = reading_of_unit(rig.units[name]);
    if (!reading.unit) units->reject(name, "is " + reading.fault);
  }
}

void read_drum(const Node& table, RigFile& rig) {
  rig.circumference = table.quantity("circumference", "m", Range::positive());
  if (table.has("teeth") || !rig.pulses.empty())
    rig.teeth = static_cast<int>(table.integer("teeth", 1, 100000));
  if (rig.teeth > 0 && rig.pulses.empty())
    table.reject("teeth", "has no pulses to count, expected channels.pulses beside it");
}

/// Throws if two speeds are so close that their plateaus would contain the same samples.
void expect_apart(const Node& table, std::vector<double> speeds, double margin) {
  std::sort(speeds.begin(), speeds.end());
  if (margin > 0.5 * speeds.front())
    table.reject("margin",
                 "is more than half of the lowest speed, so a plateau would contain other speeds; "
                 "expected a margin such as \"1 km/h\"");
  for (std::size_t i = 1; i < speeds.size(); ++i) {
    if (speeds[i] - speeds[i - 1] <= kSameSpeed * speeds[i])
      table.reject("speeds", "has a speed twice, expected each once");
    if (speeds[i] - speeds[i - 1] < margin)
      table.reject("speeds",
                   "has speeds that differ by less than the margin, so that their plateaus would "
                   "be the same; expected a smaller margin");
  }
}

void read_plateaus(const Node& table, RigFile& rig) {
  PlateauSettings& p = rig.plateaus;
  rig.speeds = table.quantities("speeds", "m/s", Range::positive());
  if (rig.speeds.empty()) table.reject("speeds", "is empty, expected one speed at least");
  p.margin = table.quantity("margin", "m/s", Range::positive(), p.margin);
  expect_apart(table, rig.speeds, p.margin);
  p.low_pass = table.quantity("low_pass", "Hz", Range::positive(), p.low_pass);
  p.order = static_cast<int>(table.integer("order", 1, 12, p.order));
  p.trim = table.quantity("trim", "s", Range::not_negative(), p.trim);
  p.shortest = table.quantity("shortest", "s", Range::positive(), p.shortest);
}

void read_passages(const Node& table, RigFile& rig) {
  PassageSettings& p = rig.passages;
  p.align_to_average = table.choice("reference", {"first", "average"}, "first") == "average";
  p.hit_at = table.quantity("hit_at", "1", Range::between(0.0, 1.0), p.hit_at);
  p.align_below = table.quantity("align_below", "Hz", Range::not_negative(), p.align_below);
  p.most_shift = table.quantity("most_shift", "1", Range::between(0.0, 0.5), p.most_shift);
  p.least_likeness =
      table.quantity("least_likeness", "1", Range::between(-1.0, 1.0), p.least_likeness);
}

void read_spectrum(const Node& table, RigFile& rig) {
  using numerics::Convention;
  rig.convention_name = table.choice("convention", {"scipy", "octave", "matlab"}, "scipy");
  rig.convention = rig.convention_name == "octave"   ? Convention::octave
                   : rig.convention_name == "matlab" ? Convention::matlab
                                                     : Convention::scipy;
  if (table.has("segment")) rig.segment = table.quantity("segment", "s", Range::positive());
  if (!table.has("band")) return;
  const auto edges = table.quantities("band", "Hz", Range::positive());
  if (edges.size() != 2 || edges[0] >= edges[1]) {
    table.reject("band",
                 R"(is no band, expected two rising frequencies such as ["5 Hz", "300 Hz"])");
  }
  rig.band = {edges[0], edges[1]};
}

RigHammer read_hammer(const Node& table, const RigFile& rig) {
  RigHammer hammer;
  hammer.file = rig.file.parent_path() / table.text("file");
  hammer.input = table.text("input");
  hammer.output = table.text("output", rig.force);
  HammerSettings& s = hammer.settings;
  s.window = table.quantity("window", "s", Range::positive(), s.window);
  s.before = table.quantity("before", "s", Range::not_negative(), s.before);
  s.threshold = table.quantity("threshold", "1", Range::between(0.0, 1.0), s.threshold);
  if (s.before >= s.window) table.reject("before", "is not shorter than the window");
  hammer.estimator =
      table.choice("estimator", {"H1", "H2"}, "H1") == "H1" ? Estimator::h1 : Estimator::h2;
  return hammer;
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// Returns the index of a name in a list.
int place_of(const Node& table,
             const char* key,
             const std::string& name,
             const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    table.reject(key,
                 names.empty() ? "names " + in_quotes(name) + ", but there are none"
                               : "names " + in_quotes(name) + ", expected " + list_of(names));
  }
  return static_cast<int>(found - names.begin());
}

RigCase read_case(const Node& table, const RigFile& rig) {
  const auto runs = names_of(rig.runs);
  RigCase one;
  one.name = table.name();
  one.dummy = place_of(table, "dummy", table.text("dummy"), runs);
  one.real = place_of(table, "real", table.text("real"), runs);
  if (rig.speeds.size() == 1 && !table.has("speed")) return one;
  const double speed = table.quantity("speed", "m/s", Range::positive());
  const auto found = std::find_if(rig.speeds.begin(), rig.speeds.end(), [&](double v) {
    return std::abs(v - speed) <= kSameSpeed * v;
  });
  if (found == rig.speeds.end())
    table.reject("speed",
                 "is " + in_quotes(table.text("speed")) +
                     ", which is none of plateaus.speeds: correct it, or add it there");
  one.speed = static_cast<int>(found - rig.speeds.begin());
  return one;
}

std::optional<RigResponse> read_start(const Node& table) {
  if (!table.has("frequency")) return std::nullopt;
  return RigResponse::of(
      table.quantity("gain", "1"),
      2.0 * std::numbers::pi * table.quantity("frequency", "Hz", Range::positive()),
      table.quantity("damping", "1", Range::positive()),
      table.quantity("direct", "1"));
}

RigCompensation read_compensation(const Node& table, const RigFile& rig) {
  RigCompensation c;
  if (table.has("fit")) {
    for (const std::string& name : table.texts("fit")) {
      c.fit.push_back(place_of(table, "fit", name, names_of(rig.cases)));
    }
  }
  c.start = read_start(table);
  if (table.has("low_pass")) c.low_pass = table.quantity("low_pass", "Hz", Range::positive());
  c.bootstrap = static_cast<int>(table.integer("bootstrap", 0, 10000, 0));
  if (c.bootstrap == 1) table.reject("bootstrap", "is 1, expected 0 or 2 draws at least");
  if (table.has("apply")) {
    for (const std::string& name : table.texts("apply")) {
      c.apply.push_back(place_of(table, "apply", name, names_of(rig.runs)));
    }
  }
  if (!rig.hammer && !c.start) {
    table.reject("frequency",
                 "is missing: without a [hammer] test the fit needs a start by hand, frequency, "
                 "damping, gain and direct");
  }
  return c;
}

RigFile read_rig_tables(const Node& root, const std::filesystem::path& file) {
  RigFile rig;
  rig.file = file;
  rig.title = root.text("title", file.stem().string());
  read_channels(root.table("channels"), rig);
  if (const auto drum = root.find_table("drum")) {
    read_drum(*drum, rig);
  }
  if (!rig.pulses.empty() && rig.teeth == 0) {
    root.reject("drum",
                "is missing, expected circumference and teeth: a speed from pulses needs both");
  }
  read_plateaus(root.table("plateaus"), rig);
  if (const auto passages = root.find_table("passages")) read_passages(*passages, rig);
  if (const auto spectrum = root.find_table("spectrum")) read_spectrum(*spectrum, rig);
  for (const Node& run : root.named_tables("run")) {
    rig.runs.push_back({run.name(), file.parent_path() / run.text("file")});
  }
  if (rig.runs.empty()) root.reject("run", "is missing, expected a table [run.NAME] for each file");
  if (const auto hammer = root.find_table("hammer")) rig.hammer = read_hammer(*hammer, rig);
  for (const Node& one : root.named_tables("case")) rig.cases.push_back(read_case(one, rig));
  if (const auto table = root.find_table("compensation")) {
    rig.compensation = read_compensation(*table, rig);
  }
  if (const auto truth = root.find_table("truth")) {
    rig.truth = read_truth(*truth, names_of(rig.runs), rig.speeds);
  }
  root.close();
  return rig;
}

}  // namespace

RigFile read_rig_file(const std::filesystem::path& file) {
  return read_rig_tables(Document::read(file).root(), file);
}

std::map<std::string, DeclaredKey> keys_of_rig(const std::filesystem::path& file) {
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  read_rig_tables(record.node(), file);
  return record.keys();
}

}  // namespace latsch::correlation
