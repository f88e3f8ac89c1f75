// SPDX-License-Identifier: Apache-2.0
// The list behind unit_words.h: each row holds a word for a unit and its meaning in the language of
// UDUNITS-2.
//
// Factors that UDUNITS has rounded or lacks are written here: the pound, ounce, slug and foot-pound
// units from the international pound of 0.45359237 kg and the inch of 25.4 mm [NIST SP 811 (2008),
// B.8], kilopond and technical atmosphere from 9.80665 m/s^2 [DIN 1301-3], the metric horsepower as
// 75 kp m/s [DIN 66036], the conventional millimeter of mercury and of water [ISO 80000-4:2019].
#pragma once

#include <string_view>

namespace latsch::unit_list {

struct UnitRow {
  std::string_view written, meaning;
};

// clang-format off
// These words are recognized in other letter cases, too: "KPA", "Newton".
inline constexpr UnitRow kWords[] = {
    // Length.
    {"m", "m"}, {"meter", "m"}, {"meters", "m"}, {"metre", "m"}, {"metres", "m"}, {"mm", "mm"},
    {"millimeter", "mm"}, {"millimeters", "mm"}, {"millimetre", "mm"}, {"millimetres", "mm"},
    {"cm", "cm"}, {"centimeter", "cm"}, {"centimeters", "cm"}, {"centimetre", "cm"},
    {"zentimeter", "cm"}, {"dm", "dm"}, {"km", "km"}, {"kilometer", "km"}, {"kilometers", "km"},
    {"kilometre", "km"}, {"um", "um"}, {"micrometer", "um"}, {"micron", "um"}, {"microns", "um"},
    {"in", "in"}, {"inch", "in"}, {"inches", "in"}, {"zoll", "in"}, {"ft", "ft"}, {"foot", "ft"},
    {"feet", "ft"}, {"yd", "yd"}, {"yard", "yd"}, {"mi", "mile"}, {"mile", "mile"},
    {"miles", "mile"}, {"thou", "2.54e-5 m"},
    // Volume.
    {"l", "l"}, {"liter", "l"}, {"liters", "l"}, {"litre", "l"}, {"ml", "ml"}, {"cc", "cm^3"},
    {"ccm", "cm^3"},
    // Mass.
    {"kg", "kg"}, {"kilogram", "kg"}, {"kilograms", "kg"}, {"kilogramm", "kg"}, {"gram", "gram"},
    {"grams", "gram"}, {"gramm", "gram"}, {"milligram", "mg"}, {"tonne", "t"}, {"tonnes", "t"},
    {"megagram", "t"}, {"lbm", "lb"}, {"lb_m", "lb"}, {"pound_mass", "lb"},
    {"kpound_mass", "453.59237 kg"}, {"ounce_mass", "0.028349523125 kg"},
    {"slug", "14.593902937206364 kg"}, {"slugs", "14.593902937206364 kg"}, {"tex", "tex"},
    {"dtex", "dtex"},
    // Force.
    {"N", "N"}, {"newton", "N"}, {"newtons", "N"}, {"kN", "kN"}, {"kilonewton", "kN"},
    {"kilonewtons", "kN"}, {"knewton", "kN"}, {"daN", "daN"}, {"decanewton", "daN"},
    {"meganewton", "MN"}, {"millinewton", "mN"}, {"kgf", "kgf"}, {"kilogram_force", "kgf"},
    {"kg_force", "kgf"}, {"kgforce", "kgf"}, {"kp", "kgf"}, {"kilopond", "kgf"}, {"gf", "gf"},
    {"tf", "9806.65 N"}, {"lbf", "lbf"}, {"lbsf", "lbf"}, {"lb_f", "lbf"}, {"pound_force", "lbf"},
    {"klbf", "kip"}, {"kip", "kip"}, {"kips", "kip"}, {"kpound_force", "kip"},
    {"ozf", "0.27801385095378125 N"}, {"ounce_force", "0.27801385095378125 N"}, {"dyn", "dyne"},
    {"dyne", "dyne"},
    // Moment, impulse, damping in one word.
    {"Nm", "N m"}, {"kNm", "kN m"}, {"daNm", "daN m"}, {"Ncm", "N cm"}, {"Nmm", "N mm"},
    {"kNmm", "kN mm"}, {"Nms", "N m s"}, {"Ns", "N s"}, {"kNs", "kN s"}, {"kgfm", "kgf m"},
    {"kgfcm", "kgf cm"}, {"kgfmm", "kgf mm"}, {"kpm", "kgf m"}, {"ftlb", "ft lbf"},
    {"ftlbs", "ft lbf"}, {"ftlbf", "ft lbf"}, {"lbft", "lbf ft"}, {"lbfft", "lbf ft"},
    {"inlb", "in lbf"}, {"inlbs", "in lbf"}, {"inlbf", "in lbf"}, {"lbin", "lbf in"},
    {"lbfin", "lbf in"},
    // Time and frequency.
    {"s", "s"}, {"sec", "s"}, {"secs", "s"}, {"second", "s"}, {"seconds", "s"}, {"sek", "s"},
    {"sekunde", "s"}, {"sekunden", "s"}, {"ms", "ms"}, {"msec", "ms"}, {"millisecond", "ms"},
    {"milliseconds", "ms"}, {"us", "us"}, {"usec", "us"}, {"microsecond", "us"},
    {"microseconds", "us"}, {"min", "min"}, {"minute", "min"}, {"minutes", "min"},
    {"minuten", "min"}, {"h", "h"}, {"hr", "h"}, {"hrs", "h"}, {"hour", "h"}, {"hours", "h"},
    {"day", "day"}, {"days", "day"}, {"Hz", "Hz"}, {"hertz", "Hz"}, {"kHz", "kHz"},
    {"GHz", "GHz"}, {"cpm", "1/min"},
    // Angle and speed of rotation.
    {"deg", "deg"}, {"degs", "deg"}, {"degree", "deg"}, {"degrees", "deg"}, {"°", "deg"},
    {"rad", "rad"}, {"rads", "rad"}, {"radian", "rad"}, {"radians", "rad"}, {"radiant", "rad"},
    {"mrad", "mrad"}, {"milliradian", "mrad"}, {"milliradians", "mrad"}, {"urad", "urad"},
    {"arcmin", "arcmin"}, {"arcsec", "arcsec"}, {"gon", "0.9 deg"}, {"rev", "rev"},
    {"revs", "rev"}, {"revolution", "rev"}, {"revolutions", "rev"}, {"turn", "rev"},
    {"turns", "rev"}, {"umdr", "rev"}, {"umdrehung", "rev"}, {"umdrehungen", "rev"},
    {"rpm", "rpm"}, {"upm", "rpm"}, {"rps", "rev/s"},
    // Velocity and acceleration.
    {"kmh", "km/h"}, {"kph", "km/h"}, {"kmph", "km/h"}, {"mph", "mile/h"}, {"mps", "m/s"},
    {"fps", "ft/s"}, {"ips", "in/s"}, {"knot", "knot"}, {"knots", "knot"}, {"kts", "knot"},
    {"gn", "9.80665 m/s^2"}, {"gee", "9.80665 m/s^2"}, {"milli_gn", "9.80665e-3 m/s^2"},
    {"standard_gravity", "9.80665 m/s^2"},
    // Pressure relative to that of the atmosphere: "psig" is read as "psi".
    {"Pa", "Pa"}, {"pascal", "Pa"}, {"hPa", "hPa"}, {"kPa", "kPa"}, {"kilopascal", "kPa"},
    {"kpascal", "kPa"}, {"megapascal", "MPa"}, {"mpascal", "MPa"}, {"GPa", "GPa"},
    {"gigapascal", "GPa"}, {"bar", "bar"}, {"bars", "bar"}, {"mbar", "mbar"},
    {"millibar", "mbar"}, {"psi", "psi"}, {"psig", "psi"}, {"barg", "bar"}, {"kPag", "kPa"},
    {"ksi", "ksi"}, {"psf", "lbf/ft^2"}, {"atm", "atm"}, {"at", "98066.5 Pa"},
    {"torr", "133.32236842105263 Pa"}, {"mmHg", "mmHg"}, {"inHg", "inHg"},
    // Temperature.
    {"degC", "degC"}, {"deg_C", "degC"}, {"celsius", "degC"}, {"°C", "degC"}, {"degF", "degF"},
    {"deg_F", "degF"}, {"fahrenheit", "degF"}, {"°F", "degF"}, {"degK", "K"}, {"kelvin", "K"},
    {"°K", "K"}, {"degR", "degR"}, {"rankine", "degR"},
    // Energy, power, electricity, light, amount.
    {"J", "J"}, {"joule", "J"}, {"kJ", "kJ"}, {"watt", "W"}, {"kW", "kW"}, {"kilowatt", "kW"},
    {"Wh", "W h"}, {"kWh", "kW h"}, {"hp", "745.69987158227022 W"},
    {"bhp", "745.69987158227022 W"}, {"volt", "V"}, {"volts", "V"}, {"kV", "kV"}, {"ampere", "A"},
    {"amp", "A"}, {"ohm", "ohm"}, {"Ω", "ohm"}, {"mol", "mol"}, {"cd", "cd"},
    // Plain numbers.
    {"%", "%"}, {"percent", "%"}, {"pct", "%"}, {"prozent", "%"}, {"‰", "1e-3"},
    {"permil", "1e-3"}, {"permille", "1e-3"}, {"promille", "1e-3"}, {"ppm", "1e-6"},
    {"count", "1"}, {"counts", "1"},
};

/// These words are known only in this letter case: in another one they mean, or may mean, something
/// else.
inline constexpr UnitRow kExact[] = {
    {"M", "m"},      {"S", "s"},        {"MS", "ms"},      {"H", "h"},
    {"Min", "min"},  {"MN", "MN"},      {"mN", "mN"},      {"mNm", "mN m"},
    {"MNm", "MN m"}, {"Mg", "t"},       {"t", "t"},        {"mPa", "mPa"},
    {"MPa", "MPa"},  {"Mpa", "MPa"},    {"MPA", "MPa"},    {"PA", "Pa"},
    {"pa", "Pa"},    {"mHz", "mHz"},    {"cN", "cN"},      {"MSEC", "ms"},
    {"MHz", "MHz"},  {"nm", "N m"},     {"NM", "N m"},     {"Grad", "deg"},
    {"U", "rev"},    {"MPH", "mile/h"}, {"Mph", "mile/h"}, {"K", "K"},
    {"C", "degC"},   {"c", "degC"},     {"F", "degF"},     {"PS", "735.49875 W"},
    {"W", "W"},      {"mW", "mW"},      {"MW", "MW"},      {"mJ", "mJ"},
    {"MJ", "MJ"},    {"V", "V"},        {"mV", "mV"},      {"uV", "uV"},
    {"A", "A"},      {"mA", "mA"},      {"L", "l"}, {"d", "day"}, {"kt", "knot"},
};

/// Whole texts, compared without blanks and case.
inline constexpr UnitRow kWhole[] = {
    {"", "1"}, {"1", "1"}, {"-", "1"}, {"--", "1"}, {"—", "1"}, {"none", "1"}, {"n/a", "1"},
    {"unitless", "1"}, {"dimensionless", "1"}, {"deg.c", "degC"}, {"deg c", "degC"},
    {"° c", "degC"}, {"grad c", "degC"}, {"grad celsius", "degC"}, {"degree c", "degC"},
    {"degrees c", "degC"}, {"degree celsius", "degC"}, {"degrees celsius", "degC"},
    {"deg celsius", "degC"}, {"deg.f", "degF"}, {"deg f", "degF"}, {"° f", "degF"},
    {"degree f", "degF"}, {"degrees f", "degF"}, {"degrees fahrenheit", "degF"},
    {"deg fahrenheit", "degF"}, {"deg k", "K"}, {"km/h", "km/h"}, {"r/min", "rpm"},
    {"r.p.m.", "rpm"}, {"sq in", "in^2"}, {"lbf/sq in", "psi"}, {"psi(g)", "psi"},
    {"psi (g)", "psi"}, {"bar(g)", "bar"}, {"bar (g)", "bar"}, {"kpa(g)", "kPa"},
    {"kpa (g)", "kPa"}, {"g0", "9.80665 m/s^2"}, {"mmh2o", "9.80665 Pa"},
    {"inh2o", "249.08891 Pa"}, {"m/s/s", "m/s^2"},
};

/// Whole texts, compared after every word has been replaced by its meaning.
inline constexpr UnitRow kTogether[] = {{"rev/min", "rpm"}, {"rev min^-1", "rpm"}};

/// A text with more than one meaning. The meanings are words of the lists above, the usual one
/// first. `only_by_dimension` is true if no meaning is usual enough to be assumed when the expected
/// dimension is not known.
struct Ambiguous {
  std::string_view written;
  std::string_view meanings[2];
  bool any_case, only_by_dimension;
  std::string_view way_out;  // advice that ends the message
};
inline constexpr Ambiguous kAmbiguousWords[] = {
    {"lb", {"lbf", "lbm"}, true, false, "which may be a force or a mass: write \"lbf\" or \"lbm\""},
    {"lbs",
    {"lbf", "lbm"},
     true,
     false,
     "which may be a force or a mass: write \"lbf\" or \"lbm\""},
    {"pound",
    {"lbf", "lbm"},
     true,
     false,
     "which may be a force or a mass: write \"lbf\" or \"lbm\""},
    {"pounds",
    {"lbf", "lbm"},
     true,
     false,
     "which may be a force or a mass: write \"lbf\" or \"lbm\""},
    {"oz",
    {"ounce_mass", "ozf"},
     true,
     true,
     "which may be a mass or a force: write \"ounce_mass\" or \"ozf\""},
    {"g",
    {"gram", "gn"},
     false,
     true,
     "which may be a gram or the acceleration of gravity: write \"gram\" or \"gn\""},
    {"G",
    {"gn", "gram"},
     false,
     false,
     "which may be the acceleration of gravity or a gram: write \"gn\" or \"gram\""},
    {"mg",
    {"milligram", "milli_gn"},
     false,
     true,
     "which may be a milligram or a thousandth of gravity: write \"milligram\" or \"milli_gn\""},
    {"kn",
    {"kN", "knot"},
     false,
     true,
     "which may be a kilonewton or a knot: write \"kN\" or \"knot\""},
    {"Kn",
    {"kN", "knot"},
     false,
     true,
     "which may be a kilonewton or a knot: write \"kN\" or \"knot\""},
    {"KN", {"kN", "knot"}, false, false, ""},
    {"\"", {"in", "arcsec"}, false, true, "which may be an inch or an arc second: write \"in\" or \"arcsec\""},
    {"''", {"in", "arcsec"}, false, true, "which may be an inch or an arc second: write \"in\" or \"arcsec\""},
    {"'", {"ft", "arcmin"}, false, true, "which may be a foot or an arc minute: write \"ft\" or \"arcmin\""},
};
/// Ambiguous whole texts, compared after every word has been replaced by its meaning.
inline constexpr Ambiguous kAmbiguousTexts[] = {
    {"1/min", {"rpm", "cpm"}, false, false, ""},
    {"min^-1", {"rpm", "cpm"}, false, false, ""},
    {"kg/cm^2", {"at", "kg/(cm cm)"}, false, false, ""},
};

/// Refused texts, each with advice that follows the text in the message.
inline constexpr UnitRow kRefused[] = {
    {"grad", "which is a degree in German and 0.9 degrees in English: write \"deg\" or \"gon\""},
    {"GRAD", "which is a degree in German and 0.9 degrees in English: write \"deg\" or \"gon\""},
    {"mpa", "which may be MPa or mPa: write \"MPa\""},
    {"mn", "which may be MN or mN: write \"MN\" or \"mN\""},
    {"Mn", "which may be MN or mN: write \"MN\" or \"mN\""},
    {"ton", "which may be 1000 kg, 2000 lb or 2240 lb: write \"tonne\" or \"kg\""},
    {"tons", "which may be 1000 kg, 2000 lb or 2240 lb: write \"tonne\" or \"kg\""},
    {"tonf", "which may be of 1000 kg or of 2000 lb: write \"tf\" or \"lbf\""},
    {"gr", "which may be a gram or a grain: write \"gram\""},
    {"cps", "which may count oscillations or revolutions: write \"Hz\" or \"rev/s\""},
    {"psia", "which is an absolute pressure: subtract the atmospheric pressure and write \"psi\""},
    {"bara", "which is an absolute pressure: subtract the atmospheric pressure and write \"bar\""},
    {"kPaa", "which is an absolute pressure: subtract the atmospheric pressure and write \"kPa\""},
    {"dB", "which is a level, no quantity: give the quantity itself"},
    {"dBA", "which is a level, no quantity: give the quantity itself"},
};

/// Characters and the characters they stand for.
inline constexpr UnitRow kCharacters[] = {
    {"µ", "u"},      {"μ", "u"},       {"º", "°"},          {"˚", "°"},      {"²", "2"},
    {"³", "3"},      {"¹", "1"},       {"⁴", "4"},          {"⁻", "-"},      {"−", "-"},
    {"‐", "-"},      {"‑", "-"},       {"–", "-"},          {"·", "*"},      {"⋅", "*"},
    {"•", "*"},      {"×", "*"},       {"∙", "*"},          {"・", "*"},     {"∕", "/"},
    {"⁄", "/"},      {"÷", "/"},       {"\u00a0", " "},     {"\u2009", " "}, {"\u202f", " "},
    {"　", " "},     {"′", "'"},       {"″", "\""},         {"“", "\""},     {"”", "\""},
    {"’", "'"},      {"\u212a", "K"},  {"\u2126", "Ω"},     {"\u309c", "°"}, {"\uff9f", "°"},
    {"℃", "°C"},     {"℉", "°F"},      {"㎜", "mm"},        {"㎝", "cm"},    {"㎞", "km"},
    {"㎛", "um"},    {"㎡", "m2"},     {"㎥", "m3"},        {"㎟", "mm2"},   {"㎠", "cm2"},
    {"㎣", "mm3"},   {"㎏", "kg"},     {"㎎", "milligram"}, {"㎧", "m/s"},   {"㎨", "m/s2"},
    {"㎩", "Pa"},    {"㎪", "kPa"},    {"㎫", "MPa"},       {"㎬", "GPa"},   {"㎭", "rad"},
    {"㎮", "rad/s"}, {"㎯", "rad/s2"}, {"㎐", "Hz"},        {"㎑", "kHz"},   {"㎒", "MHz"},
    {"㎳", "ms"},    {"㎾", "kW"},     {"㎷", "mV"},
};

// clang-format on

}  // namespace latsch::unit_list
