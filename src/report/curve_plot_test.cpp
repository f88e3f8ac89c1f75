// SPDX-License-Identifier: Apache-2.0
#include "report/curve_plot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "report/color_map.h"
#include "report/comparison_plots.h"

namespace latsch::report {
namespace {

TEST(CurvePlot, ShowsEveryMeasuredValueAndTheProgramWhereItWasMeasured) {
  MeasuredCurve curve;
  curve.x_name = "time";
  curve.y_name = "body";
  curve.x_unit = "s";
  curve.y_unit = "mm";
  curve.x_measured = {1.0, 2.0, 3.0};
  curve.y_measured = {0.010, 0.020, 0.030};
  curve.errors = {0.0, 0.01, -0.02};
  for (int k = 0; k <= 1000; ++k) {  // the simulation extends far beyond the measurement
    curve.x_simulated.push_back(0.1 * k);
    curve.y_simulated.push_back(0.001 * k);
  }
  const std::string plot = curve_plot(curve);
  for (const char* words : {"time [s]", "body [mm]", "2 s: measured 20 mm", "−2.00 %"}) {
    EXPECT_NE(plot.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(plot.find("initial values"), std::string::npos);
  // Samples every 0.1 s from 1 to 3 s are 21 pairs "x,y" separated by blanks.
  const size_t start = plot.find("points=\"") + 8;
  const std::string points = plot.substr(start, plot.find('"', start) - start);
  EXPECT_EQ(std::count(points.begin(), points.end(), ','), 21) << points;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

TEST(CurvePlot, TellsTheLoadsOfManySamplesApartByColor) {
  MeasuredCurve curve;
  curve.x_name = "alpha";
  curve.x_unit = "deg";
  curve.y_name = "Fy";
  curve.y_unit = "N";
  const char* names[] = {
      "Fz 500 N, gamma 0 deg", "Fz 500 N, gamma 2 deg", "Fz 1000 N, gamma 0 deg"};
  for (std::size_t piece = 0; piece < 3; ++piece) {
    for (int k = 0; k < 100; ++k) {
      curve.x_measured.push_back(1e-3 * k);
      curve.y_measured.push_back(10.0 * k * static_cast<double>(piece + 1));
    }
    const std::string level = piece < 2 ? "Fz 500 N" : "Fz 1000 N";
    curve.pieces.push_back({names[piece], level, 100 * piece, 100 * piece + 100});
  }
  curve.x_simulated = curve.x_measured;
  curve.y_simulated = curve.y_measured;
  curve.errors.assign(300, 0.0);
  const std::string plot = curve_plot(curve);
  const auto lines = [&](int color) {
    return count_of(
        plot, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\"", category(color)));
  };
  EXPECT_EQ(lines(0), 2u);
  EXPECT_EQ(lines(1), 1u);
  EXPECT_EQ(count_of(plot, ">Fz 500 N<"), 1u);
  EXPECT_EQ(count_of(plot, ">Fz 1000 N<"), 1u);
  EXPECT_NE(plot.find("circles: measured"), std::string::npos);
  EXPECT_NE(plot.find("lines of a color differ in gamma<"), std::string::npos);
  EXPECT_NE(plot.find("Fz 500 N, gamma 2 deg, "), std::string::npos);  // the tooltip of a circle
  // the color of a line must not have a second meaning
  EXPECT_EQ(plot.find("class=\"measured\""), std::string::npos);
}

// With few pieces each has its own color and its own row of the legend.
TEST(CurvePlot, NamesEveryHeldChannelOfFewPiecesInItsLegend) {
  MeasuredCurve curve;
  curve.x_name = "alpha";
  curve.x_measured = {0.0, 0.1, 0.2, 0.0, 0.1, 0.2};
  curve.y_measured = {0.0, 1.0, 2.0, 1.0, 2.0, 3.0};
  curve.pieces = {{"Fz 500 N, gamma 0 deg", "Fz 500 N, gamma 0 deg", 0, 3},
                  {"Fz 500 N, gamma 2 deg", "Fz 500 N, gamma 2 deg", 3, 6}};
  curve.x_simulated = curve.x_measured;
  curve.y_simulated = curve.y_measured;
  curve.errors.assign(6, 0.0);
  const std::string plot = curve_plot(curve);
  EXPECT_EQ(count_of(plot, ">Fz 500 N, gamma 0 deg<"), 1u);
  EXPECT_EQ(count_of(plot, ">Fz 500 N, gamma 2 deg<"), 1u);
  EXPECT_EQ(plot.find("differ in"), std::string::npos);
}

// A band with an unknown value in the middle has a gap there, a single value is drawn as a bar, and
// a band far wider than the curve ends at the frame.
TEST(CurvePlot, ShadesTheBandOfWhatIsComputed) {
  MeasuredCurve curve;
  curve.experiment = "pull";
  curve.y_measured = curve.y_simulated = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  curve.errors.assign(6, 0.0);
  const std::string without = curve_plot(curve);
  EXPECT_EQ(without.find("class=\"band\""), std::string::npos);
  const double unknown = std::nan("");
  curve.band.lower = {0.5, 1.5, unknown, 3.9, unknown, -1e6};
  curve.band.upper = {1.5, 2.5, unknown, 4.1, unknown, 1e6};
  const std::string picture = curve_plot(curve);
  EXPECT_EQ(count_of(picture, "<polygon"), count_of(without, "<polygon") + 1);
  EXPECT_EQ(count_of(picture, "class=\"band\""), 3u);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
  EXPECT_EQ(picture.find("e+"), std::string::npos);
}

TEST(FrequencyPlot, HasALineForTheBandOfEveryModeWhereItIsKnown) {
  ModalComparison modes;
  modes.experiment = "modes";
  modes.pairs = {{"radial", 100.0, 101.0, {}, {}}, {"lateral", 50.0, 49.0, {}, {}}};
  const std::size_t before = count_of(frequency_plot(modes), "class=\"ink\"");
  modes.band = {.lower = {99.0, std::nan("")}, .upper = {103.0, std::nan("")}};
  EXPECT_EQ(count_of(frequency_plot(modes), "class=\"ink\""), before + 1);
}

TEST(CurvePlot, AMillionSamplesStayAPicture) {
  MeasuredCurve curve;
  curve.y_name = "y";
  curve.y_measured.assign(1'000'000, 1.0);
  curve.errors.assign(1'000'000, 0.1);
  curve.y_simulated.assign(1'000'000, 2.0);
  EXPECT_LT(curve_plot(curve).size(), 200'000u);
}

}  // namespace
}  // namespace latsch::report
