// SPDX-License-Identifier: Apache-2.0
#include "correlation/basic_data/ring_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "correlation/study/variables.h"
#include "experiment/rigs/footprint_rig.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_modes.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "optimization/least_squares/residual_trust_region.h"

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
  const std::string kind = table.choice(
      "kind", {"load", "stiffness", "footprint_length", "footprint_width", "frequency", "damping"});
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
  } else if (kind == "footprint_length" || kind == "footprint_width") {
    target.kind = kind == "footprint_length" ? Kind::footprint_length : Kind::footprint_width;
    target.load = table.quantity("load", "N", Range::positive());
    unit = "m";
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
  if (target.kind == Kind::footprint_length || target.kind == Kind::footprint_width) {
    ring_tire::RingTire tire(ring);
    const auto found = experiment::footprints(tire, {.loads = {target.load}, .deflections = {}});
    if (!found) return found.failure();
    const Footprint& print = found->front().footprint;
    return target.kind == Kind::footprint_length ? print.length : print.width;
  }
  const auto mode =
      find_mode(ring_tire::unloaded_modes(ring, target.waves), target.waves, target.lateral);
  return target.kind == Kind::frequency ? mode.frequency : mode.damping;
}

/// Relative errors of all targets.
Result<Eigen::VectorXd> errors_at(const RingData& data, const DesignPoint& point) {
  const auto values = shown(data, point);
  if (!values) return values.failure();
  Eigen::VectorXd errors(static_cast<Eigen::Index>(values->size()));
  for (std::size_t i = 0; i < values->size(); ++i)
    errors[static_cast<Eigen::Index>(i)] = (*values)[i] / data.targets[i].value - 1.0;
  return errors;
}

Result<Score> score(const RingData& data, const DesignPoint& point) {
  const auto errors = errors_at(data, point);
  if (!errors) return errors.failure();
  Score score;
  for (std::size_t i = 0; i < data.targets.size(); ++i) {
    if (data.targets[i].weight == 0.0) continue;
    score.residuals.push_back(std::sqrt(data.targets[i].weight) *
                              (*errors)[static_cast<Eigen::Index>(i)]);
    score.value += score.residuals.back() * score.residuals.back();
  }
  return score;
}

/// Of the targets that count, weighted.
Linearization weighted(const RingData& data, const Linearization& all) {
  Linearization counted{all.u, {}, {}};
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < data.targets.size(); ++i)
    if (data.targets[i].weight > 0.0) rows.push_back(static_cast<Eigen::Index>(i));
  counted.r.resize(static_cast<Eigen::Index>(rows.size()));
  counted.J.resize(static_cast<Eigen::Index>(rows.size()), all.J.cols());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double factor = std::sqrt(data.targets[static_cast<std::size_t>(rows[k])].weight);
    counted.r[static_cast<Eigen::Index>(k)] = factor * all.r[rows[k]];
    counted.J.row(static_cast<Eigen::Index>(k)) = factor * all.J.row(rows[k]);
  }
  return counted;
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
  ResidualTrustRegion optimizer(data.space, {.step_tolerance = 1e-4, .restarts = 0});
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
    const auto found = errors_at(data, point);
    if (!found) return found.failure();
    differences_at.push_back(*found);
  }
  const Linearization all = differences(data.space, points, differences_at);
  const auto values = shown(data, best);
  if (!values) return values.failure();
  return RingFit{best,
                 at(data.tire, data.space, best),
                 *values,
                 evaluations + static_cast<int>(points.size()),
                 confidence(weighted(data, all), {.sigma = kTypicalError}),
                 all.r,
                 all.J};
}

std::vector<std::string> missed(const RingData& data, const RingFit& fit) {
  constexpr double kMissed = 0.03, kNothing = 1e-3, kCost = 0.01;
  const auto off = [](double error) {
    return fmt::format("{:.1f} % too {}", 100.0 * std::abs(error), error > 0.0 ? "high" : "low");
  };
  std::vector<std::string> sentences;
  for (Eigen::Index i = 0; i < fit.errors.size(); ++i) {
    const double error = fit.errors[i];
    if (std::abs(error) <= kMissed) continue;
    const RingTarget& target = data.targets[static_cast<std::size_t>(i)];
    std::string text = fmt::format("{} is {}", target.name, off(error));
    Eigen::Index variable = 0;
    const double effect = fit.effects.row(i).cwiseAbs().maxCoeff(&variable);
    if (effect < kNothing) {
      sentences.push_back(text + ": no variable moves it");
      continue;
    }
    const double change = -error / fit.effects(i, variable);  // of the variable's range
    text += fmt::format(": {} moves it most, by {:.0f} % for a tenth of its range",
                        data.space[static_cast<int>(variable)].name,
                        10.0 * effect);
    Eigen::Index payer = -1;
    double most = kCost, then = 0.0;
    for (Eigen::Index k = 0; k < fit.errors.size(); ++k) {
      if (k == i || data.targets[static_cast<std::size_t>(k)].weight == 0.0) continue;
      const double moved = fit.errors[k] + change * fit.effects(k, variable);
      if (std::abs(moved) - std::abs(fit.errors[k]) <= most) continue;
      most = std::abs(moved) - std::abs(fit.errors[k]);
      payer = k;
      then = moved;
    }
    text += payer >= 0 ? fmt::format("; mended by it alone, {} would be {}",
                                     data.targets[static_cast<std::size_t>(payer)].name,
                                     off(then))
                       : std::string("; no other target would pay for mending it");
    if (target.weight == 0.0) text += " (it has no weight)";
    sentences.push_back(text);
  }
  return sentences;
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
