// SPDX-License-Identifier: Apache-2.0
// Drawing in SVG: shapes, scales with well chosen ticks, a frame with axes.
//
// Colors of ink, grid and text come from the page's style by class (ink, soft, grid, note, strong),
// so that the same drawing suits light, dark and printed pages.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::report {

using Point = Eigen::Vector2d;

enum class Anchor { start, middle, end };

/// An SVG picture in the making; lengths in CSS pixels, y downward.
class Svg {
 public:
  /// The description is what a screen reader says.
  Svg(double width, double height, std::string_view description);

  /// attributes: raw, for example `class="ink"` or `fill="#440154"`. tip: shown under the pointer,
  /// escaped here.
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
            Anchor anchor = Anchor::start,
            std::string_view css_class = "note");
  void vertical_text(Point at, std::string_view words);

  std::string str() const { return body_ + "</svg>"; }

 private:
  void close(std::string_view name, std::string_view tip);
  std::string body_;
};

/// A range of numbers laid along pixels.
class Axis {
 public:
  Axis() = default;
  Axis(double lower, double upper, double first_pixel, double last_pixel, bool logarithmic = false);

  /// The range of the values, widened to round numbers; `zero`: includes 0.
  static Axis around(const std::vector<double>& values,
                     double first_pixel,
                     double last_pixel,
                     bool zero = false);
  /// Decades around positive values.
  static Axis logarithmic_around(const std::vector<double>& values,
                                 double first_pixel,
                                 double last_pixel);

  double at(double value) const;  // pixel
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  bool logarithmic() const { return logarithmic_; }
  double first_pixel() const { return first_; }
  double last_pixel() const { return last_; }

  struct Tick {
    double value;
    std::string label;
  };
  /// About one tick every `spacing` pixels at 1, 2 or 5 times a power of ten.
  std::vector<Tick> ticks(double spacing = 60.0) const;

 private:
  double lower_ = 0.0, upper_ = 1.0, first_ = 0.0, last_ = 1.0;
  bool logarithmic_ = false;
};

struct FrameOptions {
  bool label_x = true;      // false: another frame below carries the numbers
  double x_spacing = 60.0;  // pixels between ticks, about
  double y_spacing = 40.0;
};

/// Ticks, grid lines and titles around a rectangle of two axes. Titles name the quantity and the
/// unit.
void draw_frame(Svg& svg,
                const Axis& x,
                const Axis& y,
                std::string_view x_title,
                std::string_view y_title,
                FrameOptions options = {});

/// "line  words" with a sample of the line or dot of that class in front; returns where the next
/// one starts.
double draw_legend(
    Svg& svg, Point at, std::string_view sample_class, bool dot, std::string_view words);

/// What the line of the found point is: "fitted", "predicted" or "best trial".
std::string_view drawn_as(bool fitted, bool of_design);

/// The pixels of y(x), without values that are not finite.
std::vector<Point> points_of(const Axis& x,
                             const Axis& y,
                             const std::vector<double>& xs,
                             const std::vector<double>& ys);

/// The area between lower and upper over x, cut off at the range of y; values that are not finite
/// leave gaps. A value alone is a bar.
void draw_band(Svg& svg,
               const Axis& x,
               const Axis& y,
               const std::vector<double>& xs,
               const std::vector<double>& lower,
               const std::vector<double>& upper);

/// Values for Axis::around with those of a band, as far as they leave the values in sight: a
/// band may be far wider.
std::vector<double> with_band(const std::vector<double>& values,
                              const std::vector<double>& lower,
                              const std::vector<double>& upper);

/// A vertical bar from low (bottom) to high with the colors of viridis.
void draw_color_bar(
    Svg& svg, Point top_left, double height, const Axis& values, std::string_view title);

}  // namespace latsch::report
