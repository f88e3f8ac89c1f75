// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/laboratory/stated_difference.h"
#include "correlation/laboratory/stated_share.h"

namespace latsch::correlation {
namespace {

std::string unit_of(const Node& table,
                    const std::string& key,
                    const Document& model,
                    const std::string& path) {
  try {
    return model.unit(path);
  } catch (const InputError& error) {
    table.reject(key, std::string("leads to no number of the model: ") + error.what());
  }
}

/// Returns the unit in a text: "N/mm^2" for "22.3 N/mm^2".
std::string written_unit(const std::string& text, const std::string& si) {
  const auto quantity = parse_quantity(text, Unit::of(si));
  return quantity ? quantity->unit.text() : "1";
}

/// True for a number without a unit or in percent.
bool is_share(const Node& table, const std::string& key) {
  try {
    const auto written = parse_quantity(table.text(key));
    return written && written->unit.dimensionless();
  } catch (const InputError&) {
    return table.has(key);  // a plain number
  }
}

}  // namespace

DesignVariable read_variable(const Node& table, const Document& model) {
  DesignVariable variable;
  variable.name = table.name();
  variable.place = table.place();
  if (table.has("path") && table.has("paths"))
    table.reject("path", "is given beside paths, expected one of them");
  const std::string key = table.has("paths") ? "paths" : "path";
  variable.paths = key == "paths" ? table.texts(key) : std::vector{table.text(key)};
  if (variable.paths.empty()) table.reject(key, "is empty, expected at least one path");

  const std::string unit = unit_of(table, key, model, variable.paths.front());
  for (const std::string& path : variable.paths) {
    const std::string other = unit_of(table, key, model, path);
    if (other != unit) {
      table.reject(key,
                   "joins a number in " + unit + " with " + path + " in " + other +
                       ", expected numbers of one unit");
    }
  }
  variable.lower = table.quantity("lower", unit);
  variable.upper = table.quantity("upper", unit);
  variable.initial = table.quantity("initial", unit);
  variable.unit = unit == "1" ? "1" : written_unit(table.text("initial"), unit);
  variable.scale = table.choice("scale", {"linear", "logarithmic"}, "linear") == "linear"
                       ? Scale::linear
                       : Scale::logarithmic;
  read_prior(table, unit, variable);
  return variable;
}

std::vector<DesignVariable> read_varied(const Node& root,
                                        const Document& model,
                                        const experiment::SpecimenKind& kind) {
  std::vector<DesignVariable> variables;
  if (!root.has("vary")) return variables;
  for (const std::string& path : root.texts("vary")) {
    const std::string unit = unit_of(root, "vary", model, path);
    const auto range = kind.usual_range(path);
    if (!range)
      root.reject("vary",
                  "has " + in_quotes(path) + ", for which a " + kind.in_words() +
                      " has no usual bounds; expected a [variable.NAME] with path, lower, upper "
                      "and initial for it");
    DesignVariable variable;
    variable.name = path;
    variable.paths = {path};
    variable.place = root.place("vary");
    variable.lower = range->lower;
    variable.upper = range->upper;
    variable.initial = std::clamp(model.get(path), range->lower, range->upper);
    variable.unit = unit;
    variables.push_back(std::move(variable));
  }
  return variables;
}

void read_prior(const Node& table, const std::string& unit, DesignVariable& variable) {
  if (!table.has("prior")) {
    if (table.has("prior_sigma")) table.reject("prior_sigma", "is given, but no prior beside it");
    return;
  }
  Prior prior;
  prior.value = table.quantity("prior", unit);
  prior.of_logarithm = variable.scale == Scale::logarithmic;
  if (prior.of_logarithm && !(prior.value > 0.0)) {
    table.reject("prior", "is not above 0, as a logarithmic variable has to be");
  }
  const bool is_plain = !prior.of_logarithm && unit == "1";
  if (is_plain && is_percentage(table, "prior_sigma")) {
    const double share = table.quantity("prior_sigma", "1", Range::positive());
    table.reject("prior_sigma",
                 fmt::format("is {}, which for a number without a unit may mean {:.6g} or that "
                             "share of the prior, {:.6g}; expected a plain number",
                             in_quotes(table.text("prior_sigma")),
                             share,
                             share * std::abs(prior.value)));
  }
  if (!is_plain && is_share(table, "prior_sigma")) {
    prior.sigma = read_share(table, "prior_sigma", Range::positive(), unit);
    if (!prior.of_logarithm && is_percentage(table, "prior_sigma"))
      expect_difference(table, "prior_sigma", table.text("prior_sigma"), unit);
    if (!prior.of_logarithm) {
      prior.sigma *= std::abs(prior.value);
      if (prior.sigma == 0.0) {
        table.reject("prior_sigma", "is a share of the prior, which is 0; expected one in " + unit);
      }
    }
  } else {
    prior.sigma = read_difference(table, "prior_sigma", unit);
    if (prior.of_logarithm) prior.sigma /= prior.value;
  }
  variable.prior = prior;
}

namespace {

struct Tie {
  Node table;
  std::string name, follows;
  double factor;
};

const Tie* find_tie(const std::vector<Tie>& ties, const std::string& name) {
  for (const Tie& tie : ties) {
    if (tie.name == name) return &tie;
  }
  return nullptr;
}

DesignVariable* find_variable(std::vector<DesignVariable>& variables, const std::string& name) {
  for (DesignVariable& variable : variables) {
    if (variable.name == name) return &variable;
  }
  return nullptr;
}

/// Returns the variable at the end of a chain of ties, and the product of the factors along the
/// chain.
std::pair<DesignVariable*, double> leader(const Tie& tie,
                                          const std::vector<Tie>& ties,
                                          std::vector<DesignVariable>& variables) {
  std::string chain = tie.name;
  double factor = 1.0;
  const Tie* at = &tie;
  for (size_t step = 0; step <= ties.size(); ++step) {
    factor *= at->factor;
    chain += " follows " + at->follows;
    if (DesignVariable* variable = find_variable(variables, at->follows)) return {variable, factor};
    const Tie* next = find_tie(ties, at->follows);
    if (!next) {
      std::vector<std::string> names;
      for (const DesignVariable& variable : variables) names.push_back(variable.name);
      for (const Tie& other : ties) names.push_back(other.name);
      at->table.reject("follows",
                       "is " + in_quotes(at->follows) +
                           ", which is no variable and no tie of the "
                           "study" +
                           did_you_mean(at->follows, names));
    }
    if (next == &tie || next == at) break;
    at = next;
  }
  tie.table.reject("follows", "is circular, expected a variable at the end of the ties: " + chain);
}

void expect_unmoved(const Tie& tie,
                    const std::vector<std::string>& paths,
                    const std::vector<DesignVariable>& variables) {
  const auto moves = [](const std::vector<std::string>& all, const std::string& path) {
    return std::find(all.begin(), all.end(), path) != all.end();
  };
  for (const std::string& path : paths) {
    for (const DesignVariable& variable : variables) {
      std::string mover;
      if (moves(variable.paths, path)) mover = "variable " + variable.name;
      for (const Follower& other : variable.followers) {
        if (moves(other.paths, path)) mover = "tie " + other.name;
      }
      if (!mover.empty()) {
        tie.table.reject(tie.table.has("paths") ? "paths" : "path",
                         "leads to " + in_quotes(path) + ", which " + mover + " moves already");
      }
    }
  }
}

}  // namespace

void read_ties(const Node& root, const Document& model, std::vector<DesignVariable>& variables) {
  std::vector<Tie> ties;
  for (const Node& table : root.named_tables("tie")) {
    ties.push_back(
        {table, table.name(), table.text("follows"), table.quantity("factor", "1", {}, 1.0)});
    if (find_variable(variables, table.name())) {
      throw InputError(table.place(), "tie " + table.name() + " has the name of a variable");
    }
  }
  for (const Tie& tie : ties) {
    const auto [variable, factor] = leader(tie, ties, variables);
    const std::string key = tie.table.has("paths") ? "paths" : "path";
    const auto paths = key == "paths" ? tie.table.texts(key) : std::vector{tie.table.text(key)};
    if (paths.empty()) tie.table.reject(key, "is empty, expected at least one path");
    const std::string unit = model.unit(variable->paths.front());
    for (const std::string& path : paths) {
      const std::string own = unit_of(tie.table, key, model, path);
      if (own == unit) continue;
      tie.table.reject(key,
                       "leads to a number in " + own + ", but " + variable->name +
                           ", which it follows, is in " + unit);
    }
    expect_unmoved(tie, paths, variables);
    variable->followers.push_back({tie.name, paths, factor});
  }
}

Document at(const Document& model, const DesignSpace& space, const DesignPoint& point) {
  assert(static_cast<int>(point.values.size()) == space.size());
  Document changed = model;
  for (int i = 0; i < space.size(); ++i) {
    for (const std::string& path : space[i].paths) changed.set(path, point.values[i]);
    for (const Follower& follower : space[i].followers) {
      for (const std::string& path : follower.paths) {
        changed.set(path, follower.factor * point.values[i]);
      }
    }
  }
  return changed;
}

}  // namespace latsch::correlation
