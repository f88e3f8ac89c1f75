// SPDX-License-Identifier: Apache-2.0
// Time of `latsch test` for 10^5 steady states, measured as a whole process, and the memory that
// tables of any length need. An argument sets the size of the table in MB; the memory must stay
// below a limit.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/random.h"
#include "formats/tables/csv_table.h"
#include "table.h"

namespace {

using namespace latsch;
namespace fs = std::filesystem;

constexpr double kMegabyte = 1e6;

struct Cost {
  double seconds = 0.0, peak = 0.0;  // wall time, s; peak memory, bytes
  bool done = false;
};

/// Returns wall time and peak memory of a command, from the start to the end of its process.
Cost cost_of(const std::function<int()>& run) {
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) ::_exit(run());
  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {wall.count(), 1024.0 * static_cast<double>(used.ru_maxrss), status == 0};
}

/// Writes states of a tire until the file has the given size, and returns their number.
long write_states(const fs::path& file, long rows, double bytes) {
  std::ofstream out(file, std::ios::binary);
  out << "Fz [N],alpha [deg],kappa,gamma [deg],p [bar]\n";
  long row = 0;
  for (; row < rows || static_cast<double>(out.tellp()) < bytes; ++row) {
    RandomStream random(5, static_cast<std::uint64_t>(row));
    const auto within = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    out << fmt::format("{:.1f},{:.3f},{:.4f},{:.2f},{:.2f}\n",
                       within(1500.0, 6000.0),
                       within(-8.0, 8.0),
                       within(-0.2, 0.2),
                       within(-4.0, 4.0),
                       within(2.0, 2.6));
  }
  return row;
}

Cost evaluate(const fs::path& states, const fs::path& output) {
  const fs::path latsch = fs::read_symlink("/proc/self/exe").parent_path() / "latsch";
  const std::string tire = LATSCH_SOURCE_DIR "/studies/tire_model_comparison/magic_formula.tir";
  const auto test = fmt::format("{{kind = \"steady_states\", states = \"{}\"}}", states.string());
  return cost_of([&] {
    ::execl(latsch.c_str(),
            "latsch",
            "test",
            tire.c_str(),
            test.c_str(),
            "-o",
            output.c_str(),
            "--quiet",
            nullptr);
    return 127;
  });
}

/// Reads every number of a table, block by block.
Cost read_all(const fs::path& file) {
  return cost_of([&] {
    const auto table = formats::CsvTable::read(file);
    double sum = 0.0;
    table.for_blocks({{"Fz", "N"}, {"alpha", "rad"}, {"kappa", "1"}, {"gamma", "rad"}, {"p", "Pa"}},
                     8192,
                     [&](const auto& block) {
                       for (const auto& column : block)
                         for (const double value : column) sum += value;
                     });
    return sum > 0.0 ? 0 : 1;
  });
}

int run(const benchmarks::Options& options) {
  const double megabytes = options.number("MB", options.size(64.0, 4.0));
  benchmarks::Table table("evaluate", options);
  const fs::path folder = fs::temp_directory_path() / fmt::format("latsch_evaluate_{}", ::getpid());
  fs::create_directories(folder);
  const fs::path states = folder / "states.csv", forces = folder / "forces.csv";
  write_states(states, options.size(100'000, 5'000), 0.0);
  Cost best = evaluate(states, forces);
  for (int i = 0; i < 2; ++i) {
    const Cost again = evaluate(states, forces);
    if (again.seconds < best.seconds) best = again;
  }
  table.full_row("latsch test, 10^5 steady states, 23 columns, the whole process",
                 fmt::format("{:.2f} s, peak {:.0f} MB", best.seconds, best.peak / kMegabyte),
                 "<= 1 s",
                 best.done && best.seconds <= 1.0);

  const long rows = write_states(states, 0, megabytes * kMegabyte);
  const Cost read = read_all(states);
  table.row(fmt::format("a table of {:.0f} MB, {:.1e} rows, every number", megabytes, 1.0 * rows),
            fmt::format("{:.2e} rows/s, peak {:.0f} MB",
                        static_cast<double>(rows) / read.seconds,
                        read.peak / kMegabyte),
            "peak <= 150 MB",
            read.done && read.peak <= 150.0 * kMegabyte);
  const Cost all = evaluate(states, "/dev/null");
  table.row("latsch test of that table",
            fmt::format("{:.2e} rows/s, peak {:.0f} MB",
                        static_cast<double>(rows) / all.seconds,
                        all.peak / kMegabyte),
            "peak <= 200 MB",
            all.done && all.peak <= 200.0 * kMegabyte);
  fs::remove_all(folder);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return benchmarks::run_benchmark(argc, argv, {{"MB", "", "size of the long table"}}, run);
}
