// SPDX-License-Identifier: Apache-2.0
#include "report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/color_map.h"
#include "report/html_text.h"

namespace latsch::report {
namespace {

constexpr int kMostDecimals = 6;  // most decimals of a label; smaller numbers are written as 2e-07
// share of the largest value at which a logarithmic axis begins at the latest
constexpr double kSmallestShown = 1e-9;
constexpr double kDigit = 7.7;    // px, width of the widest digit of a page's fonts
constexpr double kAscent = 12.0;  // px, height of letters above their baseline

/// Returns the number of characters of a UTF-8 text.
double letters_of(const std::string& text) {
  return static_cast<double>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string pixel(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

/// True if the point is finite and not far outside any picture. A failed trial may leave points
/// that are not.
bool drawable(const Point& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() < 1e5; }

std::string pixels(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points) {
    if (drawable(p)) text += pixel(p.x()) + "," + pixel(p.y()) + " ";
  }
  if (!text.empty()) text.pop_back();
  return text;
}

/// Returns 1, 2 or 5 times a power of ten, at least `length`.
double round_step(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= length * (1.0 - 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace

Svg::Svg(double width, double height, std::string_view description)
    : body_(fmt::format("<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
                        "aria-label=\"{2}\">",
                        pixel(width),
                        pixel(height),
                        escape(description))) {}

void Svg::close(std::string_view name, std::string_view tip) {
  body_ +=
      tip.empty() ? std::string("/>") : fmt::format("><title>{}</title></{}>", escape(tip), name);
}

void Svg::line(Point a, Point b, std::string_view attributes) {
  if (!drawable(a) || !drawable(b)) return;
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>",
                       pixel(a.x()),
                       pixel(a.y()),
                       pixel(b.x()),
                       pixel(b.y()),
                       attributes);
}

void Svg::polyline(const std::vector<Point>& points, std::string_view attributes) {
  body_ += fmt::format("<polyline fill=\"none\" points=\"{}\" {}/>", pixels(points), attributes);
}

void Svg::polygon(const std::vector<Point>& points,
                  std::string_view attributes,
                  std::string_view tip) {
  body_ += fmt::format("<polygon points=\"{}\" {}", pixels(points), attributes);
  close("polygon", tip);
}

void Svg::rectangle(
    Point corner, double width, double height, std::string_view attributes, std::string_view tip) {
  if (!drawable(corner) || !drawable({width, height})) return;
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}",
                       pixel(corner.x()),
                       pixel(corner.y()),
                       pixel(width),
                       pixel(height),
                       attributes);
  close("rect", tip);
}

void Svg::circle(Point center, double radius, std::string_view attributes, std::string_view tip) {
  if (!drawable(center)) return;
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}",
                       pixel(center.x()),
                       pixel(center.y()),
                       pixel(radius),
                       attributes);
  close("circle", tip);
}

void Svg::path(std::string_view data, std::string_view attributes) {
  body_ += fmt::format("<path d=\"{}\" {}/>", data, attributes);
}

void Svg::text(Point at, std::string_view words, TextAnchor anchor, std::string_view css_class) {
  if (!drawable(at)) return;
  const char* side = anchor == TextAnchor::start    ? "start"
                     : anchor == TextAnchor::middle ? "middle"
                                                    : "end";
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" class=\"{}\">{}</text>",
                       pixel(at.x()),
                       pixel(at.y()),
                       side,
                       css_class,
                       escape(words));
}

void Svg::vertical_text(Point at, std::string_view words) {
  body_ += fmt::format(
      "<text transform=\"translate({},{}) rotate(-90)\" text-anchor=\"middle\" "
      "class=\"title\">{}</text>",
      pixel(at.x()),
      pixel(at.y()),
      escape(words));
}

Axis::Axis(double lower, double upper, double first_pixel, double last_pixel, bool logarithmic)
    : lower_(lower),
      upper_(upper),
      first_(first_pixel),
      last_(last_pixel),
      logarithmic_(logarithmic) {
  if (!(upper_ > lower_)) {
    const double half = logarithmic_ ? 0.0 : 0.5 * std::max(1e-12, std::abs(lower_));
    upper_ = logarithmic_ ? 10.0 * lower_ : lower_ + half;
    lower_ -= half;
  }
}

Axis Axis::around(const std::vector<double>& values,
                  double first_pixel,
                  double last_pixel,
                  bool zero) {
  double low = zero ? 0.0 : std::numeric_limits<double>::infinity(), high = zero ? 0.0 : -low;
  for (double v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (!(low <= high)) low = 0.0, high = 1.0;
  if (low == high) {
    const double half = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
    low -= half;
    high += half;
  }
  const double step = round_step((high - low) / 6.0);
  return Axis(std::floor(low / step + 1e-9) * step,
              std::ceil(high / step - 1e-9) * step,
              first_pixel,
              last_pixel);
}

Axis Axis::logarithmic_around(const std::vector<double>& values,
                              double first_pixel,
                              double last_pixel) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (double v : values) {
    if (!std::isfinite(v) || v <= 0.0) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (!(low <= high)) low = 0.1, high = 1.0;
  low = std::max(low, kSmallestShown * high);
  const auto down = [](double v) {
    const double power = std::pow(10.0, std::floor(std::log10(v) + 1e-9));
    return v >= 5.0 * power ? 5.0 * power : v >= 2.0 * power ? 2.0 * power : power;
  };
  const auto up = [](double v) {
    const double power = std::pow(10.0, std::floor(std::log10(v) - 1e-9));
    return v <= 2.0 * power ? 2.0 * power : v <= 5.0 * power ? 5.0 * power : 10.0 * power;
  };
  return Axis(down(low), up(high), first_pixel, last_pixel, true);
}

double Axis::at(double value) const {
  const double part = logarithmic_ ? std::log(value / lower_) / std::log(upper_ / lower_)
                                   : (value - lower_) / (upper_ - lower_);
  return first_ + part * (last_ - first_);
}

std::vector<Axis::Tick> Axis::ticks(double spacing) const {
  const double count = std::max(1.0, std::abs(last_ - first_) / spacing);
  std::vector<Tick> ticks;
  if (logarithmic_ && upper_ / lower_ > 3.0) {
    const double per_decade = count / std::log10(upper_ / lower_);
    const std::vector<double> steps =
        per_decade > 2.5 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
    for (double power = std::pow(10.0, std::floor(std::log10(lower_))); power <= upper_;
         power *= 10.0) {
      for (double step : steps) {
        const double value = step * power;
        if (value >= lower_ * (1 - 1e-9) && value <= upper_ * (1 + 1e-9)) {
          ticks.push_back({value, significant(value, 3)});
        }
      }
    }
    if (ticks.size() >= 2) return ticks;
    ticks.clear();
  }
  const double step = round_step((upper_ - lower_) / count);
  // An axis whose ends are as far apart as numbers reach, or not apart, has no round steps.
  if (!(step > 0.0) || !std::isfinite(step)) return ticks;
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  for (double k = std::ceil(lower_ / step - 1e-9); k * step <= upper_ + 1e-9 * step; ++k) {
    ticks.push_back(
        {k * step,
         decimals > kMostDecimals ? significant(k * step, 3) : fixed(k * step, decimals)});
  }
  return ticks;
}

void draw_frame(Svg& svg,
                const Axis& x,
                const Axis& y,
                std::string_view x_title,
                std::string_view y_title,
                FrameOptions options) {
  const double left = x.first_pixel(), right = x.last_pixel(), bottom = y.first_pixel(),
               top = y.last_pixel();
  for (const auto& tick : x.ticks(options.x_spacing)) {
    const double px = x.at(tick.value);
    svg.line({px, top}, {px, bottom}, "class=\"grid\"");
    if (options.label_x) svg.text({px, bottom + 16}, tick.label, TextAnchor::middle);
  }
  double widest = 0.0;
  for (const auto& tick : y.ticks(options.y_spacing)) {
    const double py = y.at(tick.value);
    svg.line({left, py}, {right, py}, "class=\"grid\"");
    svg.text({left - 7, py + 4}, tick.label, TextAnchor::end);
    widest = std::max(widest, kDigit * letters_of(tick.label));
  }
  svg.line({left, bottom}, {right, bottom}, "class=\"axis\"");
  if (!x_title.empty())
    svg.text({0.5 * (left + right), bottom + 36}, x_title, TextAnchor::middle, "title");
  // the margin is so wide that no title is cut off at the left edge
  const double beside = std::max(kAscent, left - 16 - widest);
  if (!y_title.empty()) svg.vertical_text({beside, 0.5 * (top + bottom)}, y_title);
}

double draw_legend(
    Svg& svg, Point at, std::string_view sample_class, bool dot, std::string_view words) {
  if (dot) {
    svg.circle({at.x() + 9, at.y() - 4}, 3.6, fmt::format("class=\"{}\"", sample_class));
  } else {
    svg.line(
        {at.x(), at.y() - 4}, {at.x() + 18, at.y() - 4}, fmt::format("class=\"{}\"", sample_class));
  }
  svg.text({at.x() + 24, at.y()}, words);
  return at.x() + 42 + 6.4 * static_cast<double>(words.size());
}

std::vector<Point> points_of(const Axis& x,
                             const Axis& y,
                             const std::vector<double>& xs,
                             const std::vector<double>& ys) {
  std::vector<Point> points;
  for (size_t k = 0; k < std::min(xs.size(), ys.size()); ++k) {
    if (std::isfinite(ys[k])) points.push_back({x.at(xs[k]), y.at(ys[k])});
  }
  return points;
}

void draw_band(Svg& svg,
               const Axis& x,
               const Axis& y,
               const std::vector<double>& xs,
               const std::vector<double>& lower,
               const std::vector<double>& upper) {
  const std::size_t count = std::min({xs.size(), lower.size(), upper.size()});
  const auto at = [&](std::size_t k, double value) {
    return Point(x.at(xs[k]), y.at(std::clamp(value, y.lower(), y.upper())));
  };
  const auto is_known = [&](std::size_t k) {
    return std::isfinite(xs[k]) && std::isfinite(lower[k]) && std::isfinite(upper[k]);
  };
  for (std::size_t first = 0; first < count; ++first) {
    std::size_t end = first;
    while (end < count && is_known(end)) ++end;
    if (end == first + 1)
      svg.line(at(first, lower[first]), at(first, upper[first]), "class=\"band\"");
    std::vector<Point> outline;
    for (std::size_t k = first; k < end; ++k) outline.push_back(at(k, upper[k]));
    for (std::size_t k = end; k-- > first;) outline.push_back(at(k, lower[k]));
    if (end > first + 1) svg.polygon(outline, "class=\"band\"");
    first = end;
  }
}

std::vector<double> with_band(const std::vector<double>& values,
                              const std::vector<double>& lower,
                              const std::vector<double>& upper) {
  // largest part of an axis that a band may take in addition to the range of the values, as a share
  // of that range
  constexpr double kBeyond = 0.5;
  std::vector<double> all;
  for (const double value : values) {
    if (std::isfinite(value)) all.push_back(value);
  }
  if (all.empty()) return all;
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  const double beyond = kBeyond * (*most > *least ? *most - *least : std::abs(*most));
  const double bottom = *least - beyond, top = *most + beyond;
  for (const auto* ends : {&lower, &upper}) {
    for (const double value : *ends) {
      if (std::isfinite(value)) all.push_back(std::clamp(value, bottom, top));
    }
  }
  return all;
}

void draw_color_bar(
    Svg& svg, Point top_left, double height, const Axis& values, std::string_view title) {
  constexpr int kSteps = 48;
  constexpr double kWidth = 12.0;
  const double step = height / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    svg.rectangle({top_left.x(), top_left.y() + height - (k + 1) * step},
                  kWidth,
                  step + (k > 0 ? 0.6 : 0.0),
                  fmt::format("fill=\"{}\"", viridis((k + 0.5) / kSteps)));
  }
  for (const auto& tick : values.ticks(40.0)) {
    const double py = values.at(tick.value);
    svg.line({top_left.x() + kWidth, py}, {top_left.x() + kWidth + 4, py}, "class=\"axis\"");
    svg.text({top_left.x() + kWidth + 7, py + 4}, tick.label);
  }
  svg.text({top_left.x(), top_left.y() - 9}, title, TextAnchor::start, "title");
}

std::string_view drawn_as(bool fitted, bool of_design) {
  if (!fitted) return "predicted";
  return of_design ? "best trial" : "fitted";
}

}  // namespace latsch::report
