// SPDX-License-Identifier: Apache-2.0
// latsch footprint: where a standing tire touches the ground, of every kind of tire that knows it.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/parsed.h"
#include "cli/run/model_source.h"
#include "cli/verbs/verbs.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/footprint_rig.h"
#include "formats/tables/csv_table.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/ring/fe_tire.h"
#include "report/color_map.h"
#include "report/html_text.h"
#include "report/page_style.h"
#include "report/svg_plot.h"

namespace latsch::cli {
namespace {

using experiment::StandingFootprint;
using report::Axis;

struct FootprintOptions {
  std::string tire, kind, camber, output, elements, html;
  std::vector<std::string> loads, deflections;
};

experiment::FootprintTest test_of(const FootprintOptions& options) {
  if (options.loads.empty() == options.deflections.empty())
    throw InputError("--load or --deflection has to be given, one of the two, as often as wanted");
  experiment::FootprintTest test;
  for (const std::string& load : options.loads)
    test.loads.push_back(parse_option("--load", load, "N"));
  for (const std::string& deflection : options.deflections)
    test.deflections.push_back(parse_option("--deflection", deflection, "m"));
  if (!options.camber.empty())
    test.camber = parse_option("--camber", options.camber, "rad", Range::between(-0.5, 0.5));
  return test;
}

Result<std::vector<StandingFootprint>> footprints_of(const FootprintOptions& options,
                                                     const experiment::Language& language) {
  const auto test = test_of(options);
  const ModelSource model = model_source(options.tire, language, options.kind);
  const auto specimen = model.kind->build(model.numbers);
  if (auto* standing = specimen->find<experiment::HasFootprint>())
    return standing->footprints(test);
  throw InputError("a " + model.kind->in_words() + " leaves no footprint");
}

/// All elements, the state they belong to by its number.
Channels element_channels(const std::vector<StandingFootprint>& states) {
  Channel state{"state", "1", {}}, x{"x", "m", {}}, y{"y", "m", {}}, pressure{"pressure", "Pa", {}};
  Channel shear_x{"shear_x", "Pa", {}}, shear_y{"shear_y", "Pa", {}};
  for (std::size_t i = 0; i < states.size(); ++i)
    for (const FootprintElement& at : states[i].footprint.elements) {
      state.values.push_back(static_cast<double>(i + 1));
      x.values.push_back(at.x);
      y.values.push_back(at.y);
      pressure.values.push_back(at.pressure);
      shear_x.values.push_back(at.shear_x);
      shear_y.values.push_back(at.shear_y);
    }
  Channels channels;
  for (Channel* channel : {&state, &x, &y, &pressure, &shear_x, &shear_y})
    channels.add(std::move(*channel));
  return channels;
}

/// From above, forward to the right; millimeters and bar.
std::string picture(const Footprint& print, double most) {
  constexpr double kLeft = 64.0, kTop = 28.0, kScale = 2.2;  // pixels, pixels a millimeter
  double x = 10.0, y = 10.0;
  for (const FootprintElement& at : print.elements) {
    x = std::max(x, 1e3 * (std::abs(at.x) + 0.5 * at.length) + 5.0);
    y = std::max(y, 1e3 * (std::abs(at.y) + 0.5 * at.width) + 5.0);
  }
  const double right = kLeft + 2.0 * kScale * x, bottom = kTop + 2.0 * kScale * y;
  report::Svg svg(right + 110.0, bottom + 48.0, "Pressure in the footprint");
  const Axis along(-x, x, kLeft, right), across(-y, y, bottom, kTop);
  draw_frame(svg, along, across, "x [mm]", "y [mm]");
  for (const FootprintElement& at : print.elements) {
    const report::Point corner(along.at(1e3 * (at.x - 0.5 * at.length)),
                               across.at(1e3 * (at.y + 0.5 * at.width)));
    svg.rectangle(
        corner,
        kScale * 1e3 * at.length,
        kScale * 1e3 * at.width,
        fmt::format("fill=\"{}\"", report::viridis(at.pressure / most)),
        fmt::format(
            "x {:.1f} mm, y {:.1f} mm: {:.2f} bar", 1e3 * at.x, 1e3 * at.y, at.pressure / 1e5));
  }
  draw_color_bar(
      svg, {right + 24.0, kTop}, bottom - kTop, Axis(0.0, most / 1e5, bottom, kTop), "bar");
  return svg.str();
}

std::string page(const std::string& tire, const std::vector<StandingFootprint>& states) {
  const std::string title = "Footprint of " + std::filesystem::path(tire).filename().string();
  std::string text = report::page_begin(title);
  text += "<h1>" + report::escape(title) +
          "</h1>\n<p>Seen from above, forward to the right. Pressure is over the tread with its "
          "grooves; one scale for all pictures.</p>\n";
  double most = 1e-9;
  for (const StandingFootprint& state : states)
    for (const FootprintElement& at : state.footprint.elements) most = std::max(most, at.pressure);
  for (const StandingFootprint& state : states) {
    const Footprint& print = state.footprint;
    text += fmt::format(
        "<section>\n<h2>{:.0f} N</h2>\n<p>Deflection {:.2f} mm; {:.1f} mm long, {:.1f} mm wide, "
        "{:.1f} cm², mean pressure {:.2f} bar.</p>\n{}\n</section>\n",
        print.load,
        1e3 * state.deflection,
        1e3 * print.length,
        1e3 * print.width,
        1e4 * print.area,
        print.mean_pressure() / 1e5,
        picture(print, most));
  }
  return text.append(report::kPageEnd);
}

int footprint(const FootprintOptions& options, const experiment::Language& language) {
  const auto states = footprints_of(options, language);
  if (!states) {
    complain(states.failure().reason);
    return kFailed;
  }
  say("{:>9} {:>16} {:>12} {:>11} {:>11} {:>20}\n",
      "load [N]",
      "deflection [mm]",
      "length [mm]",
      "width [mm]",
      "area [cm²]",
      "mean pressure [bar]");
  answer()["channels"] = answer_of(experiment::to_channels(*states));
  for (const StandingFootprint& state : *states) {
    const Footprint& print = state.footprint;
    say("{:9.1f} {:16.3f} {:12.2f} {:11.2f} {:10.2f} {:20.3f}\n",
        print.load,
        1e3 * state.deflection,
        1e3 * print.length,
        1e3 * print.width,
        1e4 * print.area,
        print.mean_pressure() / 1e5);
  }
  const auto write = [](const std::string& file, const std::string& text) {
    if (file.empty()) return;
    write_text_file(file, text);
    say_written(file);
  };
  if (!options.output.empty())
    write(options.output, formats::csv_text(experiment::to_channels(*states)));
  if (!options.elements.empty())
    write(options.elements, formats::csv_text(element_channels(*states)));
  if (!options.html.empty()) write(options.html, page(options.tire, *states));
  return kDone;
}

}  // namespace

void add_footprint(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("footprint",
                                 "Length, width, area and pressure of a standing tire's patch");
  verb.footer(
      "TIRE is a file with kind = \"ring_tire\", a .tir (its rectangle), or a tire of finite\n"
      "elements. In a study the same is a test: kind = \"footprint\", loads = [\"2 kN\", \"4 "
      "kN\"].\n\n"
      "Examples:\n"
      "  latsch footprint tire.toml --load \"2 kN\" --load \"4 kN\" --html footprint.html\n"
      "  latsch footprint tire.toml --deflection \"20 mm\" --camber \"2 deg\" --elements "
      "blocks.csv");
  auto options = std::make_shared<FootprintOptions>();
  verb.add_option("tire", options->tire, "Tire file").required();
  verb.add_option("--load", options->loads, "As \"4 kN\"; as often as wanted");
  verb.add_option("--deflection", options->deflections, "As \"20 mm\", from first touch");
  verb.add_option("--camber", options->camber, "As \"2 deg\", top to the right");
  verb.add_option("-o,--output", options->output, "CSV file of the table to write");
  verb.add_option("--elements", options->elements, "CSV file of the pressure picture to write");
  verb.add_option("--html", options->html, "Page with the pressure pictures to write");
  verb.add_option("--kind", options->kind, "Of a .tir: magic_formula unless given")
      .one_of(program.language.kind_names());
  verb.callback([=, &program] { program.exit_code = footprint(*options, program.language); });
}

}  // namespace latsch::cli
