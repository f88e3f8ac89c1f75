// SPDX-License-Identifier: Apache-2.0
#include "report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/comparison_plots.h"
#include "report/curve_plot.h"
#include "report/html_parts.h"
#include "report/html_text.h"
#include "report/live_page.h"
#include "report/page_style.h"
#include "report/surface_plot.h"
#include "report/tables.h"
#include "report/tire_pictures.h"
#include "report/value_table.h"

namespace latsch::report {
namespace {

struct Chapter {
  std::string id, title, body;
};

std::string with_kind(const std::string& conditions, bool fitted) {
  return fitted ? conditions : conditions.empty() ? "predicted" : conditions + ", predicted";
}

/// Returns the mean of |1 - simulated / measured|.
double mean_error(const std::vector<double>& measured, const std::vector<double>& simulated) {
  const size_t count = std::min(measured.size(), simulated.size());
  double sum = 0.0;
  for (size_t k = 0; k < count; ++k) sum += std::abs((measured[k] - simulated[k]) / measured[k]);
  return sum / static_cast<double>(std::max<size_t>(1, count));
}

/// Returns the error of an experiment in its own measure in words, such as "RMS error 3 %"; empty
/// if the report has no row for the experiment.
std::string error_of(const StudyReport& report, const std::string& name, const char* between) {
  for (const ExperimentRow& row : report.experiments)
    if (row.name == name)
      return (row.measure == "mean" ? "Mean" : row.measure) + between + small_percent(row.error);
  return "";
}

std::string band_in_words(std::string_view how, const Band& band) {
  if (band.lower.empty()) return "";
  return fmt::format(" {}: 95 % band, as uncertain as the variables are{}.",
                     how,
                     band.inside.empty() ? "" : "; " + band.inside + " inside band and noise");
}

std::string forces(const StudyReport& report) {
  std::string html = "<div class=\"figures\">";
  for (const ComparedForces& curve : report.forces) {
    const std::string of_row = error_of(report, curve.experiment, " |ΔF| = ");
    html += figure(curve.experiment,
                   with_kind(curve.conditions, curve.fitted),
                   force_plot(curve),
                   (of_row.empty() ? "Mean |ΔF| = " +
                                         small_percent(mean_error(curve.measured, curve.simulated))
                                   : of_row) +
                       "; below, ΔF = (measured − simulated) / measured at every point." +
                       band_in_words("Shaded", curve.band));
  }
  return html + "</div>";
}

std::string curves(const StudyReport& report) {
  std::string html = "<div class=\"figures\">";
  for (const MeasuredCurve& curve : report.curves) {
    double sum = 0.0;
    for (const double error : curve.errors) sum += std::abs(error);
    const std::string of_row = error_of(report, curve.experiment, " error ");
    const double mean = sum / static_cast<double>(std::max<size_t>(1, curve.errors.size()));
    html += figure(curve.experiment,
                   with_kind(curve.conditions, curve.fitted),
                   curve_plot(curve),
                   (of_row.empty() ? "Mean error " + small_percent(mean) : of_row) +
                       "; below, (measured − simulated) / scale at every measured value." +
                       band_in_words("Shaded", curve.band));
  }
  return html + "</div>";
}

std::string unmatched(std::string_view words, const std::vector<UnmatchedMode>& modes) {
  if (modes.empty()) return "";
  std::string list;
  for (const UnmatchedMode& mode : modes) {
    list += (list.empty() ? "" : ", ") + mode.label + " (" + fixed(mode.frequency, 1) + " Hz)";
  }
  return fmt::format("<p><b>{}:</b> {}.</p>", escape(words), escape(list));
}

std::string frequencies(const StudyReport& report) {
  std::string html;
  for (const ModalComparison& comparison : report.modes) {
    std::vector<double> measured, simulated;
    for (const ComparedModes& pair : comparison.pairs) {
      measured.push_back(pair.measured);
      simulated.push_back(pair.simulated);
    }
    const std::string of_row = error_of(report, comparison.experiment, " |Δf| = ");
    std::string caption = fmt::format(
        "{} modes paired. {}.",
        comparison.pairs.size(),
        of_row.empty() ? "Mean |Δf| = " + small_percent(mean_error(measured, simulated)) : of_row);
    const bool initial = std::any_of(
        comparison.pairs.begin(), comparison.pairs.end(), [](const ComparedModes& pair) {
          return pair.initial.has_value();
        });
    if (initial) caption += " Dashed: at the initial values.";
    caption += band_in_words("Lines", comparison.band);
    html += figure(comparison.experiment,
                   with_kind(comparison.conditions, comparison.fitted),
                   frequency_plot(comparison),
                   caption);
    html += unmatched("Measured without a simulated partner", comparison.missing);
    html += unmatched("Simulated without a measured partner", comparison.extra);
  }
  return html;
}

/// The report also knows trials outside the search, so its best trial may be better than that of
/// the search; a sentence then says so.
std::string better_beside(const StudyReport& report) {
  double best = std::numeric_limits<double>::infinity();
  for (const double target : report.convergence->target) {
    if (std::isfinite(target)) best = std::min(best, target);
  }
  return report.target < best && percent(report.target, 3) != percent(best, 3)
             ? " A trial of another command, or beside the best one, has " +
                   percent(report.target, 3) + ": everything else on this page belongs to it."
             : "";
}

std::string search(const StudyReport& report) {
  std::string html;
  if (report.convergence && !report.convergence->target.empty()) {
    html += figure("Convergence",
                   "",
                   convergence_plot(*report.convergence),
                   "Target of every trial in the order the optimizer saw them; line: the best so "
                   "far; crosses: failed." +
                       better_beside(report));
  }
  return html + run_facts(report);
}

std::string surfaces(const StudyReport& report) {
  std::string html = "<div class=\"figures\">";
  for (const Surface& surface : report.surfaces) {
    std::string caption = "Dots: trials; rings: minima of the grid, the lowest in orange.";
    if (!surface.held.empty()) caption += " Held: " + surface.held + ".";
    html += figure(surface.x_name + " and " + surface.y_name, "", surface_plot(surface), caption);
  }
  return html + "</div>";
}

std::string basins(const Basins& basins) {
  std::string html =
      fmt::format("<h3>Minima of the design <span>{}</span></h3>", escape(basins.design));
  if (!basins.doubt.empty()) {
    html += fmt::format("<p><span class=\"flag\">too coarse to trust</span> {}.</p>",
                        escape(basins.doubt));
  }
  html += "<div class=\"scroll\"><table><thead><tr><th class=\"n\">Target</th>";
  for (const std::string& name : basins.variables)
    html += "<th class=\"n\">" + escape(name) + "</th>";
  html += "<th class=\"n\">Points that lead there</th></tr></thead><tbody>\n";
  for (const BasinRow& row : basins.rows) {
    html += fmt::format("<tr><td class=\"n\">{}</td>", small_percent(row.target));
    for (const std::string& value : row.values) {
      html += fmt::format("<td class=\"n\">{}</td>", escape(typeset_unit(value)));
    }
    html += fmt::format("<td class=\"n\">{}</td></tr>\n", row.points);
  }
  html += "</tbody></table></div>";
  const auto left = basins.count - std::ssize(basins.rows);
  return left > 0 ? html + fmt::format("<p class=\"quiet\">{} higher ones are left out.</p>", left)
                  : html;
}

std::string effects(const StudyReport& report) {
  std::string html =
      "<p class=\"lead\">Morris' elementary effects: how much the target changes over a variable's "
      "whole range.</p><div class=\"scroll\"><table><thead><tr><th>Variable</th>"
      "<th class=\"n\">μ*, how much it matters</th><th class=\"n\">μ, with its sign</th>"
      "<th class=\"n\">σ, curved or joint</th><th class=\"n\">Effects</th></tr></thead><tbody>\n";
  for (const EffectRow& row : report.effects) {
    html += fmt::format(
        "<tr><td>{}</td><td class=\"n strong\">{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td>"
        "<td class=\"n\">{}</td></tr>\n",
        escape(row.variable),
        percent(row.mu_star),
        signed_percent(row.mu),
        percent(row.sigma),
        row.effects);
  }
  return html + "</tbody></table></div>";
}

std::string shares(const StudyReport& report) {
  std::string html =
      "<p class=\"lead\">Sobol's indices: the share of the variance that a variable causes if all "
      "vary between their bounds, alone (first) and with others (total). Intervals are of 95 "
      "%.</p>";
  for (const SharesOfResponse& response : report.shares) {
    html += fmt::format("<p><b>{}</b>: ", escape(response.response));
    if (response.of.empty()) {
      html += "it does not vary.</p>";
      continue;
    }
    html += fmt::format("the points explain {:.0f} % of the variance{}.</p>",
                        100.0 * response.explained,
                        response.is_trusted ? "" : ", so that the shares are not to be trusted");
    html += fmt::format(
        "<div class=\"scroll{}\"><table><thead><tr><th>Variable</th><th class=\"n\">First</th>"
        "<th class=\"n\">interval</th><th class=\"n\">Total</th><th class=\"n\">interval</th>"
        "</tr></thead><tbody>\n",
        response.is_trusted ? "" : " quiet");
    for (const ShareOfVariance& row : response.of)
      html += fmt::format(
          "<tr><td>{}</td><td class=\"n strong\">{:.0f} %</td><td class=\"n\">{:.0f} .. {:.0f} "
          "%</td>"
          "<td class=\"n strong\">{:.0f} %</td><td class=\"n\">{:.0f} .. {:.0f} %</td></tr>\n",
          escape(row.variable),
          100.0 * row.first,
          100.0 * row.first_lower,
          100.0 * row.first_upper,
          100.0 * row.total,
          100.0 * row.total_lower,
          100.0 * row.total_upper);
    html += "</tbody></table></div>";
  }
  return html;
}

std::string surface_chapter(const StudyReport& report) {
  std::string html = report.surfaces.empty() ? "" : surfaces(report);
  if (report.basins) html += basins(*report.basins);
  return html;
}

std::string patch_figure(const fe_tire::Standing& standing) {
  const std::string picture = patch_picture(standing.patch);
  if (picture.empty()) return "";
  return figure(
      "Contact patch",
      fmt::format(
          "{} N at {} mm", fixed(standing.force.z(), 0), fixed(1e3 * standing.deflection, 1)),
      picture,
      fmt::format("Length {} mm, width {} mm, area {} cm².",
                  fixed(1e3 * standing.patch.length, 0),
                  fixed(1e3 * standing.patch.width, 0),
                  fixed(1e4 * standing.patch.area, 1)));
}

/// Returns a table of the modes that the page shows as animations.
std::string mode_table(const TirePictures& pictures) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < pictures.modes.size(); ++k)
    rows.push_back({pictures.mode_name(k), fixed(pictures.modes[k].frequency, 1)});
  return fmt::format("<h3>Modes <span>{}{}</span></h3>",
                     pictures.modes_loaded ? "loaded tire" : "unloaded tire",
                     pictures.spin.empty() ? "" : ", " + pictures.spin) +
         number_table({"mode", "Hz"}, rows);
}

std::string pictures(const TirePictures& p) {
  std::string html;
  if (p.mesh.sectors > 1) {
    html += figure("Section",
                   fmt::format("{} elements, {} sectors, {} free unknowns",
                               p.mesh.element_count(),
                               p.mesh.sectors,
                               p.mesh.free_dofs()),
                   section_picture(p.mesh, p.layers, p.inflated ? &*p.inflated : nullptr),
                   "As built; dashed: inflated.");
  }
  if (p.loaded) {
    html += "<div class=\"figures\">" + patch_figure(p.loaded->standing);
    if (p.mesh.sectors > 1 && p.inflated) {
      html += figure("Section above the contact",
                     "",
                     loaded_section_picture(
                         p.mesh, *p.inflated, p.loaded->u, p.loaded->standing.loaded_radius),
                     "True to scale; dashed: inflated.");
    }
    html += "</div>";
  }
  return p.modes.empty() ? html : html + mode_table(p);
}

std::string slip_chapter(const StudyReport& report) {
  if (report.slip_plots.empty()) return "";
  std::string html =
      "<p class=\"lead\">The tire found, from its nominal state: load, camber and pressure varied "
      "each alone.";
  if (report.fitted_by)
    html +=
        " Shaded: slips outside of the fitted data. Dashed, <em>assumed</em>: neither the data "
        "nor the model's file determine it.";
  html += "</p><div class=\"figures\">";
  for (const LinePlot& plot : report.slip_plots)
    html += figure(plot.description, "", line_plot(plot), "");
  return html + "</div>";
}

std::vector<Chapter> chapters(const StudyReport& report) {
  std::vector<Chapter> all;
  const auto add = [&all](const char* id, const char* title, std::string body) {
    if (!body.empty()) all.push_back({id, title, std::move(body)});
  };
  add("checks", "Checks", report.checks.empty() ? "" : check_table(report));
  add("variables", "Design variables", report.variables.empty() ? "" : variable_table(report));
  add("experiments", "Experiments", report.experiments.empty() ? "" : experiment_table(report));
  add("values", "Values", report.values.empty() ? "" : value_table(report));
  add("forces", "Forces", report.forces.empty() ? "" : forces(report));
  add("curves", "Curves", report.curves.empty() ? "" : curves(report));
  add("slip", "Force over slip", slip_chapter(report));
  add("frequencies", "Frequencies", report.modes.empty() ? "" : frequencies(report));
  add("surface", "Target surface", surface_chapter(report));
  add("sensitivity",
      "Sensitivity",
      (report.effects.empty() ? "" : effects(report)) +
          (report.shares.empty() ? "" : shares(report)));
  add("identifiability",
      "What the data determine",
      report.identifiability ? identifiability_chapter(*report.identifiability) : "");
  add("search", "Search", search(report));
  add("discretization",
      "Discretization error",
      report.discretization.empty() ? "" : discretization_table(report));
  add("tire", "The tire", report.pictures ? pictures(*report.pictures) : "");
  return all;
}

std::string header(const StudyReport& report, const std::vector<Chapter>& all, bool is_live) {
  std::string line;
  for (const std::string& part : {report.tire, report.study_file, report.date}) {
    if (!part.empty()) line += (line.empty() ? "" : " · ") + escape(part);
  }
  std::string html = fmt::format("<header><h1>{}</h1><p>{}</p><nav>", escape(report.title), line);
  for (const Chapter& chapter : all)
    html += fmt::format("<a href=\"#{}\">{}</a>", chapter.id, chapter.title);
  if (is_live) html += "<a href=\"#/study\">Views that answer</a>";
  html += "</nav></header>\n" + key_numbers(report);
  for (const std::string& remark : report.remarks) html += fmt::format("<p>{}</p>", escape(remark));
  return html;
}

}  // namespace

std::string html(const StudyReport& report, const LivePage* live) {
  const std::vector<Chapter> all = chapters(report);
  std::string page = live ? live_page_begin(report.title, *live) : page_begin(report.title);
  page += header(report, all, live != nullptr);
  for (const Chapter& chapter : all) {
    page += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}\n</section>\n",
                        chapter.id,
                        chapter.title,
                        chapter.body);
  }
  page += fmt::format(
      "<footer>Latsch{}{}</footer>\n",
      report.version.empty() ? "" : fmt::format(" {}", escape(report.version)),
      report.model_file.empty() ? "" : fmt::format(" · model {}", escape(report.model_file)));
  return page + (live ? live_page_end(*live) : std::string(kPageEnd));
}

}  // namespace latsch::report
