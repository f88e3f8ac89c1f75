// SPDX-License-Identifier: Apache-2.0
#include "correlation/ring_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "correlation/variables.h"
#include "models/ring_tire/ring_modes.h"
#include "models/ring_tire/ring_reader.h"
#include "models/ring_tire/ring_tire.h"
#include "optimization/residual_trust_region.h"

namespace latsch::correlation {
namespace {

using experiment::Direction;
using Kind = RingTarget::Kind;

void read_mode(const Node& table, RingTarget& target) {
  const std::string mode = table.choice("mode", {"f1", "f2", "f3", "f4", "f5", "f6"});
  const int number = mode[1] - '0';
  constexpr int kWaves[] = {0, 1, 0, 1, 2, 2};
  target.waves = kWaves[number - 1];
  target.lateral = number == 3 || number == 4 || number == 6;
}

Direction read_direction(const Node& table) {
  const std::string name =
      table.choice("direction", {"vertical", "longitudinal", "lateral", "torsional"});
  return name == "vertical"       ? Direction::vertical
         : name == "longitudinal" ? Direction::longitudinal
         : name == "lateral"      ? Direction::lateral
                                  : Direction::torsional;
}

RingTarget read_target(const Node& table) {
  RingTarget target;
  target.name = table.name();
  target.weight = table.quantity("weight", "1", Range::not_negative(), 1.0);
  const std::string kind = table.choice("kind", {"load", "stiffness", "frequency", "damping"});
  const char* unit = "1";
  if (kind == "load") {
    target.kind = Kind::load;
    target.deflection = table.quantity("deflection", "m", Range::positive());
    unit = "N";
  } else if (kind == "stiffness") {
    target.kind = Kind::stiffness;
    target.direction = read_direction(table);
    target.load = table.quantity("load", "N", Range::positive());
    unit = target.direction == Direction::torsional ? "N m/rad" : "N/m";
  } else {
    target.kind = kind == "frequency" ? Kind::frequency : Kind::damping;
    read_mode(table, target);
    if (kind == "frequency") unit = "Hz";
  }
  target.value = table.quantity("value", unit, Range::positive());
  return target;
}

Result<double> shown(const ring_tire::RingParameters& ring, const RingTarget& target) {
  if (target.kind == Kind::load || target.kind == Kind::stiffness) {
    ring_tire::RingTire tire(ring);
    if (target.kind == Kind::load) return experiment::load_at(tire, target.deflection);
    experiment::StiffnessTest test{.direction = target.direction, .load = target.load};
    if (target.direction == Direction::torsional) test.travel = 5e-3;
    return experiment::stiffness(tire, test);
  }
  const auto mode =
      find_mode(ring_tire::unloaded_modes(ring, target.waves), target.waves, target.lateral);
  return target.kind == Kind::frequency ? mode.frequency : mode.damping;
}

Result<Score> score(const RingData& data, const DesignPoint& point) {
  const auto values = shown(data, point);
  if (!values) return values.failure();
  Score score;
  for (std::size_t i = 0; i < values->size(); ++i) {
    const RingTarget& target = data.targets[i];
    if (target.weight == 0.0) continue;
    score.residuals.push_back(std::sqrt(target.weight) * ((*values)[i] / target.value - 1.0));
    score.value += score.residuals.back() * score.residuals.back();
  }
  return score;
}

Result<Eigen::VectorXd> residuals(const RingData& data, const DesignPoint& point) {
  const auto found = score(data, point);
  if (!found) return found.failure();
  return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
      found->residuals.data(), static_cast<Eigen::Index>(found->residuals.size())));
}

}  // namespace

RingData read_ring_data(const std::filesystem::path& file) {
  const Document document = Document::read(file);
  const Node root = document.root();
  Document tire = Document::read(file.parent_path() / root.text("tire"));
  ring_tire::read_ring_tire(tire.root());
  std::vector<DesignVariable> variables;
  for (const Node& table : root.named_tables("variable"))
    variables.push_back(read_variable(table, tire));
  if (variables.empty()) root.reject("variable", "is missing, expected [variable.NAME]");
  std::vector<RingTarget> targets;
  for (const Node& table : root.named_tables("target")) targets.push_back(read_target(table));
  const auto counts = std::any_of(
      targets.begin(), targets.end(), [](const RingTarget& t) { return t.weight > 0.0; });
  if (!counts) root.reject("target", "is missing, expected [target.NAME] of positive weight");
  root.close();
  return {file, std::move(tire), DesignSpace(std::move(variables)), std::move(targets)};
}

Result<std::vector<double>> shown(const RingData& data, const DesignPoint& point) {
  ring_tire::RingParameters ring;
  try {
    ring = ring_tire::read_ring_tire(at(data.tire, data.space, point).root());
  } catch (const InputError& error) {
    return Failure{std::string("the tire does not accept this point: ") + error.what()};
  }
  std::vector<double> values;
  for (const RingTarget& target : data.targets) {
    const auto value = shown(ring, target);
    if (!value) return Failure{target.name + ": " + value.failure().reason};
    values.push_back(*value);
  }
  return values;
}

Result<RingFit> fit_ring(const RingData& data, int most_evaluations) {
  ResidualTrustRegion optimizer(data.space, {.step_tolerance = 1e-4});
  DesignPoint best = data.space.initial();
  double least = std::numeric_limits<double>::infinity();
  int evaluations = 0;
  std::string trouble;
  while (!optimizer.converged() && evaluations < most_evaluations) {
    const DesignPoint point = optimizer.propose(1).front();
    const auto outcome = score(data, point);
    ++evaluations;
    if (outcome && outcome->value < least) {
      least = outcome->value;
      best = point;
    }
    if (!outcome) trouble = outcome.failure().reason;
    optimizer.observe(point, outcome);
  }
  if (!std::isfinite(least)) return Failure{"no tire could be computed: " + trouble};
  const auto points = difference_points(data.space, best);
  std::vector<Eigen::VectorXd> differences_at;
  for (const DesignPoint& point : points) {
    const auto found = residuals(data, point);
    if (!found) return found.failure();
    differences_at.push_back(*found);
  }
  const auto values = shown(data, best);
  if (!values) return values.failure();
  return RingFit{
      best,
      at(data.tire, data.space, best),
      *values,
      evaluations + static_cast<int>(points.size()),
      confidence(differences(data.space, points, differences_at), {.sigma = kTypicalError})};
}

std::vector<std::string> left_open(const RingData& data, const Confidence& confidence) {
  constexpr double kOpen = 0.1;   // of the range
  constexpr double kShare = 0.3;  // of a direction, to be named
  std::vector<std::string> sentences;
  const auto say = [&](const Eigen::VectorXd& direction, const std::string& how) {
    std::string names;
    for (int i = 0; i < data.space.size(); ++i)
      if (std::abs(direction[i]) >= kShare)
        names += fmt::format(
            "{}{} {}", names.empty() ? "" : ", ", direction[i] > 0 ? "+" : "-", data.space[i].name);
    sentences.push_back(fmt::format("{}: {}", names, how));
  };
  for (Eigen::Index k = 0; k < confidence.directions.cols(); ++k) {
    const double sigma =
        k < confidence.singular_values.size() ? confidence.singular_values[k] : 0.0;
    const double deviation = sigma > 0.0 ? kTypicalError / sigma : 1e300;
    if (deviation < kOpen) continue;
    say(confidence.directions.col(k),
        deviation > 1.0 ? std::string("the data say nothing")
                        : fmt::format("known to {:.0f} % of the range", 100.0 * deviation));
  }
  return sentences;
}

}  // namespace latsch::correlation
