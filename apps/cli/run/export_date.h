// SPDX-License-Identifier: Apache-2.0
// The date that an exported file states. Nothing else in such a file differs from one export to the
// next; SOURCE_DATE_EPOCH (seconds since 1970, as reproducible-builds.org defines it) sets it, and
// then the same study gives the same bytes.
#pragma once

#include <functional>
#include <string>

namespace latsch::cli {

/// Returns seconds since 1970-01-01 UTC.
using Calendar = std::function<double()>;
/// Returns SOURCE_DATE_EPOCH if it is set, else the time of the system clock. Throws InputError if
/// SOURCE_DATE_EPOCH is no number of seconds.
Calendar calendar_of_system();

/// "2026-03-01", in UTC.
std::string export_date(const Calendar& calendar);

}  // namespace latsch::cli
