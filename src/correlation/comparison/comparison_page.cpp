// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/comparison_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html_parts.h"
#include "report/html_text.h"
#include "report/line_plot.h"
#include "report/page_style.h"

namespace latsch::correlation {
namespace {

using report::escape;
using report::figure;
using report::number_table;
using report::significant;

constexpr int kMeasuredColor = 1;

/// Returns the color of a tire on the whole page. It differs from the color of the measurement.
int color_of_tire(std::size_t tire) { return tire == 0 ? 0 : static_cast<int>(tire) + 1; }

std::string range(FrequencyBand band) {
  return band.upper > 0.0 ? fmt::format("{:.0f} to {:.0f} Hz", band.lower, band.upper) : "nowhere";
}

std::string summary_table(const ComparisonFile& file, const TireComparison& comparison) {
  std::vector<std::string> heads = {"Tire"};
  for (const std::string& channel : file.channels) {
    heads.push_back(fmt::format("{} within {:g} dB", channel, file.agreement));
    heads.push_back(channel + " error in time");
    heads.push_back(channel + " error of PSD");
  }
  heads.emplace_back("CPU over real time");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < file.tires.size(); ++i) {
    const TireSummary& sum = comparison.tires[i];
    std::vector<std::string> cells = {file.tires[i].title};
    for (std::size_t c = 0; c < file.channels.size(); ++c) {
      cells.push_back(range(sum.follows[c]));
      cells.push_back(report::percent(sum.time_error[c], 0));
      cells.push_back(report::percent(sum.psd_error[c], 0));
    }
    cells.push_back(significant(sum.cpu_over_time, 2));
    rows.push_back(std::move(cells));
  }
  return number_table(heads, rows);
}

/// Returns the errors over the tests to which no tire was fitted; empty if the file calls no test
/// or every test fitted.
std::string held_out_table(const ComparisonFile& file, const TireComparison& comparison) {
  const std::size_t count = held_out_tests(file);
  if (count == 0) return "";
  std::vector<std::string> heads = {"Tire, held-out tests alone"};
  for (const std::string& channel : file.channels) {
    heads.push_back(channel + " error in time");
    heads.push_back(channel + " error of PSD");
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < file.tires.size(); ++i) {
    const TireSummary& sum = comparison.tires[i];
    std::vector<std::string> cells = {file.tires[i].title};
    for (std::size_t c = 0; c < file.channels.size(); ++c) {
      cells.push_back(report::percent(sum.held_out_time_error[c], 0));
      cells.push_back(report::percent(sum.held_out_psd_error[c], 0));
    }
    rows.push_back(std::move(cells));
  }
  return number_table(heads, rows) +
         fmt::format(
             "<p>No tire was fitted to {} of the {} tests.</p>\n", count, file.tests.size());
}

std::string needs_table(const ComparisonFile& file) {
  std::string html =
      "<div class=\"scroll\"><table><thead><tr><th>Tire</th><th>Parameters</th>"
      "<th>Built from</th></tr></thead><tbody>\n";
  for (const ComparedTire& tire : file.tires)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        escape(tire.title),
                        escape(tire.parameters),
                        escape(tire.built_from));
  return html + "</tbody></table></div>\n";
}

std::string level_figures(const ComparisonFile& file, const TireComparison& comparison) {
  std::string html = "<div class=\"figures\">";
  std::vector<double> centers;
  for (const FrequencyBand& band : comparison.bands)
    centers.push_back(std::sqrt(band.lower * band.upper));
  for (std::size_t c = 0; c < file.channels.size(); ++c) {
    report::LinePlot plot;
    plot.description = "Level error of " + file.channels[c];
    plot.x_title = "Frequency [Hz]";
    plot.y_title = "Level error [dB]";
    for (std::size_t i = 0; i < file.tires.size(); ++i)
      plot.lines.push_back(
          {file.tires[i].title, centers, comparison.tires[i].level_error[c], color_of_tire(i), {}});
    plot.lines.push_back({fmt::format("{:g} dB", file.agreement),
                          {centers.front(), centers.back()},
                          {file.agreement, file.agreement},
                          kMeasuredColor,
                          {}});
    html += figure(file.channels[c],
                   plot,
                   "Root mean square over the tests of the distance to the measured level, in "
                   "third-octave bands.");
  }
  return html + "</div>";
}

report::LinePlot time_plot(const ComparisonFile& file,
                           const TestComparison& test,
                           const std::string& name,
                           std::size_t channel) {
  report::LinePlot plot;
  plot.description = fmt::format("{} over time in test {}", file.channels[channel], name);
  plot.x_title = "Time [s]";
  plot.y_title = fmt::format("{} [{}]", file.channels[channel], unit_of(file.channels[channel]));
  plot.lines.push_back({"measured", test.time, test.measured[channel].force, kMeasuredColor, {}});
  for (std::size_t i = 0; i < file.tires.size(); ++i)
    plot.lines.push_back({file.tires[i].title,
                          test.time,
                          test.tires[i].channels[channel].force,
                          color_of_tire(i),
                          {}});
  return plot;
}

report::PlotLine density_line(const ComparisonFile& file,
                              const std::string& name,
                              const numerics::Density& density,
                              double highest,
                              int color) {
  report::PlotLine line{name, {}, {}, color, {}};
  for (std::size_t k = 0; k < density.frequency.size(); ++k) {
    if (density.frequency[k] < file.band.lower ||
        density.frequency[k] > std::min(file.band.upper, highest))
      continue;
    line.x.push_back(density.frequency[k]);
    line.y.push_back(density.value[k]);
  }
  return line;
}

report::LinePlot density_plot(const ComparisonFile& file,
                              const TestComparison& test,
                              const std::string& name,
                              std::size_t channel) {
  report::LinePlot plot;
  plot.description = fmt::format("Spectra of {} in test {}", file.channels[channel], name);
  plot.x_title = "Frequency [Hz]";
  const std::string unit = unit_of(file.channels[channel]);
  plot.y_title =
      fmt::format("PSD of {} [{}²/Hz]", file.channels[channel], unit == "N" ? "N" : "(N m)");
  plot.logarithmic_y = true;
  plot.lines.push_back(
      density_line(file, "measured", test.measured[channel].density, test.highest, kMeasuredColor));
  for (std::size_t i = 0; i < file.tires.size(); ++i)
    plot.lines.push_back(density_line(file,
                                      file.tires[i].title,
                                      test.tires[i].channels[channel].density,
                                      test.highest,
                                      color_of_tire(i)));
  return plot;
}

std::string error_table(const ComparisonFile& file, const TestComparison& test) {
  std::vector<std::string> heads = {"Tire"};
  for (const std::string& channel : file.channels) {
    heads.push_back(channel + " error in time");
    heads.push_back(channel + " error of PSD");
  }
  heads.emplace_back("CPU over real time");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < file.tires.size(); ++i) {
    std::vector<std::string> cells = {file.tires[i].title};
    for (std::size_t c = 0; c < file.channels.size(); ++c) {
      cells.push_back(report::percent(test.tires[i].time_error[c], 1));
      cells.push_back(report::percent(test.tires[i].psd_error[c], 1));
    }
    cells.push_back(significant(test.tires[i].cpu_over_time, 2));
    rows.push_back(std::move(cells));
  }
  return number_table(heads, rows);
}

std::string test_chapter(const ComparisonFile& file,
                         const TireComparison& comparison,
                         std::size_t t) {
  const ComparisonTest& test = file.tests[t];
  const TestComparison& compared = comparison.tests[t];
  std::string html =
      fmt::format("<section><h2>{}</h2><p>{}{}.</p>",
                  escape(test.name),
                  escape(test.in_words),
                  test.fitted ? "; the tires were fitted to this test" : "; held out of every fit");
  html += error_table(file, compared) + "<div class=\"figures\">";
  for (std::size_t c = 0; c < file.channels.size(); ++c) {
    html += figure(file.channels[c],
                   time_plot(file, compared, test.name, c),
                   "Force on the hub; at time 0 the cleat is below the axle.");
    html += figure(file.channels[c],
                   density_plot(file, compared, test.name, c),
                   "Power spectral density of the record.");
  }
  return html + "</div></section>\n";
}

/// Lists the limits that the specimen and the tires met; empty if they met none.
std::string limits_list(const ComparisonFile& file, const TireComparison& comparison) {
  std::string items;
  for (const std::string& limit : comparison.limits_of_specimen)
    items += "<li>" + escape("the specimen: " + limit) + "</li>";
  for (std::size_t i = 0; i < file.tires.size(); ++i)
    for (const std::string& limit : limits_of_tire(file, comparison, i))
      items += "<li>" + escape(file.tires[i].title + ": " + limit) + "</li>";
  return items.empty() ? "" : "<h3>Limits that the tires met</h3><ul>" + items + "</ul>";
}

std::string verdict_chapter(const ComparisonFile& file, const TireComparison& comparison) {
  std::string html = "<section><h2>What each tire can do</h2><ul>";
  for (const std::string& sentence : verdicts(file, comparison))
    html += "<li>" + escape(sentence) + "</li>";
  html += "</ul>";
  for (const std::string& remark : comparison.remarks) html += "<p>" + escape(remark) + ".</p>";
  html += limits_list(file, comparison);
  html += summary_table(file, comparison) + held_out_table(file, comparison) + needs_table(file);
  html += fmt::format(
      "<p>Errors are means over {} tests, of the root mean square of the measured force about its "
      "mean and of its spectral density from {} to {} Hz. A tire reproduces a force over the "
      "longest sequence of third-octave bands whose level is at most {:g} dB off; bands in which "
      "noise has more than a quarter of "
      "the power are left out. CPU time is that of one core, including the settling at the "
      "start.{}</p></section>\n",
      file.tests.size(),
      significant(file.band.lower, 3),
      significant(file.band.upper, 3),
      file.agreement,
      file.specimen ? fmt::format(" The specimen takes {} of real time.",
                                  significant(comparison.specimen_cpu_over_time, 2) + " times")
                    : "");
  return html;
}

}  // namespace

std::string comparison_page(const ComparisonFile& file, const TireComparison& comparison) {
  std::string html = report::page_begin(file.title);
  html += fmt::format("<header><h1>{}</h1><p>{}; measured: {}.</p></header>\n",
                      escape(file.title),
                      escape(file.file.filename().string()),
                      file.specimen
                          ? escape("the specimen " + file.specimen->tire.file.filename().string() +
                                   ", a simulated tire with noise")
                          : "recordings");
  html += verdict_chapter(file, comparison);
  html +=
      "<section><h2>Errors over frequency</h2>" + level_figures(file, comparison) + "</section>\n";
  for (std::size_t t = 0; t < file.tests.size(); ++t) html += test_chapter(file, comparison, t);
  return html.append(report::kPageEnd);
}

}  // namespace latsch::correlation
