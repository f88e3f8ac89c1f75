// SPDX-License-Identifier: Apache-2.0
#include "report/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <regex>
#include <set>
#include <vector>

#include "models/fe_tire/description/reference_tires.h"
#include "report/color_map.h"
#include "report/comparison_plots.h"
#include "report/html_text.h"
#include "report/identifiability_plots.h"
#include "report/line_plot.h"
#include "report/live_page.h"
#include "report/surface_plot.h"
#include "report/svg_plot.h"
#include "report/tables.h"

namespace latsch::report {
namespace {

constexpr const char* kHostile = "</script><script>alert(\"1\")</script> & 'x'";

/// Returns the first error in the nesting of HTML elements; empty if every element is closed, in
/// order.
std::string fault_in_tags(std::string page) {
  page = std::regex_replace(page, std::regex("<!DOCTYPE html>"), "");
  const std::set<std::string> alone = {"meta", "br"};
  std::vector<std::string> open;
  for (size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at)) {
    const size_t end = page.find('>', at);
    if (end == std::string::npos) return "unclosed < at " + page.substr(at, 40);
    const std::string tag = page.substr(at + 1, end - at - 1);
    const bool closing = tag[0] == '/';
    const size_t from = closing ? 1 : 0;
    const std::string name = tag.substr(from, tag.find_first_of(" />", from) - from);
    at = end + 1;
    if (closing) {
      if (open.empty() || open.back() != name)
        return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
      open.pop_back();
    } else if (tag.back() != '/' && !alone.contains(name)) {
      if (name == "script" || name == "style") {
        at = page.find("</" + name + ">", at);
        if (at == std::string::npos) return "unclosed " + name;
      }
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "left open: " + open.back();
}

TirePictures pictures() {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.section.meridional = 9;
  tire.section.sectors = 12;
  TirePictures p;
  p.mesh = fe_tire::build_mesh(tire);
  p.layers = {{kHostile, 0.4}};
  const Eigen::Matrix3Xd sector = Eigen::Matrix3Xd::Constant(3, p.mesh.nodes_per_sector(), 1e-3);
  const Eigen::Matrix3Xd ring = Eigen::Matrix3Xd::Constant(3, p.mesh.nodes(), 2e-3);
  p.inflated = fe_tire::Inflated{.pressure = 2.6e5, .u = sector, .alpha = {}};
  report::TirePictures::Loaded loaded;
  loaded.u = ring;
  fe_tire::Standing point{.deflection = 0.025,
                          .loaded_radius = 0.29,
                          .force = {0.0, 0.0, 4000.0},
                          .moment = {0.0, 0.0, 0.0},
                          .patch = {}};
  point.patch = {.length = 0.1, .width = 0.12, .area = 0.01, .points = {}};
  for (double x : {-0.03, 0.0, 0.03}) {
    for (double y : {-0.04, 0.0, 0.04})
      point.patch.points.push_back({x, y, 3e5, 0.0, 0.0, 1.2e-3, 0.03, true});
  }
  loaded.standing = point;
  p.loaded = loaded;
  fe_tire::Mode mode;
  mode.frequency = 36.9;
  mode.n = 1;
  mode.type = fe_tire::ModeType::lateral;
  mode.shape = ring;
  p.modes.assign(15, mode);
  return p;
}

StudyReport full_report() {
  StudyReport r;
  r.title = std::string("Tire B ") + kHostile;
  r.study_file = r.model_file = r.tire = kHostile;
  r.target = 0.003;
  r.initial_target = 0.14;
  r.remarks = {kHostile};
  r.variables = {{kHostile, "N/mm^2", 10e6, 50e6, 5e6, 50e6, true}};
  r.experiments = {
      {kHostile, "load_deflection", kHostile, "force", true, 1.0, 2, 0.01, 0.01, 0.02, 0.2}};
  r.forces = {
      {kHostile, kHostile, true, false, {0.01, 0.02}, {2000, 4000}, {2010, 3990}, {1500, 3000}}};
  r.curves = {{kHostile,
               kHostile,
               true,
               kHostile,
               kHostile,
               "s",
               "mm",
               {0.1, 0.2},
               {1e-3, 2e-3},
               {0.01, -0.02},
               {0.0, 0.3},
               {0.0, 3e-3},
               {0.0, 0.3},
               {0.0, 4e-3},
               false,
               {}}};
  r.values = {{kHostile, kHostile, "mm", true, 1.0, 2e-3, 1.98e-3, 4e-3, 1.9e-3, 2.1e-3}};
  r.modes = {{kHostile,
              kHostile,
              true,
              {{kHostile, 40.0, 41.0, 36.0, 0.98}},
              {{kHostile, 50.0}},
              {{kHostile, 60.0}}}};
  r.convergence = Convergence{{0.14, std::numeric_limits<double>::quiet_NaN(), 0.01, 0.003}};
  Surface surface;
  surface.x_name = surface.y_name = kHostile;
  surface.x = surface.y = {1.0, 2.0, 3.0};
  surface.target = Eigen::Matrix3d::Random().cwiseAbs();
  surface.held = kHostile;
  surface.found = Eigen::Vector2d(2.0, 2.0);
  r.surfaces = {surface};
  r.run = RunFacts{kHostile, kHostile, 4, 1, 2, 12.0, 23.0, {{kHostile, 1}}, 1.0, {kHostile}};
  r.discretization = {{kHostile, 0.01}};
  r.pictures = pictures();
  return r;
}

TEST(Report, IsWellFormedWithEveryChapter) {
  const std::string page = html(full_report());
  EXPECT_EQ(fault_in_tags(page), "");
  for (const char* id : {"variables",
                         "experiments",
                         "values",
                         "forces",
                         "curves",
                         "frequencies",
                         "surface",
                         "search",
                         "discretization",
                         "tire"}) {
    EXPECT_NE(page.find(std::string("<section id=\"") + id + "\">"), std::string::npos) << id;
  }
  for (const char* words : {"at bound",
                            "Contact patch",
                            "Section above the contact",
                            "Length 100 mm, width 120 mm, area 100.0 cm²"}) {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
}

TEST(Report, EmptyStudyIsAPageWithoutChapters) {
  const std::string page = html(StudyReport{});
  EXPECT_EQ(fault_in_tags(page), "");
  EXPECT_EQ(page.find("<section"), std::string::npos);
}

TEST(Report, LetsNoNameBecomeMarkup) {
  const std::string page = html(full_report());
  EXPECT_EQ(page.find("alert(\""), std::string::npos);
  EXPECT_NE(page.find("&lt;/script&gt;&lt;script&gt;alert(&quot;1&quot;)"), std::string::npos);
}

TEST(Report, NeedsNothingFromOutside) {
  const std::string page = html(full_report());
  for (const char* outside : {"http:", "https:", "url(", "src=", "@import", "file:", "//cdn"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
}

TEST(Report, IsTheSameForTheSameStudy) {
  const StudyReport report = full_report();
  EXPECT_TRUE(html(report) == html(report));
}

TEST(Report, OfADesignSaysNothingOfAFit) {
  StudyReport report = full_report();
  report.identifiability.reset();
  EXPECT_NE(html(report).find(">Found</th>"), std::string::npos);
  report.is_of_design = true;
  for (ComparedForces& curve : report.forces) curve.of_design = true;
  for (MeasuredCurve& curve : report.curves) curve.of_design = true;
  const std::string page = html(report);
  EXPECT_EQ(page.find(">Found</th>"), std::string::npos);
  EXPECT_EQ(page.find("fitted"), std::string::npos);
  EXPECT_NE(page.find("Best trial"), std::string::npos);
}

TEST(Report, FlagsAVariableAtItsBound) {
  Variable v{"E", "1", 2.0, 9.0, 1.0, 10.0, false};
  EXPECT_EQ(at_bound(v), AtBound::no);
  v.found = 10.0;
  EXPECT_EQ(at_bound(v), AtBound::upper);
  v.found = 1.001;
  EXPECT_EQ(at_bound(v), AtBound::lower);
  v.logarithmic = true;
  EXPECT_EQ(at_bound(v), AtBound::lower);
}

// the numbers include values that a failed or unusual trial may leave
TEST(Report, IsDrawnFromAnyNumbers) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const std::vector<double> odd = {0.0, -0.0, nan, inf, -inf, 1e-300, 1e300, -5.0, 3.0};
  std::mt19937 random(1);
  const auto any = [&] { return odd[random() % odd.size()]; };
  const auto some = [&] {
    std::vector<double> values(random() % 5);
    for (double& v : values) v = any();
    return values;
  };
  for (int trial = 0; trial < 300; ++trial) {
    StudyReport r;
    r.target = any();
    r.variables = {{"v", "mm", any(), any(), any(), any(), trial % 2 == 0}};
    r.experiments = {{"e", "k", "c", "force", true, any(), 3, any(), any(), any(), any()}};
    r.forces = {{"e", "c", true, trial % 3 == 0, some(), some(), some(), some()}};
    r.curves = {{"e",
                 "c",
                 true,
                 trial % 2 == 0 ? "x" : "",
                 "y",
                 "s",
                 "mm",
                 some(),
                 some(),
                 some(),
                 some(),
                 some(),
                 some(),
                 some(),
                 false,
                 {}}};
    r.modes = {
        {"m", "c", true, {{"a", any(), any(), any(), any()}, {"b", any(), any(), {}, {}}}, {}, {}}};
    r.convergence = Convergence{some()};
    Surface surface;
    surface.x_name = "x";
    surface.y_name = "y";
    surface.x_logarithmic = trial % 2 == 0;
    surface.x = {1.0, 2.0, 4.0};
    surface.y = {-1.0, 0.0};
    surface.target.resize(3, 2);
    for (double& t : surface.target.reshaped()) t = any();
    surface.initial = Eigen::Vector2d(any(), any());
    r.surfaces = {surface};
    r.run = RunFacts{"m", "e", 0, 0, 1, any(), any(), {}};
    r.discretization = {{"q", any()}};
    const std::string page = html(r);
    EXPECT_EQ(fault_in_tags(page), "");
    for (const char* bad :
         {"=\"nan", "=\"inf", "=\"-inf", " nan", "nan,", ",nan", "inf,", ",inf"}) {
      ASSERT_EQ(page.find(bad), std::string::npos)
          << bad << " in trial " << trial << ": " << page.substr(page.find(bad) - 60, 120);
    }
    ASSERT_LT(page.size(), 1'000'000u);
  }
}

TEST(Report, HoldsTheViewsOfTheStudioBesideItsChapters) {
  const LivePage live{R"({"study": {"title": "</script><script>alert(1)</script><!--"}})",
                      "show(document.getElementById('answers'));",
                      "h1 { color: black }"};
  const std::string page = html(full_report(), &live);
  EXPECT_EQ(fault_in_tags(page), "");
  EXPECT_NE(page.find("<section id=\"forces\">"), std::string::npos);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("\\u003c/script>\\u003cscript>alert(1)"), std::string::npos);
  EXPECT_NE(page.find(std::string("<script>") + std::string(live.script)), std::string::npos);
  EXPECT_NE(page.find("<style id=\"studio-style\" media=\"not all\">h1"), std::string::npos);
}

/// Returns the cells of the row of the value table with the given name.
std::string value_row(const std::string& html, const std::string& name) {
  const std::size_t begin = html.find("<tr><td>" + name);
  return begin == std::string::npos ? "" : html.substr(begin, html.find("</tr>", begin) - begin);
}

TEST(ValueTable, HasTargetInitialAndOptimizedWithTheDigitsThatTheBandLeaves) {
  StudyReport report;
  report.values = {{"A_dz", "A/dz_by_Fz", "mm", true, 1.0, 2e-3, 1.9834e-3, 0.5e-3, 1.9e-3, 2.1e-3},
                   {"E_dz", "", "mm", false, 1.0, 1e-3, 1.2345678e-3, {}, {}, {}}};
  const std::string page = html(report);
  const std::string row = value_row(page, "A_dz");
  for (const char* words : {">2<", ">0.5<", ">0.25<", ">1.98<", ">0.99<", ">1.9 .. 2.1<"})
    EXPECT_NE(row.find(words), std::string::npos) << words << " in " << row;
  const std::string predicted = value_row(page, "E_dz");
  for (const char* words : {">predicted<", ">1.235<", ">–<"})
    EXPECT_NE(predicted.find(words), std::string::npos) << words << " in " << predicted;
  EXPECT_EQ(page.find("weight near zero"), std::string::npos);
}

TEST(ValueTable, FlagsInWordsWhatTheFitHardlySees) {
  StudyReport report;
  report.values = {{"A_dz", "", "mm", true, 1.0, 1e-3, 1e-3, {}, {}, {}},
                   {"A_toe", "", "deg", true, 0.01, 1e-3, 1e-3, {}, {}, {}},
                   {"B_dz", "", "mm", true, 0.06, 1e-3, 1e-3, {}, {}, {}},
                   // an experiment that is not fitted
                   {"E_dz", "", "mm", false, 0.0, 1e-3, 1e-3, {}, {}, {}}};
  const std::string page = html(report);
  EXPECT_NE(value_row(page, "A_toe").find("weight near zero"), std::string::npos);
  for (const char* name : {"A_dz", "B_dz", "E_dz"})
    EXPECT_EQ(value_row(page, name).find("weight near zero"), std::string::npos) << name;
  EXPECT_NE(page.find("hardly affects the fit"), std::string::npos);
}

TEST(SurfacePlot, FindsEveryMinimumOfTheGrid) {
  Eigen::MatrixXd t(4, 5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  t << 3, 3, 3, 3, 1,  //
      3, 2, 3, 3, 3,   //
      3, 3, 3, 3, 3,   //
      nan, 3, 0.5, 0.5, 3;
  const auto minima = local_minima(t);
  ASSERT_EQ(minima.size(), 3u);
  EXPECT_EQ(minima[0].target, 0.5);  // a plateau of two points counts once
  EXPECT_EQ(minima[0].j, 2);
  EXPECT_EQ(minima[1].target, 1.0);
  EXPECT_EQ(minima[2].target, 2.0);
}

TEST(SurfacePlot, DrawsFailedFlatAndSmallGrids) {
  Surface s;
  EXPECT_EQ(surface_plot(s), "");
  s.x = s.y = {1.0, 2.0};
  s.target = Eigen::Matrix2d::Constant(0.1);
  EXPECT_EQ(surface_plot(s).find("nan"), std::string::npos);
  s.target.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(surface_plot(s).find("nan"), std::string::npos);
}

TEST(HtmlText, NumbersAreReadable) {
  EXPECT_EQ(significant(22.31456, 4), "22.31");
  EXPECT_EQ(significant(1987.3, 4), "1987");
  EXPECT_EQ(significant(0.5, 4), "0.5");
  EXPECT_EQ(significant(123456.0, 3), "123456");
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
  EXPECT_EQ(signed_percent(-0.0123), "−1.23 %");
  EXPECT_EQ(signed_percent(0.0123), "+1.23 %");
  EXPECT_EQ(percent(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(small_percent(0.0123), "1.23 %");
  EXPECT_EQ(small_percent(1.46e-5), "0.0015 %");  // the target is a mean of squares
  EXPECT_EQ(small_percent(0.0), "0.00 %");
  EXPECT_EQ(typeset_words("-1.42 .. -0.78 N/mm^2"), "−1.42 … −0.78 N/mm²");
  EXPECT_EQ(typeset_words("+- 2 mm (0.1 %), x-ray at -3 s"), "± 2 mm (0.1 %), x-ray at −3 s");
  EXPECT_EQ(duration(125.0), "2 min 05 s");
  EXPECT_EQ(typeset_unit("N/mm^2"), "N/mm²");
  EXPECT_DOUBLE_EQ(in_unit(22.3e6, "N/mm^2"), 22.3);
}

TEST(Report, SaysWhatTheDataDetermine) {
  StudyReport report;
  IdentifiabilityPage what;
  what.variables = {"matrix <b>", "carcass"};
  what.values = {"10 N/mm^2", "6 GPa"};
  what.intervals = {"9 .. 11 N/mm^2", "at least 2 GPa"};
  what.shifts = {"-0.4 N/mm^2", "+1 GPa"};
  what.residuals = 17;
  what.deviations = {0.01, 3.0};
  what.directions = {"matrix up, carcass up", "carcass up"};
  what.correlation = Eigen::Matrix2d{{1.0, -0.97}, {-0.97, 1.0}};
  what.profiles = {{"carcass",
                    "GPa",
                    true,
                    {1e9, 4e9, 2e10},
                    {"1 GPa", "4 GPa", "20 GPa"},
                    {9.0, 0.0, 0.4},
                    4e9,
                    "one-sided",
                    "at least 2 GPa"}};
  what.left_out = {{"modes", 0.01, 0.12}};
  what.bands = {
      {"footprint", false, "+- 3 mm^2", "2 of 3 measured values", {"matrix <b> is held"}}};
  what.gains = {{"footprint", 20.0, "carcass"}};
  report.identifiability = what;
  report.effects = {{"carcass", 0.12, -0.05, 0.03, 10}};
  report.shares = {{"value of radial", 0.97, true, {{"carcass", 0.6, 0.55, 0.65, 0.7, 0.6, 0.8}}},
                   {"target", 0.41, false, {{"carcass", 0.2, 0.0, 0.9, 0.3, 0.0, 0.9}}},
                   {"value of mass", 0.0, false, {}}};
  report.basins = Basins{"full factorial grid, 6 x 6",
                         {"matrix", "carcass"},
                         1,
                         {{0.02, 36, {"10 N/mm^2", "6 GPa"}}},
                         "minima may hide there"};
  const std::string page = html(report);
  for (const char* part : {"What the data determine",
                           "Mesh and step",
                           "−0.4 N/mm²",
                           "Sensitivity",
                           "17 measured values",
                           "one-sided",
                           "−0.97",
                           "at least 2 GPa",
                           "1 / 20",
                           "12.00 %",
                           "± 3 mm²",
                           "2 of 3 measured values",
                           "is held",
                           "too coarse to trust",
                           "minima may hide"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  // The name "matrix <b>" does not fit above its column, so numbers stand there instead, and also
  // after the names.
  EXPECT_NE(page.find("carcass (2)"), std::string::npos);
  EXPECT_NE(page.find(">(1)<"), std::string::npos);
  EXPECT_EQ(page.find("<b>\""), std::string::npos);
  EXPECT_EQ(page.find("matrix <b>"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

/// Expects that both ends of every text and every rectangle lie within the width of the picture.
void expect_nothing_cut(const std::string& svg) {
  std::smatch box;
  ASSERT_TRUE(std::regex_search(svg, box, std::regex("viewBox=\"0 0 ([0-9.]+) ")));
  const double width = std::stod(box[1]);
  constexpr double kLetter = 6.0, kStrongLetter = 7.5;  // px, average widths of letters in the font
  static const std::regex kText("<text x=\"([-0-9.]+)\"([^>]*)>([^<]*)<");
  for (std::sregex_iterator at(svg.begin(), svg.end(), kText), end; at != end; ++at) {
    const std::string how = (*at)[2], element = (*at)[0];
    if (how.find("transform") != how.npos) continue;
    const double letter = how.find("\"strong\"") != how.npos ? kStrongLetter : kLetter;
    const double x = std::stod((*at)[1]), length = letter * static_cast<double>((*at)[3].length());
    const double before = how.find("\"end\"") != how.npos      ? length
                          : how.find("\"middle\"") != how.npos ? 0.5 * length
                                                               : 0.0;
    EXPECT_GE(x - before, 0.0) << element;
    EXPECT_LE(x - before + length, width) << element;
  }
  static const std::regex kRectangle("<rect x=\"([-0-9.]+)\"[^>]*? width=\"([0-9.]+)\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), kRectangle), end; at != end; ++at)
    EXPECT_LE(std::stod((*at)[1]) + std::stod((*at)[2]), width) << (*at)[0];
}

// Returns a page with as many variables as a Magic Formula has in a fit of pure slips.
IdentifiabilityPage of_many_variables(int count) {
  IdentifiabilityPage what;
  what.residuals = 400;
  for (int i = 0; i < count; ++i) {
    what.variables.push_back(fmt::format("lateral_peak_{}", i));
    what.values.push_back("1.234");
    what.intervals.push_back("1.1 .. 1.3");
    what.deviations.push_back(std::pow(10.0, -3.0 + 0.1 * i));
    what.directions.push_back("0.71 lateral_peak_1 - 0.69 lateral_peak_17, 0.1 others");
  }
  what.correlation = Eigen::MatrixXd::Identity(count, count);
  return what;
}

TEST(IdentifiabilityChapter, NothingIsCutAtTwentyTwoVariables) {
  for (const int count : {2, 5, 22, 40}) {
    SCOPED_TRACE(count);
    const IdentifiabilityPage what = of_many_variables(count);
    expect_nothing_cut(correlation_plot(what));
    expect_nothing_cut(spectrum_plot(what));
    EXPECT_EQ(fault_in_tags(identifiability_chapter(what)), "");
  }
}

TEST(ConvergencePlot, TheBestTargetIsNotCut) {
  for (const double target : {6.15432e-4, 1.23e-9, 0.123456, 12.3456}) {
    expect_nothing_cut(convergence_plot(Convergence{{20.0, target}}));
  }
}

TEST(CorrelationPlot, AVariableHeldAtItsBoundHasNone) {
  IdentifiabilityPage what = of_many_variables(3);
  what.correlation(1, 1) = 0.0;
  const std::string svg = correlation_plot(what);
  EXPECT_NE(svg.find(">–<"), std::string::npos);
  EXPECT_NE(svg.find("held at its bound"), std::string::npos);
}

TEST(Axis, LabelsOfTicksAreShortWhateverTheNumbers) {
  for (const double most : {4e-16, 3e-9, 2e-5, 0.07, 1.0, 5e3}) {
    for (const auto& tick : Axis(-most, most, 0.0, 420.0).ticks()) {
      EXPECT_LE(tick.label.size(), 12u) << tick.label;  // bytes; the minus character has three
    }
  }
}

TEST(LinePlot, LegendsTakeTheRowsTheyNeed) {
  LinePlot plot{"many lines", "x", "y", {}};
  for (int i = 0; i < 14; ++i)
    plot.lines.push_back(
        {fmt::format("load of {} N at 2.4 bar", 500 * i), {0.0, 1.0}, {0.0, 1.0 * i}, i, {}});
  expect_nothing_cut(line_plot(plot));
}

// If the trial with the least target does not come from the search, the page must explain why.
TEST(Report, SaysWhereItsBestTrialIsNotOfTheSearch) {
  StudyReport report;
  report.title = "t";
  report.run = RunFacts{};
  report.convergence = Convergence{{0.2, std::nan(""), 0.143}};
  report.target = 0.143;
  EXPECT_EQ(html(report).find("everything else on this page"), std::string::npos);
  report.target = 0.0621;
  EXPECT_NE(html(report).find("has 6.210 %: everything else on this page"), std::string::npos);
}

TEST(Report, TheTargetSaysWhatItSquares) {
  StudyReport report;
  report.title = "t";
  report.target = 6e-4;
  report.target_in_words = "mean square of the errors, its root 2.45 %";
  EXPECT_NE(html(report).find("its root 2.45 %"), std::string::npos);
}

}  // namespace
}  // namespace latsch::report
