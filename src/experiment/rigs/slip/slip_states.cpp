// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/slip_states.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/text.h"
#include "base/units.h"
#include "measurement/axes.h"
#include "measurement/meaning/absent_channel.h"
#include "measurement/meaning/channel_checks.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/filler_numbers.h"
#include "measurement/meaning/natural_unit.h"
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
  const char* otherwise;  // value if the column is missing, in words
};
constexpr std::array<StateColumn, 7> kStateColumns = {
    {{"Fz", "N", &State::Fz, ""},
     {"kappa", "1", &State::kappa, "0"},
     {"alpha", "rad", &State::alpha, "0"},
     {"gamma", "rad", &State::gamma, "0"},
     {"phit", "1/m", &State::phit, "0"},
     {"Vx", "m/s", &State::Vx, "LONGVL of the tire (of finite elements: 60 km/h)"},
     {"p", "Pa", &State::p, "INFLPRES of the tire (of finite elements: its pressure)"}}};

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

constexpr std::size_t kMostLines =
    100;  // largest number of lines listed for one filler, so that a message stays short

bool same_name(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

/// A column and the state it contains; nullptr: none.
struct Meant {
  std::string column;
  const StateColumn* state = nullptr;
};

/// Returns the unit that ends a name such as "SA_deg" of a column without a unit of its own; empty
/// if there is none.
std::string unit_in_name(const formats::CsvTable& table,
                         const std::string& column,
                         const char* expected) {
  const auto found = std::find_if(table.header().begin(),
                                  table.header().end(),
                                  [&](const auto& one) { return one.name == column; });
  if (found == table.header().end() || !found->unit.empty()) return "";
  formats::TableColumn named = *found;
  formats::take_unit_of_name(named, expected);
  return named.unit;
}

/// Returns the unit in which a column of states is read: that of the state, or that of a plain
/// number if the column has no unit at all and is in SI.
std::string unit_to_read(const formats::CsvTable& table,
                         const std::string& column,
                         const char* unit) {
  return unit_in_name(table, column, unit).empty() ? table.si_or_plain(column, unit) : unit;
}

const StateColumn* state_of(const formats::CsvTable& table, const std::string& column) {
  for (const StateColumn& state : kStateColumns)
    if (same_name(column, state.name)) return &state;
  const auto found = recognized(column);
  if (!found) return nullptr;
  const std::string name =
      found->channel == "FzW" ? std::string("Fz") : found->channel;  // states are in W
  for (const StateColumn& state : kStateColumns) {
    if (name != state.name) continue;
    const std::string& written = table.unit(column);
    const auto unit = Unit::find(written);
    const bool fits = unit && unit->same_dimension(Unit::of(state.unit));
    if (column.size() == 1 && !fits && !written.empty()) return nullptr;  // "V" may be a voltage
    if (fits || Unit::of(state.unit).dimensionless() || !written.empty()) return &state;
    if (!unit_in_name(table, column, state.unit).empty()) return &state;
    throw InputError(
        table.header_place(),
        fmt::format("column {0} has no unit, and {1} is {2}: write it as {3}, or call the column "
                    "{1}, which is in {4} where it has no unit",
                    in_quotes(column),
                    state.name,
                    words_for(Unit::of(state.unit)).noun,
                    formats::unit_in_file(
                        *std::find_if(table.header().begin(),
                                      table.header().end(),
                                      [&](const auto& one) { return one.name == column; }),
                        found->unit.empty() ? natural_unit(state.unit) : found->unit),
                    state.unit));
  }
  return nullptr;
}

/// Returns every column in the order of the table. Throws InputError if two columns are the same
/// state, Fz is missing, or a column looks like a missing state.
std::vector<Meant> meant_by(const formats::CsvTable& table) {
  std::vector<Meant> all;
  for (const std::string& column : table.columns()) {
    const StateColumn* state = state_of(table, column);
    for (const Meant& other : all)
      if (state && other.state == state)
        throw InputError(table.header_place(),
                         same_name(other.column, column)
                             ? fmt::format("{} comes twice", in_quotes(column))
                             : fmt::format("columns {} and {} both are {}: expected one of them",
                                           in_quotes(other.column),
                                           in_quotes(column),
                                           state->name));
    all.push_back({column, state});
  }
  std::vector<std::string> unknown;
  for (const Meant& one : all)
    if (!one.state && !recognized(one.column)) unknown.push_back(one.column);
  for (const StateColumn& state : kStateColumns) {
    if (std::any_of(all.begin(), all.end(), [&](const Meant& one) { return one.state == &state; }))
      continue;
    const auto alike = look_like(state.name, unknown);
    const std::string hint =
        alike.empty()
            ? ""
            : fmt::format("; column {} looks like it: call it {}, or give it another name{}",
                          in_quotes(alike.front()),
                          state.name,
                          alike.front().starts_with('-')
                              ? " (a minus in a name is not applied: change the signs, too)"
                              : "");
    if (state.member == &State::Fz)
      throw InputError(table.header_place(),
                       "there is no column Fz; a table of states has Fz and any of kappa, alpha, "
                       "gamma, phit, Vx, p" +
                           hint + " (columns: " + list_of(table.columns()) + ")");
    if (!alike.empty())
      throw InputError(table.header_place(),
                       fmt::format("there is no column {}, which would be taken as {}{}",
                                   state.name,
                                   state.otherwise,
                                   hint));
  }
  return all;
}

/// Adds doubts about numbers that are probably placeholders and no states, and replaces them by
/// gaps for the other checks.
void note_fillers(const formats::CsvTable& table, Channels& states, Ledger& ledger) {
  Channels plain;
  for (Channel channel : states.all()) {
    const LedgerRow& row = *ledger.find_taken(channel.name);
    std::vector<double> numbers = channel.values;
    for (double& value : numbers) value = (value - row.offset) / row.factor;
    for (const FillerNumber& filler : filler_numbers(numbers, false)) {
      std::vector<long> lines;
      for (const std::size_t i : filler.samples) {
        if (lines.size() < kMostLines) lines.push_back(table.place(static_cast<int>(i)).line);
        channel.values[i] = std::nan("");
      }
      ledger.doubts.push_back(
          {row.written,
           fmt::format("column {} is {}{} in {} of {} rows (line {}{}), {}: cut the rows off",
                       in_quotes(row.written),
                       format_number(filler.number, 10),
                       row.unit_written.empty() ? "" : " " + row.unit_written,
                       filler.samples.size(),
                       table.rows(),
                       runs_in_words(lines),
                       filler.samples.size() > kMostLines ? " and more" : "",
                       filler.reason),
           table.place(static_cast<int>(filler.samples.front())),
           filler.is_certain});
    }
    plain.add(std::move(channel));
  }
  states = std::move(plain);
}

/// Reports a turn slip other than 0, which the test ignores.
void note_no_turn_slip(const formats::CsvTable& table,
                       const Channels& states,
                       const std::string& by,
                       const std::string& why,
                       Ledger& ledger) {
  const Channel* phit = states.find("phit");
  if (!phit ||
      std::all_of(phit->values.begin(), phit->values.end(), [](double x) { return x == 0.0; }))
    return;
  const std::string& column = ledger.find_taken("phit")->written;
  ledger.doubts.push_back(
      {column,
       fmt::format("{}: column {} (phit) is not used: {}", by, in_quotes(column), why),
       table.header_place()});
}

OtherColumn other_column(const formats::CsvTable& table,
                         const std::string& column,
                         const StateColumn* state) {
  const auto unit = Unit::find(table.unit(column));
  return {column,
          unit && table.has_unit(column) ? si_unit(unit->dimension()) : "",
          table.has_unit(column),
          state ? state->name : "",
          state != nullptr};
}

/// Returns the ledger's row of a column. `state` is the member of State as which the column is
/// read; null if the column is not used.
LedgerRow row_of_column(const formats::CsvTable& table,
                        const std::string& column,
                        const StateColumn* state,
                        const std::string& by,
                        const std::string& no_turn_slip) {
  LedgerRow row;
  row.written = column;
  row.line = table.header_place().line;
  row.unit_written = table.unit(column);
  if (!state) {
    if (const auto known = recognized(column)) row.meaning = known->meaning->words;
    return row;
  }
  if (row.unit_written.empty()) row.unit_written = unit_in_name(table, column, state->unit);
  row.taken_as = state->name;
  row.unit = state->unit;
  if (const ChannelMeaning* known = find_meaning(state->name)) row.meaning = known->words;
  if (const auto unit = Unit::find(row.unit_written); unit && !row.unit_written.empty()) {
    row.offset = unit->to_si(0.0L);
    row.factor = unit->to_si(1.0L) - row.offset;
  }
  row.axes = "iso";
  const bool is_ignored = state->member == &State::phit && !no_turn_slip.empty();
  if (!is_ignored) Ledger::use(row, by);
  if (is_ignored) row.remark = "not used: " + no_turn_slip;
  if (row.unit_written.empty() && row.unit != "1")
    row.remark = "no unit: " + row.unit + " is taken";
  return row;
}

/// Adds the states that no column gives, and the columns that may be meant for them.
void add_assumed_states(const formats::CsvTable& table,
                        const std::vector<OtherColumn>& others,
                        const std::string& by,
                        const std::string& no_turn_slip,
                        Ledger& ledger) {
  for (const StateColumn& state : kStateColumns) {
    if (ledger.find_taken(state.name)) continue;
    if (state.member == &State::phit && !no_turn_slip.empty()) continue;
    LedgerRow row;
    row.taken_as = state.name;
    row.state = LedgerState::assumed;
    row.used_by = {by};
    row.remark = std::string("is taken as ") + state.otherwise;
    ledger.rows.push_back(std::move(row));
    constexpr std::size_t kMostNamed = 12;
    const auto may_be = columns_that_may_be(state.name, state.unit, others);
    if (may_be.empty()) continue;
    ledger.doubts.push_back(
        {may_be.front().column,
         fmt::format("{}: {} is taken as {}: no column is called {}; columns that may be it: {}. "
                     "Did you mean "
                     "{}? Then {} {}",
                     by,
                     state.name,
                     state.otherwise,
                     spellings_of(state.name),
                     list_in_words(may_be, kMostNamed),
                     may_be.size() == 1 ? "it" : "one of them",
                     may_be.front().is_as_it_stands ? "call it" : "add a column",
                     state.name),
         table.header_place()});
  }
}

}  // namespace

std::vector<experiment::MeasuredCondition> measured_states(const std::string& no_turn_slip) {
  std::vector<experiment::MeasuredCondition> conditions;
  for (const StateColumn& column : kStateColumns) {
    const bool is_load = column.member == &State::Fz;
    conditions.push_back({.channel = column.name,
                          .unit = column.unit,
                          .is_needed = is_load,
                          .frame = is_load ? name_of(AxisFrame::W) : std::string(),
                          .otherwise = column.otherwise,
                          .ignored = column.member == &State::phit ? no_turn_slip : std::string()});
  }
  return conditions;
}

Ledger ledger_of_states(const formats::CsvTable& table,
                        const std::string& by,
                        const std::string& no_turn_slip) {
  Ledger ledger{table.file()};
  std::vector<formats::CsvTable::Wanted> wanted;
  std::vector<OtherColumn> others;
  const auto meant = meant_by(table);
  for (const auto& [column, state] : meant) {
    others.push_back(other_column(table, column, state));
    ledger.rows.push_back(row_of_column(table, column, state, by, no_turn_slip));
    ledger.rows.back().column = static_cast<int>(ledger.rows.size());
    if (state) wanted.push_back({column, unit_to_read(table, column, state->unit)});
  }
  add_assumed_states(table, others, by, no_turn_slip, ledger);
  constexpr int kMostChecked = 1'000'000;  // rows; the checks hold all of them in memory
  if (table.rows() > kMostChecked) {
    ledger.doubts.push_back(
        {"",
         fmt::format("signs and ranges of {} rows are not checked, more than {}",
                     table.rows(),
                     kMostChecked),
         {table.file(), 0}});
    return ledger;
  }
  Channels states;
  auto values = table.numbers(wanted);
  std::size_t k = 0;
  for (const auto& [column, state] : meant)
    if (state) states.add({state->name, state->unit, std::move(values[k++])});
  if (!no_turn_slip.empty()) note_no_turn_slip(table, states, by, no_turn_slip, ledger);
  note_fillers(table, states, ledger);
  for (const ChannelDoubt& doubt : doubts_about(states)) {
    const std::string column = ledger.find_taken(doubt.channel)->written;
    ledger.doubts.push_back({column,
                             "column " + in_quotes(column) + " " + doubt.sentence,
                             table.place(static_cast<int>(doubt.sample)),
                             doubt.is_error});
  }
  return ledger;
}

std::vector<double> values_of(const formats::CsvTable& table, const std::string& condition) {
  constexpr int kMostRows = 200'000;
  if (table.rows() > kMostRows) return {};
  const auto known = std::find_if(
      kStateColumns.begin(), kStateColumns.end(), [&](auto& c) { return condition == c.name; });
  if (known == kStateColumns.end()) return {};
  for (const auto& [column, state] : meant_by(table))
    if (state == &*known) return table.numbers(column, unit_to_read(table, column, known->unit));
  return {};
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
  for (const auto& [column, state] : meant_by(table)) {
    if (!state) {
      unused.push_back(column);
      continue;
    }
    wanted.push_back({column, unit_to_read(table, column, state->unit)});
    members.push_back(state->member);
  }
  std::vector<State> states;
  table.for_blocks(wanted, rows, [&](const std::vector<std::vector<double>>& values) {
    states.assign(values.front().size(), fallback);
    for (std::size_t k = 0; k < members.size(); ++k)
      for (std::size_t i = 0; i < states.size(); ++i) states[i].*members[k] = values[k][i];
    block(states);
  });
  return unused;
}

namespace {

/// Returns a sentence that names the columns of states without a unit and the units in which they
/// are read; empty if there are none.
std::string assumed_units(const formats::CsvTable& table, const std::vector<Meant>& meant) {
  std::vector<std::string> names, units;
  for (const auto& [column, state] : meant) {
    const bool is_bare = state && table.unit(column).empty() &&
                         std::string_view("1") != state->unit &&
                         unit_in_name(table, column, state->unit).empty();
    if (!is_bare) continue;
    names.push_back(column);
    units.push_back(state->unit);
  }
  if (names.empty()) return "";
  return fmt::format("{} {} taken in {}, because {} no unit",
                     fmt::join(names, ", "),
                     names.size() == 1 ? "is" : "are",
                     fmt::join(units, ", "),
                     names.size() == 1 ? "the column has" : "the columns have");
}

}  // namespace

std::string assumed_states(const formats::CsvTable& table, const Parameters& tire) {
  std::vector<std::string> assumed;
  const auto meant = meant_by(table);
  for (const StateColumn& state : kStateColumns) {
    const bool is_there = std::any_of(
        meant.begin(), meant.end(), [&](const Meant& one) { return one.state == &state; });
    if (is_there || state.member == &State::phit) continue;
    const std::string value = state.member == &State::Vx  ? format_quantity(tire.LONGVL, "m/s", 4)
                              : state.member == &State::p ? format_quantity(tire.INFLPRES, "bar", 4)
                                                          : "0";
    assumed.push_back(fmt::format("{} = {}", state.name, value));
  }
  const std::string bare = assumed_units(table, meant);
  if (assumed.empty()) return bare;
  return fmt::format("{} {} taken, because the table has no column of {}{}{}",
                     fmt::join(assumed, ", "),
                     assumed.size() == 1 ? "is" : "are",
                     assumed.size() == 1 ? "it" : "them",
                     bare.empty() ? "" : "; ",
                     bare);
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
