// SPDX-License-Identifier: Apache-2.0
#include "correlation/basic_data/slip_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "optimization/least_squares/residual_trust_region.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

using magic_formula::MagicFormula;
using magic_formula::Parameters;
using magic_formula::State;

struct Bounds {
  double lower, upper;
};

/// What tires of cars and race cars have, with room to spare.
const std::map<std::string, Bounds, std::less<>>& usual_ranges() {
  static const std::map<std::string, Bounds, std::less<>> ranges = {
      {"PCY1", {1.0, 2.2}},    {"PDY1", {0.5, 4.0}},    {"PDY2", {-1.0, 0.5}},
      {"PDY3", {-40, 40}},     {"PEY1", {-5, 1}},       {"PEY2", {-5, 5}},
      {"PEY3", {-2, 2}},       {"PEY4", {-60, 60}},     {"PEY5", {-600, 600}},
      {"PKY1", {-150, -8}},    {"PKY2", {0.3, 8}},      {"PKY3", {-6, 6}},
      {"PKY4", {1, 3}},        {"PKY5", {-60, 60}},     {"PKY6", {-6, 3}},
      {"PKY7", {-4, 4}},       {"PHY1", {-0.03, 0.03}}, {"PHY2", {-0.03, 0.03}},
      {"PVY1", {-0.3, 0.3}},   {"PVY2", {-0.3, 0.3}},   {"PVY3", {-4, 4}},
      {"PVY4", {-4, 4}},       {"PPY1", {-4, 4}},       {"PPY2", {-4, 4}},
      {"PPY3", {-2, 2}},       {"PPY4", {-8, 8}},       {"PPY5", {-8, 8}},
      {"QBZ1", {1, 40}},       {"QBZ2", {-20, 20}},     {"QBZ3", {-20, 20}},
      {"QBZ4", {-15, 15}},     {"QBZ5", {-15, 15}},     {"QBZ9", {0, 80}},
      {"QBZ10", {-8, 8}},      {"QCZ1", {0.6, 2.5}},    {"QDZ1", {0.01, 0.5}},
      {"QDZ2", {-0.4, 0.4}},   {"QDZ3", {-15, 15}},     {"QDZ4", {-200, 200}},
      {"QDZ6", {-0.08, 0.08}}, {"QDZ7", {-0.08, 0.08}}, {"QDZ8", {-4, 4}},
      {"QDZ9", {-4, 4}},       {"QDZ10", {-40, 40}},    {"QDZ11", {-40, 40}},
      {"QEZ1", {-10, 1}},      {"QEZ2", {-10, 10}},     {"QEZ3", {-15, 15}},
      {"QEZ4", {-4, 4}},       {"QEZ5", {-40, 40}},     {"QHZ1", {-0.08, 0.08}},
      {"QHZ2", {-0.08, 0.08}}, {"QHZ3", {-3, 3}},       {"QHZ4", {-3, 3}},
      {"PPZ1", {-4, 4}},       {"PPZ2", {-6, 6}},
  };
  return ranges;
}

double Parameters::*member(const std::string& name) {
  return magic_formula::find_parameter(name)->member;
}

std::vector<DesignVariable> variables_of(const SlipFitStage& stage, const Parameters& start) {
  std::vector<DesignVariable> variables;
  for (const std::string& name : stage.coefficients) {
    const auto range = usual_ranges().find(name);
    if (range == usual_ranges().end())
      throw InputError(fmt::format("{} has no usual range to be fitted in", name));
    DesignVariable v;
    v.name = name;
    v.lower = range->second.lower;
    v.upper = range->second.upper;
    v.initial = std::clamp(start.*member(name), v.lower, v.upper);
    variables.push_back(v);
  }
  return variables;
}

/// The samples of a stage, column by column, and the formula on them.
class Sweep {
 public:
  Sweep(const SlipRecord& record,
        SlipChannel channel,
        const SlipFitStage* stage,
        const Parameters& tire)
      : channel_(channel) {
    constexpr double kUpright = 0.005, kNominal = 0.08;  // rad, share of the pressure
    double squares = 0.0;
    for (std::size_t i = 0; i < record.states.size(); ++i) {
      const State& s = record.states[i];
      if (stage != nullptr && stage->upright_at_nominal_pressure &&
          (std::abs(s.gamma) > kUpright || std::abs(s.p / tire.NOMPRES - 1.0) > kNominal))
        continue;
      const double state[] = {s.Fz, s.kappa, s.alpha, s.gamma, s.phit, s.Vx, s.p};
      for (int k = 0; k < 7; ++k) columns_[k].push_back(state[k]);
      measured_.push_back(channel == SlipChannel::Fy ? record.Fy[i] : record.Mz[i]);
      squares += measured_.back() * measured_.back();
    }
    if (measured_.empty() || squares == 0.0)
      throw InputError("no sample of the record belongs to the stage, or all are zero");
    scale_ = std::sqrt(squares);
    for (auto& column : results_) column.resize(measured_.size());
  }

  std::vector<double> residuals(const Parameters& p) {
    const auto& c = columns_;
    auto& r = results_;
    MagicFormula(p).forces({c[0], c[1], c[2], c[3], c[4], c[5], c[6]},
                           {r[0], r[1], r[2], r[3], r[4]});
    const std::vector<double>& y = channel_ == SlipChannel::Fy ? r[1] : r[4];
    std::vector<double> residuals(measured_.size());
    for (std::size_t i = 0; i < residuals.size(); ++i)
      residuals[i] = (measured_[i] - y[i]) / scale_;
    return residuals;
  }

 private:
  SlipChannel channel_;
  std::vector<double> columns_[7], results_[5], measured_;
  double scale_ = 1.0;
};

double norm(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double v : r) sum += v * v;
  return std::sqrt(sum);
}

Parameters with(Parameters tire,
                const std::vector<DesignVariable>& variables,
                const DesignPoint& point) {
  for (std::size_t i = 0; i < variables.size(); ++i)
    tire.*member(variables[i].name) = point.values[i];
  return tire;
}

/// Residuals and their derivatives with respect to the coefficients.
Score score(Sweep& sweep,
            const Parameters& start,
            const std::vector<DesignVariable>& variables,
            const DesignPoint& point) {
  constexpr double kStep = 1e-6;  // of the range: cube root of the rounding
  Score s;
  s.residuals = sweep.residuals(with(start, variables, point));
  const std::size_t m = s.residuals.size(), n = variables.size();
  s.jacobian.resize(m * n);
  for (std::size_t j = 0; j < n; ++j) {
    const double h = kStep * (variables[j].upper - variables[j].lower);
    DesignPoint up = point, down = point;
    up.values[j] += h;
    down.values[j] -= h;
    const auto a = sweep.residuals(with(start, variables, up)),
               b = sweep.residuals(with(start, variables, down));
    for (std::size_t i = 0; i < m; ++i) s.jacobian[i * n + j] = (a[i] - b[i]) / (2.0 * h);
  }
  for (const double r : s.residuals) s.value += r * r;
  return s;
}

Linearization linearization(const Score& s, const DesignSpace& space, const DesignPoint& point) {
  return {to_vector(space.to_unit(point)), to_vector(s.residuals), space.unit_jacobian(point, s)};
}

}  // namespace

std::vector<SlipFitStage> cornering_stages() {
  const std::vector<std::string> curve = {"PCY1",
                                          "PDY1",
                                          "PDY2",
                                          "PEY1",
                                          "PEY2",
                                          "PEY3",
                                          "PKY1",
                                          "PKY2",
                                          "PHY1",
                                          "PHY2",
                                          "PVY1",
                                          "PVY2"},
                                 camber = {"PDY3", "PEY4", "PKY3", "PKY6", "PKY7", "PVY3", "PVY4"},
                                 pressure = {"PPY1", "PPY2", "PPY3", "PPY4"};
  const std::vector<std::string>
      trail = {"QBZ1",
               "QBZ2",
               "QCZ1",
               "QDZ1",
               "QDZ2",
               "QDZ6",
               "QDZ7",
               "QEZ1",
               "QEZ2",
               "QEZ4",
               "QHZ1",
               "QHZ2",
               "QBZ9"},
      torque = {"QBZ4", "QBZ5", "QDZ3", "QDZ8", "QDZ9", "QHZ3", "QHZ4", "QEZ5", "PPZ1", "PPZ2"};
  const auto joined = [](std::initializer_list<std::vector<std::string>> lists) {
    std::vector<std::string> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
  };
  return {{"Fy upright, nominal pressure", SlipChannel::Fy, curve, true},
          {"Fy, camber and pressure", SlipChannel::Fy, joined({camber, pressure}), false},
          {"Fy, all",
           SlipChannel::Fy,
           joined({curve, {"PKY4"}, camber, {"PEY5", "PKY5"}, pressure, {"PPY5"}}),
           false},
          {"Mz upright, nominal pressure", SlipChannel::Mz, trail, true},
          {"Mz, camber and pressure", SlipChannel::Mz, torque, false},
          {"Mz, all",
           SlipChannel::Mz,
           joined({trail, torque, {"QBZ3", "QEZ3", "QDZ4", "QDZ10", "QDZ11"}}),
           false}};
}

double SlipFit::half_width(int i) const {
  const Interval& interval = confidence.intervals[i];
  return 0.5 * (interval.upper - interval.lower) * (variables[i].upper - variables[i].lower);
}

SlipFit fit(const Parameters& start, const SlipRecord& record, const SlipFitStage& stage) {
  std::vector<DesignVariable> variables = variables_of(stage, start);
  const DesignSpace space(variables);
  Sweep sweep(record, stage.channel, &stage, start);
  ResidualTrustRegionOptions options;
  options.restarts = 0;
  options.step_tolerance = 1e-5;
  ResidualTrustRegion optimizer(space, options);
  constexpr int kMost = 300;
  SlipFit result;
  DesignPoint best = space.initial();
  Score at_best = score(sweep, start, variables, best);
  for (; result.evaluations < kMost && !optimizer.converged(); ++result.evaluations) {
    const auto plan = optimizer.propose(1);
    if (plan.empty()) break;
    const Score found = score(sweep, start, variables, plan.front());
    if (found.value < at_best.value) {
      at_best = found;
      best = plan.front();
    }
    optimizer.observe(plan.front(), found);
  }
  for (std::size_t i = 0; i < variables.size(); ++i) variables[i].initial = best.values[i];
  result.parameters = with(start, variables, best);
  result.error = norm(at_best.residuals);
  result.variables = variables;
  result.confidence = confidence(linearization(at_best, space, best));
  return result;
}

double relative_error(const Parameters& tire, const SlipRecord& record, SlipChannel channel) {
  Sweep sweep(record, channel, nullptr, tire);
  return norm(sweep.residuals(tire));
}

}  // namespace latsch::correlation
