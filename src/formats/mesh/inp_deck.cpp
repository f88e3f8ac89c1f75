// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "formats/mesh/inp_cards.h"

namespace latsch::formats {
namespace {

constexpr std::uintmax_t kLargestDeck = 256u << 20;
constexpr std::size_t kLargestSet = 2'000'000;

bool is_number(const std::string& field) {
  return !field.empty() && (std::isdigit(static_cast<unsigned char>(field[0])) || field[0] == '-');
}

class DeckReader {
 public:
  explicit DeckReader(std::string file_name) { deck_.file = std::move(file_name); }

  InpDeck read(const std::vector<InpCard>& cards) {
    for (const InpCard& card : cards) read_card(card);
    if (step_) throw InputError(step_->place, "*STEP is never closed, expected *END STEP");
    check_references();
    return std::move(deck_);
  }

 private:
  using Handler = void (DeckReader::*)(const InpCard&);

  void read_card(const InpCard& card) {
    static const std::map<std::string, Handler> kHandlers = {
        {"NODE", &DeckReader::node},
        {"ELEMENT", &DeckReader::element},
        {"NSET", &DeckReader::node_set},
        {"ELSET", &DeckReader::element_set},
        {"MATERIAL", &DeckReader::material},
        {"HYPERELASTIC", &DeckReader::hyperelastic},
        {"ELASTIC", &DeckReader::elastic},
        {"DENSITY", &DeckReader::density},
        {"ORIENTATION", &DeckReader::orientation},
        {"SOLID SECTION", &DeckReader::solid_section},
        {"SURFACE", &DeckReader::surface},
        {"SURFACE INTERACTION", &DeckReader::interaction},
        {"SURFACE BEHAVIOR", &DeckReader::behavior},
        {"FRICTION", &DeckReader::friction},
        {"CONTACT PAIR", &DeckReader::contact},
        {"BOUNDARY", &DeckReader::boundary},
        {"STEP", &DeckReader::step},
        {"STATIC", &DeckReader::statics},
        {"FREQUENCY", &DeckReader::frequency},
        {"DLOAD", &DeckReader::pressure},
        {"END STEP", &DeckReader::end_step},
    };
    // What a program is asked to print does not change the model.
    static const std::set<std::string> kOutput = {"HEADING",
                                                  "NODE PRINT",
                                                  "NODE FILE",
                                                  "NODE OUTPUT",
                                                  "EL PRINT",
                                                  "EL FILE",
                                                  "ELEMENT OUTPUT",
                                                  "CONTACT PRINT",
                                                  "CONTACT FILE",
                                                  "CONTACT OUTPUT",
                                                  "OUTPUT",
                                                  "RESTART",
                                                  "PREPRINT"};
    if (kOutput.count(card.keyword)) return;
    const auto handler = kHandlers.find(card.keyword);
    if (handler == kHandlers.end())
      throw InputError(card.place,
                       fmt::format("keyword *{} is not supported", card.keyword.substr(0, 60)));
    (this->*handler->second)(card);
  }

  // Nodes, elements, sets.

  void node(const InpCard& card) {
    std::vector<int> added;
    for (const InpLine& line : card.lines) {
      const int number = card.integer(line, 0);
      if (number < 1)
        throw InputError(card.at(line), fmt::format("node {}, expected a positive number", number));
      const Eigen::Vector3d x(
          card.number(line, 1, 0.0), card.number(line, 2, 0.0), card.number(line, 3, 0.0));
      if (!deck_.nodes.emplace(number, x).second)
        throw InputError(card.at(line), fmt::format("node {} is defined twice", number));
      added.push_back(number);
    }
    if (card.has("NSET")) append(deck_.node_sets[card.option("NSET")], added, card.place);
  }

  void element(const InpCard& card) {
    if (const std::string& type = card.option("TYPE"); type != "C3D8")
      throw InputError(card.place,
                       fmt::format("element type {} is not supported, expected C3D8", type));
    std::vector<int> added;
    for (std::size_t i = 0; i < card.lines.size();) {
      InpElement element{0, {}, card.at(card.lines[i])};
      std::vector<int> numbers;  // number and eight nodes, perhaps on several lines
      for (; i < card.lines.size() && numbers.size() < 9; ++i)
        for (std::size_t k = 0; k < card.lines[i].fields.size(); ++k)
          numbers.push_back(card.integer(card.lines[i], k));
      if (numbers.size() != 9)
        throw InputError(element.place,
                         fmt::format("an element of {} nodes, expected 8",
                                     static_cast<int>(numbers.size()) - 1));
      element.number = numbers[0];
      std::copy(numbers.begin() + 1, numbers.end(), element.node.begin());
      if (std::set<int>(element.node.begin(), element.node.end()).size() != 8)
        throw InputError(element.place,
                         fmt::format("element {} uses a node twice", element.number));
      if (!deck_.elements.emplace(element.number, element).second)
        throw InputError(element.place, fmt::format("element {} is defined twice", element.number));
      added.push_back(element.number);
    }
    if (card.has("ELSET")) append(deck_.element_sets[card.option("ELSET")], added, card.place);
  }

  void node_set(const InpCard& card) { collect(card, "NSET", deck_.node_sets); }
  void element_set(const InpCard& card) { collect(card, "ELSET", deck_.element_sets); }

  void collect(const InpCard& card,
               const char* kind,
               std::map<std::string, std::vector<int>>& sets) {
    std::vector<int> members;
    for (const InpLine& line : card.lines) {
      if (card.has("GENERATE")) {
        const long first = card.integer(line, 0), last = card.integer(line, 1);
        const long step = line.fields.size() > 2 ? card.integer(line, 2) : 1;
        if (step < 1 || last < first || (last - first) / step > long(kLargestSet))
          throw InputError(
              card.at(line),
              fmt::format(
                  "generates {} to {} by {}, expected an ascending range", first, last, step));
        for (long i = first; i <= last; i += step) members.push_back(static_cast<int>(i));
      } else {
        for (std::size_t i = 0; i < line.fields.size(); ++i) {
          if (is_number(line.fields[i])) {
            members.push_back(card.integer(line, i));
          } else {
            append(members, find(sets, line.fields[i], kind, card.at(line)), card.at(line));
          }
        }
      }
    }
    append(sets[card.option(kind)], members, card.place);
  }

  static void append(std::vector<int>& set, const std::vector<int>& members, const Place& place) {
    if (set.size() + members.size() > kLargestSet)
      throw InputError(place, fmt::format("a set of more than {} members", kLargestSet));
    set.insert(set.end(), members.begin(), members.end());
  }

  template <class Value>
  static const Value& find(const std::map<std::string, Value>& map,
                           const std::string& name,
                           const char* kind,
                           const Place& place) {
    const auto found = map.find(name);
    if (found == map.end())
      throw InputError(place,
                       fmt::format("{} \"{}\" is not defined above", kind, name.substr(0, 60)));
    return found->second;
  }

  /// A number or the name of a set.
  static std::vector<int> members(const InpCard& card,
                                  const InpLine& line,
                                  const std::map<std::string, std::vector<int>>& sets,
                                  const char* kind) {
    const std::string& field = card.text(line, 0);
    if (is_number(field)) return {card.integer(line, 0)};
    return find(sets, field, kind, card.at(line));
  }

  // Materials and sections.

  void material(const InpCard& card) {
    material_ = &deck_.materials[card.option("NAME")];
    material_->name = card.option("NAME");
    material_->place = card.place;
  }

  InpMaterial& current_material(const InpCard& card) {
    if (!material_)
      throw InputError(card.place, fmt::format("*{} stands before any *MATERIAL", card.keyword));
    return *material_;
  }

  static void expect_count(const InpCard& card,
                           const std::vector<double>& values,
                           std::size_t count) {
    if (values.size() != count)
      throw InputError(card.place,
                       fmt::format("*{} has {} constants, expected {} at one temperature",
                                   card.keyword,
                                   values.size(),
                                   count));
  }

  void hyperelastic(const InpCard& card) {
    InpMaterial& material = current_material(card);
    const std::vector<double> c = card.numbers();
    if (card.has("NEO HOOKE")) {
      expect_count(card, c, 2);
      material.hyperelastic = {c[0], 0.0, c[1]};
    } else if (card.has("MOONEY-RIVLIN")) {
      expect_count(card, c, 3);
      material.hyperelastic = {c[0], c[1], c[2]};
    } else {
      throw InputError(
          card.place,
          "this hyperelastic law is not supported, expected NEO HOOKE or MOONEY-RIVLIN");
    }
    if (!(material.hyperelastic->D1 > 0.0))
      throw InputError(card.place,
                       fmt::format("D1 is {}, expected more than 0 (the law is compressible)",
                                   material.hyperelastic->D1));
    if (!(material.hyperelastic->C10 > 0.0) || material.hyperelastic->C01 < 0.0)
      throw InputError(card.place, "C10 and C01 give no positive shear modulus");
  }

  void elastic(const InpCard& card) {
    InpMaterial& material = current_material(card);
    const std::string type = card.option("TYPE", "ISO");
    if (type == "ISO" || type == "ISOTROPIC") {
      material.elastic = card.numbers();
      expect_count(card, material.elastic, 2);
      if (!(material.elastic[0] > 0.0) ||
          !(material.elastic[1] > -1.0 && material.elastic[1] < 0.5))
        throw InputError(card.place,
                         fmt::format("E = {}, nu = {}, expected E > 0 and -1 < nu < 0.5",
                                     material.elastic[0],
                                     material.elastic[1]));
    } else if (type == "ANISO" || type == "ANISOTROPIC") {
      material.anisotropic = card.numbers();
      if (material.anisotropic.size() == 22) material.anisotropic.pop_back();  // a temperature
      expect_count(card, material.anisotropic, 21);
    } else {
      throw InputError(
          card.place,
          fmt::format("*ELASTIC, TYPE={} is not supported, expected ISO or ANISO", type));
    }
  }

  void density(const InpCard& card) {
    const std::vector<double> values = card.numbers();
    expect_count(card, values, 1);
    if (!(values[0] > 0.0))
      throw InputError(card.place, fmt::format("density {}, expected more than 0", values[0]));
    current_material(card).density = values[0];
  }

  void orientation(const InpCard& card) {
    const std::vector<double> v = card.numbers();
    if (v.size() < 6)
      throw InputError(card.place,
                       fmt::format("*ORIENTATION has {} numbers, expected two points", v.size()));
    InpOrientation orientation{card.option("SYSTEM", "RECTANGULAR") == "CYLINDRICAL",
                               {v[0], v[1], v[2]},
                               {v[3], v[4], v[5]}};
    if (orientation.cylindrical && (orientation.b - orientation.a).norm() == 0.0)
      throw InputError(card.place, "both points of the axis are the same");
    deck_.orientations[card.option("NAME")] = orientation;
  }

  void solid_section(const InpCard& card) {
    deck_.sections.push_back({card.option("ELSET"),
                              card.option("MATERIAL"),
                              card.option("ORIENTATION", ""),
                              card.place});
  }

  // Surfaces and contact.

  InpFaces faces(const InpCard& card, const InpLine& line, char letter) {
    const std::string& face = card.text(line, 1);
    if (face.size() != 2 || face[0] != letter || face[1] < '1' || face[1] > '6')
      throw InputError(
          card.at(line),
          fmt::format("face \"{}\", expected {}1 to {}6", face.substr(0, 20), letter, letter));
    return {members(card, line, deck_.element_sets, "ELSET"), face[1] - '0', card.at(line)};
  }

  void surface(const InpCard& card) {
    if (const std::string type = card.option("TYPE", "ELEMENT"); type != "ELEMENT")
      throw InputError(card.place,
                       fmt::format("*SURFACE, TYPE={} is not supported, expected ELEMENT", type));
    for (const InpLine& line : card.lines)
      deck_.surfaces[card.option("NAME")].push_back(faces(card, line, 'S'));
  }

  void interaction(const InpCard& card) { interaction_ = &deck_.interactions[card.option("NAME")]; }

  InpInteraction& current_interaction(const InpCard& card) {
    if (!interaction_)
      throw InputError(card.place,
                       fmt::format("*{} stands before any *SURFACE INTERACTION", card.keyword));
    return *interaction_;
  }

  void behavior(const InpCard& card) {
    if (card.option("PRESSURE-OVERCLOSURE") != "LINEAR")
      throw InputError(card.place, "only PRESSURE-OVERCLOSURE=LINEAR is supported");
    if (card.lines.empty()) throw InputError(card.place, "the contact stiffness is missing");
    const double stiffness = card.number(card.lines[0], 0);
    if (!(stiffness > 0.0))
      throw InputError(card.at(card.lines[0]),
                       fmt::format("contact stiffness {}, expected more than 0", stiffness));
    current_interaction(card).stiffness = stiffness;
  }

  void friction(const InpCard& card) {
    if (card.lines.empty()) throw InputError(card.place, "the friction coefficient is missing");
    const double mu = card.number(card.lines[0], 0);
    if (mu < 0.0)
      throw InputError(card.at(card.lines[0]),
                       fmt::format("friction coefficient {}, expected 0 or more", mu));
    current_interaction(card).mu = mu;
  }

  void contact(const InpCard& card) {
    for (const InpLine& line : card.lines)
      deck_.contacts.push_back(
          {card.option("INTERACTION"), card.text(line, 0), card.text(line, 1), card.at(line)});
  }

  // Supports, loads, steps.

  void boundary(const InpCard& card) {
    for (const InpLine& line : card.lines) {
      InpSupport support{members(card, line, deck_.node_sets, "NSET"),
                         card.integer(line, 1),
                         0,
                         card.number(line, 3, 0.0),
                         card.at(line)};
      support.last =
          line.fields.size() > 2 && !line.fields[2].empty() ? card.integer(line, 2) : support.first;
      if (support.first < 1 || support.last > 3 || support.last < support.first)
        throw InputError(
            card.at(line),
            fmt::format(
                "degrees of freedom {} to {}, expected 1 to 3", support.first, support.last));
      (step_ ? step_->supports : deck_.supports).push_back(std::move(support));
    }
  }

  void step(const InpCard& card) {
    if (step_) throw InputError(card.place, "*STEP inside a step, expected *END STEP before");
    step_.emplace();
    step_->place = card.place;
    step_->perturbation = card.has("PERTURBATION");
  }

  InpStep& current_step(const InpCard& card) {
    if (!step_) throw InputError(card.place, fmt::format("*{} outside a step", card.keyword));
    return *step_;
  }

  void statics(const InpCard& card) { current_step(card).kind = InpStep::Kind::statics; }

  void frequency(const InpCard& card) {
    InpStep& step = current_step(card);
    step.kind = InpStep::Kind::frequency;
    if (card.lines.empty()) throw InputError(card.place, "the number of modes is missing");
    step.modes = card.integer(card.lines[0], 0);
    if (step.modes < 1)
      throw InputError(card.at(card.lines[0]),
                       fmt::format("{} modes, expected 1 or more", step.modes));
  }

  void pressure(const InpCard& card) {
    InpStep& step = current_step(card);
    for (const InpLine& line : card.lines)
      step.pressures.push_back({faces(card, line, 'P'), card.number(line, 2)});
  }

  void end_step(const InpCard& card) {
    current_step(card);
    deck_.steps.push_back(std::move(*step_));
    step_.reset();
  }

  // What is named must exist.

  void check_references() const {
    for (const auto& [number, element] : deck_.elements)
      for (int node : element.node)
        if (!deck_.nodes.count(node))
          throw InputError(
              element.place,
              fmt::format("element {} uses node {}, which is not defined", number, node));
    for (const auto& [name, set] : deck_.node_sets) check_members(name, set, deck_.nodes, "node");
    for (const auto& [name, set] : deck_.element_sets)
      check_members(name, set, deck_.elements, "element");
    for (const InpSection& section : deck_.sections) {
      find(deck_.element_sets, section.elset, "ELSET", section.place);
      find(deck_.materials, section.material, "MATERIAL", section.place);
      if (!section.orientation.empty())
        find(deck_.orientations, section.orientation, "ORIENTATION", section.place);
    }
    for (const InpContact& contact : deck_.contacts) {
      find(deck_.interactions, contact.interaction, "SURFACE INTERACTION", contact.place);
      find(deck_.surfaces, contact.slave, "SURFACE", contact.place);
      find(deck_.surfaces, contact.master, "SURFACE", contact.place);
    }
  }

  template <class Value>
  void check_members(const std::string& name,
                     const std::vector<int>& set,
                     const std::map<int, Value>& defined,
                     const char* kind) const {
    for (int number : set)
      if (!defined.count(number))
        throw InputError(
            {deck_.file, 0},
            fmt::format("set \"{}\" holds {} {}, which is not defined", name, kind, number));
  }

  InpDeck deck_;
  InpMaterial* material_ = nullptr;
  InpInteraction* interaction_ = nullptr;
  std::optional<InpStep> step_;
};

}  // namespace

InpDeck parse_inp(std::string_view text, const std::string& file_name) {
  return DeckReader(file_name).read(split_cards(text, file_name));
}

InpDeck read_inp(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InputError({file.string(), 0}, "cannot be read: " + error.message());
  if (size > kLargestDeck)
    throw InputError({file.string(), 0},
                     fmt::format("has {} bytes, expected at most {}", size, kLargestDeck));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError({file.string(), 0}, "cannot be read");
  return parse_inp(text.view(), file.string());
}

}  // namespace latsch::formats
