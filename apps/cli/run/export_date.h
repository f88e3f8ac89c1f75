// SPDX-License-Identifier: Apache-2.0
// The date that an exported file states. Nothing else in such a file differs from one export to the
// next. The environment variable SOURCE_DATE_EPOCH (seconds since 1970, as reproducible-builds.org
// defines it) sets the date; then equal studies give equal bytes.
#pragma once

#include <functional>
#include <string>

namespace latsch::cli {

/// A clock that returns seconds since 1970-01-01 UTC.
using Calendar = std::function<double()>;
/// Returns a clock that gives SOURCE_DATE_EPOCH if it is set, else the time of the system. Throws
/// InputError if SOURCE_DATE_EPOCH is no number of seconds.
Calendar calendar_of_system();

/// "2026-03-01", in UTC.
std::string export_date(const Calendar& calendar);

}  // namespace latsch::cli
