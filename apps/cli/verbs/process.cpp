// SPDX-License-Identifier: Apache-2.0
// Implements `latsch process`: processes recordings of a drum rig into passages, averages, spectra
// and the rig's filter.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "cli/console/console.h"
#include "cli/console/ledgers.h"
#include "cli/run/written_tydex.h"
#include "cli/verbs/verbs.h"
#include "correlation/rig_data/rig_doubts.h"
#include "correlation/rig_data/rig_processing.h"
#include "correlation/rig_data/rig_report.h"
#include "correlation/rig_data/rig_tables.h"
#include "correlation/rig_data/rig_tydex.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "measurement/axes.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using correlation::RigFile;
using correlation::RigResults;

void print_passages(const RigResults& results) {
  for (const Ledger& ledger : results.ledgers) {
    answer()["ledgers"].push_back(correlation::json_of(ledger));
    say("{}: {}\n", fs::path(ledger.file).filename().string(), in_one_line(ledger));
  }
  warn_of_doubts(results.ledgers);
  say("{:<18} {:>10} {:>12} {:>9} {:>9}\n", "run", "speed", "period ms", "passages", "left out");
  for (const auto& run : results.runs) {
    for (const auto& p : run.plateaus) {
      answer()["plateaus"].push_back({{"run", run.name},
                                      {"speed_m_per_s", p.plateau.target},
                                      {"period_s", p.period.samples / run.record.rate},
                                      {"passages", p.passages.starts.size()},
                                      {"left_out", p.passages.left_out}});
      say("{:<18} {:>10} {:>12.5f} {:>9} {:>9}\n",
          run.name,
          format_quantity(p.plateau.target, "km/h", 4),
          p.period.samples / run.record.rate * 1e3,
          p.passages.starts.size(),
          p.passages.left_out);
    }
  }
}

/// Returns the value with as many digits as its standard deviation, from a bootstrap, allows; with
/// `decimals` decimals if the deviation is 0.
std::string known(double value, double deviation, int decimals) {
  return deviation > 0.0 ? format_known(value, deviation) : fmt::format("{:.{}f}", value, decimals);
}

void print_response(const char* name,
                    const RigResponse& r,
                    const correlation::ResponseDeviation& d = {}) {
  const double Hz = 2.0 * std::numbers::pi;  // rad/s for one Hz
  answer()["responses"].push_back(
      {{"name", name}, {"f_Hz", r.f / Hz}, {"zeta", r.zeta}, {"gain", r.gain()}, {"c", r.c}});
  say("{:<28} f = {} Hz, zeta = {}, A/f^2 = {}, c = {}\n",
      name,
      known(r.f / Hz, d.f / Hz, 3),
      known(r.zeta, d.zeta, 5),
      known(r.gain(), d.gain, 4),
      known(r.c, d.c, 4));
}

void print_compensation(const RigFile& rig, const RigResults& results) {
  if (results.hammer) {
    const auto& hammer = *results.hammer;
    print_response("rig by the hammer", hammer.fit.response, hammer.over_hits);
  }
  if (rig.truth) print_response("rig, truth", rig.truth->rig.response);
  if (!results.compensation) return;
  print_response("filter dummy to real",
                 results.compensation->filter_response,
                 results.compensation->over_hits);
  if (const auto back = rig.truth ? inverse(rig.truth->rig.response) : std::nullopt) {
    print_response("filter, truth", *back);
  }
  if (results.compensation->cases.empty()) return;
  say("\n{:<10} {:>9} {:>26} {:>30}\n", "case", "", "RMS of time series N", "RMS of PSD N^2/Hz");
  for (const auto& row : results.compensation->cases) {
    answer()["cases"].push_back({{"name", row.name},
                                 {"fitted", row.fitted},
                                 {"time_rms_before_N", row.dummy.time},
                                 {"time_rms_after_N", row.filtered.time},
                                 {"psd_rms_before_N2_per_Hz", row.dummy.psd},
                                 {"psd_rms_after_N2_per_Hz", row.filtered.psd}});
    say("{:<10} {:>9} {:>10.2f} -> {:>8.2f} {:>+4.0f}% {:>12.3f} -> {:>10.3f} {:>+4.0f}%\n",
        row.name,
        row.fitted ? "fitted" : "",
        row.dummy.time,
        row.filtered.time,
        100.0 * (row.filtered.time / row.dummy.time - 1.0),
        row.dummy.psd,
        row.filtered.psd,
        100.0 * (row.filtered.psd / row.dummy.psd - 1.0));
  }
}

void write_synthetic(const RigFile& rig) {
  if (!rig.truth) {
    throw InputError({rig.file.string(), 0}, "has no [truth] to write recordings from");
  }
  for (const std::string& file : write_synthetic_files(rig)) say_written(file);
}

/// Writes the averages as TYDEX files and says once what holds for all of them.
void write_averages(const RigResults& results, const std::string& frame, const fs::path& folder) {
  say("\n");
  formats::WrittenTydex worst;
  for (auto& [name, record] : correlation::averages_in_tydex(results, frame)) {
    const std::string file = (folder / name).string();
    formats::WrittenTydex written =
        write_tydex(std::move(record), formats::TydexDigits::columns_of_ten, file);
    answer()["tables"].push_back(file);
    if (worst.names.empty() || written.rounding > worst.rounding) worst = std::move(written);
  }
  say_remarks(worst, "the .csv file of the same name");
}

void process(const std::string& file,
             bool synthetic,
             const std::string& output,
             const std::string& tydex_frame) {
  const RigFile rig = correlation::read_rig_file(file);
  if (synthetic) write_synthetic(rig);
  RigResults results;
  {
    RunningNote progress;
    results = correlation::process(rig, [&](long done, long total, const std::string& note) {
      progress.update(done, total, note);
    });
  }
  const fs::path folder = output.empty()
                              ? rig.file.parent_path() / (rig.file.stem().string() + "_processed")
                              : fs::path(output);
  const auto files = write_rig_tables(rig, results, folder);
  const fs::path page = folder / "report.html";
  write_text_file(page, rig_page(rig, results));
  for (const fs::path& table : files) answer()["tables"].push_back(table.string());
  answer()["report"] = page.string();
  say("{}\n\n", rig.title);
  print_passages(results);
  for (const std::string& doubt : doubts_of(rig, results)) warn(doubt, {rig.file.string(), 0});
  say("\n");
  print_compensation(rig, results);
  if (!tydex_frame.empty()) write_averages(results, tydex_frame, folder);
  say("\n{} tables in {}\nReport: {}\n", files.size(), folder.string(), page.string());
}

}  // namespace

void add_process(CommandLine& app, Program&) {
  Verb verb = app.add_subcommand(
      "process",
      "Drum recordings to passages, averages, spectra, and a filter that removes the rig's "
      "response");
  verb.footer(
      "Recordings are tables (.csv, .txt, .dat), TYDEX (.tdx), MATLAB (.mat) and files of "
      "recorders:\n"
      "MDF 4 (.mf4), universal files (.uff), TDMS (.tdms), RPC III (.rsp, .drv, .tim), MoTeC "
      "(.ld).\n"
      "In [channels] of the rig file, group = \"NAME\" chooses a group of a recorder's file, and\n"
      "resample = \"0.5 ms\" joins its groups; latsch show FILE lists them.\n\n"
      "Examples:\n"
      "  # Writes the recordings of a rig whose dynamics are known, and processes them.\n"
      "  latsch process studies/drum_processing/rig.toml --synthetic\n"
      "  latsch process studies/drum_processing/rig.toml --output tables");
  auto file = std::make_shared<std::string>();
  auto output = std::make_shared<std::string>();
  auto tydex = std::make_shared<std::string>();
  auto synthetic = std::make_shared<bool>(false);
  verb.add_option("rig", *file, "Rig file (TOML)").required();
  verb.add_option(
      "--output", *output, "Folder for tables and page, beside the rig file unless given");
  verb.add_option("--tydex",
                  *tydex,
                  "Also write the averages as TYDEX files; states the axes W, H or C of the "
                  "recorded forces, which must have the signs of ISO 8855")
      .one_of(axis_frame_names());
  verb.add_flag("--synthetic", *synthetic, "First write the recordings from the file's [truth]");
  verb.callback([=] { process(*file, *synthetic, *output, *tydex); });
}

}  // namespace latsch::cli
