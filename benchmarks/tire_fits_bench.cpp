// SPDX-License-Identifier: Apache-2.0
// Tire twins from 20 random starts: evaluations of the residual trust region beside those of GSS
//
//   ./bench.sh tire_fits [residuals | gss]     both unless one of them is named
//
// The meshes are coarse (15 columns, 30 sectors): what is compared is the number of evaluations,
// which a coarse tire tells as well as a fine one. GSS needs ten times as many and starts from
// three of the twenty points: its median is one of three and is called so.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/random.h"
#include "correlation/target/study_trials.h"
#include "fit_study.h"
#include "optimization/strategy/optimizer_choice.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

constexpr int kStarts = 20;
constexpr int kGssStarts = 3;  // the first of them
constexpr int kMostEvaluations = 300;
constexpr int kReach = 60;        // evaluations without a Jacobian
constexpr double kTarget = 5e-3;  // of the target function
constexpr double kModulusError = 0.01;

struct Tries {
  int starts = 0;
  std::vector<int> evaluations = {};  // of the starts that were solved, until they were
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

/// Evaluations until the moduli are found; none where the method ends or tires before.
std::optional<int> solve(const correlation::Study& study,
                         const Evaluator& trial,
                         Optimizer& optimizer) {
  const Objective objective = correlation::objective(study);
  for (int k = 1; k <= kMostEvaluations && !optimizer.converged(); ++k) {
    const DesignPoint point = optimizer.propose(1).front();
    const Result<Channels> channels = trial(point);
    const Result<Score> score = channels ? objective(*channels) : Result<Score>(channels.failure());
    if (score && found(study, point, *score)) return k;
    optimizer.observe(point, score);
  }
  return std::nullopt;
}

using Start = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

Tries try_all(const correlation::Study& study,
              const std::string& what,
              int starts,
              const Start& start_at) {
  const Evaluator trial = correlation::evaluator(study);
  Tries tries{starts};
  for (int start = 0; start < starts; ++start) {
    const auto optimizer = start_at(started_at_random(study, start));
    const auto evaluations = solve(study, trial, *optimizer);
    if (evaluations) tries.evaluations.push_back(*evaluations);
    fmt::print(stderr,
               "  {}, start {}: {}\n",
               what,
               start + 1,
               evaluations ? fmt::format("{} evaluations", *evaluations) : "not solved");
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

/// Tries of a method on a twin of the tire called `title`.
Tries tries_of(Method method,
               const std::string& title,
               const correlation::Study& study,
               int starts) {
  return try_all(study, title, starts, [&](const DesignSpace& space) {
    return make_optimizer(method, space, study.optimizer);
  });
}

using Twins = std::vector<std::pair<std::string, correlation::Study>>;

std::string what(const std::string& tire, const correlation::Study& study) {
  return fmt::format("{}, {} variables", tire, study.space.size());
}

void by_residuals(Table& table, const Twins& tires) {
  for (const auto& [tire, study] : tires) {
    const Tries residual =
        tries_of(Method::residual_trust_region, tire + ", residual trust region", study, kStarts);
    table.row(what(tire, study) + ": residual trust region",
              text(residual),
              fmt::format("{} of {}, <= {}", kStarts, kStarts, kReach),
              residual.solved() == kStarts && residual.most() <= kReach);
  }
}

/// Nothing to reach: for comparison.
void by_directions(Table& table, const Twins& tires) {
  for (const auto& [tire, study] : tires) {
    table.note(fmt::format("{}: GSS, {} starts", what(tire, study), kGssStarts),
               text(tries_of(Method::gss, tire + ", GSS", study, kGssStarts)));
  }
}

int run(const std::string& half) {
  if (!half.empty() && half != "residuals" && half != "gss") {
    throw InputError(
        fmt::format("tire_fits: a half is called \"{}\", expected residuals or gss", half));
  }
  Table table("tire_fits");
  const Twins tires{{"tire B", fresh_twin("tire_b_twin", TwinMesh::coarse)},
                    {"tire A", fresh_twin("tire_a_twin", TwinMesh::coarse)}};
  if (half != "gss") by_residuals(table, tires);
  if (half != "residuals") by_directions(table, tires);
  if (half == "gss") return 0;  // figures to compare with, nothing to reach
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  const std::string half = argc > 1 ? argv[1] : "";
  return latsch::benchmarks::guarded([&] { return latsch::benchmarks::run(half); });
}
