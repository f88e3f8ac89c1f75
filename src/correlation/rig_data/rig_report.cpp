// SPDX-License-Identifier: Apache-2.0
#include "correlation/rig_data/rig_report.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "base/units.h"
#include "correlation/rig_data/rig_tables.h"
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
using report::true_minus;

std::string kph(double speed) { return format_quantity(speed, "km/h", 4); }

std::vector<double> times(std::size_t count, double rate) {
  std::vector<double> t(count);
  for (std::size_t i = 0; i < count; ++i) t[i] = static_cast<double>(i) / rate;
  return t;
}

std::string plateau_table(const RigResults& results) {
  std::vector<std::vector<std::string>> rows;
  for (const ProcessedRun& run : results.runs) {
    for (const ProcessedPlateau& p : run.plateaus) {
      double likeness = 1.0;
      for (const double value : p.passages.likeness) likeness = std::min(likeness, value);
      rows.push_back({run.name + " at " + kph(p.plateau.target),
                      significant(run.record.time(p.plateau.first), 5),
                      significant(run.record.time(p.plateau.end), 5),
                      significant(p.plateau.mean * 3.6, 5),
                      significant(p.plateau.range * 3.6, 2),
                      significant(p.period.samples / run.record.rate * 1e3, 7),
                      significant(p.period.strength, 3),
                      std::to_string(p.passages.starts.size()),
                      std::to_string(p.passages.left_out),
                      significant(likeness, 4)});
    }
  }
  return number_table({"Run",
                       "From s",
                       "To s",
                       "Speed km/h",
                       "Its range km/h",
                       "Period ms",
                       "Strength",
                       "Passages",
                       "Left out",
                       "Least likeness"},
                      rows);
}

std::string speed_figures(const RigFile& rig, const RigResults& results) {
  std::string html = "<div class=\"figures\">";
  for (const ProcessedRun& run : results.runs) {
    report::LinePlot plot;
    plot.description = "Speed of " + run.name;
    plot.x_title = "Time [s]";
    plot.y_title = "Speed [km/h]";
    std::vector<double> speed = smooth_speed(run.record, rig.speed, rig.plateaus);
    for (double& v : speed) v *= 3.6;
    const auto t = times(speed.size(), run.record.rate);
    plot.lines.push_back({"low-passed", t, speed, 0, {}});
    for (const ProcessedPlateau& p : run.plateaus) {
      const auto from = t.begin() + p.plateau.first, to = t.begin() + p.plateau.end;
      const auto v = speed.begin() + p.plateau.first;
      plot.lines.push_back({p.plateau.target == rig.speeds[0] ? "plateaus" : "",
                            {from, to},
                            {v, v + p.plateau.samples()},
                            1,
                            {}});
    }
    html += figure(run.name, plot, "Speed, low-passed without delay, and the part that is used.");
  }
  return html + "</div>";
}

std::string average_figures(const RigFile& rig, const RigResults& results) {
  std::string html = "<div class=\"figures\">";
  for (const ProcessedRun& run : results.runs) {
    for (const ProcessedPlateau& p : run.plateaus) {
      const auto& average = p.channels[0].average;
      report::LinePlot plot;
      plot.description = "Average passage of " + run.name;
      plot.x_title = "Time [s]";
      plot.y_title = fmt::format("{} [{}]", rig.force, p.channels[0].unit);
      plot.lines.push_back(
          {"", times(average.mean.size(), run.record.rate), average.mean, 0, average.spread});
      html += figure(run.name + " at " + kph(p.plateau.target),
                     plot,
                     fmt::format("Mean of {} passages and their standard deviation.",
                                 p.passages.starts.size()));
    }
  }
  return html + "</div>";
}

report::PlotLine in_band(const RigFile& rig,
                         const std::string& name,
                         const std::vector<double>& f,
                         const std::vector<double>& y,
                         int color) {
  report::PlotLine line{name, {}, {}, color, {}};
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (f[k] < rig.band.lower || f[k] > rig.band.upper) continue;
    line.x.push_back(f[k]);
    line.y.push_back(y[k]);
  }
  return line;
}

std::string spectrum_figures(const RigFile& rig, const RigResults& results) {
  std::string html = "<div class=\"figures\">";
  for (const ProcessedRun& run : results.runs) {
    report::LinePlot density, coherence;
    density.description = "Spectra of " + run.name;
    density.x_title = coherence.x_title = "Frequency [Hz]";
    density.y_title = fmt::format("PSD [({})²/Hz]", run.plateaus[0].channels[0].unit);
    density.logarithmic_y = true;
    coherence.description = "Coherence of the passages of " + run.name;
    coherence.y_title = "Coherence";
    int color = 0;
    for (const ProcessedPlateau& p : run.plateaus) {
      density.lines.push_back(
          in_band(rig, kph(p.plateau.target), p.density.frequency, p.density.value, color));
      coherence.lines.push_back(
          in_band(rig, kph(p.plateau.target), p.coherence.frequency, p.coherence.value, color++));
    }
    html += figure(run.name, density, "Power spectral density of the average passages.");
    html += figure(
        run.name, coherence, "Part of the power that every passage repeats; noise: 1/passages.");
  }
  return html + "</div>";
}

std::vector<std::string> response_cells(const std::string& name,
                                        const RigResponse& r,
                                        const ResponseDeviation& d) {
  const auto cell = [](double value, double deviation) {
    if (!(deviation > 0.0)) return significant(value, 5);
    return true_minus(format_known(value, deviation)) + " ± " + format_known(deviation, deviation);
  };
  return {name,
          cell(r.f / kTwoPi, d.f / kTwoPi),
          cell(r.zeta, d.zeta),
          cell(r.gain(), d.gain),
          cell(r.c, d.c)};
}

std::string responses(const RigFile& rig, const RigResults& results) {
  std::vector<std::vector<std::string>> rows;
  const auto truth = rig.truth ? std::optional(rig.truth->rig.response) : std::nullopt;
  if (results.hammer) {
    const HammerResult& h = *results.hammer;
    rows.push_back(response_cells(fmt::format("Rig, by {} hits of the hammer", h.measured.hits),
                                  h.fit.response,
                                  h.over_hits));
  }
  if (truth) rows.push_back(response_cells("Rig, truth", *truth, {}));
  if (results.compensation) {
    const CompensationResult& c = *results.compensation;
    rows.push_back(response_cells(
        c.fit ? "Filter dummy to real, fitted" : "Filter dummy to real, inverse of the rig",
        c.filter_response,
        c.over_hits));
    if (const auto back = truth ? inverse(*truth) : std::nullopt) {
      rows.push_back(response_cells("Filter dummy to real, truth", *back, {}));
    }
  }
  std::string html =
      "<p>TF(s) = A / (s² + 2 f ζ s + f²) + c (3-3); ± is one standard deviation over resampled "
      "hits.</p>" +
      number_table({"Response", "f Hz", "ζ", "A/f²", "c"}, rows);
  if (!results.hammer) return html;
  const MeasuredResponse& m = results.hammer->measured;
  std::vector<double> measured, fitted;
  for (std::size_t k = 0; k < m.H.size(); ++k) {
    measured.push_back(std::abs(m.H[k]));
    fitted.push_back(std::abs(results.hammer->fit.response.at(kTwoPi * m.frequency[k])));
  }
  report::LinePlot plot;
  plot.description = "Frequency response of the rig";
  plot.x_title = "Frequency [Hz]";
  plot.y_title = "|H|";
  plot.lines = {in_band(rig, "hammer", m.frequency, measured, 1),
                in_band(rig, "fitted", m.frequency, fitted, 0)};
  return html + "<div class=\"figures\">" +
         figure("Hammer test", plot, "Frequency response of the rig and (3-3) fitted to it.") +
         "</div>";
}

std::string change(double before, double after) {
  return fmt::format("{} → {} ({})",
                     significant(before, 4),
                     significant(after, 4),
                     report::signed_percent(after / before - 1.0, 0));
}

std::string case_chapter(const RigFile& rig, const RigResults& results) {
  const CompensationResult& c = *results.compensation;
  std::vector<std::vector<std::string>> rows;
  double time = 0.0, psd = 0.0;
  int held_out = 0;
  for (const CaseRow& row : c.cases) {
    rows.push_back({row.name + (row.fitted ? " (fitted)" : ""),
                    kph(row.speed),
                    change(row.dummy.time, row.filtered.time),
                    change(row.dummy.psd, row.filtered.psd),
                    change(row.dummy.level, row.filtered.level)});
    if (row.fitted) continue;
    time += row.filtered.time / row.dummy.time - 1.0;
    psd += row.filtered.psd / row.dummy.psd - 1.0;
    ++held_out;
  }
  if (held_out > 0) {
    rows.push_back({"Mean of those not fitted",
                    "",
                    report::signed_percent(time / held_out, 0),
                    report::signed_percent(psd / held_out, 0),
                    ""});
  }
  std::string html =
      "<p>Against the real rim, dummy rim → dummy rim filtered; averages without their means, "
      "after "
      "the delay that makes them most alike.</p>" +
      number_table(
          {"Case", "Speed", "RMS of time series N", "RMS of PSD N²/Hz", "Distance of PSD dB"},
          rows) +
      "<div class=\"figures\">";
  for (const CaseRow& row : c.cases) {
    const auto t = times(row.real.size(), results.runs[0].record.rate);
    report::LinePlot plot;
    plot.description = "Case " + row.name;
    plot.x_title = "Time [s]";
    plot.y_title = rig.force + " [N]";
    plot.lines = {{"real", t, row.real, 1, {}},
                  {"dummy", t, row.before, 5, {}},
                  {"filtered", t, row.after, 0, {}}};
    html += figure("Case " + row.name, plot, "Average passages.");
    report::LinePlot spectra;
    spectra.description = "Spectra of case " + row.name;
    spectra.x_title = "Frequency [Hz]";
    spectra.y_title = "PSD [N²/Hz]";
    spectra.logarithmic_y = true;
    const auto& f = row.real_density.frequency;
    spectra.lines = {in_band(rig, "real", f, row.real_density.value, 1),
                     in_band(rig, "dummy", f, row.before_density.value, 5),
                     in_band(rig, "filtered", f, row.after_density.value, 0)};
    html += figure("Case " + row.name, spectra, "Power spectral densities.");
  }
  return html + "</div>";
}

std::string chapter(const std::string& title, const std::string& body) {
  return fmt::format("<section><h2>{}</h2>{}</section>\n", escape(title), body);
}

}  // namespace

std::string rig_page(const RigFile& rig, const RigResults& results) {
  std::string html = report::page_begin(rig.title);
  html +=
      fmt::format("<header><h1>{}</h1><p>{}; spectra by Welch as {}; {} to {} Hz.</p></header>\n",
                  escape(rig.title),
                  escape(rig.file.filename().string()),
                  escape(rig.convention_name),
                  significant(rig.band.lower, 4),
                  significant(rig.band.upper, 4));
  html += chapter("Plateaus and passages", plateau_table(results) + speed_figures(rig, results));
  html += chapter("Average passages", average_figures(rig, results));
  html += chapter("Spectra", spectrum_figures(rig, results));
  if (results.hammer || results.compensation) {
    html += chapter("The rig and its filter", responses(rig, results));
  }
  if (results.compensation && !results.compensation->cases.empty()) {
    html += chapter("Dummy rim against real rim", case_chapter(rig, results));
  }
  return html.append(report::kPageEnd);
}

}  // namespace latsch::correlation
