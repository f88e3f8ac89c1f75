// SPDX-License-Identifier: Apache-2.0
#include "correlation/rig_data/rig_tables.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "formats/tables/csv_table.h"
#include "measurement/band_level.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

/// Writes tables into a folder and lists the files.
class Folder {
 public:
  explicit Folder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    fs::create_directories(path_, error);
    if (error) throw InputError({path_.string(), 0}, "cannot be made: " + error.message());
  }
  void write(const std::string& name, const std::string& comment, const Channels& table) {
    files.push_back(path_ / (name + ".csv"));
    write_text_file(files.back(), "# " + comment + "\n" + formats::csv_text(table));
  }
  void write_text(const std::string& name, const std::string& text) {
    files.push_back(path_ / name);
    write_text_file(files.back(), text);
  }

  std::vector<fs::path> files;

 private:
  fs::path path_;
};

Channels table_of(std::initializer_list<Channel> columns) {
  Channels table;
  for (const Channel& column : columns) table.add(column);
  return table;
}

/// Returns the SI unit of a density, such as "N^2/Hz".
std::string squared_per_hertz(const std::string& unit) {
  return unit == "1" ? "s" : "(" + unit + ")^2 s";
}

void write_passages(Folder& folder, const ProcessedRun& run, const ProcessedPlateau& p) {
  Channel begin{"begin", "s", {}}, likeness{"likeness", "1", p.passages.likeness};
  for (const double start : p.passages.starts) {
    begin.values.push_back(run.record.time(p.plateau.first + start));
  }
  folder.write("passages_" + plateau_name(run.name, p.plateau.target),
               fmt::format("where each passage begins; its likeness to the reference; {} were left "
                           "out; period {:.9g} s",
                           p.passages.left_out,
                           p.period.samples / run.record.rate),
               table_of({begin, likeness}));
}

void write_average(Folder& folder, const ProcessedRun& run, const ProcessedPlateau& p) {
  Channels table;
  Channel time{"time", "s", {}};
  for (int i = 0; i < p.passages.length; ++i) time.values.push_back(i / run.record.rate);
  table.add(time);
  for (const ChannelAverage& channel : p.channels) {
    table.add({channel.name, channel.unit, channel.average.mean});
    table.add({channel.name + "_spread", channel.unit, channel.average.spread});
  }
  folder.write(
      "average_" + plateau_name(run.name, p.plateau.target),
      fmt::format("mean of {} passages and their standard deviation", p.passages.starts.size()),
      table);
}

void write_spectra(Folder& folder,
                   const RigFile& rig,
                   const ProcessedRun& run,
                   const ProcessedPlateau& p) {
  const std::string name = plateau_name(run.name, p.plateau.target);
  const std::string unit = squared_per_hertz(p.channels[0].unit);
  folder.write(
      "psd_" + name,
      "power spectral density of the average " + rig.force + ", Welch as " + rig.convention_name,
      table_of({{"frequency", "Hz", p.density.frequency}, {"psd", unit, p.density.value}}));
  folder.write("coherence_" + name,
               "part of the power of " + rig.force + " that every passage repeats",
               table_of({{"frequency", "Hz", p.coherence.frequency},
                         {"coherence", "1", p.coherence.value}}));
  Channel center{"frequency", "Hz", {}}, level{"level_dB", "1", {}};
  for (const FrequencyBand& band : third_octave_bands(rig.band)) {
    if (band.upper > 0.5 * run.record.rate) break;  // nothing was recorded there
    center.values.push_back(std::sqrt(band.lower * band.upper));
    level.values.push_back(std::max(-999.0, band_level(p.density, band)));
  }
  folder.write(
      "levels_" + name,
      "third-octave levels of the average " + rig.force + ", dB re 1 " + p.channels[0].unit,
      table_of({center, level}));
}

void write_hammer(Folder& folder, const HammerResult& hammer) {
  Channel size{"magnitude", "1", {}}, phase{"phase", "rad", {}}, fit{"fit_magnitude", "1", {}},
      fit_phase{"fit_phase", "rad", {}};
  for (std::size_t k = 0; k < hammer.measured.H.size(); ++k) {
    const auto H = hammer.fit.response.at(kTwoPi * hammer.measured.frequency[k]);
    size.values.push_back(std::abs(hammer.measured.H[k]));
    phase.values.push_back(std::arg(hammer.measured.H[k]));
    fit.values.push_back(std::abs(H));
    fit_phase.values.push_back(std::arg(H));
  }
  folder.write("hammer_response",
               fmt::format("frequency response of the rig over {} hits, and (3-3) fitted",
                           hammer.measured.hits),
               table_of({{"frequency", "Hz", hammer.measured.frequency},
                         size,
                         phase,
                         {"coherence", "1", hammer.measured.coherence},
                         fit,
                         fit_phase}));
}

std::string response_row(const char* name, const RigResponse& r, const ResponseDeviation& d) {
  return fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g},{:.3g},{:.3g},{:.3g},{:.3g}\n",
                     name,
                     r.f / kTwoPi,
                     r.zeta,
                     r.gain(),
                     r.c,
                     d.f / kTwoPi,
                     d.zeta,
                     d.gain,
                     d.c);
}

void write_responses(Folder& folder, const RigResults& results) {
  std::string text =
      "# TF(s) = A/(s^2 + 2 f zeta s + f^2) + c; deviations over resampled hits, 0: none drawn\n"
      "what,f [Hz],zeta,A/f^2,c,f_deviation [Hz],zeta_deviation,A/f^2_deviation,c_deviation\n";
  if (results.hammer) {
    text += response_row("rig by hammer", results.hammer->fit.response, results.hammer->over_hits);
  }
  const CompensationResult& c = *results.compensation;
  text += response_row("filter dummy to real", c.filter_response, c.over_hits);
  folder.write_text("responses.csv", text);
  Channel b{"b", "1", c.filter.b}, a{"a", "1", c.filter.a};
  b.values.resize(std::max(b.values.size(), a.values.size()), 0.0);
  a.values.resize(b.values.size(), 0.0);
  folder.write("filter",
               fmt::format("coefficients of 1, 1/z, 1/z^2 ... at {:g} Hz: the filter that "
                           "removes the rig's response",
                           results.runs[0].record.rate),
               table_of({b, a}));
}

void write_cases(Folder& folder, const std::vector<CaseRow>& cases) {
  std::string text =
      "# against the real rim: RMS of the time series, RMS of the densities, log-spectral "
      "distance\n"
      "case,use,speed [m/s],time_dummy [N],time_filtered [N],psd_dummy [N^2 s],psd_filtered [N^2 "
      "s],level_dummy_dB,level_filtered_dB\n";
  for (const CaseRow& row : cases) {
    text += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g},{:.4g}\n",
                        formats::csv_field(row.name),
                        row.fitted ? "fitted" : "held out",
                        row.speed,
                        row.dummy.time,
                        row.filtered.time,
                        row.dummy.psd,
                        row.filtered.psd,
                        row.dummy.level,
                        row.filtered.level);
  }
  folder.write_text("cases.csv", text);
}

void write_filtered(Folder& folder,
                    const RigFile& rig,
                    const ProcessedRun& run,
                    const numerics::RationalFilter& filter) {
  Channels table;
  Channel time{"time", "s", {}};
  for (int i = 0; i < run.record.samples; ++i) time.values.push_back(run.record.time(i));
  table.add(std::move(time));
  for (const Channel& channel : run.record.channels.all()) {
    table.add(channel.name == rig.force
                  ? Channel{channel.name, channel.unit, filtered_force(filter, channel.values)}
                  : channel);
  }
  folder.write(run.name + "_filtered",
               run.record.source + " with the rig's response removed from " + rig.force,
               table);
}

}  // namespace

std::string plateau_name(const std::string& run, double speed) {
  constexpr double kKph = 3.6;
  return fmt::format("{}_{:.4g}kph", run, speed * kKph);
}

std::vector<fs::path> write_rig_tables(const RigFile& rig,
                                       const RigResults& results,
                                       const fs::path& path) {
  Folder folder(path);
  for (const ProcessedRun& run : results.runs) {
    for (const ProcessedPlateau& plateau : run.plateaus) {
      write_passages(folder, run, plateau);
      write_average(folder, run, plateau);
      write_spectra(folder, rig, run, plateau);
    }
  }
  if (results.hammer) write_hammer(folder, *results.hammer);
  if (results.compensation) {
    write_responses(folder, results);
    write_cases(folder, results.compensation->cases);
    for (const int run : rig.compensation->apply) {
      write_filtered(folder, rig, results.runs[run], results.compensation->filter);
    }
  }
  return folder.files;
}

}  // namespace latsch::correlation
