// SPDX-License-Identifier: Apache-2.0
#include "fit_study.h"

#include <chrono>
#include <stdexcept>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/search/study_method.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/twin.h"
#include "evaluation/executors/process_executor.h"

namespace latsch::benchmarks {

namespace fs = std::filesystem;

correlation::Study study_of_folder(const std::string& name) {
  return correlation::read_study(fs::path(LATSCH_SOURCE_DIR) / "studies" / name / "study.toml",
                                 experiment::language());
}

namespace {

/// Returns a folder that is removed at the end of the program, because worker processes read their
/// study in it until then.
const fs::path& scratch_folder() {
  static const ScratchFolder folder;
  return folder.path();
}

void coarsen(const fs::path& tires, const CoarseMesh& mesh) {
  for (const auto& tire : fs::directory_iterator(tires))
    write_text_file(tire.path(), with_coarse_mesh(read_text_file(tire.path()), mesh));
}

void pair_by_shapes(const fs::path& study) {
  std::string text = read_text_file(study);
  if (text.find("\nshapes = ") != text.npos) return;
  const std::string modes = "\nmeasurement = \"modes.csv\"\n";
  const std::size_t at = text.find(modes);
  if (at == text.npos) throw InputError(study.string() + " has no measured modes");
  write_text_file(study, text.insert(at + modes.size(), "shapes = \"mode_shapes.csv\"\n"));
}

}  // namespace

correlation::Study fresh_twin(const std::string& name, const std::optional<CoarseMesh>& mesh) {
  const fs::path studies = fs::path(LATSCH_SOURCE_DIR) / "studies";
  const fs::path copy = scratch_folder() / name;
  fs::create_directories(copy);
  fs::copy(studies / "tires", copy / "tires");
  if (mesh) coarsen(copy / "tires", *mesh);
  fs::copy(studies / name, copy / name);
  const fs::path file = copy / name / "study.toml";
  if (mesh) pair_by_shapes(file);
  const auto written = correlation::write_twin(
      correlation::read_study(file, experiment::language(), correlation::Measurements::not_yet));
  if (!written) throw std::runtime_error(written.failure().reason);
  return correlation::read_study(file, experiment::language());
}

DesignPoint true_point(const correlation::Study& study) {
  DesignPoint point = study.space.initial();
  for (int i = 0; i < study.space.size(); ++i)
    point.values[static_cast<std::size_t>(i)] = study.model.get(study.space[i].paths.front());
  return point;
}

fs::path program() { return fs::read_symlink("/proc/self/exe").parent_path() / "latsch"; }

Fit fit(const correlation::Study& study, int workers) {
  const ScratchFolder folder;
  Fit fit;
  {
    Journal journal = Journal::open(folder / "fit.latsch", correlation::identity(study));
    ProcessOptions options;
    options.arguments = {program().string(), "worker", study.file.string()};
    if (study.asks_slopes) options.arguments.emplace_back("--slopes");
    options.workers = workers;
    options.timeout = study.run.timeout;
    ProcessExecutor executor(options);
    const auto optimizer = correlation::make_optimizer(study);
    RunOptions run;
    run.max_steps = study.max_steps;
    const auto start = std::chrono::steady_clock::now();
    fit.run = run_optimizer(*optimizer, correlation::objective(study), executor, &journal, run);
    fit.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fit.trials = journal.size();
    journal.for_each([&](const Trial& trial) { fit.cpu_time += trial.outcome.cpu_time; });
  }
  return fit;
}

}  // namespace latsch::benchmarks
