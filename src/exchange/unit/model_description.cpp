// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/model_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

#include "base/text.h"

namespace latsch::exchange {
namespace {

/// A unit of measurement as exponents of the SI base units.
struct BaseUnit {
  std::string_view name;
  int kg = 0, m = 0, s = 0, rad = 0;
};
constexpr std::array kUnits = {BaseUnit{"N", 1, 1, -2, 0},
                               BaseUnit{"N m", 1, 2, -2, 0},
                               BaseUnit{"N m/rad", 1, 2, -2, -1},
                               BaseUnit{"N/m", 1, 0, -2, 0},
                               BaseUnit{"Pa", 1, -1, -2, 0},
                               BaseUnit{"kg m^2", 1, 2, 0, 0},
                               BaseUnit{"m", 0, 1, 0, 0},
                               BaseUnit{"m/s", 0, 1, -1, 0},
                               BaseUnit{"m/s^2", 0, 1, -2, 0},
                               BaseUnit{"m^2", 0, 2, 0, 0},
                               BaseUnit{"rad", 0, 0, 0, 1},
                               BaseUnit{"rad/s", 0, 0, -1, 1},
                               BaseUnit{"s", 0, 0, 1, 0}};

/// Returns a text as an XML attribute's value in double quotes [XML 1.0, 2.3]; characters that XML
/// cannot represent become blanks.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return result;
}

std::string attribute(std::string_view name, std::string_view value) {
  return fmt::format(" {}=\"{}\"", name, escaped(value));
}

std::string unit_definitions(const std::vector<ExchangedVariable>& variables) {
  std::string text = "  <UnitDefinitions>\n";
  for (const BaseUnit& unit : kUnits) {
    const bool used =
        unit.name == "s" ||
        std::any_of(variables.begin(), variables.end(), [&](const ExchangedVariable& variable) {
          return variable.unit == unit.name;
        });
    if (!used) continue;
    text += fmt::format("    <Unit{}><BaseUnit", attribute("name", unit.name));
    for (const auto& [base, exponent] :
         {std::pair("kg", unit.kg), {"m", unit.m}, {"s", unit.s}, {"rad", unit.rad}})
      if (exponent != 0) text += attribute(base, std::to_string(exponent));
    text += "/></Unit>\n";
  }
  return text + "  </UnitDefinitions>\n";
}

std::string log_categories() {
  std::string text = "  <LogCategories>\n";
  for (const char* category : {kLogWarning, kLogDiscard, kLogError})
    text += "    <Category" + attribute("name", category) + "/>\n";
  return text + "  </LogCategories>\n";
}

std::string causality(const ExchangedVariable& variable) {
  switch (variable.causality) {
    case Causality::parameter:
      return attribute("causality", "parameter") + attribute("variability", "fixed");
    case Causality::input:
      return attribute("causality", "input") + attribute("variability", "continuous");
    case Causality::output:
      break;
  }
  return attribute("causality", "output") + attribute("variability", "continuous");
}

std::string unit_and_start(const ExchangedVariable& variable) {
  assert(variable.unit == "1" ||
         std::any_of(kUnits.begin(), kUnits.end(), [&](const BaseUnit& unit) {
           return unit.name == variable.unit;
         }));
  std::string text;
  if (variable.unit != "1") text += attribute("unit", variable.unit);
  if (variable.causality != Causality::output)
    text += attribute("start", format_number(variable.start));
  return text;
}

std::string variable_element(FmiVersion version,
                             const std::string& name,
                             unsigned reference,
                             const std::string& description,
                             const std::string& role,
                             const std::string& unit) {
  const std::string head = attribute("name", name) +
                           attribute("valueReference", std::to_string(reference)) +
                           attribute("description", description) + role;
  return version == FmiVersion::fmi2
             ? "    <ScalarVariable" + head + "><Real" + unit + "/></ScalarVariable>\n"
             : "    <Float64" + head + unit + "/>\n";
}

std::string model_variables(FmiVersion version, const std::vector<ExchangedVariable>& variables) {
  std::string text = "  <ModelVariables>\n";
  text += variable_element(
      version,
      "time",
      kTimeReference,
      "of the last communication point",
      attribute("causality", "independent") + attribute("variability", "continuous"),
      attribute("unit", "s"));
  for (std::size_t i = 0; i < variables.size(); ++i)
    text += variable_element(version,
                             variables[i].name,
                             reference_of(i),
                             variables[i].description,
                             causality(variables[i]),
                             unit_and_start(variables[i]));
  return text + "  </ModelVariables>\n";
}

std::string model_structure(FmiVersion version, const std::vector<ExchangedVariable>& variables) {
  const bool two = version == FmiVersion::fmi2;
  std::string outputs, initial;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (variables[i].causality != Causality::output) continue;
    // FMI 2.0 refers to variables by their position in ModelVariables, counted from 1; position 1
    // is the time.
    const std::string place = two ? attribute("index", std::to_string(i + 2))
                                  : attribute("valueReference", std::to_string(reference_of(i)));
    outputs +=
        (two ? "      <Unknown" : "    <Output") + place + attribute("dependencies", "") + "/>\n";
    initial += (two ? "      <Unknown" : "    <InitialUnknown") + place + "/>\n";
  }
  if (two) {
    outputs = "    <Outputs>\n" + outputs + "    </Outputs>\n";
    initial = "    <InitialUnknowns>\n" + initial + "    </InitialUnknowns>\n";
  }
  return "  <ModelStructure>\n" + outputs + initial + "  </ModelStructure>\n";
}

}  // namespace

std::string identifier_of(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool digit = c >= '0' && c <= '9';
    if (digit && result.empty()) result = "_";
    result += letter || digit ? c : '_';
  }
  return result.empty() ? "unit" : result;
}

std::string model_description(FmiVersion version,
                              const UnitTitle& title,
                              const std::vector<ExchangedVariable>& variables) {
  const bool two = version == FmiVersion::fmi2;
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription" +
         attribute("fmiVersion", two ? "2.0" : "3.0") + attribute("modelName", title.name) +
         attribute(two ? "guid" : "instantiationToken", title.token) +
         attribute("description", title.description) + attribute("generationTool", "Latsch") +
         attribute("variableNamingConvention", "structured") + ">\n  <CoSimulation" +
         attribute("modelIdentifier", identifier_of(title.name)) +
         attribute("needsExecutionTool", "false") +
         attribute("canHandleVariableCommunicationStepSize", "true") +
         attribute("canBeInstantiatedOnlyOncePerProcess", "false") +
         (two ? attribute("canNotUseMemoryManagementFunctions", "true") +
                    attribute("canGetAndSetFMUstate", "true") +
                    attribute("canSerializeFMUstate", "false")
              : attribute("canGetAndSetFMUState", "true") +
                    attribute("canSerializeFMUState", "false")) +
         "/>\n" + unit_definitions(variables) + log_categories() + "  <DefaultExperiment" +
         attribute("startTime", "0") + attribute("stopTime", "1") +
         attribute("stepSize", format_number(title.step)) + "/>\n" +
         model_variables(version, variables) + model_structure(version, variables) +
         "</fmiModelDescription>\n";
}

}  // namespace latsch::exchange
