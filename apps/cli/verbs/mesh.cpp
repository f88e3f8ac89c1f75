// SPDX-License-Identifier: Apache-2.0
// Implements `latsch mesh`: shows the finite-element mesh of a tire and the error of the mesh
// compared with the converged solution.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/file.h"
#include "base/units.h"
#include "cli/console/console.h"
#include "cli/console/parsed.h"
#include "cli/run/model_source.h"
#include "cli/templates/meshed_tire.h"
#include "cli/templates/placed_tire.h"
#include "cli/verbs/verbs.h"
#include "experiment/rigs/fe_tire/column_placement.h"
#include "experiment/rigs/fe_tire/discretization.h"
#include "formats/mesh/vtu_file.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {
namespace {

using fe_tire::TireDescription;

struct MeshOptions {
  std::string file, vtu, deflection, place_columns;
  int refinement = 1;
  int modes = 20;
  int finest = 4;
  int unknowns = 0;
  bool convergence = false, thorough = false, choose_sectors = false;
};

void print_counts(const MeshedTire& tire, const fe_tire::Mesh& mesh, double mass) {
  std::map<int, int> elements_of_region;
  size_t rebars = 0;
  for (const fe_tire::Element& element : mesh.elements) {
    elements_of_region[element.region] += mesh.sectors;
    rebars += element.rebars.size() * static_cast<size_t>(mesh.sectors);
  }
  answer() = {{"name", tire.name},
              {"size", tire.size},
              {"elements", mesh.element_count()},
              {"sectors", mesh.sectors},
              {"nodes", mesh.nodes()},
              {"free_degrees_of_freedom", mesh.free_dofs()},
              {"outer_radius_m", mesh.outer_radius()},
              {"mass_kg", mass}};
  const auto line = [](const std::string& what, const std::string& value) {
    say("  {:<28} {}\n", what, value);
  };
  say("{}{}\n", tire.name, tire.size.empty() ? "" : ", " + tire.size);
  line("elements (HEX8)", std::to_string(mesh.element_count()));
  line("sectors", std::to_string(mesh.sectors));
  line("nodes", std::to_string(mesh.nodes()));
  line("free degrees of freedom", std::to_string(mesh.free_dofs()));
  line("cord layers in elements", std::to_string(rebars));
  line("outer radius, not inflated", format_quantity(mesh.outer_radius(), "mm", 5));
  line("mass, bead to bead", format_quantity(mass, "kg", 4));
  for (const auto& [region, count] : elements_of_region) {
    line("elements of " + mesh.region_names[region], std::to_string(count));
  }
}

/// Returns the deflection, m; 0 if none is given.
double deflection_of(const MeshOptions& options) {
  return options.deflection.empty() ? 0.0 : parse_option("--deflection", options.deflection, "m");
}

void print_rows(const std::string& title, const std::vector<DiscretizationRow>& rows) {
  if (rows.empty()) return;
  for (const DiscretizationRow& row : rows) {
    nlohmann::ordered_json found = {{"state", title},
                                    {"name", row.name},
                                    {"unit", row.unit},
                                    {"values", row.values},
                                    {"paired", row.paired}};
    if (row.paired) {
      found["converged"] = row.converged;
      found["order"] = row.order;
      found["asymptotic"] = row.asymptotic();
      found["error"] = row.error();
      found["error_uncertainty"] = row.error_uncertainty();
    }
    answer()["convergence"].push_back(found);
  }
  const std::size_t meshes = rows.front().values.size();
  say("\n{:<24}", title);
  for (size_t i = 0; i < meshes; ++i) say(" {:>10}", fmt::format("mesh {}", i + 1));
  say(" {:>11} {:>6} {:>20}\n", "converged", "order", "error of mesh 1");
  bool asymptotic = true;
  for (const DiscretizationRow& row : rows) {
    say("{:<24}", fmt::format("{} [{}]", row.name, row.unit));
    for (double value : row.values) say(" {:>10.5g}", value);
    if (!row.paired) {
      say("  not found on every mesh\n");
      continue;
    }
    asymptotic = asymptotic && row.asymptotic();
    say(" {:>11.5g} {:>6} {:>11.2f} +- {:.2f} %\n",
        row.converged,
        row.asymptotic() ? fmt::format("{:.2f}", row.order) : "none",
        100.0 * row.error(),
        100.0 * row.error_uncertainty());
  }
  if (!asymptotic) {
    say("order none: these meshes do not show how the error falls, so only the +- limits it;\n"
        "rows of elements that meet on the plies ([mesh] faces) or a larger --finest may show "
        "it\n");
  }
}

int print_convergence(const TireDescription& tire, const MeshOptions& options) {
  DiscretizationSettings settings;
  settings.element = tire.element;
  settings.pressure = tire.pressure;
  settings.modes = options.modes;
  settings.loaded_thoroughly = options.thorough;
  settings.refinements.resize(options.finest);
  std::iota(settings.refinements.begin(), settings.refinements.end(), 1);
  settings.deflection = deflection_of(options);
  RunningNote note;
  long done = 0;
  const auto study = study_discretization(
      tire, settings, [&](const std::string& mesh) { note.update(done++, 0, mesh); });
  if (!study) {
    complain(study.failure().reason);
    return kFailed;
  }
  print_rows("Inflated", study->unloaded);
  print_rows("On the ground", study->loaded);
  return kDone;
}

/// Places the columns of elements where they reduce the error and writes the tire with them.
int place(const TireDescription& tire, const MeshOptions& options) {
  RunningNote note;
  long done = 0;
  ColumnPlacementSettings settings = {.unknowns = options.unknowns, .modes = options.modes};
  settings.choose_sectors = options.choose_sectors;
  settings.deflection = deflection_of(options);
  const auto found = place_columns(
      tire, settings, [&](const std::string& round) { note.update(done++, 0, round); });
  if (!found) {
    complain(found.failure().reason);
    return kFailed;
  }
  answer()["columns"] = {{"positions", found->columns},
                         {"sectors", found->sectors},
                         {"free_degrees_of_freedom", found->unknowns},
                         {"error_before", found->error_before},
                         {"error", found->error},
                         {"worst", found->worst},
                         {"stopped", found->stopped}};
  if (!found->stopped.empty()) warn(found->stopped + "; the best mesh before it is kept");
  say("\n{} columns, {} sectors, {} unknowns: largest error of growth and {} modes{} {:.2f} -> "
      "{:.2f} % ({}), estimated\n{}\n",
      2 * (found->columns.size() - 1),
      found->sectors,
      found->unknowns,
      options.modes,
      settings.deflection > 0.0 ? ", unloaded and on the ground," : "",
      100.0 * found->error_before,
      100.0 * found->error,
      found->worst,
      columns_line(found->columns));
  write_text_file(options.place_columns,
                  placed_tire(read_text_file(options.file), found->columns, found->sectors));
  say_written(options.place_columns);
  return kDone;
}

int mesh(const MeshOptions& options, const experiment::Language& language) {
  if (options.thorough && options.deflection.empty())
    throw InputError(
        "mesh: --thorough has no effect without a pressed tire; expected --deflection beside it, "
        "or the command without it");
  const MeshedTire tire = meshed_tire(options.file, language);
  const bool changes =
      options.refinement > 1 || options.convergence || !options.place_columns.empty();
  if (!tire.description && changes)
    throw InputError({options.file, 0},
                     "has a mesh of the user, which cannot be refined: expected a tire described "
                     "by its section for --refinement, --convergence and --place-columns");
  const fe_tire::Mesh mesh =
      tire.description ? fe_tire::build_mesh(*tire.description, options.refinement) : tire.mesh;
  fe_tire::check(mesh);
  print_counts(tire, mesh, fe_tire::FeTire(mesh, tire.materials).total_mass());
  if (!options.vtu.empty()) {
    formats::write_tire_vtu(std::filesystem::path(options.vtu), mesh, {});
    say_written(options.vtu);
  }
  if (!options.place_columns.empty()) {
    if (is_study(options.file)) {
      throw InputError({options.file, 0}, "is a study, expected a tire file for --place-columns");
    }
    const int code = place(*tire.description, options);
    if (code != kDone) return code;
  }
  return options.convergence ? print_convergence(*tire.description, options) : kDone;
}

}  // namespace

void add_mesh(CommandLine& app, Program& program) {
  Verb verb =
      app.add_subcommand("mesh", "Meshes a tire: counts, mass, how far it is from converged");
  verb.footer(
      "Examples:\n"
      "  latsch mesh studies/tires/passenger_225_50R16.toml --vtu mesh.vtu\n"
      "  # The same tire on finer meshes, extrapolated: the error that a fit would hide in the "
      "moduli.\n"
      "  latsch mesh studies/tires/passenger_225_50R16.toml --convergence --deflection \"25 mm\"\n"
      "  # The same tire and as many unknowns; columns of elements are short where that changes "
      "results.\n"
      "  latsch mesh studies/tires/passenger_225_50R16.toml --place-columns placed.toml\n"
      "  # The same by the loads on the ground, too, which takes minutes.\n"
      "  latsch mesh studies/tires/passenger_225_50R16.toml --place-columns placed.toml "
      "--deflection \"25 mm\" --choose-sectors");
  auto options = std::make_shared<MeshOptions>();
  verb.add_option("file", options->file, "Tire file (TOML, .inp) or study file").required();
  verb.add_option(
          "--refinement",
          options->refinement,
          "Splits every element into this number of parts in each direction; 1 unless given")
      .between(1, 8);
  verb.add_option("--vtu", options->vtu, "ParaView file to write")
      .written_as("a ParaView file", {".vtu"});
  verb.add_flag("--convergence", options->convergence, "Compares with refined meshes");
  verb.add_option(
      "--deflection",
      options->deflection,
      "Also pressed on the ground by this much, such as \"25 mm\", for --convergence and "
      "--place-columns");
  verb.add_flag("--choose-sectors",
                options->choose_sectors,
                "Also chooses the number of sectors, within the same unknowns, for "
                "--place-columns");
  verb.add_flag(
      "--thorough",
      options->thorough,
      "Judges the pressed tire on five meshes in place of three, in about four times the time");
  verb.add_option(
          "--finest",
          options->finest,
          "Compares with meshes refined 2 to this number of times, for --convergence; 4 unless "
          "given")
      .between(3, 8);
  verb.add_option("--place-columns",
                  options->place_columns,
                  "Tire file to write, with columns of elements placed by their effect")
      .written_as("TOML", {".toml"});
  verb.add_option("--unknowns",
                  options->unknowns,
                  "Greatest number of unknowns, for --place-columns; the present number unless "
                  "given")
      .between(1, 10'000'000);
  verb.add_option(
          "--modes",
          options->modes,
          "Number of modes to compare, for --convergence and --place-columns; 20 unless given")
      .between(1, 100);
  const bool alone = false;
  verb.forms({{"prints the counts of a mesh", {}},
              {"compares with refined meshes",
               {"--convergence"},
               {"--deflection", "--thorough", "--finest", "--modes"},
               alone},
              {"places columns of elements",
               {"--place-columns"},
               {"--deflection", "--choose-sectors", "--unknowns", "--modes"},
               alone}});
  verb.callback([=, &program] { program.exit_code = mesh(*options, program.language); });
}

}  // namespace latsch::cli
