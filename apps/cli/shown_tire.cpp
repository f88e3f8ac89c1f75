// SPDX-License-Identifier: Apache-2.0
// A Magic Formula tire to look at: its file as written, and what the tire does.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cli/shown_file.h"
#include "formats/tir_file.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch::cli {
namespace {

using magic_formula::MagicFormula;
using magic_formula::State;
using magic_formula::SteadyState;
using report::LinePlot;
using report::PlotLine;

constexpr int kTirePoints = 121;
constexpr double kDegree = 0.017453292519943295;
constexpr double kMostAlpha = 15.0 * kDegree, kMostKappa = 0.3;
constexpr std::array kLoads = {0.5, 1.0, 1.5};          // of the nominal one
constexpr std::array kCombined = {0.0, 2.0, 4.0, 8.0};  // deg, side slip of the friction ellipse

/// From -1 to 1.
double swept(int i) { return 2.0 * i / (kTirePoints - 1) - 1.0; }

std::vector<LinePlot> plots(const MagicFormula& tire) {
  const auto& p = tire.parameters();
  const State nominal{p.FNOMIN, 0.0, 0.0, 0.0, 0.0, p.LONGVL, p.INFLPRES};
  LinePlot lateral{"Fy over alpha", "alpha [deg]", "Fy [N]", {}};
  LinePlot aligning{"Mz over alpha", "alpha [deg]", "Mz [N m]", {}};
  LinePlot longitudinal{"Fx over kappa", "kappa", "Fx [N]", {}};
  LinePlot combined{"Fy over Fx at side slip, kappa from -0.3 to 0.3", "Fx [N]", "Fy [N]", {}};
  int color = 0;
  for (const double load : kLoads) {
    State state = nominal;
    state.Fz = load * p.FNOMIN;
    const PlotLine line{fmt::format("{:.0f} N", state.Fz), {}, {}, color++, {}};
    for (LinePlot* plot : {&lateral, &aligning, &longitudinal}) plot->lines.push_back(line);
    for (int i = 0; i < kTirePoints; ++i) {
      state.kappa = 0.0;
      state.alpha = kMostAlpha * swept(i);
      const SteadyState sideways = tire.evaluate(state);
      for (LinePlot* plot : {&lateral, &aligning}) {
        plot->lines.back().x.push_back(state.alpha / kDegree);
      }
      lateral.lines.back().y.push_back(sideways.Fy);
      aligning.lines.back().y.push_back(sideways.Mz);
      state.alpha = 0.0;
      state.kappa = kMostKappa * swept(i);
      longitudinal.lines.back().x.push_back(state.kappa);
      longitudinal.lines.back().y.push_back(tire.evaluate(state).Fx);
    }
  }
  color = 0;
  for (const double alpha : kCombined) {
    combined.lines.push_back({fmt::format("{} deg", alpha), {}, {}, color++, {}});
    State state = nominal;
    state.alpha = alpha * kDegree;
    for (int i = 0; i < kTirePoints; ++i) {
      state.kappa = kMostKappa * swept(i);
      const SteadyState both = tire.evaluate(state);
      combined.lines.back().x.push_back(both.Fx);
      combined.lines.back().y.push_back(both.Fy);
    }
  }
  return {lateral, aligning, longitudinal, combined};
}

}  // namespace

ShownFile shown_tire(const std::filesystem::path& tir) {
  const formats::TirFile file = formats::read_tir(tir);
  ShownFile shown;
  shown.kind = "Magic Formula tire (.tir)";
  shown.facts = file.notes;
  ShownTable table{"As written", {"section", "key", "value", "comment"}, {}};
  for (const auto& section : file.source.sections()) {
    for (const auto& entry : section.entries()) {
      table.rows.push_back({section.name(), entry.key, entry.value, entry.comment});
    }
  }
  shown.tables.push_back(std::move(table));
  if (file.parameters.FNOMIN > 0.0) shown.plots = plots(MagicFormula(file.parameters));
  return shown;
}

}  // namespace latsch::cli
