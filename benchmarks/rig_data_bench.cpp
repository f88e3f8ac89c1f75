// SPDX-License-Identifier: Apache-2.0
// Processing of drum recordings: agreement with SciPy, alignment of passages within a sample,
// identification of the rig's dynamics, and computing time. SciPy runs as a separate program on the
// same samples (python3-scipy). The recordings are synthetic and come from a rig whose parameters
// are known (measurement/synthetic_rig.h): 92 Hz, 6 % damping, A/f^2 = 0.45, c = 0.55, a drifting
// speed, periods that are no whole number of samples, and noise of 15 N.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "base/file.h"
#include "base/random.h"
#include "command.h"
#include "correlation/rig_data/rig_processing.h"
#include "correlation/rig_data/rig_report.h"
#include "correlation/rig_data/rig_tables.h"
#include "cpu_time.h"
#include "formats/tables/recording.h"
#include "numerics/signals/butterworth.h"
#include "numerics/signals/time_delay.h"
#include "numerics/signals/welch.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using namespace correlation;
using namespace numerics;

constexpr double kRate = 2000.0;
constexpr int kSamples = 20000;
constexpr double kKph = 1.0 / 3.6;
constexpr const char* kScript = R"py(
import numpy as np
from scipy import signal
x, y = np.loadtxt("x"), np.loadtxt("y")
put = lambda name, v: np.savetxt(name, np.column_stack([v.real, v.imag]).ravel() if np.iscomplexobj(v) else v, fmt="%.17g")
b, a = signal.butter(4, 60.0, fs=2000.0)
put("butter", np.concatenate([b, a]))
put("filtfilt", signal.filtfilt(b, a, x))
sos = signal.butter(4, 20.0, fs=2000.0, output="sos")
put("sosfiltfilt", signal.sosfiltfilt(sos, x))
put("welch", signal.welch(x, 2000.0, nperseg=1024)[1])
put("csd", signal.csd(x, y, 2000.0, nperseg=1024)[1])
)py";

/// A temporary folder.
struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("latsch_rig_bench_{}", getpid());
  Scratch() { fs::create_directory(path); }
  ~Scratch() { fs::remove_all(path); }
};

void write(const fs::path& file, const std::vector<double>& values) {
  std::ofstream out(file);
  for (const double value : values) out << fmt::format("{:.17g}\n", value);
}

std::vector<double> read(const fs::path& file) {
  std::ifstream in(file);
  std::vector<double> values;
  for (double value; in >> value;) values.push_back(value);
  return values;
}

/// Returns the largest difference between SciPy's values in `file` and ours, divided by the largest
/// value.
double difference(const fs::path& file, const std::vector<double>& ours) {
  std::ifstream in(file);
  double largest = 0.0, difference = 0.0, theirs = 0.0;
  for (const double value : ours) {
    if (!(in >> theirs)) throw std::runtime_error(file.string() + " is too short");
    largest = std::max(largest, std::abs(theirs));
    difference = std::max(difference, std::abs(value - theirs));
  }
  return difference / largest;
}

void compare_with_scipy(Table& table) {
  const Scratch scratch;
  RandomStream random(5, 0);
  std::vector<double> x, y;
  for (int i = 0; i < kSamples; ++i) {
    x.push_back(100.0 + std::sin(0.1 * i) + random.normal());
    y.push_back((i > 3 ? x[i - 3] : 0.0) + random.normal());
  }
  write(scratch.path / "x", x);
  write(scratch.path / "y", y);
  std::ofstream(scratch.path / "oracle.py") << kScript;
  (void)benchmarks::run_command(
      fmt::format("cd '{}' && /usr/bin/python3 oracle.py", scratch.path.string()));
  const auto row = [&](const char* name, const char* what, const std::vector<double>& ours) {
    const double d = difference(scratch.path / name, ours);
    table.row(what, fmt::format("{:.1e}", d), "<= 1e-12 relative", d <= 1e-12);
  };
  const auto f = polynomials_of(butterworth(4, FilterBand::low_pass, {60.0}, kRate));
  auto coefficients = f.b;
  coefficients.insert(coefficients.end(), f.a.begin(), f.a.end());
  row("butter", "butter, order 4, 60 Hz at 2 kHz", coefficients);
  // The result of filtfilt depends on b, a and x, so SciPy and we use equal ones. The rounding of
  // the coefficients alone would change it by 1e-16 / (2 pi 0.03)^4 times their number.
  const auto theirs = read(scratch.path / "butter");
  const RationalFilter same{{theirs.begin(), theirs.begin() + 5},
                            {theirs.begin() + 5, theirs.end()}};
  row("filtfilt", "filtfilt, the same b and a", filter_forward_backward(same, x));
  table.note(
      "  with b and a designed here",
      fmt::format("{:.1e}", difference(scratch.path / "filtfilt", filter_forward_backward(f, x))));
  row("sosfiltfilt",
      "sosfiltfilt, order 4, 20 Hz at 2 kHz",
      filter_forward_backward(sections_of(butterworth(4, FilterBand::low_pass, {20.0}, kRate)), x));
  const auto settings = welch_settings(Convention::scipy, kSamples, 1024);
  row("welch", "welch, 1024 samples", power_density(x, kRate, settings).value);
  std::vector<double> parts;
  for (const auto& s : densities(x, y, kRate, settings).xy) {
    parts.push_back(s.real());
    parts.push_back(s.imag());
  }
  row("csd", "csd, 1024 samples", parts);
}

SyntheticRig known_rig() {
  return {kRate, 6.0, RigResponse::of(0.45, 2.0 * std::numbers::pi * 92.0, 0.06, 0.55), 8};
}

SyntheticRun known_run(std::vector<double> speeds, double hold) {
  SyntheticRun run;
  run.speeds = std::move(speeds);
  run.hold = hold;
  run.modes = {{46.0, 0.05, 400.0}, {92.0, 0.04, 250.0}, {141.0, 0.04, 120.0}};
  return run;
}

RigFile known_file(const std::vector<double>& speeds) {
  RigFile rig;
  rig.file = "rig.toml";
  rig.title = "Benchmark";
  rig.time = "time";
  rig.speed = "speed";
  rig.force = "Fz";
  rig.circumference = 6.0;
  rig.speeds = speeds;
  rig.segment = 0.2;
  rig.band = {10.0, 300.0};
  return rig;
}

/// Returns the scatter, in samples, of the detected starts of the passages relative to the true
/// times at which the cleat hits.
double jitter(const SyntheticRun& run, const ProcessedPlateau& p) {
  const auto hits = synthetic_hits(known_rig(), run);
  std::vector<double> offsets;
  double mean = 0.0, sum = 0.0;
  for (const double start : p.passages.starts) {
    const double place = p.plateau.first + start;
    const auto hit = std::lower_bound(hits.begin(), hits.end(), place / kRate);
    offsets.push_back(*hit * kRate - place);
    mean += offsets.back() / static_cast<double>(p.passages.starts.size());
  }
  for (const double offset : offsets) sum += (offset - mean) * (offset - mean);
  return std::sqrt(sum / static_cast<double>(offsets.size()));
}

void align(Table& table, double hold) {
  const std::vector<double> speeds{30 * kKph, 60 * kKph, 90 * kKph};
  for (const double noise : {0.0, 15.0}) {
    auto run = known_run(speeds, hold);
    run.noise = noise;
    double worst = 0.0, whole = 0.0;
    for (const bool whole_samples : {false, true}) {
      RigFile rig = known_file(speeds);
      rig.passages.whole_samples = whole_samples;
      const auto result =
          process_run(rig, "run", drum_record(synthetic_run(known_rig(), run), "time", "run"));
      for (const auto& plateau : result.plateaus) {
        double& scatter = whole_samples ? whole : worst;
        scatter = std::max(scatter, jitter(run, plateau));
      }
    }
    // Without noise, only interpolation and the drifting speed cause an error; noise adds about
    // 1/20 of a sample.
    const double reach = noise == 0.0 ? 0.01 : 0.1;
    table.row(fmt::format("alignment against the hits, noise {:g} N", noise),
              fmt::format("{:.4f} samples", worst),
              fmt::format("<= {:g} samples", reach),
              worst <= reach);
    table.note("  the same by whole samples", fmt::format("{:.3f} samples", whole));
  }
}

void find_rig(Table& table) {
  const std::vector<double> speeds{30 * kKph, 60 * kKph, 90 * kKph};
  RigFile rig = known_file(speeds);
  rig.hammer = RigHammer{"", "hammer", "Fz", {}, Estimator::h1};
  rig.compensation = RigCompensation{};
  rig.compensation->fit = {2};
  std::vector<ProcessedRun> runs;
  for (const bool dummy : {true, false}) {
    auto run = known_run(speeds, 20.0);
    run.dummy_rim = dummy;
    run.number = runs.size();
    const char* name = dummy ? "dummy" : "real";
    rig.runs.push_back({name, ""});
    runs.push_back(
        process_run(rig, name, drum_record(synthetic_run(known_rig(), run), "time", name)));
  }
  for (int k = 0; k < 3; ++k)
    rig.cases.push_back({std::string(1, static_cast<char>('A' + k)), 0, 1, k});
  const auto hammer =
      process_hammer(rig, drum_record(synthetic_hammer(known_rig(), 20, 2.0), "time", "hammer"));
  const auto found = compensate(rig, runs, hammer);
  const RigResponse truth = known_rig().response, back = *inverse(truth);
  const auto row = [&](const char* what, double value, double exact, double reach) {
    const double error = std::abs(value / exact - 1.0);
    table.row(what,
              fmt::format("{:.4g} for {:.4g}, {:.2f} %", value, exact, 100.0 * error),
              fmt::format("<= {:g} %", 100.0 * reach),
              error <= reach);
  };
  const double kTwoPi = 2.0 * std::numbers::pi;
  row("rig by the hammer: f, Hz", hammer.fit.response.f / kTwoPi, truth.f / kTwoPi, 1e-3);
  row("rig by the hammer: zeta", hammer.fit.response.zeta, truth.zeta, 0.02);
  row("rig by the hammer: A/f^2", hammer.fit.response.gain(), truth.gain(), 0.01);
  row("rig by the hammer: c", hammer.fit.response.c, truth.c, 0.01);
  row("filter from case C: f, Hz", found.filter_response.f / kTwoPi, back.f / kTwoPi, 5e-3);
  row("filter from case C: zeta", found.filter_response.zeta, back.zeta, 0.05);
  row("filter from case C: A/f^2", found.filter_response.gain(), back.gain(), 0.05);
  row("filter from case C: c", found.filter_response.c, back.c, 0.05);
  for (const CaseRow& one : found.cases) {
    table.note(fmt::format("case {}, dummy to filtered, RMS of time", one.name),
               fmt::format("{:.1f} to {:.1f} N", one.dummy.time, one.filtered.time));
    table.note("  RMS of PSD",
               fmt::format("{:.2f} to {:.2f} N^2/Hz", one.dummy.psd, one.filtered.psd));
  }
}

/// Processes ten channels at 2 kHz: three constant speeds of `hold` s each, every channel averaged.
/// Ten minutes of recording are `hold` = 196 s.
void process_ten_minutes(Table& table, double hold) {
  const std::vector<double> speeds{30 * kKph, 60 * kKph, 90 * kKph};
  RigFile rig = known_file(speeds);
  Channels channels = synthetic_run(known_rig(), known_run(speeds, hold));
  RandomStream random(1, 9);
  for (int k = 0; k < 6; ++k) {
    std::vector<double> values = channels["Fx"];
    for (double& value : values) value += random.normal();
    channels.add({fmt::format("channel_{}", k), "N", std::move(values)});
  }
  for (const Channel& channel : channels.all()) {
    if (channel.name != rig.time && channel.name != rig.speed && channel.name != rig.force) {
      rig.also.push_back(channel.name);
    }
  }
  const std::size_t samples = channels["time"].size();
  std::string text;
  for (const Channel& channel : channels.all()) {
    text += (text.empty() ? "" : ",") + channel.name + " [" + channel.unit + "]";
  }
  for (std::size_t i = 0; i < samples; ++i) {
    for (std::size_t c = 0; c < channels.all().size(); ++c) {
      fmt::format_to(
          std::back_inserter(text), "{}{:.4f}", c == 0 ? '\n' : ',', channels.all()[c].values[i]);
    }
  }
  const Scratch scratch;
  const fs::path file = scratch.path / "run.csv";
  write_text_file(file, text);
  double reading = 1e9, processing = 1e9;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const double start = cpu_seconds();
    DrumRecord record = drum_record(formats::read_recording(file), rig.time, file.string());
    const double read = cpu_seconds();
    RigResults results;
    results.runs.push_back(process_run(rig, "run", std::move(record)));
    write_rig_tables(rig, results, scratch.path / "out");
    write_text_file(scratch.path / "out" / "report.html", rig_page(rig, results));
    reading = std::min(reading, read - start);
    processing = std::min(processing, cpu_seconds() - read);
  }
  table.note("ten minutes, ten channels, 2 kHz",
             fmt::format("{} samples, {:.0f} MB", samples, static_cast<double>(text.size()) / 1e6));
  table.note("  reading the file", fmt::format("{:.2f} s", reading));
  table.note("  processing, tables, page", fmt::format("{:.2f} s", processing));
  table.full_row("ten minutes, ten channels, 2 kHz, file to page (CPU, best of 3)",
                 fmt::format("{:.2f} s", reading + processing),
                 "<= 5 s",
                 reading + processing <= 5.0);
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  using namespace latsch::benchmarks;
  return run_benchmark(argc, argv, {}, [](const Options& options) {
    Table table("rig_data", options);
    compare_with_scipy(table);
    align(table, 20.0);
    if (!options.is_smoke()) find_rig(table);  // this needs the long record
    process_ten_minutes(table, options.size(196.0, 8.0));
    return table.exit_code();
  });
}
