// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/rolling_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "base/file.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/test_words.h"
#include "experiment/rigs/fe_rolling/patch_limits.h"
#include "experiment/rigs/fe_rolling/rolling_table.h"
#include "experiment/rigs/slip/slip_states.h"

namespace latsch::experiment {
namespace {

/// Says which losses a result contains.
std::vector<std::string> limits_of_losses(const fe_tire::LossMaterials& losses) {
  if (losses.is_elastic())
    return {
        "rolling: the tire's file states neither prony nor loss_factor of a rubber or a layer, "
        "so rolling_resistance is that of friction alone"};
  return {
      "rolling: rubber and cords relax while they roll, so they are stiffer than at rest by the "
      "storage moduli of their terms; moduli are those of the relaxed tire at every temperature "
      "and amplitude"};
}

/// Reads a key that states one value for all states or one value for each. Returns nothing if the
/// key is missing.
struct Column {
  std::string key;
  std::vector<double> values;
  double at(std::size_t k) const { return values.size() == 1 ? values[0] : values[k]; }
};

Column column(const Node& root, const char* key, const char* unit, Range range) {
  return {key, root.has(key) ? root.one_or_more(key, unit, range) : std::vector<double>()};
}

/// Throws InputError for a speed of 0, of which the range alone would not say what to do.
void refuse_standstill(const Node& root) {
  if (!root.has("speed")) return;
  for (const double speed : root.one_or_more("speed", "m/s"))
    if (speed == 0.0)
      root.reject(
          "speed",
          "is 0: a wheel that stands does not roll; expected speeds above 0, or a test of a "
          "standing tire, static_stiffness or load_deflection");
}

std::vector<RollingRow> read_rows(const Node& root) {
  refuse_standstill(root);
  const Column load = column(root, "load", "N", Range::positive());
  const Column speed = column(root, "speed", "m/s", Range::between(1e-3, 150.0));
  const Column kappa =
      column(root, "kappa", "1", Range::between(kLeastRollingSlip, kMostRollingSlip));
  const Column alpha =
      column(root, "alpha", "rad", Range::between(-kMostRollingSlipAngle, kMostRollingSlipAngle));
  const Column camber =
      column(root, "camber", "rad", Range::between(-kMostRollingCamber, kMostRollingCamber));
  const Column turn = column(root, "turn_slip", "1/m", Range::between(-2.0, 2.0));
  for (const Column* needed : {&load, &speed})
    if (needed->values.empty())
      root.reject(needed->key, "is required: one value for all states, or one for each");
  std::size_t count = 1;
  for (const Column* one : {&load, &speed, &kappa, &alpha, &camber, &turn})
    count = std::max(count, one->values.size());
  for (const Column* one : {&load, &speed, &kappa, &alpha, &camber, &turn})
    if (one->values.size() > 1 && one->values.size() != count)
      root.reject(one->key,
                  fmt::format("has {} values where another key has {}: expected one for all "
                              "states, or one for each",
                              one->values.size(),
                              count));
  std::vector<RollingRow> rows(count);
  for (std::size_t k = 0; k < count; ++k) {
    RollingRow& row = rows[k];
    row.load = load.at(k);
    row.speed = speed.at(k);
    if (!kappa.values.empty()) row.kappa = kappa.at(k);
    if (!alpha.values.empty()) row.alpha = alpha.at(k);
    if (!camber.values.empty()) row.camber = camber.at(k);
    if (!turn.values.empty()) row.turn_slip = turn.at(k);
  }
  return rows;
}

/// Reads the states of a table. Without a column of slip the wheel rolls freely. The speed and the
/// pressure of the test are used if the test states them, or if the table has no column of them.
std::vector<RollingRow> rows_of(const Node& root, const formats::CsvTable& table) {
  for (const char* key : {"load", "kappa", "alpha", "camber", "turn_slip"})
    if (root.has(key)) root.reject(key, "stands beside states, whose table has it: expected one");
  TableReading reading;
  if (root.has("speed") || values_of(table, "Vx").empty())
    reading.speed = root.quantity("speed", "m/s", Range::between(1e-3, 150.0));
  reading.takes_pressure = !root.has("pressure");
  return rows_of(table, reading);
}

/// Throws InputError if a slip is stated on ground without friction.
void check_friction(const Node& root, const RollingTest& test) {
  if (test.friction.value_or(kAssumedFriction) > 0.0) return;
  for (const RollingRow& row : test.rows)
    if (row.kappa || row.alpha != 0.0 || row.turn_slip != 0.0)
      root.reject("friction",
                  "is 0, and a state has a slip: frictionless ground carries neither torque nor "
                  "side force; expected friction above 0, or no slips");
}

/// Throws InputError if a wheel turns on a drum.
void check_drum(const Node& root, const RollingTest& test) {
  if (test.drum_radius == 0.0) return;
  for (const RollingRow& row : test.rows)
    if (row.turn_slip != 0.0)
      root.reject("drum_radius",
                  "stands beside a turn slip: a wheel that turns on a drum has no steady state; "
                  "expected flat ground, or turn slips of 0");
}

}  // namespace

RollingStates read_rolling_states(const Node& root, const TestSource& source) {
  RollingStates read;
  RollingTest& test = read.test;
  if (root.has("friction"))
    test.friction = root.quantity("friction", "1", Range::between(0.0, 5.0));
  test.pressure = read_pressure(root, source.measured);
  if (root.has("drum_radius"))
    test.drum_radius = root.quantity("drum_radius", "m", Range::between(0.1, 100.0));
  std::optional<formats::CsvTable> table;
  if (const auto measured = find_measured(root, "states")) {
    table = formats::CsvTable::parse(std::make_shared<MappedFile>(formats::csv_text(take_measured(
                                         *measured, measured_states(), source.measured))),
                                     measured->text("from"));
  } else if (root.has("states")) {
    const auto file = source.file(root, "states");
    table =
        formats::CsvTable::parse(std::make_shared<MappedFile>(read_text_file(file)), file.string());
    read.table = table;
  }
  test.rows = table ? rows_of(root, *table) : read_rows(root);
  if (test.rows.empty() || test.rows.size() > kMostRollingRows)
    root.reject("states",
                fmt::format("has {} states: expected 1 to {}", test.rows.size(), kMostRollingRows));
  check_friction(root, test);
  check_drum(root, test);
  return read;
}

std::vector<std::string> RollsFeTire::needs() const { return {IsFeTire::kName}; }

std::vector<Ledger> RollsFeTire::ledgers(const std::string& by) const {
  if (!states_.table) return {};
  return {ledger_of_states(*states_.table, by)};
}

std::vector<double> RollsFeTire::driven_at(const std::string& condition) const {
  return states_.table ? values_of(*states_.table, condition) : std::vector<double>();
}

std::string RollsFeTire::states_in_words() const {
  const std::size_t states = rolling().rows.size();
  const double drum = rolling().drum_radius;
  return fmt::format("in {} steady {}{}{}{}",
                     states,
                     states == 1 ? "state" : "states",
                     drum > 0.0 ? fmt::format(" on a drum of radius {:g} m", drum) : "",
                     rolling().friction ? fmt::format(", friction {:g}", *rolling().friction) : "",
                     inflated(rolling().pressure));
}

Result<Channels> RollsFeTire::run_with_slopes(Specimen& specimen, const Asked& asked) const {
  return specimen.find<IsFeTire>()->drive(
      [this](TireRig& rig, fe_tire::TireSlopes* slopes) { return measure(rig, slopes); },
      rolling().pressure.has_value(),
      asked);
}

std::vector<std::string> RollsFeTire::limits(Specimen& specimen) const {
  std::vector<std::string> limits;
  (void)specimen.find<IsFeTire>()->drive(
      [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
        limits = limits_of_losses(rig.losses());
        if (std::string words = words_on_sectors(rig, rolling()); !words.empty())
          limits.push_back("rolling: " + words);
        if (rolling().friction) return Channels();
        limits.push_back("rolling: " +
                         friction_in_words(rig,
                                           highest_pressure(rolling(), rig.own_pressure()),
                                           fastest(rolling().rows)));
        return Channels();
      },
      true,
      {});
  return limits;
}

Result<std::vector<std::string>> RollsFeTire::run_in_blocks(
    Specimen& specimen, const std::function<void(const Channels&)>& tell) const {
  auto notes = Test::run_in_blocks(specimen, tell);
  if (!notes) return notes;
  for (std::string& limit : limits(specimen)) notes->push_back(std::move(limit));
  return notes;
}

}  // namespace latsch::experiment
