// SPDX-License-Identifier: Apache-2.0
#include "cli/run/exported_kc.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/parsed.h"
#include "cli/console/version.h"
#include "cli/run/model_source.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/suspension/kc_tables.h"
#include "formats/car/modelica_tables.h"
#include "formats/tables/csv_table.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using experiment::KcTable;
using experiment::KcTables;
using suspension::CornerGeometry;
using suspension::Side;
using suspension::SuspensionCorner;

constexpr double kLargestTravel = 1.0;  // m
constexpr const char* kAxesOfTables =
    "ISO 8855: x forward, y left, z up; origin and axes of the file's hardpoints";

/// Returns a range end of the command line, m. A rack of 0 is allowed.
double end_of_range(const std::string& option, const std::string& text, double unless_given) {
  if (text.empty()) return unless_given;
  return parse_option(option, text, "m", Range::between(0.0, kLargestTravel));
}

Json point_of(const Eigen::Vector3d& point, double y_sign) {
  return {point.x(), y_sign * point.y(), point.z()};
}

/// Returns a point of the corner for both wheels; that of the other wheel is its mirror image.
Json both_sides(const Eigen::Vector3d& own, Side side) {
  const bool left = side == Side::left;
  return {{"left", point_of(own, left ? 1.0 : -1.0)}, {"right", point_of(own, left ? -1.0 : 1.0)}};
}

Json columns_of(const KcTable& table) {
  Json columns = Json::array();
  for (std::size_t i = 0; i < table.words.size(); ++i) {
    const Channel& channel = table.columns.all()[i];
    columns.push_back(
        {{"name", channel.name}, {"unit", channel.unit}, {"meaning", table.words[i]}});
  }
  return columns;
}

/// Returns the tables by the names of their files.
std::vector<std::pair<std::string, const KcTable*>> files_of(const KcTables& tables) {
  std::vector<std::pair<std::string, const KcTable*>> files = {
      {"kinematics.csv", &tables.kinematics},
      {"roll.csv", &tables.roll},
      {"springs.csv", &tables.springs}};
  if (tables.compliance) files.emplace_back("compliance.csv", &*tables.compliance);
  return files;
}

/// Returns how the compliance was computed, or why the folder has none.
std::string words_of_compliance(const KcTables& tables) {
  if (!tables.compliance)
    return "none: the suspension's file has no bushings, so its links are rigid";
  return "loads of the ground on the tire act at the contact point of each travel, motion is that "
         "of the upright there; bushings without load in each position, a rigid bar in place of "
         "the spring, rack held; nothing couples the wheels, so that the blocks of one wheel by "
         "the other's loads are zero";
}

Json json_of(const KcTables& tables, const SuspensionCorner& corner, const std::string& file) {
  const CornerGeometry& geometry = corner.geometry;
  const auto& wheel = geometry.linkage.wheel;
  Json about = {{"format", "latsch kc"},
                {"version", 1},
                {"program", "Latsch " + version_number()},
                {"model", fs::path(file).filename().string()},
                {"corner", wheel.side == Side::left ? "left" : "right"},
                {"axes", kAxesOfTables},
                {"units", "SI"},
                {"travel", "of the wheel center, upward in the chassis, 0 as in the file"}};
  about["travel_positions"] = tables.travel;
  about["rack_positions"] = tables.rack;
  about["wheel_center"] = both_sides(wheel.center, wheel.side);
  about["contact"] = both_sides(wheel.center + wheel.down(wheel.spin_axis), wheel.side);
  about["tire_radius"] = wheel.radius;
  about["compliance"] = words_of_compliance(tables);
  Json spring = nullptr;
  if (geometry.rates)
    spring = {{"stiffness", geometry.rates->spring},
              {"force_at_rest", *tables.spring_force},
              {"sprung_mass", geometry.rates->sprung_mass},
              {"tire_stiffness", geometry.rates->tire}};
  about["spring"] = spring;
  for (const auto& [name, table] : files_of(tables))
    about["files"][name] = {{"rows", table->columns.all().front().values.size()},
                            {"columns", columns_of(*table)}};
  about["files"]["kc_tables.txt"] = {
      {"form",
       "Modelica CombiTable: every column of kinematics.csv over travel and rack in two "
       "dimensions; roll, springs and compliance over travel, the columns of their files"}};
  return about;
}

/// Returns a table over travel with the columns of its CSV file.
formats::ModelicaTable over_travel(const std::string& name, const KcTable& table) {
  formats::ModelicaTable rows = {name, "columns as in " + name + ".csv", {}};
  const auto& columns = table.columns.all();
  for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
    rows.rows.emplace_back();
    for (const Channel& column : columns) rows.rows.back().push_back(column.values[row]);
  }
  return rows;
}

std::string modelica_of(const KcTables& tables, const std::string& file) {
  constexpr std::size_t kAbscissas = 2;  // travel, rack
  std::vector<formats::ModelicaTable> all;
  const auto& columns = tables.kinematics.columns.all();
  for (std::size_t i = kAbscissas; i < columns.size(); ++i)
    all.push_back(
        formats::table_of_two(columns[i].name,
                              fmt::format("[{}] {}", columns[i].unit, tables.kinematics.words[i]),
                              tables.travel,
                              tables.rack,
                              columns[i].values));
  all.push_back(over_travel("roll", tables.roll));
  all.push_back(over_travel("springs", tables.springs));
  if (tables.compliance) all.push_back(over_travel("compliance", *tables.compliance));
  return formats::modelica_text(
      {fmt::format("Kinematics and compliance of {} by Latsch {}",
                   fs::path(file).filename().string(),
                   version_number()),
       std::string("SI units; ") + kAxesOfTables,
       "tables in two dimensions: travel in the first column, rack in the first row"},
      all);
}

void write_into(const fs::path& folder, const std::string& name, const std::string& text) {
  write_text_file(folder / name, text);
  say_written((folder / name).string());
}

}  // namespace

void write_kc(const KcExport& options, const experiment::Language& language) {
  const ModelSource source = model_source(options.file, language);
  if (!experiment::can(*source.kind, {experiment::MovesAsLinkage::kName}))
    throw InputError({options.file, 0},
                     "is a " + source.kind->in_words() +
                         ": expected a suspension, whose kinematics and compliance --kc writes; of "
                         "a car, export the suspensions that its file names");
  experiment::KcRange range;
  range.travel = end_of_range("--kc-travel", options.travel, range.travel);
  range.rack = end_of_range("--kc-rack", options.rack, range.rack);
  if (range.travel == 0.0) throw InputError("--kc-travel: is 0, expected a range of travel");
  const SuspensionCorner corner = suspension::read_corner(source.numbers.root());
  const auto tables = experiment::kc_tables(corner, range);
  if (!tables)
    throw InputError({options.file, 0},
                     tables.failure().reason +
                         "; --kc-travel and --kc-rack set the ranges, \"0 mm\" of a rack that does "
                         "not move");
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error) throw InputError({options.folder, 0}, "cannot be made: " + error.message());
  const fs::path folder = options.folder;
  for (const auto& [name, table] : files_of(*tables))
    write_into(folder, name, formats::csv_text(table->columns));
  write_into(folder, "kc_tables.txt", modelica_of(*tables, options.file));
  const Json about = json_of(*tables, corner, options.file);
  write_into(folder, "kc.json", about.dump(2) + "\n");
  say("  {}\n  Travel of the wheel center -{} to {}, rack -{} to {}\n  Compliance: {}\n",
      kAxesOfTables,
      format_quantity(range.travel, "mm"),
      format_quantity(range.travel, "mm"),
      format_quantity(range.rack, "mm"),
      format_quantity(range.rack, "mm"),
      words_of_compliance(*tables));
  if (!about["spring"].is_object())
    say("  Spring: its stiffness and the sprung mass are not in the file, so springs.csv has no "
        "rates\n");
  if (fs::exists(folder / "compliance.csv") && !tables->compliance)
    warn("compliance.csv in this folder is of an earlier export, of another suspension",
         {(folder / "compliance.csv").string(), 0});
}

}  // namespace latsch::cli
