// SPDX-License-Identifier: Apache-2.0
// The studio's page in a browser: time to the first point, 50,000 trials, stopping a run, sizes of
// the scripts, accessibility (axe).
//
//   ./bench.sh studio          needs the page (Node) and Debian's chromium
//
// The journals are written by `latsch doe` on a Magic Formula with two variables, at 224 and 71
// levels each; the study that is watched while it runs has an outside program that sleeps.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "command.h"
#include "killed_study.h"
#include "table.h"
#include "web/web_assets.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr double kPause = 0.4;  // s, duration of a trial of the watched study
constexpr double kKilobyte = 1024.0;

fs::path program() { return fs::read_symlink("/proc/self/exe").parent_path() / "latsch"; }

/// Writes a study of side force over slip angle of a Magic Formula with two unknown coefficients.
fs::path write_force_study(const fs::path& folder) {
  fs::create_directories(folder);
  fs::copy_file(fs::path(LATSCH_SOURCE_DIR) / "studies/race_tire_mf/tire.tir", folder / "tire.tir");
  std::string states = "Fz [N],alpha [deg]\n", measured = "Fy [N]\n";
  for (int i = -12; i <= 12; ++i) {
    states += fmt::format("{},{}\n", 3000 + 500 * ((i + 12) % 3), i);
    measured += fmt::format("{}\n", -290 * i);
  }
  write_text_file(folder / "states.csv", states);
  write_text_file(folder / "measured.csv", measured);
  write_text_file(folder / "study.toml", R"(title = "Side force over slip angle"
[model]
kind = "magic_formula"
file = "tire.tir"
[test.steady]
kind = "steady_states"
states = "states.csv"
[variable.grip]
path = "PDY1"
lower = 0.5
upper = 2
initial = 0.7
[variable.stiffness]
path = "PKY1"
lower = -60
upper = -5
initial = -10
[experiment.side_force]
kind = "curve"
y = "steady/Fy"
measurement = "measured.csv"
[run]
workers = 2
)");
  return folder / "study.toml";
}

void evaluate_grid(const fs::path& study, int levels) {
  (void)run_command(
      fmt::format("'{}' doe '{}' --levels {}", program().string(), study.string(), levels));
}

/// Returns by name the figures that the script in the browser prints.
std::map<std::string, double> figures(const fs::path& folder, const Options& options) {
  const fs::path page = program().parent_path().parent_path() / "apps/web/page";
  std::istringstream in(run_command(fmt::format("cd '{}' && node tests/bench.mjs '{}' '{}' {}",
                                                page.string(),
                                                program().string(),
                                                folder.string(),
                                                options.size("", "--smoke")))
                            .output);
  std::map<std::string, double> found;
  std::string name;
  for (double value = 0.0; in >> name >> value;) found[name] = value;
  return found;
}

bool is_script(const studio::Asset& asset) {
  return asset.path.ends_with(".js") && !asset.path.starts_with("/report/");
}

/// Returns the total size, bytes, of all scripts, and of those that index.html loads first.
std::pair<double, double> script_sizes() {
  double all = 0.0, first = 0.0;
  for (const studio::Asset& asset : studio::web_assets()) {
    if (!is_script(asset)) continue;
    all += static_cast<double>(asset.body.size());
    if (asset.path.find("/index-") != std::string::npos)
      first += static_cast<double>(asset.body.size());
  }
  return {first, all};
}

int run(const Options& options) {
  Table table("studio", options);
  if (studio::web_assets().empty()) {
    table.skip("the page", "is not in this build: install Node and build again");
    return table.exit_code();
  }
  const auto [first, all] = script_sizes();
  table.row("first script, gzipped",
            fmt::format("{:.1f} KB", first / kKilobyte),
            "<= 60 KB",
            first > 0.0 && first <= 60.0 * kKilobyte);
  table.row("all scripts, 3-D too, gzipped",
            fmt::format("{:.1f} KB", all / kKilobyte),
            "<= 200 KB",
            all <= 200.0 * kKilobyte);

  const ScratchFolder folder;
  evaluate_grid(write_force_study(folder / "many"), options.size(224, 12));
  evaluate_grid(write_force_study(folder / "some"), options.size(71, 8));
  fs::create_directories(folder / "live");
  write_small_study(folder / "live", kPause);
  auto at = figures(folder.path(), options);

  const auto milliseconds = [&](const char* what, const char* name, double most) {
    table.full_row(what,
                   fmt::format("{:.0f} ms", at.at(name)),
                   fmt::format("< {:g} ms", most),
                   at.at(name) < most);
  };
  const auto none = [&](const char* what, const char* name) {
    table.row(what, fmt::format("{:g}", at.at(name)), "0", at.at(name) == 0.0);
  };
  if (!options.is_smoke())
    table.row("latsch new, run from the page, first point of an FE tire",
              fmt::format("{:.1f} s", at.at("fresh_s")),
              "<= 60 s",
              at.at("fresh_s") <= 60.0);
  milliseconds("point on the page after its trial is committed, worst of 5", "live_ms", 1000.0);
  milliseconds("50,176 trials: from the address to the drawn convergence", "many_load_ms", 2000.0);
  milliseconds("50,176 trials: convergence drawn again, worst of 7", "many_redraw_ms", 100.0);
  table.note("50,176 trials: read by the server",
             fmt::format("{:.2f} s after its start", at.at("many_read_s")));
  milliseconds("stop, until nobody runs it", "stop_ms", 1000.0);
  none("axe violations, all views, light and dark", "axe");
  none("errors in the browser's console", "console");
  table.row("report of 5,041 trials",
            fmt::format("{:.2f} MB", at.at("report_bytes") / 1e6),
            "< 3 MB",
            at.at("report_bytes") < 3e6);
  milliseconds("that report opens", "report_open_ms", 1000.0);
  none("axe violations and console errors of that report", "report_faults");
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
