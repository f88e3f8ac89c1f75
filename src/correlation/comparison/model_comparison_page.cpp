// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/model_comparison_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "correlation/comparison/comparison_effects.h"
#include "report/html_parts.h"
#include "report/html_text.h"
#include "report/line_plot.h"
#include "report/page_style.h"

namespace latsch::correlation {
namespace {

using report::escape;
using report::figure;
using report::fixed;
using report::number_table;
using report::percent;
using report::significant;

constexpr int kReferenceColor = 1;

/// Returns the color of a model on the whole page. It differs from the color of the reference.
int color_of_model(std::size_t model) { return model == 0 ? 0 : static_cast<int>(model) + 1; }

std::string in_words(const NamedBand& band) {
  return fmt::format("{}, {:g} to {:g} Hz", band.name, band.band.lower, band.band.upper);
}

std::vector<std::string> heads_of(const ModelComparisonFile& file, const std::string& first) {
  std::vector<std::string> heads = {first};
  for (const ComparedModel& model : file.models) heads.push_back(model.title);
  return heads;
}

std::string distance_tables(const ModelComparisonFile& file, const ModelComparison& comparison) {
  std::string html;
  for (std::size_t b = 0; b < file.bands.size(); ++b) {
    std::vector<std::vector<std::string>> rows;
    const auto add = [&](const std::string& name, const std::vector<std::size_t>& cases) {
      std::vector<std::string> row = {name};
      for (std::size_t m = 0; m < file.models.size(); ++m)
        row.push_back(fmt::format("{} ({} dB)",
                                  percent(mean_distance(comparison, cases, m, b), 0),
                                  fixed(mean_distance(comparison, cases, m, b, true), 1)));
      rows.push_back(std::move(row));
    };
    for (std::size_t t = 0; t < file.tests.size(); ++t)
      add(fmt::format("{} ({} cases)", file.tests[t].name, cases_of(file, t).size()),
          cases_of(file, t));
    add("all", all_cases(file));
    html += fmt::format("<h3>{}</h3>\n", escape(in_words(file.bands[b]))) +
            number_table(heads_of(file, "Test"), rows);
  }
  return html;
}

std::string effect_table(const ModelComparisonFile& file, const ModelComparison& comparison) {
  if (file.factors.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& name, const std::vector<std::size_t>& cases) {
    for (std::size_t b = 0; b < file.bands.size(); ++b) {
      const FactorialEffects e = mean_effects(file, comparison, cases, b, false);
      rows.push_back({name + ", " + file.bands[b].name,
                      percent(e.distance[0][0], 0),
                      percent(e.distance[0][1], 0),
                      percent(e.distance[1][0], 0),
                      percent(e.distance[1][1], 0),
                      report::signed_percent(e.first, 0),
                      report::signed_percent(e.second, 0),
                      report::signed_percent(e.interaction, 0),
                      percent(e.first_is_larger, 0)});
    }
  };
  for (std::size_t t = 0; t < file.tests.size(); ++t) add(file.tests[t].name, cases_of(file, t));
  add("all", all_cases(file));
  const std::string& first = file.factors[0];
  const std::string& second = file.factors[1];
  return "<h2>Two factors</h2>\n<p>Distances at both levels of " + escape(first) + " and " +
         escape(second) +
         ", main effects and interaction of the 2&nbsp;×&nbsp;2 design: a negative effect brings "
         "the model nearer to the reference.</p>\n" +
         number_table({"Cases",
                       "neither",
                       second,
                       first,
                       "both",
                       "effect of " + first,
                       "effect of " + second,
                       "interaction",
                       first + " is the larger in"},
                      rows);
}

std::string sensitivity_table(const ModelComparisonFile& file, const ModelComparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const GridSensitivity& one : sensitivities(file, comparison)) {
    const GridTest& test = file.tests[one.test];
    const VariedNumber& varied = test.varied[one.varied];
    for (std::size_t level = 0; level < varied.values.size(); ++level) {
      std::vector<std::string> row = {fmt::format("{}: {} {} {}",
                                                  test.name,
                                                  varied.path,
                                                  significant(varied.values[level], 4),
                                                  varied.unit)};
      for (std::size_t m = 0; m < file.models.size(); ++m)
        row.push_back(percent(one.mean[m][level], 0));
      rows.push_back(std::move(row));
    }
    std::vector<std::string> row = {fmt::format("{}: range over {}", test.name, varied.path)};
    for (std::size_t m = 0; m < file.models.size(); ++m) row.push_back(percent(one.range(m), 0));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  return "<h2>Sensitivity of the distance</h2>\n<p>In " + escape(in_words(file.bands[0])) +
         ": means over the levels of the other numbers of the grid.</p>\n" +
         number_table(heads_of(file, "Level"), rows);
}

std::string told_table(const ModelComparisonFile& file, const ModelComparison& comparison) {
  if (file.told.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < file.told.size(); ++k)
    for (std::size_t t = 0; t < file.tests.size(); ++t) {
      std::vector<std::string> row = {file.told[k] + ", " + file.tests[t].name};
      for (std::size_t m = 0; m < file.models.size(); ++m) {
        double sum = 0.0;
        const auto cases = cases_of(file, t);
        for (const std::size_t i : cases) sum += comparison.cases[i].models[m].told[k];
        row.push_back(significant(sum / static_cast<double>(cases.size()), 4));
      }
      rows.push_back(std::move(row));
    }
  return "<h2>Other channels</h2>\n<p>Means over the record and the cases, SI.</p>\n" +
         number_table(heads_of(file, "Channel"), rows);
}

constexpr double kDecibels = 4.342945;  // 10 / ln 10: decibels of a natural logarithm of 1

/// Returns the mean over cases and channels; NaN if the model has no bands.
double mean_of(const ModelComparison& comparison,
               const std::vector<std::size_t>& cases,
               std::size_t model,
               std::vector<double> ModelRun::*values) {
  double sum = 0.0, count = 0.0;
  for (const std::size_t i : cases)
    for (const double value : comparison.cases[i].models[model].*values) {
      sum += value;
      count += 1.0;
    }
  return count > 0.0 ? sum / count : std::nan("");
}

/// Returns for example "82 % (± 1.4 dB)".
std::string coverage_text(const ModelComparison& comparison,
                          const std::vector<std::size_t>& cases,
                          std::size_t model) {
  const double share = mean_of(comparison, cases, model, &ModelRun::coverage);
  if (!std::isfinite(share)) return "–";
  return fmt::format("{} (± {:.1f} dB)",
                     percent(share, 0),
                     kDecibels * mean_of(comparison, cases, model, &ModelRun::reach));
}

std::string span_of(const SpectralDiscrepancy& discrepancy, FrequencyBand band) {
  double low = INFINITY, high = 0.0;
  for (std::size_t k = 0; k < discrepancy.frequency.size(); ++k) {
    if (discrepancy.frequency[k] < band.lower || discrepancy.frequency[k] > band.upper) continue;
    low = std::min(low, discrepancy.deviation[k]);
    high = std::max(high, discrepancy.deviation[k]);
  }
  if (low > high) return "–";
  return fmt::format("{:.1f} to {:.1f} dB", kDecibels * low, kDecibels * high);
}

std::string fit_table(const ModelComparisonFile& file, const ModelComparison& comparison) {
  if (file.fits.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  std::string remarks;
  for (std::size_t k = 0; k < file.fits.size(); ++k) {
    const FitPosterior& fit = comparison.fits[k];
    std::string models;
    for (const ComparedModel& model : file.models)
      if (std::find(model.fits.begin(), model.fits.end(), k) != model.fits.end())
        models += (models.empty() ? "" : ", ") + model.title;
    rows.push_back({fit.name + ": " + file.fits[k].study->title,
                    models,
                    fmt::format("{}", file.fits[k].study->space.size()),
                    file.fits[k].has_bands ? significant(fit.excess, 2) : "–",
                    file.fits[k].has_bands ? significant(fit.held_out, 2) : "–",
                    span_of(fit.discrepancy, file.bands[0].band)});
    for (const std::string& remark : fit.remarks)
      remarks += "<li>" + escape(fit.name + ": " + remark) + "</li>\n";
  }
  return number_table({"Fit",
                       "Models that come from it",
                       "Variables",
                       "Residuals over stated noise",
                       "Held out over explained",
                       "Error of its spectra"},
                      rows) +
         (remarks.empty() ? "" : "<ul>\n" + remarks + "</ul>\n");
}

std::string coverage_table(const ModelComparisonFile& file, const ModelComparison& comparison) {
  if (file.uncertainties.empty() && file.fits.empty()) return "";
  const bool has_bands =
      !file.uncertainties.empty() ||
      std::ranges::any_of(file.fits, [](const FitSource& fit) { return fit.has_bands; });
  if (!has_bands) return "<h2>Fits</h2>\n" + fit_table(file, comparison);
  std::string html =
      "<h2>Bands</h2>\n<p>" + escape(bands_in_words(file)) + "</p>\n" + fit_table(file, comparison);
  std::vector<std::vector<std::string>> rows;
  for (const Uncertainty& one : file.uncertainties)
    rows.push_back({one.name, percent(one.spread, 0), one.source});
  if (!rows.empty()) html += number_table({"Typed number", "Spread", "Source"}, rows);
  rows.clear();
  const auto add = [&](const std::string& name, const std::vector<std::size_t>& cases) {
    std::vector<std::string> row = {name};
    for (std::size_t m = 0; m < file.models.size(); ++m)
      row.push_back(coverage_text(comparison, cases, m));
    rows.push_back(std::move(row));
  };
  for (std::size_t t = 0; t < file.tests.size(); ++t) add(file.tests[t].name, cases_of(file, t));
  add("all", all_cases(file));
  return html +
         "<p>Share of the reference's lines inside, its noise included, and the mean half width of "
         "the bands, in " +
         escape(in_words(file.bands[0])) + ".</p>\n" + number_table(heads_of(file, "Test"), rows);
}

report::PlotLine density_line(const ModelComparisonFile& file,
                              const std::string& name,
                              const numerics::Density& density,
                              int color,
                              double scale,
                              const ModelRun* run = nullptr,
                              std::size_t channel = 0) {
  report::PlotLine line{name, {}, {}, color, {}};
  for (std::size_t k = 0; k < density.frequency.size(); ++k) {
    const double f = density.frequency[k];
    if (f < file.bands[0].band.lower || f > file.bands[0].band.upper) continue;
    line.x.push_back(f / scale);
    line.y.push_back(density.value[k]);
    if (!run || run->lower.empty()) continue;
    line.lower.push_back(run->lower[channel][k]);
    line.upper.push_back(run->upper[channel][k]);
  }
  return line;
}

report::LinePlot density_plot(const ModelComparisonFile& file,
                              const CaseComparison& compared,
                              const ComparedCase& one,
                              std::size_t channel,
                              bool is_normalized) {
  report::LinePlot plot;
  const double scale = is_normalized ? file.normalize : 1.0;
  plot.description = fmt::format("Spectra of {} in {}", file.channels[channel], one.name);
  plot.x_title =
      is_normalized ? fmt::format("Frequency over {:g} Hz", file.normalize) : "Frequency [Hz]";
  plot.y_title = fmt::format("PSD of {}", file.channels[channel]);
  plot.logarithmic_y = true;
  plot.lines.push_back(density_line(
      file, file.reference.title, compared.reference[channel], kReferenceColor, scale));
  for (std::size_t m = 0; m < file.models.size(); ++m)
    plot.lines.push_back(density_line(file,
                                      file.models[m].title,
                                      compared.models[m].densities[channel],
                                      color_of_model(m),
                                      scale,
                                      &compared.models[m],
                                      channel));
  if (one.mark <= 0.0) return plot;
  double low = INFINITY, high = 0.0;
  for (const report::PlotLine& line : plot.lines)
    for (const double value : line.y) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  plot.lines.push_back(
      {fmt::format("{:.1f} Hz{}",
                   one.mark,
                   file.normalize > 0.0 ? fmt::format(" = {:.2f}", one.mark / file.normalize) : ""),
       {one.mark / scale, one.mark / scale},
       {low, high},
       7,
       {}});
  return plot;
}

/// Returns the samples over time, the reference's first.
report::LinePlot time_plot(const ModelComparisonFile& file,
                           const CaseComparison& compared,
                           const ComparedCase& one,
                           std::size_t channel) {
  report::LinePlot plot;
  plot.description = fmt::format("{} over time in {}", file.channels[channel], one.name);
  const std::string& unit = compared.units[channel];
  plot.x_title = "Time [s]";
  plot.y_title = file.channels[channel] + (unit.empty() || unit == "1" ? "" : " [" + unit + "]");
  plot.lines.push_back(
      {file.reference.title, compared.times, compared.samples[channel], kReferenceColor, {}});
  for (std::size_t m = 0; m < file.models.size(); ++m)
    plot.lines.push_back({file.models[m].title,
                          compared.models[m].times,
                          compared.models[m].samples[channel],
                          color_of_model(m),
                          {}});
  return plot;
}

/// Draws the channels over time in the middle case of each test; all cases would make a page of
/// many megabytes.
std::string time_figures(const ModelComparisonFile& file, const ModelComparison& comparison) {
  std::string html = "<h2>Over time</h2>\n";
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    const auto cases = cases_of(file, t);
    const std::size_t i = cases[cases.size() / 2];
    const ComparedCase& one = file.cases[i];
    html += fmt::format("<h3>{}{}{}</h3>\n<div class=\"figures\">",
                        escape(one.name),
                        one.in_words.empty() ? "" : ": ",
                        escape(one.in_words));
    for (std::size_t c = 0; c < file.channels.size(); ++c)
      html += figure(file.channels[c], time_plot(file, comparison.cases[i], one, c), "");
    html += "</div>\n";
  }
  return html;
}

std::string case_figures(const ModelComparisonFile& file, const ModelComparison& comparison) {
  std::string html = "<h2>Spectra</h2>\n";
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    const auto cases = cases_of(file, t);
    const std::size_t middle = cases[cases.size() / 2];
    for (const std::size_t i : cases) {
      const ComparedCase& one = file.cases[i];
      const CaseComparison& compared = comparison.cases[i];
      html += fmt::format("<details{}><summary>{}{}{}</summary>\n<div class=\"figures\">",
                          i == middle ? " open" : "",
                          escape(one.name),
                          one.in_words.empty() ? "" : ": ",
                          escape(one.in_words));
      for (std::size_t c = 0; c < file.channels.size(); ++c) {
        std::string caption = fmt::format("Distance, {}:", in_words(file.bands[0]));
        for (std::size_t m = 0; m < file.models.size(); ++m)
          caption += fmt::format("{} {} {}",
                                 m == 0 ? "" : ";",
                                 file.models[m].title,
                                 percent(compared.models[m].distance[0][c], 0));
        html += figure(file.channels[c],
                       density_plot(file, compared, one, c, i == middle && file.normalize > 0.0),
                       caption + ".");
      }
      html += "</div></details>\n";
    }
  }
  return html;
}

}  // namespace

std::string bands_in_words(const ModelComparisonFile& file) {
  std::string text = fmt::format("A band of {:g} % holds, ", 100.0 * file.level) +
                     (file.samples > 0 ? fmt::format("by quantiles over {} samples", file.samples)
                                       : std::string("to first order of the logarithm")) +
                     ":";
  if (!file.fits.empty())
    text +=
        " the uncertainty that the model's fits leave in their variables, with correlations and "
        "inside their bounds, widened by the ratio of residuals to stated noise and of held-out "
        "errors to explained ones; the error of the fits' own spectra beyond all that, "
        "third octave by third octave, assumed to be the same in the prediction;";
  if (!file.uncertainties.empty()) text += " the typed spreads;";
  return text +
         " but not the effect of numbers that are neither fitted nor stated, of the driving of "
         "the reference, or of any effect that did not occur on the rig of a fit.";
}

std::vector<std::string> findings(const ModelComparisonFile& file,
                                  const ModelComparison& comparison) {
  std::vector<std::string> sentences;
  const auto cases = all_cases(file);
  for (std::size_t m = 0; m < file.models.size(); ++m) {
    std::string text = file.models[m].title + ": PSD distance to " + file.reference.title;
    for (std::size_t b = 0; b < file.bands.size(); ++b)
      text += fmt::format("{} {:.0f} % ({:.1f} dB) in {}",
                          b == 0 ? "" : ",",
                          100.0 * mean_distance(comparison, cases, m, b),
                          mean_distance(comparison, cases, m, b, true),
                          in_words(file.bands[b]));
    sentences.push_back(text + ".");
  }
  for (std::size_t m = 0; m < file.models.size(); ++m) {
    const double share = mean_of(comparison, cases, m, &ModelRun::coverage);
    if (std::isfinite(share))
      sentences.push_back(
          fmt::format("{}: bands of {:g} % hold {:.0f} % of the lines of {}; they are ± {:.1f} dB "
                      "wide on average.",
                      file.models[m].title,
                      100.0 * file.level,
                      100.0 * share,
                      file.reference.title,
                      kDecibels * mean_of(comparison, cases, m, &ModelRun::reach)));
  }
  if (file.factors.empty()) return sentences;
  for (std::size_t b = 0; b < file.bands.size(); ++b)
    for (const bool in_decibels : {false, true}) {
      const FactorialEffects e = mean_effects(file, comparison, cases, b, in_decibels);
      const double unit = in_decibels ? 1.0 : 100.0;
      sentences.push_back(
          fmt::format("{}: effect of {} {:+.1f} {}, of {} {:+.1f}, interaction {:+.1f}; {} is the "
                      "larger in {:.0f} % of {} cases.",
                      in_words(file.bands[b]),
                      file.factors[0],
                      unit * e.first,
                      in_decibels ? "dB" : "%",
                      file.factors[1],
                      unit * e.second,
                      unit * e.interaction,
                      file.factors[0],
                      100.0 * e.first_is_larger,
                      cases.size()));
    }
  return sentences;
}

std::string model_comparison_page(const ModelComparisonFile& file,
                                  const ModelComparison& comparison) {
  std::string html(report::page_begin(file.title));
  html += fmt::format("<header><h1>{}</h1><p>{} models, {} cases, beside {}</p></header>\n<ul>\n",
                      escape(file.title),
                      file.models.size(),
                      file.cases.size(),
                      escape(file.reference.title));
  for (const std::string& sentence : findings(file, comparison))
    html += "<li>" + escape(sentence) + "</li>\n";
  const auto limits = limits_of_models(file, comparison);
  if (!limits.empty()) html += "</ul>\n<h2>Limits that the models met</h2>\n<ul>\n";
  for (const std::string& limit : limits) html += "<li>" + escape(limit) + "</li>\n";
  html +=
      "</ul>\n<h2>Distances</h2>\n<p>RMS of the difference of both power spectral densities "
      "over the RMS of the reference's, lines of the band, mean over the channels; in "
      "brackets the log-spectral distance.</p>\n" +
      distance_tables(file, comparison) + effect_table(file, comparison) +
      sensitivity_table(file, comparison) + coverage_table(file, comparison) +
      told_table(file, comparison);
  if (file.pictures) {
    html += fmt::format("<h2>{} in {}</h2>\n",
                        escape(file.models[file.pictures->first].title),
                        escape(file.cases[file.pictures->second].name));
    if (!comparison.pictures.empty()) {  // the first picture is as wide as the page
      const auto& first = comparison.pictures.front();
      html += figure(first.title, "", first.svg, first.caption);
    }
    html += "<div class=\"figures\">";
    for (std::size_t k = 1; k < comparison.pictures.size(); ++k)
      html += figure(comparison.pictures[k].title,
                     "",
                     comparison.pictures[k].svg,
                     comparison.pictures[k].caption);
    html += "</div>\n";
  }
  html += time_figures(file, comparison) + case_figures(file, comparison);
  return html + std::string(report::kPageEnd);
}

}  // namespace latsch::correlation
