// SPDX-License-Identifier: Apache-2.0
// Spellings of units in files of tires, vehicles and rigs, in German, English, American and
// Japanese custom, with factor and offset entered from the cited sources: SI value = number *
// factor + offset. The tests of all readers use this table.
#pragma once

#include <limits>
#include <numbers>

namespace latsch {

struct UnitSpelling {
  const char* written;
  const char* si;  // unit of the measured quantity
  double factor;   // factor to SI; kRefused: a reader must refuse the text
  double offset = 0.0;
};

inline constexpr double kRefused = std::numeric_limits<double>::quiet_NaN();

namespace unit_spellings {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDegree = kPi / 180.0;
inline constexpr double kPound = 0.45359237;
inline constexpr double kPoundForce = 0.45359237 * 9.80665;
inline constexpr double kPsi = kPoundForce / (0.0254 * 0.0254);

// clang-format off
inline constexpr UnitSpelling kAll[] = {
    // Length [BIPM SI brochure, 9th ed.; international inch of 25.4 mm: NIST SP 811, B.8].
    {"m", "m", 1.0}, {"M", "m", 1.0}, {"meter", "m", 1.0}, {"Meter", "m", 1.0},
    {"METER", "m", 1.0}, {"metre", "m", 1.0}, {"meters", "m", 1.0}, {"mm", "m", 1e-3},
    {"MM", "m", 1e-3}, {"[mm]", "m", 1e-3}, {"(mm)", "m", 1e-3}, {"millimeter", "m", 1e-3},
    {"Millimeter", "m", 1e-3}, {"MILLIMETERS", "m", 1e-3}, {"ｍｍ", "m", 1e-3}, {"㎜", "m", 1e-3},
    {"cm", "m", 1e-2}, {"CM", "m", 1e-2}, {"Zentimeter", "m", 1e-2}, {"km", "m", 1e3},
    {"KM", "m", 1e3}, {"µm", "m", 1e-6}, {"μm", "m", 1e-6}, {"um", "m", 1e-6},
    {"micron", "m", 1e-6}, {"in", "m", 0.0254}, {"IN", "m", 0.0254}, {"inch", "m", 0.0254},
    {"INCH", "m", 0.0254}, {"Inches", "m", 0.0254}, {"Zoll", "m", 0.0254}, {"\"", "m", 0.0254},
    {"″", "m", 0.0254}, {"ft", "m", 0.3048}, {"FT", "m", 0.3048}, {"Ft", "m", 0.3048},
    {"foot", "m", 0.3048}, {"feet", "m", 0.3048}, {"'", "m", 0.3048}, {"yd", "m", 0.9144},
    {"mile", "m", 1609.344}, {"miles", "m", 1609.344}, {"mi", "m", 1609.344},
    {"Mm", "m", kRefused}, {"pt", "m", kRefused}, {"mil", "m", kRefused}, {"ua", "m", kRefused},
    {"furlong", "m", kRefused}, {"N/A m", "m", kRefused},
    // Mass [international pound of 0.45359237 kg: NIST SP 811, B.8; slug = lbf s^2/ft].
    {"kg", "kg", 1.0}, {"KG", "kg", 1.0}, {"Kg", "kg", 1.0}, {"kilogram", "kg", 1.0},
    {"Kilogramm", "kg", 1.0}, {"ｋｇ", "kg", 1.0}, {"㎏", "kg", 1.0}, {"g", "kg", 1e-3},
    {"gram", "kg", 1e-3}, {"Gramm", "kg", 1e-3}, {"G", "kg", 1e-3}, {"mg", "kg", 1e-6},
    {"t", "kg", 1e3}, {"tonne", "kg", 1e3}, {"Tonne", "kg", 1e3}, {"Mg", "kg", 1e3},
    {"megagram", "kg", 1e3}, {"lb", "kg", kPound}, {"LB", "kg", kPound}, {"lbs", "kg", kPound},
    {"Lbs", "kg", kPound}, {"LBS", "kg", kPound}, {"lbm", "kg", kPound}, {"LBM", "kg", kPound},
    {"pound", "kg", kPound}, {"pounds", "kg", kPound}, {"pound_mass", "kg", kPound},
    {"oz", "kg", kPound / 16}, {"ounce_mass", "kg", kPound / 16},
    {"slug", "kg", 14.593902937206364}, {"Slug", "kg", 14.593902937206364},
    {"slugs", "kg", 14.593902937206364}, {"ton", "kg", kRefused}, {"tons", "kg", kRefused},
    {"gr", "kg", kRefused}, {"u", "kg", kRefused},
    // Force [newton; kilopond of 9.80665 N: DIN 1301-3; pound-force: NIST SP 811, B.8].
    {"N", "N", 1.0}, {"n", "N", 1.0}, {"[N]", "N", 1.0}, {"newton", "N", 1.0},
    {"Newton", "N", 1.0}, {"NEWTON", "N", 1.0}, {"newtons", "N", 1.0}, {"Ｎ", "N", 1.0},
    {"kN", "N", 1e3}, {"KN", "N", 1e3}, {"kn", "N", 1e3}, {"Kn", "N", 1e3}, {"[kN]", "N", 1e3},
    {"kilonewton", "N", 1e3}, {"KiloNewton", "N", 1e3}, {"daN", "N", 10.0}, {"DaN", "N", 10.0},
    {"DAN", "N", 10.0}, {"dan", "N", 10.0}, {"MN", "N", 1e6}, {"mN", "N", 1e-3},
    {"kgf", "N", 9.80665}, {"KGF", "N", 9.80665}, {"Kgf", "N", 9.80665}, {"kp", "N", 9.80665},
    {"KP", "N", 9.80665}, {"kilopond", "N", 9.80665}, {"kilogram_force", "N", 9.80665},
    {"tf", "N", 9806.65}, {"lbf", "N", kPoundForce}, {"LBF", "N", kPoundForce},
    {"Lbf", "N", kPoundForce}, {"lb", "N", kPoundForce}, {"LB", "N", kPoundForce},
    {"lbs", "N", kPoundForce}, {"LBS", "N", kPoundForce}, {"Lbs", "N", kPoundForce},
    {"pound", "N", kPoundForce}, {"pounds", "N", kPoundForce}, {"pound_force", "N", kPoundForce},
    {"kip", "N", 1e3 * kPoundForce}, {"klbf", "N", 1e3 * kPoundForce},
    {"ozf", "N", kPoundForce / 16}, {"dyn", "N", 1e-5}, {"dyne", "N", 1e-5},
    {"tonf", "N", kRefused}, {"mn", "N", kRefused}, {"Mn", "N", kRefused}, {"ns", "N", kRefused},
    {"p", "N", kRefused}, {"T", "N", kRefused},
    // Moment.
    {"Nm", "N m", 1.0}, {"NM", "N m", 1.0}, {"nm", "N m", 1.0}, {"N m", "N m", 1.0},
    {"N*m", "N m", 1.0}, {"N·m", "N m", 1.0}, {"N.m", "N m", 1.0}, {"N-m", "N m", 1.0},
    {"N⋅m", "N m", 1.0}, {"Newton meter", "N m", 1.0}, {"Ｎ・ｍ", "N m", 1.0}, {"kNm", "N m", 1e3},
    {"KNM", "N m", 1e3}, {"kN m", "N m", 1e3}, {"kN*m", "N m", 1e3}, {"kN-m", "N m", 1e3},
    {"Nmm", "N m", 1e-3}, {"NMM", "N m", 1e-3}, {"N mm", "N m", 1e-3}, {"N-mm", "N m", 1e-3},
    {"Ncm", "N m", 1e-2}, {"N cm", "N m", 1e-2}, {"daNm", "N m", 10.0}, {"kgfm", "N m", 9.80665},
    {"kgf m", "N m", 9.80665}, {"kgf·m", "N m", 9.80665}, {"kgf-m", "N m", 9.80665},
    {"kpm", "N m", 9.80665}, {"kp m", "N m", 9.80665}, {"kgfcm", "N m", 9.80665e-2},
    {"kgf cm", "N m", 9.80665e-2}, {"ft-lb", "N m", 0.3048 * kPoundForce},
    {"ft lb", "N m", 0.3048 * kPoundForce}, {"ft-lbf", "N m", 0.3048 * kPoundForce},
    {"ft·lbf", "N m", 0.3048 * kPoundForce}, {"ftlb", "N m", 0.3048 * kPoundForce},
    {"lb-ft", "N m", 0.3048 * kPoundForce}, {"LB-FT", "N m", 0.3048 * kPoundForce},
    {"lbf ft", "N m", 0.3048 * kPoundForce}, {"lb ft", "N m", 0.3048 * kPoundForce},
    {"lbft", "N m", 0.3048 * kPoundForce}, {"ft-lbs", "N m", 0.3048 * kPoundForce},
    {"FT-LB", "N m", 0.3048 * kPoundForce}, {"in-lb", "N m", 0.0254 * kPoundForce},
    {"in lb", "N m", 0.0254 * kPoundForce}, {"in-lbf", "N m", 0.0254 * kPoundForce},
    {"in.lb", "N m", 0.0254 * kPoundForce}, {"inlb", "N m", 0.0254 * kPoundForce},
    {"lb-in", "N m", 0.0254 * kPoundForce}, {"LB-IN", "N m", 0.0254 * kPoundForce},
    {"lbf·in", "N m", 0.0254 * kPoundForce}, {"in-lbs", "N m", 0.0254 * kPoundForce},
    {"mnm", "N m", kRefused},
    // Pressure [bar, mmHg, mmH2O: ISO 80000-4; at = kgf/cm^2, atm, torr: NIST SP 811, B.8].
    {"Pa", "Pa", 1.0}, {"PA", "Pa", 1.0}, {"pa", "Pa", 1.0}, {"pascal", "Pa", 1.0},
    {"Pascal", "Pa", 1.0}, {"N/m^2", "Pa", 1.0}, {"N/m2", "Pa", 1.0}, {"N/m²", "Pa", 1.0},
    {"N/M2", "Pa", 1.0}, {"kPa", "Pa", 1e3}, {"KPA", "Pa", 1e3}, {"KPa", "Pa", 1e3},
    {"kpa", "Pa", 1e3}, {"Kpa", "Pa", 1e3}, {"[kPa]", "Pa", 1e3}, {"kilopascal", "Pa", 1e3},
    {"㎪", "Pa", 1e3}, {"kPa(g)", "Pa", 1e3}, {"kPag", "Pa", 1e3}, {"hPa", "Pa", 100.0},
    {"HPA", "Pa", 100.0}, {"mbar", "Pa", 100.0}, {"millibar", "Pa", 100.0}, {"MPa", "Pa", 1e6},
    {"Mpa", "Pa", 1e6}, {"MPA", "Pa", 1e6}, {"N/mm^2", "Pa", 1e6}, {"N/mm2", "Pa", 1e6},
    {"N/mm²", "Pa", 1e6}, {"N/mm**2", "Pa", 1e6}, {"MN/m^2", "Pa", 1e6}, {"㎫", "Pa", 1e6},
    {"GPa", "Pa", 1e9}, {"GPA", "Pa", 1e9}, {"kN/mm^2", "Pa", 1e9}, {"bar", "Pa", 1e5},
    {"Bar", "Pa", 1e5}, {"BAR", "Pa", 1e5}, {"[bar]", "Pa", 1e5}, {"barg", "Pa", 1e5},
    {"bar(g)", "Pa", 1e5}, {"ｂａｒ", "Pa", 1e5}, {"psi", "Pa", kPsi}, {"PSI", "Pa", kPsi},
    {"Psi", "Pa", kPsi}, {"psig", "Pa", kPsi}, {"PSIG", "Pa", kPsi}, {"psi(g)", "Pa", kPsi},
    {"lbf/in^2", "Pa", kPsi}, {"lbf/in2", "Pa", kPsi}, {"lb/in^2", "Pa", kPsi},
    {"lb/in²", "Pa", kPsi}, {"ksi", "Pa", 1e3 * kPsi}, {"KSI", "Pa", 1e3 * kPsi},
    {"psf", "Pa", kPsi / 144}, {"lbf/ft^2", "Pa", kPsi / 144}, {"at", "Pa", 98066.5},
    {"AT", "Pa", 98066.5}, {"kgf/cm2", "Pa", 98066.5}, {"kgf/cm^2", "Pa", 98066.5},
    {"kgf/cm²", "Pa", 98066.5}, {"kg/cm2", "Pa", 98066.5}, {"kg/cm^2", "Pa", 98066.5},
    {"kg/cm²", "Pa", 98066.5}, {"KG/CM2", "Pa", 98066.5}, {"kp/cm2", "Pa", 98066.5},
    {"kgf/mm2", "Pa", 9.80665e6}, {"kgf/mm^2", "Pa", 9.80665e6}, {"atm", "Pa", 101325.0},
    {"ATM", "Pa", 101325.0}, {"torr", "Pa", 101325.0 / 760}, {"Torr", "Pa", 101325.0 / 760},
    {"mmHg", "Pa", 13595.1 * 9.80665e-3}, {"MMHG", "Pa", 13595.1 * 9.80665e-3},
    {"inHg", "Pa", 13595.1 * 9.80665 * 0.0254}, {"mmH2O", "Pa", 9.80665}, {"mpa", "Pa", kRefused},
    {"Mbar", "Pa", kRefused}, {"psia", "Pa", kRefused}, {"bara", "Pa", kRefused},
    {"kPaa", "Pa", kRefused}, {"ata", "Pa", kRefused}, {"PSI abs", "Pa", kRefused},
    // Angle; gon of 400 to the turn [DIN 1315]; Grad is German for degree [DIN 1315].
    {"deg", "rad", kDegree}, {"Deg", "rad", kDegree}, {"DEG", "rad", kDegree},
    {"[deg]", "rad", kDegree}, {"(deg)", "rad", kDegree}, {"degree", "rad", kDegree},
    {"Degree", "rad", kDegree}, {"DEGREE", "rad", kDegree}, {"degrees", "rad", kDegree},
    {"Degrees", "rad", kDegree}, {"°", "rad", kDegree}, {"º", "rad", kDegree},
    {"˚", "rad", kDegree}, {"Grad", "rad", kDegree}, {"rad", "rad", 1.0}, {"RAD", "rad", 1.0},
    {"Rad", "rad", 1.0}, {"radian", "rad", 1.0}, {"Radians", "rad", 1.0}, {"RADIANS", "rad", 1.0},
    {"mrad", "rad", 1e-3}, {"MRAD", "rad", 1e-3}, {"gon", "rad", 0.9 * kDegree},
    {"GON", "rad", 0.9 * kDegree}, {"rev", "rad", 2 * kPi}, {"U", "rad", 2 * kPi},
    {"Umdr", "rad", 2 * kPi}, {"turn", "rad", 2 * kPi}, {"arcmin", "rad", kDegree / 60},
    {"'", "rad", kDegree / 60}, {"arcsec", "rad", kDegree / 3600}, {"\"", "rad", kDegree / 3600},
    {"grad", "rad", kRefused}, {"GRAD", "rad", kRefused}, {"Mrad", "rad", kRefused},
    {"degg", "rad", kRefused}, {"d°", "rad", kRefused},
    // Speed of rotation.
    {"rad/s", "rad/s", 1.0}, {"RAD/S", "rad/s", 1.0}, {"rad/sec", "rad/s", 1.0},
    {"rad s^-1", "rad/s", 1.0}, {"rad·s⁻¹", "rad/s", 1.0}, {"deg/s", "rad/s", kDegree},
    {"Deg/s", "rad/s", kDegree}, {"DEG/S", "rad/s", kDegree}, {"deg/sec", "rad/s", kDegree},
    {"°/s", "rad/s", kDegree}, {"degrees/second", "rad/s", kDegree}, {"rpm", "rad/s", kPi / 30},
    {"RPM", "rad/s", kPi / 30}, {"Rpm", "rad/s", kPi / 30}, {"1/min", "rad/s", kPi / 30},
    {"min-1", "rad/s", kPi / 30}, {"min^-1", "rad/s", kPi / 30}, {"min⁻¹", "rad/s", kPi / 30},
    {"U/min", "rad/s", kPi / 30}, {"Umdr/min", "rad/s", kPi / 30}, {"rev/min", "rad/s", kPi / 30},
    {"r/min", "rad/s", kPi / 30}, {"Upm", "rad/s", kPi / 30}, {"1/Min", "rad/s", kPi / 30},
    {"rev/s", "rad/s", 2 * kPi}, {"rps", "rad/s", 2 * kPi}, {"U/s", "rad/s", 2 * kPi},
    {"cps", "rad/s", kRefused}, {"1/s", "rad/s", kRefused}, {"Hz", "rad/s", kRefused},
    // Velocity; knot of 1852 m/h [NIST SP 811, B.8].
    {"m/s", "m/s", 1.0}, {"M/S", "m/s", 1.0}, {"m/sec", "m/s", 1.0}, {"m s^-1", "m/s", 1.0},
    {"m·s⁻¹", "m/s", 1.0}, {"m s-1", "m/s", 1.0}, {"mps", "m/s", 1.0}, {"km/h", "m/s", 1.0 / 3.6},
    {"KM/H", "m/s", 1.0 / 3.6}, {"Km/h", "m/s", 1.0 / 3.6}, {"KMH", "m/s", 1.0 / 3.6},
    {"Kmh", "m/s", 1.0 / 3.6}, {"kmh", "m/s", 1.0 / 3.6}, {"kph", "m/s", 1.0 / 3.6},
    {"KPH", "m/s", 1.0 / 3.6}, {"km/hr", "m/s", 1.0 / 3.6}, {"㎞/h", "m/s", 1.0 / 3.6},
    {"[km/h]", "m/s", 1.0 / 3.6}, {"mph", "m/s", 0.44704}, {"MPH", "m/s", 0.44704},
    {"Mph", "m/s", 0.44704}, {"mi/h", "m/s", 0.44704}, {"mile/h", "m/s", 0.44704},
    {"ft/s", "m/s", 0.3048}, {"FT/S", "m/s", 0.3048}, {"fps", "m/s", 0.3048},
    {"ft/sec", "m/s", 0.3048}, {"in/s", "m/s", 0.0254}, {"ips", "m/s", 0.0254},
    {"mm/s", "m/s", 1e-3}, {"knot", "m/s", 1852.0 / 3600}, {"knots", "m/s", 1852.0 / 3600},
    {"kts", "m/s", 1852.0 / 3600}, {"kn", "m/s", 1852.0 / 3600}, {"ms/", "m/s", kRefused},
    {"kmph/s", "m/s", kRefused},
    // Acceleration; standard gravity 9.80665 m/s^2 [NIST SP 811, B.8].
    {"m/s^2", "m/s^2", 1.0}, {"m/s2", "m/s^2", 1.0}, {"m/s²", "m/s^2", 1.0},
    {"m/s**2", "m/s^2", 1.0}, {"m/s/s", "m/s^2", 1.0}, {"m/sec^2", "m/s^2", 1.0},
    {"M/S2", "m/s^2", 1.0}, {"m s^-2", "m/s^2", 1.0}, {"m·s⁻²", "m/s^2", 1.0},
    {"g", "m/s^2", 9.80665}, {"G", "m/s^2", 9.80665}, {"gn", "m/s^2", 9.80665},
    {"g0", "m/s^2", 9.80665}, {"mg", "m/s^2", 9.80665e-3}, {"ft/s^2", "m/s^2", 0.3048},
    {"ft/s2", "m/s^2", 0.3048}, {"deg/s^2", "rad/s^2", kDegree}, {"°/s²", "rad/s^2", kDegree},
    {"Gal", "m/s^2", kRefused}, {"gs", "m/s^2", kRefused},
    // Time and frequency.
    {"s", "s", 1.0}, {"S", "s", 1.0}, {"sec", "s", 1.0}, {"SEC", "s", 1.0}, {"Sec", "s", 1.0},
    {"second", "s", 1.0}, {"seconds", "s", 1.0}, {"Sek", "s", 1.0}, {"ms", "s", 1e-3},
    {"MS", "s", 1e-3}, {"msec", "s", 1e-3}, {"MSEC", "s", 1e-3}, {"millisecond", "s", 1e-3},
    {"µs", "s", 1e-6}, {"us", "s", 1e-6}, {"min", "s", 60.0}, {"MIN", "s", 60.0},
    {"Min", "s", 60.0}, {"minute", "s", 60.0}, {"h", "s", 3600.0}, {"H", "s", 3600.0},
    {"hr", "s", 3600.0}, {"HR", "s", 3600.0}, {"hour", "s", 3600.0}, {"Hz", "Hz", 1.0},
    {"HZ", "Hz", 1.0}, {"hz", "Hz", 1.0}, {"hertz", "Hz", 1.0}, {"1/s", "Hz", 1.0},
    {"s^-1", "Hz", 1.0}, {"s-1", "Hz", 1.0}, {"kHz", "Hz", 1e3}, {"KHZ", "Hz", 1e3},
    {"Ms", "s", kRefused}, {"as", "s", kRefused}, {"Std", "s", kRefused},
    {"samples", "s", kRefused},
    // Temperature [ITS-90; degree Fahrenheit: NIST SP 811, B.8].
    {"°C", "K", 1.0, 273.15}, {"degC", "K", 1.0, 273.15}, {"DegC", "K", 1.0, 273.15},
    {"DEGC", "K", 1.0, 273.15}, {"deg C", "K", 1.0, 273.15}, {"Deg C", "K", 1.0, 273.15},
    {"DEG C", "K", 1.0, 273.15}, {"C", "K", 1.0, 273.15}, {"[C]", "K", 1.0, 273.15},
    {"Celsius", "K", 1.0, 273.15}, {"celsius", "K", 1.0, 273.15}, {"deg_C", "K", 1.0, 273.15},
    {"℃", "K", 1.0, 273.15}, {"Grad C", "K", 1.0, 273.15}, {"°F", "K", 5.0 / 9, 459.67 * 5 / 9},
    {"degF", "K", 5.0 / 9, 459.67 * 5 / 9}, {"deg F", "K", 5.0 / 9, 459.67 * 5 / 9},
    {"DEG F", "K", 5.0 / 9, 459.67 * 5 / 9}, {"F", "K", 5.0 / 9, 459.67 * 5 / 9},
    {"Fahrenheit", "K", 5.0 / 9, 459.67 * 5 / 9}, {"K", "K", 1.0}, {"Kelvin", "K", 1.0},
    {"degK", "K", 1.0}, {"degR", "K", 5.0 / 9}, {"Rankine", "K", 5.0 / 9}, {"k", "K", kRefused},
    {"f", "K", kRefused}, {"R", "K", kRefused},
    // Plain numbers.
    {"-", "1", 1.0}, {"--", "1", 1.0}, {"[-]", "1", 1.0}, {"(-)", "1", 1.0}, {"1", "1", 1.0},
    {"none", "1", 1.0}, {"N/A", "1", 1.0}, {"n/a", "1", 1.0}, {"—", "1", 1.0}, {"%", "1", 1e-2},
    {"percent", "1", 1e-2}, {"Prozent", "1", 1e-2}, {"pct", "1", 1e-2}, {"％", "1", 1e-2},
    {"permil", "1", 1e-3}, {"‰", "1", 1e-3}, {"Promille", "1", 1e-3}, {"ppm", "1", 1e-6},
    {"dB", "1", kRefused}, {"pi", "1", kRefused}, {"dozen", "1", kRefused},
    // Stiffness, compliance, damping, slopes.
    {"N/mm", "N/m", 1e3}, {"N/MM", "N/m", 1e3}, {"N mm^-1", "N/m", 1e3}, {"N·mm⁻¹", "N/m", 1e3},
    {"N per mm", "N/m", 1e3}, {"kN/m", "N/m", 1e3}, {"N/m", "N/m", 1.0}, {"kN/mm", "N/m", 1e6},
    {"KN/MM", "N/m", 1e6}, {"kgf/mm", "N/m", 9806.65}, {"KGF/MM", "N/m", 9806.65},
    {"kp/mm", "N/m", 9806.65}, {"lbf/in", "N/m", kPoundForce / 0.0254},
    {"lb/in", "N/m", kPoundForce / 0.0254}, {"LB/IN", "N/m", kPoundForce / 0.0254},
    {"lbs/in", "N/m", kPoundForce / 0.0254}, {"lbf/inch", "N/m", kPoundForce / 0.0254},
    {"N/deg", "N/rad", 1.0 / kDegree}, {"N/DEG", "N/rad", 1.0 / kDegree},
    {"N/°", "N/rad", 1.0 / kDegree}, {"kN/deg", "N/rad", 1e3 / kDegree},
    {"lb/deg", "N/rad", kPoundForce / kDegree}, {"lbf/deg", "N/rad", kPoundForce / kDegree},
    {"Nm/deg", "N m/rad", 1.0 / kDegree}, {"N m/deg", "N m/rad", 1.0 / kDegree},
    {"N*m/deg", "N m/rad", 1.0 / kDegree}, {"N·m/°", "N m/rad", 1.0 / kDegree},
    {"NM/DEG", "N m/rad", 1.0 / kDegree}, {"Nm/rad", "N m/rad", 1.0}, {"N·m/rad", "N m/rad", 1.0},
    {"Nmm/deg", "N m/rad", 1e-3 / kDegree}, {"kNm/deg", "N m/rad", 1e3 / kDegree},
    {"ft-lb/deg", "N m/rad", 0.3048 * kPoundForce / kDegree},
    {"lbf-ft/deg", "N m/rad", 0.3048 * kPoundForce / kDegree}, {"Ns/m", "N s/m", 1.0},
    {"N s/m", "N s/m", 1.0}, {"N·s/m", "N s/m", 1.0}, {"N*s/m", "N s/m", 1.0},
    {"N/(m/s)", "N s/m", 1.0}, {"N-s/m", "N s/m", 1.0}, {"kNs/m", "N s/m", 1e3},
    {"N s/mm", "N s/m", 1e3}, {"Ns/mm", "N s/m", 1e3},
    {"lbf s/in", "N s/m", kPoundForce / 0.0254}, {"lb-s/in", "N s/m", kPoundForce / 0.0254},
    {"Nms/rad", "N m s/rad", 1.0}, {"N m s/rad", "N m s/rad", 1.0},
    {"Nms/deg", "N m s/rad", 1.0 / kDegree}, {"mm/kN", "m/N", 1e-6}, {"MM/KN", "m/N", 1e-6},
    {"mm/N", "m/N", 1e-3}, {"deg/kN", "rad/N", kDegree * 1e-3}, {"°/kN", "rad/N", kDegree * 1e-3},
    {"deg/(N m)", "rad/(N m)", kDegree}, {"deg/Nm", "rad/(N m)", kDegree}, {"1/m", "1/m", 1.0},
    {"m^-1", "1/m", 1.0}, {"m-1", "1/m", 1.0}, {"1/mm", "1/m", 1e3}, {"mm/min", "m/s", 1e-3 / 60},
    {"N/Mm", "N/m", kRefused}, {"nN/um", "N/m", kRefused}, {"PS/m", "N/m", kRefused},
    // Density, inertia, energy, power [metric horsepower of 75 kp m/s: DIN 66036; hp of
    // 550 ft lbf/s], yarns.
    {"kg/m^3", "kg/m^3", 1.0}, {"kg/m3", "kg/m^3", 1.0}, {"kg/m³", "kg/m^3", 1.0},
    {"KG/M3", "kg/m^3", 1.0}, {"g/cm^3", "kg/m^3", 1e3}, {"g/cm3", "kg/m^3", 1e3},
    {"g/cm³", "kg/m^3", 1e3}, {"kg/l", "kg/m^3", 1e3}, {"t/m^3", "kg/m^3", 1e3},
    {"lb/ft^3", "kg/m^3", kPound / (0.3048 * 0.3048 * 0.3048)},
    {"lbm/ft3", "kg/m^3", kPound / (0.3048 * 0.3048 * 0.3048)}, {"kg m^2", "kg m^2", 1.0},
    {"kg·m²", "kg m^2", 1.0}, {"kg*m^2", "kg m^2", 1.0}, {"kg m2", "kg m^2", 1.0},
    {"kg mm^2", "kg m^2", 1e-6}, {"Ns", "N s", 1.0}, {"N s", "N s", 1.0}, {"J", "J", 1.0},
    {"N m", "J", 1.0}, {"PS", "W", 735.49875}, {"hp", "W", 550 * 0.3048 * kPoundForce},
    {"HP", "W", 550 * 0.3048 * kPoundForce}, {"kW", "W", 1e3}, {"KW", "W", 1e3},
    {"dtex", "kg/m", 1e-7}, {"mm^2", "m^2", 1e-6}, {"mm2", "m^2", 1e-6}, {"mm²", "m^2", 1e-6},
    {"l", "m^3", 1e-3}, {"L", "m^3", 1e-3}, {"mV", "V", 1e-3}, {"ps", "W", kRefused},
    {"CV", "W", kRefused}, {"pw", "W", kRefused},
};
// clang-format on

}  // namespace unit_spellings

}  // namespace latsch
