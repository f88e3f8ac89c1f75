// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/drum_template.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "cli/templates/ring_template.h"
#include "cli/templates/schema_files.h"
#include "correlation/laboratory/channel_names.h"
#include "correlation/rig_data/rig_doubts.h"
#include "correlation/rig_data/rig_processing.h"
#include "correlation/rig_data/rig_tables.h"
#include "formats/recorders/recorded_file.h"
#include "formats/tables/recording.h"
#include "formats/text/letter_case.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/pulse_speed.h"
#include "models/ring_tire/description/ring_reader.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using correlation::ProcessedPlateau;
using correlation::ProcessedRun;
using correlation::RigFile;

// s, shown part of the response before and behind the hit
constexpr double kBefore = 0.04, kBehind = 0.2;
// largest distance of the hit from the ends of a passage, as a share of the drum's period
constexpr double kOfTurn = 0.9;
// share of the window that is reserved on each side for a fitted delay
constexpr double kRoom = 0.1;
constexpr double kMoreRoom = 5e-3;     // s, added to that share
constexpr double kQuiet = 15e-3;       // s; the mean load is taken up to this time before the hit
constexpr double kFarthest = 60e-3;    // s, largest time between the hits in record and test
constexpr double kShiftStep = 0.5e-3;  // s
// correlation below which the program reports that record and simulation are dissimilar
constexpr double kAlike = 0.5;

const std::vector<RingNumber> kNumbersOfPassage = {
    {"radial", "sidewall.radial.stiffness", "MN/m^2", 2.0},
    {"radial_damping", "sidewall.radial.damping", "N s/m^2", 5.0}};
const std::vector<RingNumber> kAlong = {
    {"tangential", "sidewall.tangential.stiffness", "MN/m^2", 2.0},
    {"tangential_damping", "sidewall.tangential.damping", "N s/m^2", 5.0}};

/// A channel that the study needs, and the column of the recording that holds it.
struct Column {
  std::string ours, unit;          // "Fz", "N"
  std::vector<std::string> usual;  // usual names of the column, in any case
  std::string written = {};        // name of the column in the file; empty: no such column
  std::string unit_of_table = {};  // unit from the header of the table; empty if it states none
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return text;
}

/// Reads "Fz = LOAD [N]", which names the column of a channel.
void take_stated(const std::string& text, std::vector<Column>& columns) {
  const auto equals = text.find('=');
  const std::string ours(trimmed(std::string_view(text).substr(0, equals)));
  const auto one = std::find_if(
      columns.begin(), columns.end(), [&](const Column& column) { return column.ours == ours; });
  if (equals == std::string::npos || one == columns.end()) {
    std::vector<std::string> names;
    for (const Column& column : columns) names.push_back(column.ours);
    throw InputError("--column \"" + text +
                     "\": expected a channel and its column, such as \"Fz = "
                     "LOAD [N]\"; channels of a drum are " +
                     list_of(names));
  }
  std::string_view theirs = trimmed(std::string_view(text).substr(equals + 1));
  const auto bracket = theirs.find('[');
  if (bracket != std::string_view::npos && theirs.back() == ']') {
    one->unit_of_table = theirs.substr(bracket + 1, theirs.size() - bracket - 2);
    theirs = trimmed(theirs.substr(0, bracket));
  }
  one->written = theirs;
}

bool is_called(const Channel& channel, const Column& column) {
  auto framed = lower(channel.name);
  for (char& c : framed)
    if (c == ' ' || c == '-' || c == '.') c = '_';
  for (const std::string& usual : column.usual) {
    if (framed == usual) return true;
    if (column.unit[0] == 'N')
      for (const char* frame : {"w", "h", "c"})
        if (framed == usual + frame) return true;
  }
  const auto known = recognized(channel.name);  // a name known from a laboratory, such as "Radlast"
  return known && known->meaning->name == (column.ours == "speed" ? "Vx" : column.ours);
}

/// Returns what to do about a column whose unit has another dimension; "" if nothing is known.
std::string way_out_of(const Channel& found, const Column& column) {
  const Unit unit = Unit::of(found.unit);
  if (column.ours != "speed") return "";
  if (unit.same_dimension(Unit::of("rpm")) || unit.same_dimension(Unit::of("Hz")))
    return fmt::format(
        ". This is the rate at which the drum turns: write its speed at the circumference, rate "
        "times pi times diameter, as a column in m/s; 1 {} at a diameter of 2 m is {:.4g} m/s",
        found.unit,
        unit.to_si(1.0) * (unit.same_dimension(Unit::of("Hz")) ? 2.0 * std::numbers::pi : 1.0));
  return "";
}

/// Returns the unit that a column's name ends with, such as km/h for "V_kph", if the file states no
/// other.
std::string unit_of_name(const Channel& channel) {
  const auto known = recognized(channel.name);
  return known && channel.unit == "1" ? known->unit : "";
}

/// Returns what to do if the channels of a drum are in several groups of a recorder's file.
std::string hint_of_groups(const fs::path& file) {
  const auto endings = formats::recorder_endings();
  const bool has_groups =
      std::find(endings.begin(), endings.end(), formats::lower(file.extension().string())) !=
      endings.end();
  return has_groups ? ". One group of the file was read: if latsch show lists the channel in "
                      "another one, write a rig file with resample in [channels] for latsch process"
                    : "";
}

/// Throws InputError with the reason if the file has the column of a channel but the reader left it
/// out.
void expect_readable(const Column& column,
                     const formats::Recording& recording,
                     const fs::path& file) {
  for (const auto& [name, why] : recording.left_out) {
    const bool is_it =
        column.written.empty() ? is_called({name, "1", {}}, column) : column.written == name;
    if (!is_it) continue;
    throw InputError({file.string(), recording.header_line},
                     fmt::format("{}; the drum needs it as its {}: correct the unit in the file",
                                 why.find(name) == why.npos ? in_quotes(name) + " " + why : why,
                                 column.ours));
  }
}

/// Finds the columns of one recording by their names.
std::vector<Column> columns_of(const formats::Recording& recording,
                               const DrumRecordings& recordings,
                               const fs::path& file) {
  const Channels& record = recording.channels;
  std::vector<Column> columns = {
      {"time", "s", {"time", "t", "et", "runtime"}},
      {"speed", "m/s", {"speed", "drum_speed", "v", "vx", "longvel", "trajvelw", "trajvelh"}},
      {"pulses", "1", {"pulses", "pulse", "tooth", "teeth"}},
      {"Fz", "N", {"fz"}},
      {"Fx", "N", {"fx"}}};
  for (const std::string& stated : recordings.columns) take_stated(stated, columns);
  std::vector<std::string> there;
  for (const Channel& channel : record.all()) there.push_back(channel.name);
  for (Column& column : columns) {
    for (const Channel& channel : record.all())
      if (column.written.empty() && is_called(channel, column)) {
        column.written = channel.name;
        column.unit_of_table = unit_of_name(channel);
      }
    const Channel* found = record.find(column.written);
    if (found && found->unit != "1" && column.unit != "1" && column.unit_of_table.empty() &&
        !Unit::of(found->unit).same_dimension(Unit::of(column.unit)))
      throw InputError({file.string(), 0},
                       fmt::format("has {}, in SI in {}, which is not a unit of the {} of a drum; "
                                   "expected a column in {} or a unit like it{}",
                                   in_quotes(column.written),
                                   found->unit,
                                   column.ours,
                                   column.unit,
                                   way_out_of(*found, column)));
    if (!column.written.empty() && !found && !recording.left_out.contains(column.written))
      throw InputError({file.string(), 0},
                       fmt::format("has no column {}{}; it has {}",
                                   in_quotes(column.written),
                                   did_you_mean(column.written, there),
                                   list_of(there)));
  }
  const bool has_teeth = recordings.teeth > 0;
  columns.erase(columns.begin() + (has_teeth ? 1 : 2));
  for (const Column& column : columns)
    if (!record.find(column.written) && (column.ours != "Fx" || !column.written.empty()))
      expect_readable(column, recording, file);
  for (const Column& column : columns)
    if (column.written.empty() && column.ours != "Fx")
      throw InputError(
          {file.string(), 0},
          fmt::format(
              "has no column that is {} of a drum ({}); it has {}. Name it: "
              "--column \"{} = NAME\"{}{}",
              column.ours,
              fmt::join(column.usual, ", "),
              list_of(there),
              column.ours,
              column.ours == "speed" ? ", or --teeth N if a toothed wheel was recorded" : "",
              hint_of_groups(file)));
  return columns;
}

const Column* find_column(const std::vector<Column>& columns, const std::string& ours) {
  for (const Column& column : columns)
    if (column.ours == ours && !column.written.empty()) return &column;
  return nullptr;
}

double length_in(const std::string& text, const std::string& option, const char* example) {
  const auto quantity = parse_quantity(text);
  if (!quantity || si_unit(quantity->unit.dimension()) != "m" || !(quantity->si > 0.0))
    throw InputError(option + " \"" + text + "\": expected " + example);
  return quantity->si;
}

/// Converts "10 mm x 20 mm" to the table that describes the cleat in a test.
std::string cleat_table(const std::string& text) {
  constexpr const char* kExpected = "height and length of the cleat, such as \"10 mm x 20 mm\"";
  const auto cross = text.find('x');
  if (cross == std::string::npos)
    throw InputError("--cleat \"" + text + "\": expected " + kExpected);
  const std::string height(trimmed(std::string_view(text).substr(0, cross)));
  const std::string length(trimmed(std::string_view(text).substr(cross + 1)));
  length_in(height, "--cleat", kExpected);
  length_in(length, "--cleat", kExpected);
  return fmt::format("{{height = {}, length = {}}}", in_quotes(height), in_quotes(length));
}

std::string word_of(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

/// Returns a name for the run of each recording: that of the file, with the folder before it if two
/// files have the same name. Throws InputError if a file is given twice.
std::vector<std::string> run_names(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (fs::weakly_canonical(files[k]) == fs::weakly_canonical(files[i]))
        throw InputError({files[i].string(), 0}, "is given twice, expected each recording once");
    const auto same = [&](const fs::path& other) { return other.stem() == files[i].stem(); };
    const bool is_alone = std::count_if(files.begin(), files.end(), same) == 1;
    const std::string stem = files[i].stem().string();
    const std::string folder = fs::absolute(files[i]).lexically_normal().parent_path().filename();
    std::string name = word_of(is_alone ? stem : folder + "_" + stem);
    while (std::find(names.begin(), names.end(), name) != names.end()) name += "_";
    names.push_back(name);
  }
  return names;
}

std::string rig_text(const DrumRecordings& recordings,
                     const std::vector<Column>& columns,
                     const std::vector<double>& speeds,
                     std::optional<double> diameter,
                     const fs::path& folder) {
  const auto name = [&](const char* ours) {
    return in_quotes(find_column(columns, ours)->written);
  };
  std::string text = fmt::format(
      "# For latsch process: what the columns are and where the drum holds "
      "its speed.\n[channels]\ntime = {}\n{} = {}\nforce = {}\n",
      name("time"),
      recordings.teeth > 0 ? "pulses" : "speed",
      name(recordings.teeth > 0 ? "pulses" : "speed"),
      name("Fz"));
  if (find_column(columns, "Fx")) text += fmt::format("also = [{}]\n", name("Fx"));
  std::string units;
  for (const Column& column : columns)
    if (!column.unit_of_table.empty())
      units += fmt::format("{} = {}\n", in_quotes(column.written), in_quotes(column.unit_of_table));
  if (!units.empty()) text += "[channels.units]\n" + units;
  if (diameter) {
    text += fmt::format("[drum]\ncircumference = \"{:.6g} m\"\n", std::numbers::pi * *diameter);
    if (recordings.teeth > 0) text += fmt::format("teeth = {}\n", recordings.teeth);
  }
  std::vector<std::string> held;
  for (const double speed : speeds) held.push_back(in_quotes(format_quantity(speed, "km/h", 5)));
  text += fmt::format("[plateaus]\nspeeds = [{}]\n", fmt::join(held, ", "));
  const std::vector<std::string> names = run_names(recordings.files);
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format(
        "[run.{}]\nfile = {}\n",
        names[i],
        in_quotes(fs::proximate(fs::absolute(recordings.files[i]), fs::absolute(folder)).string()));
  return text;
}

/// Returns the constant speeds, m/s, at which the first recording runs.
std::vector<double> speeds_in(const Channels& channels,
                              const DrumRecordings& recordings,
                              const std::vector<Column>& columns,
                              std::optional<double> diameter) {
  const fs::path& file = recordings.files.front();
  DrumRecord record = drum_record(channels, find_column(columns, "time")->written, file.string());
  if (recordings.teeth == 0) return held_speeds(record, find_column(columns, "speed")->written, {});
  const std::string& pulses = find_column(columns, "pulses")->written;
  record.channels.add({"speed of the teeth",
                       "m/s",
                       speed_of_pulses(record.channel(pulses),
                                       record.rate,
                                       std::numbers::pi * *diameter / recordings.teeth,
                                       pulses,
                                       record.source)});
  return held_speeds(record, "speed of the teeth", {});
}

/// One recording at one constant speed: its averaged passage over the cleat, as a measurement and
/// as a test.
class DrumPassage {
 public:
  DrumPassage(const ProcessedRun& run, const ProcessedPlateau& plateau)
      : rate_(run.record.rate),
        plateau_(plateau),
        name_(fmt::format("{}_{:.0f}kph", run.name, 3.6 * plateau.plateau.mean)),
        table_("average_" + correlation::plateau_name(run.name, plateau.plateau.target) + ".csv") {
    for (const auto& channel : plateau.channels) {
      const auto known = recognized(channel.name);
      const bool is_force = known && known->channel.size() == 3 && known->meaning->unit == "N";
      if (is_force) frames_.push_back(known->channel.substr(2));
    }
    std::sort(frames_.begin(), frames_.end());
    frames_.erase(std::unique(frames_.begin(), frames_.end()), frames_.end());
    const auto& force = plateau.force();
    const double mean = std::accumulate(force.begin(), force.end(), 0.0) / std::ssize(force);
    hit_ = std::max_element(
               force.begin(),
               force.end(),
               [&](double a, double b) { return std::abs(a - mean) < std::abs(b - mean); }) -
           force.begin();
    const double turn = std::ssize(force) / rate_;
    before_ = std::min(kBefore, kOfTurn * hit_ / rate_);
    behind_ = std::min(kBehind, kOfTurn * (turn - hit_ / rate_));
  }

  const std::string& name() const { return name_; }
  double turn() const { return plateau_.period.samples / rate_; }
  double speed() const { return plateau_.plateau.mean; }
  double diameter() const { return speed() * turn() / std::numbers::pi; }
  /// Returns the mean of the vertical force before the hit, N.
  double load() const {
    const auto& force = plateau_.force();
    const auto end = std::max<long>(1, hit_ - std::lround(kQuiet * rate_));
    return std::accumulate(force.begin(), force.begin() + end, 0.0) / static_cast<double>(end);
  }
  /// Returns the standard deviation of the averaged channel with this index.
  double noise(std::size_t channel) const {
    const auto& spread = plateau_.channels[channel].average.spread;
    double square = 0.0;
    for (const double one : spread) square += one * one;
    return std::sqrt(square / std::ssize(spread) / std::ssize(plateau_.passages.starts));
  }
  std::size_t channels() const { return plateau_.channels.size(); }
  const std::string& channel(std::size_t i) const { return plateau_.channels[i].name; }
  std::size_t passages() const { return plateau_.passages.starts.size(); }

  /// Returns the time, s, reserved on either side of the window for a fitted delay.
  double room() const { return kRoom * (before_ + behind_) + kMoreRoom; }

  std::string test(const std::string& cleat, double diameter) const {
    return fmt::format(
        "kind = \"drum_cleat\"\nspeed = {}\nload = {}           # at rest; rolling in front of the "
        "hit it is {}\n"
        "drum_diameter = {}\nlead = \"{:.0f} ms\"\nduration = \"{:.0f} ms\"\ncleat = {}\n{}",
        in_quotes(format_quantity(speed(), "km/h", 5)),
        in_quotes(format_quantity(load_at_rest(), "N", 4)),
        format_quantity(std::abs(load()), "N", 4),
        in_quotes(format_quantity(diameter, "m", 5)),
        1e3 * (before_ + room()),
        1e3 * (before_ + behind_ + 2.0 * room()),
        cleat,
        frames_.empty() ? ""
                        : fmt::format("frame = [\"{}\"]   # that of the columns' names\n",
                                      fmt::join(frames_, "\", \"")));
  }

  /// Returns the name of a channel of the test, such as "Fz"; the axis frame is part of the name if
  /// the record has channels in several frames.
  std::string in_test(std::size_t i, const std::string& ours) const {
    if (frames_.size() < 2) return ours;
    const auto known = recognized(channel(i));
    const bool has_frame = known && known->channel.size() == 3;
    return ours + (has_frame ? known->channel.substr(2) : frames_.front());
  }

  /// Finds the time shift at which record and simulation are most similar; stores shift and
  /// similarity.
  void align(const Channels& simulated, double sign) {
    const auto &time = simulated["time"], &force = simulated[in_test(0, "Fz")];
    for (double moved = -kFarthest; moved <= kFarthest; moved += kShiftStep) {
      const double alike = sign * correlation_at(time, force, moved);
      if (alike <= alike_) continue;
      alike_ = alike;
      moved_ = moved;
    }
  }
  double alike() const { return alike_; }

  /// Load, N, of the tire at rest at the height at which it has the measured force while it rolls.
  double load_at_rest() const { return at_rest_ * std::abs(load()); }
  /// Stores the ratio between the forces of the known ring at rest and while rolling. The measured
  /// tire is assumed to have the same ratio.
  void learn_rolling_load(const Channels& simulated) {
    const auto &time = simulated["time"], &force = simulated[in_test(0, "Fz")];
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < time.size() && time[i] < -kQuiet; ++i, ++count) sum += force[i];
    if (count > 0 && sum > 0.0) at_rest_ = load_at_rest() / (sum / count);
  }

  std::string measurement(const std::string& folder, const std::string& signs) const {
    return fmt::format(
        "[measurement.{0}]\nfile = \"{1}/{2}\"\n{3}shift = \"{4:.1f} ms\"               # hit of "
        "the "
        "average onto that of the known ring\nselect = {{time = \"{5:.0f} ms .. {6:.0f} ms\"}}\n",
        name_,
        folder,
        table_,
        signs,
        1e3 * (moved_ - hit_ / rate_),
        -1e3 * before_,
        1e3 * behind_);
  }

  std::string experiment(std::size_t i, const std::string& ours) const {
    return fmt::format(
        "[experiment.{0}_{1}]\nkind = \"curve\"\nx = \"{0}/time\"\ny = \"{0}/{1}\"\n"
        "measurement = \"{0}\"\ncompare = \"about_mean\"\nexponent = 2\nnoise = \"{2:.3g} N\"\n"
        "nuisance = {{delay = \"free\"}}\n",
        name_,
        in_test(i, ours),
        std::max(noise(i), 1e-3));
  }

 private:
  /// Returns the correlation of the simulated force with the measured average, shifted in time and
  /// interpolated at the simulated times.
  double correlation_at(const std::vector<double>& time,
                        const std::vector<double>& force,
                        double moved) const {
    const auto& average = plateau_.force();
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0, n = 0;
    for (std::size_t i = 0; i < time.size(); ++i) {
      const double at = (time[i] - moved) * rate_ + static_cast<double>(hit_);
      const auto k = static_cast<long>(std::floor(at));
      if (k < 0 || k + 1 >= std::ssize(average)) continue;
      const double a = average[k] + (at - k) * (average[k + 1] - average[k]);
      x += a, y += force[i], xx += a * a, yy += force[i] * force[i], xy += a * force[i], n += 1;
    }
    const double square = (xx - x * x / n) * (yy - y * y / n);
    return n > 2 && square > 0 ? (xy - x * y / n) / std::sqrt(square) : 0.0;
  }

  double rate_;
  const ProcessedPlateau& plateau_;
  std::string name_, table_;
  /// axis frames stated in the names of the columns; empty: no name states one
  std::vector<std::string> frames_;
  long hit_ = 0;
  double before_ = 0.0, behind_ = 0.0;  // s, parts of the window before and behind the hit
  double moved_ = 0.0, alike_ = 0.0;
  double at_rest_ = 1.0;  // load at rest over the load of the rolling tire
};

/// Returns the drum's diameter, m, either stated by the user or computed from speed and period, and
/// adds remarks about it to `words`.
double diameter_of(const DrumPassage& passage,
                   std::optional<double> stated,
                   std::vector<std::string>& words) {
  if (!stated) {
    words.push_back(fmt::format(
        "drum diameter {:.4g} m, by the speed and the period of the passages", passage.diameter()));
    return passage.diameter();
  }
  return *stated;
}

/// Sections of the study for all passages that have been added.
struct PassageTables {
  std::string tests, measurements, experiments;

  void add(const DrumPassage& passage, const std::string& test, bool is_negative) {
    tests += "[test." + passage.name() + "]\n" + test;
    measurements += passage.measurement("rig_processed", is_negative ? "axes = \"sae\"\n" : "");
    for (std::size_t i = 0; i < passage.channels(); ++i)
      experiments += passage.experiment(i, i == 0 ? "Fz" : "Fx");
  }
};

/// Returns the drum's diameter, m, if the user states one. Throws InputError if the speed was
/// recorded as teeth of a wheel and no diameter is stated.
std::optional<double> stated_diameter(const DrumRecordings& recordings) {
  if (!recordings.diameter.empty())
    return length_in(recordings.diameter, "--drum-diameter", "a length such as \"2.5 m\"");
  if (recordings.teeth > 0)
    throw InputError(
        "--teeth: the speed of a toothed wheel needs the drum it turns with, expected "
        "--drum-diameter \"2.5 m\" beside it");
  return {};
}

/// Aligns a passage in time with the known ring over the same cleat and returns the text of the
/// passage's test.
std::string aligned_test(DrumPassage& passage,
                         const std::string& cleat,
                         double drum,
                         double sign,
                         const Document& known,
                         const experiment::Language& language) {
  const experiment::SpecimenKind& ring = *language.find_kind("ring_tire");
  const auto rolled = [&] {
    const std::string test = passage.test(cleat, drum);
    auto answer = language.run(
        ring, known, *language.read_test(Document::parse(test, "test of the drum").root(), {}));
    if (!answer) throw InputError("the known ring over this cleat: " + answer.failure().reason);
    return std::move(*answer);
  };
  passage.learn_rolling_load(rolled());
  passage.align(rolled(), sign);
  return passage.test(cleat, drum);
}

/// Adds remarks on a passage to `words`.
void tell_of(const DrumPassage& passage, std::vector<std::string>& words) {
  words.push_back(fmt::format("{}: {} passages at {}, load {}, likeness to the known ring {}",
                              passage.name(),
                              passage.passages(),
                              format_quantity(passage.speed(), "km/h", 4),
                              format_quantity(std::abs(passage.load()), "N", 4),
                              fmt::format("{:.0f} %", 100.0 * passage.alike())));
  if (passage.alike() < kAlike)
    words.push_back("caution: " + passage.name() +
                    " is hardly similar to the known ring; check cleat, load and signs before the "
                    "fit");
}

}  // namespace

DrumStudy drum_study(const DrumRecordings& recordings,
                     const Document& known,
                     const fs::path& folder,
                     const experiment::Language& language) {
  ring_tire::read_ring_tire(known.root());  // throws for an invalid ring before any work is done
  const std::string cleat = cleat_table(recordings.cleat);
  const std::optional<double> diameter = stated_diameter(recordings);
  const fs::path& front = recordings.files.front();
  const auto columns = columns_of(formats::read_whole_recording(front), recordings, front);
  std::map<std::string, std::string> units;
  for (const Column& column : columns)
    if (!column.unit_of_table.empty()) units[column.written] = column.unit_of_table;
  const formats::Recording read = formats::read_whole_recording(front, units);
  DrumStudy written;
  for (const auto& [name, why] : read.left_out)
    written.words.push_back(fmt::format("{} of {} is left out, which a drum does not need: {}",
                                        in_quotes(name),
                                        front.filename().string(),
                                        why));
  const auto speeds = speeds_in(read.channels, recordings, columns, diameter);
  written.rig = rig_text(recordings, columns, speeds, diameter, folder);
  write_text_file(folder / "rig.toml", with_schema(written.rig, language));
  const RigFile rig = correlation::read_rig_file(folder / "rig.toml");
  const auto results = correlation::process(rig, [](long, long, const std::string&) {});
  correlation::write_rig_tables(rig, results, folder / "rig_processed");
  for (const std::string& doubt : correlation::doubts_of(rig, results))
    written.words.push_back("caution: " + doubt);

  PassageTables tables;
  std::optional<double> drum;
  bool is_negative = false;
  for (const ProcessedRun& run : results.runs) {
    for (const ProcessedPlateau& plateau : run.plateaus) {
      DrumPassage passage(run, plateau);
      if (!drum) {
        drum = diameter_of(passage, diameter, written.words);
        is_negative = passage.load() < 0.0;
        if (is_negative)
          written.words.push_back(
              "the load is negative: taken for axes of SAE J670, axes = \"sae\"");
      }
      const std::string test =
          aligned_test(passage, cleat, *drum, is_negative ? -1.0 : 1.0, known, language);
      tell_of(passage, written.words);
      tables.add(passage, test, is_negative);
    }
  }
  written.ring = known.text();
  written.study = fmt::format(
      "# A flexible ring from a drum with a cleat: averages of latsch process, rig.toml beside "
      "it.\n"
      "title = \"Flexible ring on the drum\"\nmodel = \"ring.toml\"\n\n{}{}\n{}\n{}\n{}\n[run]\n"
      "workers = 2\n",
      ring_variables(kNumbersOfPassage, known),
      find_column(columns, "Fx") ? ring_variables(kAlong, known) : "",
      tables.measurements,
      tables.tests,
      tables.experiments);
  return written;
}

}  // namespace latsch::cli
