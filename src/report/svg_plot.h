// SPDX-License-Identifier: Apache-2.0
// Draws in SVG: shapes, scales with round tick values, a frame with axes. Colors of lines, grid and
// text come from the page's style sheet by their class (ink, soft, grid, note, strong), so that a
// drawing suits light, dark and printed pages.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::report {

using Point = Eigen::Vector2d;

enum class TextAnchor { start, middle, end };

/// An SVG picture under construction. Lengths are in CSS pixels; y points downward.
class Svg {
 public:
  /// Creates an empty picture; screen readers read its description.
  Svg(double width, double height, std::string_view description);

  /// Draw shapes. `attributes` is inserted as it stands, for example `class="ink"` or
  /// `fill="#440154"`. `tip` is a tooltip and is escaped by these functions.
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

/// An axis: maps a range of numbers to a range of pixels.
class Axis {
 public:
  Axis() = default;
  Axis(double lower, double upper, double first_pixel, double last_pixel, bool logarithmic = false);

  /// Returns an axis over the range of the values, widened to round numbers; if `zero`, the range
  /// includes 0.
  static Axis around(const std::vector<double>& values,
                     double first_pixel,
                     double last_pixel,
                     bool zero = false);
  /// Returns a logarithmic axis over whole decades that contain the positive values.
  static Axis logarithmic_around(const std::vector<double>& values,
                                 double first_pixel,
                                 double last_pixel);

  double at(double value) const;  // returns the position of the value in pixels
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  bool logarithmic() const { return logarithmic_; }
  double first_pixel() const { return first_; }
  double last_pixel() const { return last_; }

  struct Tick {
    double value;
    std::string label;
  };
  /// Returns ticks at multiples of 1, 2 or 5 times a power of ten, about one every `spacing`
  /// pixels.
  std::vector<Tick> ticks(double spacing = 60.0) const;

 private:
  double lower_ = 0.0, upper_ = 1.0, first_ = 0.0, last_ = 1.0;
  bool logarithmic_ = false;
};

struct FrameOptions {
  bool label_x = true;      // false: another frame below has the numbers
  double x_spacing = 60.0;  // approximate pixels between ticks
  double y_spacing = 40.0;
};

/// Draws ticks, grid lines and titles for a rectangle with two axes. Titles state quantity and
/// unit.
void draw_frame(Svg& svg,
                const Axis& x,
                const Axis& y,
                std::string_view x_title,
                std::string_view y_title,
                FrameOptions options = {});

/// Draws an entry of the legend: a sample of the line or dot with this class, and `words` after it.
/// Returns the x at which the next entry begins.
double draw_legend(
    Svg& svg, Point at, std::string_view sample_class, bool dot, std::string_view words);

/// Returns the legend's name for the line of simulated values: "fitted", "predicted" or "best
/// trial".
std::string_view drawn_as(bool fitted, bool of_design);

/// Returns the points of y(x) in pixels, without values that are not finite.
std::vector<Point> points_of(const Axis& x,
                             const Axis& y,
                             const std::vector<double>& xs,
                             const std::vector<double>& ys);

/// Fills the area between lower and upper over x, cut off at the range of y. Values that are not
/// finite leave gaps; a single value is drawn as a bar.
void draw_band(Svg& svg,
               const Axis& x,
               const Axis& y,
               const std::vector<double>& xs,
               const std::vector<double>& lower,
               const std::vector<double>& upper);

/// Returns values for Axis::around(): `values` and the ends of a band. A band may be far wider than
/// the values, so its ends are limited.
std::vector<double> with_band(const std::vector<double>& values,
                              const std::vector<double>& lower,
                              const std::vector<double>& upper);

/// Draws a vertical color scale, with the colors of viridis from the low end of `values` at the
/// bottom to the high end.
void draw_color_bar(
    Svg& svg, Point top_left, double height, const Axis& values, std::string_view title);

}  // namespace latsch::report
