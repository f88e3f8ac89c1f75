// SPDX-License-Identifier: Apache-2.0
#include "report/line_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>

namespace latsch::report {
namespace {

TEST(LinePlot, OfALongLineKeepsItsPeakAndStaysSmall) {
  LinePlot plot{"a peak", "t [s]", "F [N]", {{"force", {}, {}, 0, {}}}, false};
  for (int i = 0; i < 100000; ++i) {
    plot.lines[0].x.push_back(i);
    plot.lines[0].y.push_back(i == 54321 ? 1000.0 : 0.0);
  }
  const std::string with = line_plot(plot);
  EXPECT_LT(with.size(), 60000u);
  EXPECT_NE(with.find(">1000<"), std::string::npos);  // the axis includes the peak
  plot.lines[0].y[54321] = 0.0;
  EXPECT_NE(with, line_plot(plot));
}

TEST(LinePlot, OfALongLineKeepsItsPeakBesideAGap) {
  for (const int gap : {54320, 54322}) {
    LinePlot plot{"a peak", "t [s]", "F [N]", {{"force", {}, {}, 0, {}}}, false};
    for (int i = 0; i < 100000; ++i) {
      plot.lines[0].x.push_back(i);
      plot.lines[0].y.push_back(i == 54321 ? 1000.0 : i == gap ? std::nan("") : 0.0);
    }
    EXPECT_NE(line_plot(plot).find(">1000<"), std::string::npos) << gap;
  }
}

TEST(LinePlot, LeavesOutWhatIsNotFiniteOrHasNoLogarithm) {
  LinePlot plot{"gaps",
                "f [Hz]",
                "PSD",
                {{"<a>", {1, 2, 3, 4}, {1.0, 0.0, std::nan(""), 100.0}, 0, {}}},
                true};
  const std::string svg = line_plot(plot);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find("&lt;a&gt;"), std::string::npos);
  plot.lines[0].y = {0.0, -1.0, 0.0, 0.0};
  EXPECT_EQ(line_plot(plot), "");  // no line has two samples, so the plot is empty
}

// The SVG text alone is an XML file, in which an attribute must not occur twice in a tag.
TEST(LinePlot, NamesNoAttributeTwice) {
  const std::string svg = line_plot({"two", "x", "y", {{"a", {1, 2}, {1, 2}, 0, {}}}, false});
  const std::regex tag("<[^>]*>"), name("([a-z-]+)=\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), tag), end; at != end; ++at) {
    const std::string text = at->str();
    std::set<std::string> names;
    for (std::sregex_iterator own(text.begin(), text.end(), name); own != end; ++own)
      EXPECT_TRUE(names.insert((*own)[1]).second) << text;
  }
}

// Digits of the widest fonts are 7.6 pixels wide, and letters of a title reach 3 pixels below its
// baseline.
TEST(LinePlot, TheTitleOfTheOrdinateStandsBesideItsNumbers) {
  for (const double scale : {1.0, 1e-3, 2e5}) {
    for (const double sign : {1.0, -1.0}) {
      const LinePlot plot{.y_title = "pressure [Pa]",
                          .lines = {{"", {0.0, 1.0}, {0.75 * sign * scale, 0.95 * sign * scale}}}};
      const std::string svg = line_plot(plot);
      const std::regex title("translate\\(([-0-9.]+),[-0-9.]+\\) rotate\\(-90\\)");
      std::smatch found;
      ASSERT_TRUE(std::regex_search(svg, found, title));
      const double base = std::stod(found[1]);
      EXPECT_GE(base, 11.0) << svg;  // the title is not cut off at the top
      const std::regex label("<text x=\"([0-9.]+)\"[^>]*text-anchor=\"end\"[^>]*>([^<]*)<");
      int labels = 0;
      for (std::sregex_iterator at(svg.begin(), svg.end(), label), end; at != end; ++at, ++labels) {
        const std::string text = (*at)[2];
        const auto letters =
            std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
        EXPECT_LT(base + 3.0, std::stod((*at)[1]) - 7.6 * static_cast<double>(letters)) << text;
      }
      EXPECT_GE(labels, 3);
    }
  }
}

}  // namespace
}  // namespace latsch::report
