// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/held_out.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "correlation/laboratory/selection.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;

std::string quantity(double si, const std::string& unit) {
  return format_number(si) + (unit == "1" ? "" : " " + unit);
}

}  // namespace

HeldOut held_out_of(const std::vector<std::string>& given) {
  HeldOut held;
  for (const std::string& one : given) {
    const auto equals = one.find('=');
    if (equals == std::string::npos || fs::exists(one)) {
      held.files.emplace_back(one);
      continue;
    }
    const std::string channel(trimmed(std::string_view(one).substr(0, equals)));
    if (!held.channel.empty() && held.channel != channel)
      throw InputError("--hold-out " + in_quotes(one) +
                       ": expected windows of one channel, found " + in_quotes(held.channel) +
                       " and " + in_quotes(channel));
    if (channel.empty())
      throw InputError("--hold-out " + in_quotes(one) +
                       ": expected a recording, or a channel and a window such as "
                       "\"p = 90 kPa .. 104 kPa\"");
    held.channel = channel;
    held.windows.emplace_back(trimmed(std::string_view(one).substr(equals + 1)));
  }
  if (!held.files.empty() && !held.channel.empty())
    throw InputError("--hold-out: expected recordings or windows of one channel, found both: " +
                     in_quotes(held.files.front().string()) + " and " + in_quotes(held.channel));
  return held;
}

std::vector<std::string> windows_outside(const std::vector<std::string>& windows,
                                         const std::string& unit) {
  std::vector<correlation::Window> held;
  for (const std::string& text : windows) {
    const auto [window, fault] = correlation::parse_window(text, unit);
    if (!window) throw InputError("--hold-out " + in_quotes(text) + ": " + fault);
    held.push_back(*window);
  }
  std::sort(held.begin(), held.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  std::vector<std::string> outside;
  double from = -kEnd;  // least value that no window so far covers
  for (const correlation::Window& window : held) {
    const double to = std::nextafter(window.from, -kEnd);
    if (to >= from && std::isfinite(to))
      outside.push_back((std::isfinite(from) ? quantity(from, unit) + " " : "") + ".. " +
                        quantity(to, unit));
    from = std::max(from, std::nextafter(window.to, kEnd));
  }
  if (std::isfinite(from)) outside.push_back(quantity(from, unit) + " ..");
  if (outside.empty())
    throw InputError(
        fmt::format("--hold-out \"{}\": holds every sample out; expected a window "
                    "with two ends, such as \"90 kPa .. 104 kPa\"",
                    fmt::join(windows, ", ")));
  return outside;
}

std::string select_text(const Select& select) {
  std::string text;
  for (const auto& [channel, windows] : select)
    text +=
        fmt::format("{}{} = {}",
                    text.empty() ? "" : ", ",
                    channel,
                    windows.size() == 1 ? "\"" + windows.front() + "\""
                                        : fmt::format("[\"{}\"]", fmt::join(windows, "\", \"")));
  return text.empty() ? "" : ", select = {" + text + "}";
}

}  // namespace latsch::cli
