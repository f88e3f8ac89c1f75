// SPDX-License-Identifier: Apache-2.0
#include "cli/run/export_date.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "base/text.h"

namespace latsch::cli {
namespace {

constexpr double kSecondsOfDay = 86400.0;
constexpr double kLastDay = 2932896.0;  // 9999-12-31, in days since 1970

}  // namespace

Calendar calendar_of_system() {
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
    const auto seconds = parse_number(epoch);
    if (!seconds || !(*seconds >= 0.0) || *seconds > kLastDay * kSecondsOfDay)
      throw InputError("SOURCE_DATE_EPOCH is " + in_quotes(epoch) +
                       ": expected seconds since 1970-01-01");
    return [at = *seconds] { return at; };
  }
  return [] {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  };
}

std::string export_date(const Calendar& calendar) {
  const auto days = std::chrono::days(static_cast<int>(std::floor(calendar() / kSecondsOfDay)));
  const std::chrono::year_month_day date{std::chrono::sys_days(days)};
  return fmt::format("{:04}-{:02}-{:02}",
                     static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

}  // namespace latsch::cli
