// SPDX-License-Identifier: Apache-2.0
// Draws in SVG: shapes, scales with round ticks, a frame with axes.
//
// Colors of ink, grid and text come from the page's style by class (ink, soft, grid, note, strong),
// so that a drawing suits light, dark and printed pages.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::report {

using Point = Eigen::Vector2d;

enum class TextAnchor { start, middle, end };

/// SVG picture under construction. Lengths are in CSS pixels, y points downward.
class Svg {
 public:
  /// The description is read by screen readers.
  Svg(double width, double height, std::string_view description);

  /// `attributes` is raw, for example `class="ink"` or `fill="#440154"`. `tip` is shown under the
  /// pointer and escaped here.
  void line(Point a, Point b, std::string_view attributes);
  void polyline(const std::vector<Point>& points, std::string_view attributes);
  void polygon(const std::vector<Point>& points,
               std::string_view attributes,
               std::string_view tip = "");
  void rectangle(Point corner,
                 double width,
                 double height,
                 std::string_view attributes,
                 std::string_view tip = "");
  void circle(Point center, double radius, std::string_view attributes, std::string_view tip = "");
  void path(std::string_view data, std::string_view attributes);
  void text(Point at,
            std::string_view words,
            TextAnchor anchor = TextAnchor::start,
            std::string_view css_class = "note");
  void vertical_text(Point at, std::string_view words);

  std::string str() const { return body_ + "</svg>"; }

 private:
  void close(std::string_view name, std::string_view tip);
  std::string body_;
};

/// Range of numbers mapped to pixels.
class Axis {
 public:
  Axis() = default;
  Axis(double lower, double upper, double first_pixel, double last_pixel, bool logarithmic = false);

  /// Returns the range of the values, widened to round numbers; with `zero`, it includes 0.
  static Axis around(const std::vector<double>& values,
                     double first_pixel,
                     double last_pixel,
                     bool zero = false);
  /// Returns decades around positive values.
  static Axis logarithmic_around(const std::vector<double>& values,
                                 double first_pixel,
                                 double last_pixel);

  double at(double value) const;  // returns the position in pixels
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  bool logarithmic() const { return logarithmic_; }
  double first_pixel() const { return first_; }
  double last_pixel() const { return last_; }

  struct Tick {
    double value;
    std::string label;
  };
  /// Returns about one tick every `spacing` pixels, at 1, 2 or 5 times a power of ten.
  std::vector<Tick> ticks(double spacing = 60.0) const;

 private:
  double lower_ = 0.0, upper_ = 1.0, first_ = 0.0, last_ = 1.0;
  bool logarithmic_ = false;
};

struct FrameOptions {
  bool label_x = true;      // false: another frame below carries the numbers
  double x_spacing = 60.0;  // approximate pixels between ticks
  double y_spacing = 40.0;
};

/// Draws ticks, grid lines and titles around a rectangle of two axes. Titles name the quantity and
/// the unit.
void draw_frame(Svg& svg,
                const Axis& x,
                const Axis& y,
                std::string_view x_title,
                std::string_view y_title,
                FrameOptions options = {});

/// Draws `words` after a sample of the line or dot of that class. Returns the start of the next
/// legend entry.
double draw_legend(
    Svg& svg, Point at, std::string_view sample_class, bool dot, std::string_view words);

/// Returns the meaning of the found point's line: "fitted", "predicted" or "best trial".
std::string_view drawn_as(bool fitted, bool of_design);

/// Returns the pixels of y(x), without values that are not finite.
std::vector<Point> points_of(const Axis& x,
                             const Axis& y,
                             const std::vector<double>& xs,
                             const std::vector<double>& ys);

/// Draws the area between lower and upper over x, cut off at the range of y. Values that are not
/// finite leave gaps; a single value is drawn as a bar.
void draw_band(Svg& svg,
               const Axis& x,
               const Axis& y,
               const std::vector<double>& xs,
               const std::vector<double>& lower,
               const std::vector<double>& upper);

/// Returns values for Axis::around including those of a band, limited so that the values stay
/// visible, because a band may be far wider.
std::vector<double> with_band(const std::vector<double>& values,
                              const std::vector<double>& lower,
                              const std::vector<double>& upper);

/// Draws a vertical bar from low (bottom) to high with the colors of viridis.
void draw_color_bar(
    Svg& svg, Point top_left, double height, const Axis& values, std::string_view title);

}  // namespace latsch::report
