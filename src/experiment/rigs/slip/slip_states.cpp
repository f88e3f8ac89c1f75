// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/slip_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/text.h"
#include "measurement/axes.h"
#include "models/magic_formula/magic_formula_slopes.h"

namespace latsch {
namespace {

using magic_formula::Parameters;
using magic_formula::State;
using magic_formula::SteadyState;

struct StateColumn {
  const char* name;
  const char* unit;
  double State::*member;
};
constexpr std::array<StateColumn, 7> kStateColumns = {{{"Fz", "N", &State::Fz},
                                                       {"kappa", "1", &State::kappa},
                                                       {"alpha", "rad", &State::alpha},
                                                       {"gamma", "rad", &State::gamma},
                                                       {"phit", "1/m", &State::phit},
                                                       {"Vx", "m/s", &State::Vx},
                                                       {"p", "Pa", &State::p}}};

struct AnswerColumn {
  const char* name;
  const char* unit;
  double SteadyState::*member;
  double factor = 1.0;
};
constexpr std::array<AnswerColumn, 23> kAnswerColumns = {{
    {"Fx", "N", &SteadyState::Fx},           {"Fy", "N", &SteadyState::Fy},
    {"Fz", "N", &SteadyState::Fz},           {"Mx", "N m", &SteadyState::Mx},
    {"My", "N m", &SteadyState::My},         {"Mz", "N m", &SteadyState::Mz},
    {"R_e", "m", &SteadyState::R_e},         {"R_l", "m", &SteadyState::R_l},
    {"rho", "m", &SteadyState::rho},         {"length", "m", &SteadyState::a, 2.0},
    {"width", "m", &SteadyState::b, 2.0},    {"t", "m", &SteadyState::t},
    {"Mzr", "N m", &SteadyState::Mzr},       {"mux", "1", &SteadyState::mux},
    {"muy", "1", &SteadyState::muy},         {"omega", "rad/s", &SteadyState::omega},
    {"Kxk", "N", &SteadyState::Kxk},         {"Kya", "N/rad", &SteadyState::Kya},
    {"Cx", "N/m", &SteadyState::Cx},         {"Cy", "N/m", &SteadyState::Cy},
    {"Cz", "N/m", &SteadyState::Cz},         {"sigma_x", "m", &SteadyState::sigma_x},
    {"sigma_y", "m", &SteadyState::sigma_y},
}};

bool same_name(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

}  // namespace

std::vector<experiment::MeasuredCondition> measured_states() {
  std::vector<experiment::MeasuredCondition> conditions;
  for (const StateColumn& column : kStateColumns) {
    const bool is_load = column.member == &State::Fz;
    conditions.push_back(
        {column.name, column.unit, is_load, is_load ? name_of(AxisFrame::W) : std::string()});
  }
  return conditions;
}

std::vector<std::string> for_slip_states(const formats::CsvTable& table,
                                         const Parameters& tire,
                                         int rows,
                                         const std::function<void(std::vector<State>&)>& block) {
  const State fallback{0.0, 0.0, 0.0, 0.0, 0.0, tire.LONGVL, tire.INFLPRES};
  if (table.rows() == 0)
    throw InputError(table.header_place(), "no row follows the header, expected a state a row");
  std::vector<std::string> unused;
  std::vector<formats::CsvTable::Wanted> wanted;
  std::vector<double State::*> members;
  std::array<bool, kStateColumns.size()> found{};
  for (const std::string& column : table.columns()) {
    const auto known = std::find_if(kStateColumns.begin(), kStateColumns.end(), [&](auto& c) {
      return same_name(column, c.name);
    });
    if (known == kStateColumns.end()) {
      unused.push_back(column);
      continue;
    }
    bool& before = found[known - kStateColumns.begin()];
    if (before)
      throw InputError(table.header_place(), fmt::format("{} comes twice", in_quotes(column)));
    before = true;
    wanted.push_back({column, table.si_or_plain(column, known->unit)});
    members.push_back(known->member);
  }
  if (!found[0])
    throw InputError(table.header_place(),
                     "there is no column Fz; a table of states has Fz and any of kappa, alpha, "
                     "gamma, phit, Vx, p");
  std::vector<State> states;
  table.for_blocks(wanted, rows, [&](const std::vector<std::vector<double>>& values) {
    states.assign(values.front().size(), fallback);
    for (std::size_t k = 0; k < members.size(); ++k)
      for (std::size_t i = 0; i < states.size(); ++i) states[i].*members[k] = values[k][i];
    block(states);
  });
  return unused;
}

SlipStates slip_states(const formats::CsvTable& table, const Parameters& tire) {
  SlipStates all;
  all.unused = for_slip_states(
      table, tire, std::max(table.rows(), 1), [&](auto& states) { all.states.swap(states); });
  return all;
}

Channels answers(const std::vector<SteadyState>& results) {
  Channels channels;
  for (const AnswerColumn& column : kAnswerColumns) {
    Channel channel{column.name, column.unit, {}};
    channel.values.reserve(results.size());
    for (const SteadyState& r : results) channel.values.push_back(column.factor * r.*column.member);
    channels.add(std::move(channel));
  }
  return channels;
}

Channels answers(const magic_formula::MagicFormula& tire, const std::vector<State>& states) {
  std::vector<SteadyState> results(states.size());
  tire.evaluate(states, results);
  return answers(results);
}

Channels with_slopes(const Channels& answers,
                     const magic_formula::MagicFormula& tire,
                     const std::vector<State>& states,
                     const std::vector<std::string>& channels,
                     const std::vector<std::string>& parameters) {
  std::vector<const AnswerColumn*> asked;
  std::vector<magic_formula::Output> outputs;
  for (const AnswerColumn& column : kAnswerColumns) {
    if (std::find(channels.begin(), channels.end(), column.name) == channels.end()) continue;
    asked.push_back(&column);
    outputs.push_back(column.member);
  }
  const auto found = magic_formula::steady_state_slopes(tire, states, parameters, outputs);
  Channels sloping;
  for (Channel channel : answers.all()) {
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (channel.name != asked[k]->name) continue;
      const Eigen::MatrixXd S = asked[k]->factor * found.slopes[k];
      channel.slopes.assign(S.data(), S.data() + S.size());
    }
    sloping.add(std::move(channel));
  }
  return sloping;
}

int outside_of_ranges(const std::vector<State>& states, const Parameters& p) {
  return static_cast<int>(std::count_if(states.begin(), states.end(), [&](const State& s) {
    return s.Fz < p.FZMIN || s.Fz > p.FZMAX || s.kappa < p.KPUMIN || s.kappa > p.KPUMAX ||
           s.alpha < p.ALPMIN || s.alpha > p.ALPMAX || s.gamma < p.CAMMIN || s.gamma > p.CAMMAX ||
           s.p < p.PRESMIN || s.p > p.PRESMAX || std::abs(s.Vx) < p.VXLOW;
  }));
}

}  // namespace latsch
