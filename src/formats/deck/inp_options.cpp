// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/text.h"

namespace latsch::formats {
namespace {

/// An option of a card with the values for which the model is supported, and the meaning of other
/// values.
struct Limited {
  std::vector<std::string> values;
  const char* otherwise;
};

struct CardOptions {
  std::vector<std::string> read;  // options that the reader of the card uses
  // options of the solution method or of naming, which do not change the model
  std::vector<std::string> idle;
  std::map<std::string, Limited> limited;
};

const Limited kOp = {{"MOD"}, "takes earlier ones away"};
const Limited kOpOfLoads = {{"MOD", "NEW"}, "is no way to add loads"};

const std::map<std::string, CardOptions>& known_options() {
  static const std::map<std::string, CardOptions> known = {
      {"NODE", {{"NSET"}, {}, {{"SYSTEM", {{"R"}, "means other than x, y, z coordinates"}}}}},
      {"ELEMENT", {{"TYPE", "ELSET"}, {}, {}}},
      {"NSET", {{"NSET", "GENERATE"}, {"INTERNAL", "UNSORTED"}, {}}},
      {"ELSET", {{"ELSET", "GENERATE"}, {"INTERNAL", "UNSORTED"}, {}}},
      {"MATERIAL", {{"NAME"}, {"DESCRIPTION"}, {}}},
      {"HYPERELASTIC",
       {{"NEO HOOKE", "MOONEY-RIVLIN"},
        // Other material laws are refused, with their name, when the law is read.
        {"MODULI",
         "OGDEN",
         "YEOH",
         "POLYNOMIAL",
         "REDUCED POLYNOMIAL",
         "ARRUDA-BOYCE",
         "VAN DER WAALS",
         "MARLOW",
         "USER",
         "TEST DATA INPUT"},
        {{"N", {{"1"}, "means a law of higher order"}}}}},
      {"ELASTIC", {{"TYPE"}, {"MODULI"}, {}}},
      {"DENSITY", {{}, {}, {}}},
      {"VISCOELASTIC",
       {{}, {}, {{"TIME", {{"PRONY"}, "means terms that are to be fitted to data"}}}}},
      {"ORIENTATION",
       {{"NAME"},
        {},
        {{"SYSTEM", {{"RECTANGULAR", "CYLINDRICAL"}, "means other axes"}},
         {"DEFINITION", {{"COORDINATES"}, "means other axes"}}}}},
      {"SOLID SECTION", {{"ELSET", "MATERIAL", "ORIENTATION"}, {}, {}}},
      {"EQUATION", {{}, {}, {}}},
      {"SPRING", {{"ELSET", "NONLINEAR"}, {}, {}}},
      {"MASS", {{"ELSET"}, {}, {}}},
      {"SURFACE", {{"NAME", "TYPE"}, {"INTERNAL"}, {}}},
      {"SURFACE INTERACTION", {{"NAME"}, {}, {}}},
      {"SURFACE BEHAVIOR", {{"PRESSURE-OVERCLOSURE"}, {}, {}}},
      {"FRICTION", {{}, {"SLIP TOLERANCE", "ELASTIC SLIP", "LAGRANGE"}, {}}},
      {"CONTACT PAIR",
       {{"INTERACTION"},
        {"SMALL SLIDING", "NO THICKNESS", "MECHANICAL CONSTRAINT"},
        {{"TYPE",
          {{"SURFACE TO SURFACE", "NODE TO SURFACE", "MORTAR", "LINMORTAR", "PGLINMORTAR"},
           "means another contact"}},
         {"ADJUST", {{"0", "0.", "0.0"}, "moves nodes onto the ground before the load"}}}}},
      {"BOUNDARY", {{}, {}, {{"OP", kOp}}}},
      {"STEP",
       {{"PERTURBATION"},
        {"INC", "NAME", "UNSYMM", "AMPLITUDE", "EXTRAPOLATION", "CONVERT SDI"},
        {{"NLGEOM", {{"", "YES", "ON"}, "means small deflections, which no tire has"}}}}},
      {"STATIC",
       {{},
        {"SOLVER",
         "DIRECT",
         "STABILIZE",
         "FACTOR",
         "ALLSDTOL",
         "CONTINUE",
         "TIME RESET",
         "TOTAL TIME AT START"},
        {}}},
      {"FREQUENCY",
       {{}, {"SOLVER", "EIGENSOLVER", "STORAGE", "NORMALIZATION", "ACOUSTIC COUPLING"}, {}}},
      {"DLOAD", {{}, {}, {{"OP", kOpOfLoads}}}},
      {"DSLOAD", {{}, {}, {{"OP", kOpOfLoads}}}},
      {"NO COMPRESSION", {{}, {}, {}}},
      {"SURFACE SECTION", {{"ELSET", "DENSITY"}, {}, {}}},
      {"REBAR LAYER", {{"ORIENTATION", "GEOMETRY"}, {}, {}}},
      {"EMBEDDED ELEMENT",
       {{"HOST ELSET"},
        {"EXTERIOR TOLERANCE", "ABSOLUTE EXTERIOR TOLERANCE", "ROUNDOFF TOLERANCE"},
        {}}},
      {"END STEP", {{}, {}, {}}},
  };
  return known;
}

bool holds(const std::vector<std::string>& list, const std::string& one) {
  return std::find(list.begin(), list.end(), one) != list.end();
}

[[noreturn]] void refuse_unknown(const InpCard& card,
                                 const CardOptions& known,
                                 const std::string& option) {
  std::vector<std::string> expected = known.read;
  for (const auto& [name, values] : known.limited) expected.push_back(name);
  std::vector<std::string> names = expected;
  names.insert(names.end(), known.idle.begin(), known.idle.end());
  throw InputError(card.place,
                   fmt::format("*{} has the option {}, which is not read here{}; expected {}",
                               card.keyword,
                               option.substr(0, 40),
                               did_you_mean(option, names),
                               expected.empty() ? std::string("none")
                                                : fmt::format("{}", fmt::join(expected, ", "))));
}

}  // namespace

void check_options(const InpCard& card) {
  const auto found = known_options().find(card.keyword);
  if (found == known_options().end()) return;
  const CardOptions& known = found->second;
  for (const auto& [option, value] : card.options) {
    if (option.empty() || holds(known.read, option) || holds(known.idle, option)) continue;
    const auto limited = known.limited.find(option);
    if (limited == known.limited.end()) refuse_unknown(card, known, option);
    if (!holds(limited->second.values, value))
      throw InputError(card.place,
                       fmt::format("*{}, {}={} {} and is not read here; expected {}",
                                   card.keyword,
                                   option,
                                   value.substr(0, 40),
                                   limited->second.otherwise,
                                   fmt::join(limited->second.values, ", ")));
  }
}

std::string way_out(const std::string& keyword) {
  if (keyword == "PART" || keyword == "ASSEMBLY" || keyword == "INSTANCE")
    return ": expected a deck without parts and assemblies";
  if (keyword == "INCLUDE") return ": expected one file";
  if (keyword == "REBAR" || keyword == "MEMBRANE SECTION")
    return ": expected cords as *REBAR LAYER below a *SURFACE SECTION of elements SFM3D4 that are "
           "an *EMBEDDED ELEMENT, as springs, or smeared as *ELASTIC";
  return "";
}

}  // namespace latsch::formats
