// SPDX-License-Identifier: Apache-2.0
// Fits of synthetic tire measurements from 20 random starts: number of evaluations of the residual
// trust region method and of GSS.
//
//   ./bench.sh tire_fits [residuals | gss]     both unless one of them is named
//
// The meshes are coarse (20 columns, 30 sectors), because only the number of evaluations is
// compared, for which a coarse tire is as good as a fine one. GSS needs ten times as many
// evaluations and starts from three of the twenty points; its median is one of three and is labeled
// so.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/random.h"
#include "base/units.h"
#include "correlation/target/study_trials.h"
#include "fit_study.h"
#include "optimization/strategy/optimizer_choice.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

// On a mesh of 15 columns the objective of tire A has a second minimum with a value of 0.08 %
// (docs/notebook/tire_fits.md), so the mesh has 20.
constexpr CoarseMesh kMesh{.meridional = 20, .sectors = 30};
constexpr int kStarts = 20;
constexpr int kGssStarts = 3;          // GSS uses only the first of the random starts
constexpr int kMostEvaluations = 300;  // limit for each start
constexpr int kReach = 60;             // limit of the median, in evaluations without a Jacobian
constexpr double kTarget = 5e-3;  // value of the objective below which a start counts as solved
constexpr double kModulusError = 0.01;

/// Number of random starts, and the largest number of evaluations for each.
struct Effort {
  int starts, evaluations;
};

struct Tries {
  int starts = 0;
  // number of evaluations until the start was solved, for each start that was
  std::vector<int> evaluations = {};
  int solved() const { return static_cast<int>(evaluations.size()); }
  int most() const { return *std::max_element(evaluations.begin(), evaluations.end()); }
  int median() {
    std::nth_element(evaluations.begin(), evaluations.begin() + solved() / 2, evaluations.end());
    return evaluations[solved() / 2];
  }
};

DesignSpace started_at_random(const correlation::Study& study, int start) {
  RandomStream random(1, start);
  std::vector<double> u(study.space.size());
  for (double& coordinate : u) coordinate = random.uniform();
  std::vector<DesignVariable> variables = study.space.variables();
  const DesignPoint point = study.space.from_unit(u);
  for (int i = 0; i < study.space.size(); ++i) variables[i].initial = point.values[i];
  return DesignSpace(std::move(variables));
}

bool found(const correlation::Study& study, const DesignPoint& point, const Score& score) {
  if (score.value >= kTarget) return false;
  for (int i = 0; i < study.space.size(); ++i) {
    const double truth = study.model.get(study.space[i].paths.front());
    if (std::abs(point.values[i] / truth - 1.0) >= kModulusError) return false;
  }
  return true;
}

/// Result of the fit from one start.
struct Solved {
  std::optional<int> evaluations;  // evaluations until the moduli were found; none: not found
  int failed = 0;                  // number of failed evaluations
  std::string reason;              // reason of the first failed evaluation
  double least = 1e300;            // least value of the objective
  DesignPoint best;                // point with the value `least`
  std::string ending;              // reason for which the method ended, in words
};

Solved solve(const correlation::Study& study,
             const Evaluator& trial,
             Optimizer& optimizer,
             int most) {
  const Objective objective = correlation::objective(study);
  Solved solved;
  for (int k = 1; k <= most && !optimizer.converged(); ++k) {
    const DesignPoint point = optimizer.propose(1).front();
    const Result<Channels> channels = trial(point);
    const Result<Score> score = channels ? objective(*channels) : Result<Score>(channels.failure());
    if (score && found(study, point, *score)) {
      solved.evaluations = k;
      return solved;
    }
    if (score && score->value < solved.least) {
      solved.least = score->value;
      solved.best = point;
    }
    if (!score && ++solved.failed == 1) solved.reason = score.failure().reason;
    optimizer.observe(point, score);
  }
  solved.ending = optimizer.ending();
  return solved;
}

std::string text(const correlation::Study& study, const Solved& solved) {
  if (solved.evaluations) return fmt::format("{} evaluations", *solved.evaluations);
  std::string text = fmt::format("not solved, least target {:.3g} %", 100.0 * solved.least);
  for (int i = 0; i < study.space.size() && !solved.best.values.empty(); ++i) {
    const DesignVariable& variable = study.space[i];
    text += fmt::format(
        ", {} {}",
        variable.name,
        format_quantity(solved.best.values[static_cast<std::size_t>(i)], variable.unit, 4));
  }
  text += "; it ended " + solved.ending;
  if (solved.failed > 0)
    text += fmt::format(", {} trials failed, the first: {}", solved.failed, solved.reason);
  return text;
}

using Start = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

Tries try_all(const correlation::Study& study,
              const std::string& what,
              const Effort& effort,
              const Start& start_at) {
  const Evaluator trial = correlation::evaluator(study);
  Tries tries{effort.starts};
  for (int start = 0; start < effort.starts; ++start) {
    const auto optimizer = start_at(started_at_random(study, start));
    const Solved solved = solve(study, trial, *optimizer, effort.evaluations);
    if (solved.evaluations) tries.evaluations.push_back(*solved.evaluations);
    fmt::print(stderr, "  {}, start {}: {}\n", what, start + 1, text(study, solved));
  }
  return tries;
}

std::string text(Tries tries) {
  if (tries.solved() == 0) return fmt::format("0 of {} starts", tries.starts);
  return fmt::format("{} of {} starts, median {}, most {} evaluations",
                     tries.solved(),
                     tries.starts,
                     tries.median(),
                     tries.most());
}

/// Returns the results of a method from all starts on synthetic measurements of the tire called
/// `title`.
Tries tries_of(Method method,
               const std::string& title,
               const correlation::Study& study,
               const Effort& effort) {
  return try_all(study, title, effort, [&](const DesignSpace& space) {
    return make_optimizer(method, space, study.optimizer);
  });
}

using Twins = std::vector<std::pair<std::string, correlation::Study>>;

std::string what(const std::string& tire, const correlation::Study& study) {
  return fmt::format("{}, {} variables", tire, study.space.size());
}

void by_residuals(Table& table, const Twins& tires, const Effort& effort) {
  for (const auto& [tire, study] : tires) {
    const Tries residual =
        tries_of(Method::residual_trust_region, tire + ", residual trust region", study, effort);
    table.full_row(what(tire, study) + ": residual trust region",
                   text(residual),
                   fmt::format("{} of {}, <= {}", effort.starts, effort.starts, kReach),
                   residual.solved() == effort.starts && residual.most() <= kReach);
  }
}

/// Adds rows for GSS, which are shown for comparison and not judged.
void by_directions(Table& table, const Twins& tires, const Effort& effort) {
  for (const auto& [tire, study] : tires) {
    table.note(fmt::format("{}: GSS, {} starts", what(tire, study), effort.starts),
               text(tries_of(Method::gss, tire + ", GSS", study, effort)));
  }
}

int run(const Options& options) {
  const std::string half = options.text("HALF");
  if (!half.empty() && half != "residuals" && half != "gss") {
    throw InputError(
        fmt::format("tire_fits: a half is called \"{}\", expected residuals or gss", half));
  }
  Table table("tire_fits", options);
  Twins tires{{"tire B", fresh_twin("tire_b_twin", kMesh)},
              {"tire A", fresh_twin("tire_a_twin", kMesh)}};
  for (const auto& [tire, study] : tires) {
    const auto truth = correlation::simulate_all(study, true_point(study));
    const double target = truth ? correlation::objective(study)(*truth)->value : 1.0;
    table.row(tire + ": target at the moduli of its file",
              fmt::format("{:.1e}", target),
              "< 1e-8",
              target < 1e-8);
  }
  if (options.is_smoke()) tires.pop_back();
  // The methods are compared without the derivatives that the search of these studies normally
  // uses.
  for (auto& [tire, study] : tires) study.asks_slopes = false;
  if (half != "gss")
    by_residuals(table, tires, options.size(Effort{kStarts, kMostEvaluations}, Effort{1, 8}));
  if (half != "residuals")
    by_directions(table, tires, options.size(Effort{kGssStarts, kMostEvaluations}, Effort{1, 4}));
  if (half == "gss") return 0;  // the rows of GSS are not judged
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc, argv, {{"HALF", "", "residuals or gss: that method alone"}}, latsch::benchmarks::run);
}
