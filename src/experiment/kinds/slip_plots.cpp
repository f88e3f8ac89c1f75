// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/slip_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "report/html_text.h"

namespace latsch::experiment {
namespace {

using magic_formula::MagicFormula;
using magic_formula::State;
using magic_formula::SteadyState;
using report::LinePlot;
using report::PlotLine;

constexpr int kPoints = 121;
constexpr double kDegree = 0.017453292519943295;
constexpr double kMostAlpha = 15.0 * kDegree, kMostKappa = 0.3;
constexpr double kBar = 1e5;
constexpr double kNothing = 1e-6;  // share of the nominal load, in N and N m; a smaller force
                                   // counts as none

/// A condition besides the slips, with its name in the legend.
struct Condition {
  std::string name;
  State state;
};

/// Returns point i of an even grid from -1 to 1.
double swept(int i) { return 2.0 * i / (kPoints - 1) - 1.0; }

PlotLine line(const Condition& condition, int color) { return {condition.name, {}, {}, color, {}}; }

LinePlot over_alpha(const MagicFormula& tire,
                    const std::string& description,
                    const std::string& y_title,
                    double SteadyState::*answer,
                    const std::vector<Condition>& conditions) {
  LinePlot plot{description, "alpha [deg]", y_title, {}};
  int color = 0;
  for (const Condition& condition : conditions) {
    plot.lines.push_back(line(condition, color++));
    State state = condition.state;
    for (int i = 0; i < kPoints; ++i) {
      state.alpha = kMostAlpha * swept(i);
      plot.lines.back().x.push_back(state.alpha / kDegree);
      plot.lines.back().y.push_back(tire.evaluate(state).*answer);
    }
  }
  return plot;
}

LinePlot over_kappa(const MagicFormula& tire,
                    const std::string& description,
                    const std::vector<Condition>& conditions) {
  LinePlot plot{description, "kappa", "Fx [N]", {}};
  int color = 0;
  for (const Condition& condition : conditions) {
    plot.lines.push_back(line(condition, color++));
    State state = condition.state;
    for (int i = 0; i < kPoints; ++i) {
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
    state.alpha = alpha * kDegree;
    plot.lines.push_back(line({fmt::format("{} deg", alpha), state}, color++));
    for (int i = 0; i < kPoints; ++i) {
      state.kappa = kMostKappa * swept(i);
      const SteadyState both = tire.evaluate(state);
      plot.lines.back().x.push_back(both.Fx);
      plot.lines.back().y.push_back(both.Fy);
    }
  }
  return plot;
}

std::vector<Condition> varied(const State& nominal,
                              const std::vector<double>& values,
                              double State::*member,
                              const std::function<std::string(double)>& name) {
  std::vector<Condition> conditions;
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

/// True if the tire has this force at all and the varied quantity changes it: a file need not have
/// the coefficients of every slip, of camber and of pressure.
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

std::vector<LinePlot> slip_plots(const MagicFormula& tire) {
  const auto& p = tire.parameters();
  if (!(p.FNOMIN > 0.0)) return {};
  const State nominal{p.FNOMIN, 0.0, 0.0, 0.0, 0.0, p.LONGVL, p.INFLPRES};
  const auto loads =
      varied(nominal, {0.5 * p.FNOMIN, p.FNOMIN, 1.5 * p.FNOMIN}, &State::Fz, [](double Fz) {
        return fmt::format("{:.0f} N", Fz);
      });
  const auto cambers =
      varied(nominal, {-4.0 * kDegree, 0.0, 4.0 * kDegree}, &State::gamma, [](double gamma) {
        return report::fixed(gamma / kDegree, 0) + " deg";
      });
  std::vector<LinePlot> plots{
      over_alpha(tire, "Fy over alpha, by load", "Fy [N]", &SteadyState::Fy, loads),
      over_alpha(tire, "Mz over alpha, by load", "Mz [N m]", &SteadyState::Mz, loads),
      over_kappa(tire, "Fx over kappa, by load", loads),
      combined(tire, nominal),
      over_alpha(tire, "Fy over alpha, by camber", "Fy [N]", &SteadyState::Fy, cambers),
      over_alpha(tire, "Mz over alpha, by camber", "Mz [N m]", &SteadyState::Mz, cambers)};
  const auto pressures =
      varied(nominal, {0.8 * nominal.p, nominal.p, 1.2 * nominal.p}, &State::p, [](double at) {
        return fmt::format("{:.2f} bar", at / kBar);
      });
  plots.push_back(
      over_alpha(tire, "Fy over alpha, by pressure", "Fy [N]", &SteadyState::Fy, pressures));
  plots.push_back(over_kappa(tire, "Fx over kappa, by pressure", pressures));
  std::erase_if(plots, [&](const LinePlot& plot) { return !tells_something(plot, p.FNOMIN); });
  return plots;
}

}  // namespace latsch::experiment
