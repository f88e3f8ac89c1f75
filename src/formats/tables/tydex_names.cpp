// SPDX-License-Identifier: Apache-2.0
// The names of TYDEX 1.3 that occur in tire tests, with the dimension of their unit.
#include <algorithm>
#include <array>

#include "formats/tables/tydex_file.h"

namespace latsch::formats {
namespace {

constexpr std::array kNames = {
    TydexName{"RUNTIME", "s", "", "running time"},
    TydexName{"LONGVEL", "m/s", "", "longitudinal velocity"},
    TydexName{"TRAJVELW", "m/s", "W", "velocity of the contact point along its trajectory"},
    TydexName{"WHROTSPD", "rad/s", "C", "rotational speed of the wheel"},
    TydexName{"SLIPANGL", "rad", "W", "slip angle"},
    TydexName{"INCLANGL", "rad", "W", "inclination angle"},
    TydexName{"LONGSLIP", "1", "W", "longitudinal slip"},
    TydexName{"INFLPRES", "Pa", "", "inflation pressure"},
    TydexName{"NOMPRES", "Pa", "", "nominal inflation pressure"},
    TydexName{"FX", "N", "W", "longitudinal force"},
    TydexName{"FXW", "N", "W", "longitudinal force"},
    TydexName{"FYW", "N", "W", "lateral force"},
    TydexName{"FZW", "N", "W", "vertical force"},
    TydexName{"MXW", "N m", "W", "overturning moment"},
    TydexName{"MYW", "N m", "W", "rolling resistance moment"},
    TydexName{"MZW", "N m", "W", "aligning moment"},
    TydexName{"FXH", "N", "H", "longitudinal force"},
    TydexName{"FYH", "N", "H", "lateral force"},
    TydexName{"FZH", "N", "H", "vertical force"},
    TydexName{"MXH", "N m", "H", "overturning moment"},
    TydexName{"MYH", "N m", "H", "moment about the lateral axis"},
    TydexName{"MZH", "N m", "H", "aligning moment"},
    TydexName{"FXC", "N", "C", "longitudinal force"},
    TydexName{"FYC", "N", "C", "lateral force"},
    TydexName{"FZC", "N", "C", "vertical force"},
    TydexName{"MXC", "N m", "C", "overturning moment"},
    TydexName{"MYC", "N m", "C", "moment about the spin axis"},
    TydexName{"MZC", "N m", "C", "aligning moment"},
    TydexName{"TRCKTEMP", "K", "", "temperature of the track"},
    TydexName{"TRDTEMP", "K", "", "temperature of the tread"},
    TydexName{"AMBITEMP", "K", "", "ambient temperature"},
    TydexName{"LGFCCOEF", "1", "", "longitudinal force coefficient"},
    TydexName{"LTFCCOEF", "1", "", "lateral force coefficient"},
    TydexName{"DSTGRWHC", "m", "", "distance from the ground to the wheel center"},
    TydexName{"NOMWIDTH", "m", "", "nominal section width"},
    TydexName{"ASPRATIO", "1", "", "aspect ratio"},
    TydexName{"RIMDIAME", "m", "", "rim diameter"},
    TydexName{"RIMWIDTH", "m", "", "rim width"},
    TydexName{"TRDDEPB", "m", "", "tread depth before the test"},
    TydexName{"TRDDEPA", "m", "", "tread depth after the test"},
    TydexName{"OVALLDIA", "m", "", "overall diameter"},
    TydexName{"RFREE", "m", "", "free radius"},
    TydexName{"PATHRADC", "m", "", "radius of the path"},
    TydexName{"FNOMIN", "N", "", "nominal load"},
    TydexName{"RELEASE", "", "", "release of the format"},
    TydexName{"MEASID", "", "", "measurement"},
    TydexName{"SUPPLIER", "", "", "supplier of the data"},
    TydexName{"DATE", "", "", "date"},
    TydexName{"CLCKTIME", "", "", "time of the day"},
    TydexName{"TESTRIG", "", "", "test rig"},
    TydexName{"LOCATION", "", "", "location"},
    TydexName{"MANUFACT", "", "", "manufacturer of the tire"},
    TydexName{"IDENTITY", "", "", "tire"},
    TydexName{"RIMPROF", "", "", "profile of the rim"},
    TydexName{"REFSIDEW", "", "", "reference sidewall"},
    TydexName{"TRCKSURF", "", "", "surface of the track"},
    TydexName{"TRCKCOND", "", "", "condition of the track"},
};

}  // namespace

const TydexName* find_tydex_name(std::string_view name) {
  const auto found = std::find_if(
      kNames.begin(), kNames.end(), [&](const TydexName& known) { return known.name == name; });
  return found == kNames.end() ? nullptr : &*found;
}

}  // namespace latsch::formats
