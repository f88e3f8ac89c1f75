// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/pictures/slip_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "models/magic_formula/coefficient_conditions.h"
#include "report/html_text.h"

namespace latsch::experiment {
namespace {

using magic_formula::MagicFormula;
using magic_formula::State;
using magic_formula::SteadyState;
using report::LinePlot;
using report::PlotLine;

constexpr int kPointsOfCurve = 121;
constexpr double kRadiansOfDegree = 0.017453292519943295;
constexpr double kMostAlpha = 15.0 * kRadiansOfDegree, kMostKappa = 0.3;
constexpr double kPascalsOfBar = 1e5;
// force or moment over the nominal load (m for moments) below which it counts as zero
constexpr double kNothing = 1e-6;

/// A test condition other than slip, with its name in the legend.
struct Varied {
  std::string name;
  State state;
};

/// Returns point i of an even grid from -1 to 1.
double swept(int i) { return 2.0 * i / (kPointsOfCurve - 1) - 1.0; }

PlotLine line(const Varied& condition, int color) { return {condition.name, {}, {}, color, {}}; }

LinePlot over_alpha(const MagicFormula& tire,
                    const std::string& description,
                    const std::string& y_title,
                    double SteadyState::*answer,
                    const std::vector<Varied>& conditions) {
  LinePlot plot{description, "alpha [deg]", y_title, {}};
  int color = 0;
  for (const Varied& condition : conditions) {
    plot.lines.push_back(line(condition, color++));
    State state = condition.state;
    for (int i = 0; i < kPointsOfCurve; ++i) {
      state.alpha = kMostAlpha * swept(i);
      plot.lines.back().x.push_back(state.alpha / kRadiansOfDegree);
      plot.lines.back().y.push_back(tire.evaluate(state).*answer);
    }
  }
  return plot;
}

LinePlot over_kappa(const MagicFormula& tire,
                    const std::string& description,
                    const std::vector<Varied>& conditions) {
  LinePlot plot{description, "kappa", "Fx [N]", {}};
  int color = 0;
  for (const Varied& condition : conditions) {
    plot.lines.push_back(line(condition, color++));
    State state = condition.state;
    for (int i = 0; i < kPointsOfCurve; ++i) {
      state.kappa = kMostKappa * swept(i);
      plot.lines.back().x.push_back(state.kappa);
      plot.lines.back().y.push_back(tire.evaluate(state).Fx);
    }
  }
  return plot;
}

LinePlot combined(const MagicFormula& tire, const State& nominal) {
  LinePlot plot{"Fy over Fx at side slip, kappa from −0.3 to 0.3", "Fx [N]", "Fy [N]", {}};
  int color = 0;
  for (const double alpha : {0.0, 2.0, 4.0, 8.0}) {
    State state = nominal;
    state.alpha = alpha * kRadiansOfDegree;
    plot.lines.push_back(line({fmt::format("{} deg", alpha), state}, color++));
    for (int i = 0; i < kPointsOfCurve; ++i) {
      state.kappa = kMostKappa * swept(i);
      const SteadyState both = tire.evaluate(state);
      plot.lines.back().x.push_back(both.Fx);
      plot.lines.back().y.push_back(both.Fy);
    }
  }
  return plot;
}

std::vector<Varied> varied(const State& nominal,
                           const std::vector<double>& values,
                           double State::*member,
                           const std::function<std::string(double)>& name) {
  std::vector<Varied> conditions;
  for (const double value : values) {
    conditions.push_back({name(value), nominal});
    conditions.back().state.*member = value;
  }
  return conditions;
}

bool exceeds(const std::vector<double>& values, double limit) {
  return std::any_of(
      values.begin(), values.end(), [&](double value) { return std::abs(value) > limit; });
}

/// A plot with the data that decide which of its lines the fit supports.
struct JudgedPlot {
  LinePlot plot;
  const char* slip;  // channel of the abscissa, a slip
  double unit;       // SI value of one unit of the abscissa; 0: the abscissa is no slip
  char force;        // force of the ordinate: 'X', 'Y', 'Z' or 'R', see is_of()
  std::optional<magic_formula::Condition> varied;
  std::vector<double> values;  // SI; value of the varied condition for each line
  double nominal = 0.0;
};

/// True for the coefficients of Fx ('X'), Fy ('Y'), Mz ('Z') or of combined slip ('R'). Those of Mx
/// and My begin with QS.
bool is_of(char force, const std::string& name) {
  if (force == 'R') return name.size() > 3 && name[0] == 'R';
  if (name.size() < 4 || name[2] != force) return false;
  return name[0] == 'P' || (force == 'Z' && name[0] == 'Q');
}

/// True if at least one coefficient of a force is known; if a condition is given, at least one of
/// those that describe the effect of the condition.
bool knows(const SlipKnowledge& knowledge,
           char force,
           const std::optional<magic_formula::Condition>& condition) {
  return std::any_of(
      knowledge.coefficients.begin(), knowledge.coefficients.end(), [&](const std::string& name) {
        if (!is_of(force, name)) return false;
        if (!condition) return true;
        const auto all = magic_formula::conditions_of(name);
        return std::any_of(
            all.begin(), all.end(), [&](const auto& one) { return one.condition == *condition; });
      });
}

/// Returns the least and the greatest value; nullopt if there is none.
std::optional<std::pair<double, double>> ends_of_values(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return std::pair{*least, *greatest};
}

/// Shades the plot outside of the data, and dashes and names lines that the fit does not support.
LinePlot told_by_knowledge(JudgedPlot one, const SlipKnowledge& knowledge) {
  LinePlot& plot = one.plot;
  if (one.unit > 0.0 && !knowledge.measured_at("Fz").empty()) {
    const auto slips = ends_of_values(knowledge.measured_at(one.slip));
    plot.data =
        slips ? std::pair{slips->first / one.unit, slips->second / one.unit} : std::pair{0.0, 0.0};
  }
  const bool has_force = knows(knowledge, one.force, std::nullopt);
  // Forces change with the load even without special coefficients; the effects of camber and
  // pressure need coefficients of their own.
  const bool has_condition = !one.varied || *one.varied == magic_formula::Condition::load ||
                             knows(knowledge, one.force, one.varied);
  const auto reached =
      one.varied ? ends_of_values(knowledge.measured_at(magic_formula::channel_of(*one.varied)))
                 : std::nullopt;
  constexpr double kEnd = 1e-3;  // share of a value by which it may lie beyond the data
  for (std::size_t k = 0; k < plot.lines.size(); ++k) {
    report::PlotLine& line = plot.lines[k];
    const double value = k < one.values.size() ? one.values[k] : one.nominal;
    line.is_dashed = !has_force || (!has_condition && value != one.nominal);
    if (line.is_dashed)
      line.name += ", assumed";
    else if (reached && (value < reached->first - kEnd * std::abs(value) ||
                         value > reached->second + kEnd * std::abs(value)))
      line.name += ", outside";
  }
  return plot;
}

/// True if the tire has this force and the varied quantity changes it: not every file has the
/// coefficients for every slip, for camber and for pressure.
bool tells_something(const LinePlot& plot, double FNOMIN) {
  const double limit = kNothing * FNOMIN;
  const auto has_force = [&](const PlotLine& line) {
    return exceeds(line.y, limit) && exceeds(line.x, kNothing);
  };
  const auto is_first = [&](const PlotLine& line) {
    const PlotLine& first = plot.lines.front();
    for (std::size_t i = 0; i < line.y.size(); ++i) {
      if (std::abs(line.y[i] - first.y[i]) > limit) return false;
    }
    return true;
  };
  return std::any_of(plot.lines.begin(), plot.lines.end(), has_force) &&
         !std::all_of(plot.lines.begin(), plot.lines.end(), is_first);
}

}  // namespace

std::vector<LinePlot> slip_plots(const MagicFormula& tire, const SlipKnowledge* knowledge) {
  using magic_formula::Condition;
  const auto& p = tire.parameters();
  if (!(p.FNOMIN > 0.0)) return {};
  const State nominal{p.FNOMIN, 0.0, 0.0, 0.0, 0.0, p.LONGVL, p.INFLPRES};
  const std::vector<double> at_loads{0.5 * p.FNOMIN, p.FNOMIN, 1.5 * p.FNOMIN},
      at_cambers{-4.0 * kRadiansOfDegree, 0.0, 4.0 * kRadiansOfDegree},
      at_pressures{0.8 * nominal.p, nominal.p, 1.2 * nominal.p};
  const auto loads =
      varied(nominal, at_loads, &State::Fz, [](double Fz) { return fmt::format("{:.0f} N", Fz); });
  const auto cambers = varied(nominal, at_cambers, &State::gamma, [](double gamma) {
    return report::fixed(gamma / kRadiansOfDegree, 0) + " deg";
  });
  const auto pressures = varied(nominal, at_pressures, &State::p, [](double at) {
    return fmt::format("{:.2f} bar", at / kPascalsOfBar);
  });
  std::vector<JudgedPlot> all;
  const auto add = [&](LinePlot plot,
                       bool is_alpha,
                       char force,
                       Condition condition,
                       const std::vector<double>& values,
                       double usual) {
    all.push_back({std::move(plot),
                   is_alpha ? "alpha" : "kappa",
                   is_alpha ? kRadiansOfDegree : 1.0,
                   force,
                   condition,
                   values,
                   usual});
  };
  const auto Fy = [&](const char* by, const std::vector<Varied>& of) {
    return over_alpha(tire, std::string("Fy over alpha, by ") + by, "Fy [N]", &SteadyState::Fy, of);
  };
  const auto Mz = [&](const char* by, const std::vector<Varied>& of) {
    return over_alpha(
        tire, std::string("Mz over alpha, by ") + by, "Mz [N m]", &SteadyState::Mz, of);
  };
  add(Fy("load", loads), true, 'Y', Condition::load, at_loads, p.FNOMIN);
  add(Mz("load", loads), true, 'Z', Condition::load, at_loads, p.FNOMIN);
  add(over_kappa(tire, "Fx over kappa, by load", loads),
      false,
      'X',
      Condition::load,
      at_loads,
      p.FNOMIN);
  all.push_back({combined(tire, nominal), "kappa", 0.0, 'R', std::nullopt, {}, 0.0});
  add(Fy("camber", cambers), true, 'Y', Condition::camber, at_cambers, 0.0);
  add(Mz("camber", cambers), true, 'Z', Condition::camber, at_cambers, 0.0);
  add(Fy("pressure", pressures), true, 'Y', Condition::pressure, at_pressures, nominal.p);
  add(over_kappa(tire, "Fx over kappa, by pressure", pressures),
      false,
      'X',
      Condition::pressure,
      at_pressures,
      nominal.p);
  std::vector<LinePlot> plots;
  for (JudgedPlot& one : all)
    if (tells_something(one.plot, p.FNOMIN))
      plots.push_back(knowledge ? told_by_knowledge(std::move(one), *knowledge)
                                : std::move(one.plot));
  return plots;
}

}  // namespace latsch::experiment
