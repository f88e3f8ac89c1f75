// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/file.h"
#include "formats/deck/inp_cards.h"
#include "formats/deck/inp_equations.h"
#include "formats/deck/inp_material_cards.h"
#include "formats/deck/inp_noted_numbers.h"
#include "formats/deck/inp_options.h"
#include "formats/deck/inp_references.h"
#include "formats/deck/inp_springs.h"

namespace latsch::formats {
namespace {

constexpr std::uintmax_t kLargestDeck = 256u << 20;
constexpr std::size_t kLargestSet = 2'000'000;

bool begins_a_number(const std::string& field) {
  return !field.empty() && (std::isdigit(static_cast<unsigned char>(field[0])) || field[0] == '-');
}

class DeckReader {
 public:
  explicit DeckReader(std::string file_name) { deck_.file = std::move(file_name); }

  InpDeck read(const std::vector<InpCard>& cards) {
    for (const InpCard& card : cards) read_card(card);
    if (step_) throw InputError(step_->place, "*STEP is never closed, expected *END STEP");
    deck_.ties = equations_.ties(deck_.nodes);
    deck_.means = equations_.means(deck_.nodes);
    springs_.put(deck_);
    note_pressure();
    check_references(deck_);
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
        {"VISCOELASTIC", &DeckReader::viscoelastic},
        {"ORIENTATION", &DeckReader::orientation},
        {"SOLID SECTION", &DeckReader::solid_section},
        {"EQUATION", &DeckReader::equation},
        {"SPRING", &DeckReader::spring},
        {"MASS", &DeckReader::mass},
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
        {"DSLOAD", &DeckReader::surface_pressure},
        {"NO COMPRESSION", &DeckReader::no_compression},
        {"SURFACE SECTION", &DeckReader::surface_section},
        {"REBAR LAYER", &DeckReader::rebar_layer},
        {"EMBEDDED ELEMENT", &DeckReader::embedded},
        {"END STEP", &DeckReader::end_step},
    };
    // Keywords that only request output and do not change the model.
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
                       fmt::format("keyword *{} is not supported, expected one of a tire{}",
                                   card.keyword.substr(0, 60),
                                   way_out(card.keyword)));
    check_options(card);
    (this->*handler->second)(card);
  }

  void equation(const InpCard& card) { equations_.add(card); }
  void spring(const InpCard& card) { springs_.add_law(card); }
  void mass(const InpCard& card) { springs_.add_mass(card); }
  void material(const InpCard& card) { materials_.material(card); }
  void hyperelastic(const InpCard& card) { materials_.hyperelastic(card); }
  void elastic(const InpCard& card) { materials_.elastic(card); }
  void density(const InpCard& card) { materials_.density(card); }
  void viscoelastic(const InpCard& card) { materials_.viscoelastic(card); }
  void no_compression(const InpCard& card) { materials_.no_compression(card); }

  // Nodes, elements and sets -----------------------------------------------------------------

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
    static const std::set<std::string> kSolids = {
        "C3D8", "C3D8I", "C3D8R", "C3D8H", "C3D8IH", "C3D8RH"};
    const std::string& type = card.option("TYPE");
    if (type == "SFM3D4" || type == "SFM3D4R") return surface_element(card);
    if (InpSprings::is_one(type)) return springs_.add_elements(card);
    if (!kSolids.count(type))
      throw InputError(card.place,
                       fmt::format("element type {} is not supported, expected C3D8, C3D8I, C3D8R "
                                   "(also with H) or, for layers of rebars, SFM3D4",
                                   type.substr(0, 40)));
    if (!deck_.element_type.empty() && deck_.element_type != type)
      throw InputError(
          card.place,
          fmt::format("element type {} beside {}, expected one of them", type, deck_.element_type));
    deck_.element_type = type;
    add_elements(card, deck_.elements);
  }

  void surface_element(const InpCard& card) { add_elements(card, deck_.surface_elements); }

  template <class Kind>
  void add_elements(const InpCard& card, std::map<int, Kind>& elements) {
    constexpr std::size_t kNodes = std::tuple_size_v<decltype(Kind::node)>;
    std::vector<int> added;
    for (std::size_t i = 0; i < card.lines.size();) {
      Kind element{0, {}, card.at(card.lines[i])};
      // Number of the element, then its nodes; the list may continue on further lines.
      std::vector<int> numbers;
      for (; i < card.lines.size() && numbers.size() < kNodes + 1; ++i)
        for (std::size_t k = 0; k < card.lines[i].fields.size(); ++k)
          numbers.push_back(card.integer(card.lines[i], k));
      if (numbers.size() != kNodes + 1)
        throw InputError(element.place,
                         fmt::format("an element of {} nodes, expected {}",
                                     static_cast<int>(numbers.size()) - 1,
                                     kNodes));
      element.number = numbers[0];
      std::copy(numbers.begin() + 1, numbers.end(), element.node.begin());
      if (std::set<int>(element.node.begin(), element.node.end()).size() != kNodes)
        throw InputError(element.place,
                         fmt::format("element {} uses a node twice", element.number));
      if (deck_.elements.count(element.number) || deck_.surface_elements.count(element.number))
        throw InputError(element.place, fmt::format("element {} is defined twice", element.number));
      elements.emplace(element.number, element);
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
          if (begins_a_number(line.fields[i])) {
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

  /// Returns the numbers that a field means: a single number, or the members of a set.
  static std::vector<int> members(const InpCard& card,
                                  const InpLine& line,
                                  const std::map<std::string, std::vector<int>>& sets,
                                  const char* kind) {
    const std::string& field = card.text(line, 0);
    if (begins_a_number(field)) return {card.integer(line, 0)};
    return find(sets, field, kind, card.at(line));
  }

  // Orientations and sections ----------------------------------------------------------------

  void orientation(const InpCard& card) {
    if (card.lines.empty() || card.lines[0].fields.size() < 6)
      throw InputError(card.place,
                       fmt::format("*ORIENTATION has {} numbers, expected two points",
                                   card.lines.empty() ? 0 : card.lines[0].fields.size()));
    double v[6];
    for (std::size_t i = 0; i < 6; ++i) v[i] = card.number(card.lines[0], i, 0.0);
    const std::string& name = card.option("NAME");
    InpOrientation orientation{card.option("SYSTEM", "RECTANGULAR") == "CYLINDRICAL",
                               {v[0], v[1], v[2]},
                               {v[3], v[4], v[5]},
                               1,
                               -1,
                               card.place};
    if (orientation.cylindrical && (orientation.b - orientation.a).norm() == 0.0)
      throw InputError(card.place, "both points of the axis are the same");
    if (card.lines.size() > 1) {
      const InpLine& turned = card.lines[1];
      orientation.axis = card.integer(turned, 0);
      if (orientation.axis < 1 || orientation.axis > 3)
        throw InputError(card.at(turned),
                         fmt::format("axis {}, expected 1, 2 or 3", orientation.axis));
      if (turned.fields.size() > 1)
        orientation.angle = note_number(deck_,
                                        "orientation." + part_of_path(name) + ".angle",
                                        InpQuantity::angle,
                                        card,
                                        turned,
                                        1);
    }
    deck_.orientations[name] = orientation;
  }

  // Layers of rebars --------------------------------------------------------------------------

  void surface_section(const InpCard& card) {
    if (card.has("DENSITY"))
      throw InputError(card.place, "a surface with a mass of its own is not supported");
    surface_section_ = card.option("ELSET");
  }

  void rebar_layer(const InpCard& card) {
    if (surface_section_.empty())
      throw InputError(card.place, "*REBAR LAYER stands before any *SURFACE SECTION");
    if (const std::string geometry = card.option("GEOMETRY", "CONSTANT"); geometry != "CONSTANT")
      throw InputError(
          card.place,
          fmt::format("GEOMETRY={} is not supported, expected CONSTANT", geometry.substr(0, 40)));
    for (const InpLine& line : card.lines) {
      InpRebars rebars;
      rebars.name = card.text(line, 0);
      rebars.elset = surface_section_;
      rebars.material = card.text(line, 4);
      rebars.orientation = card.option("ORIENTATION", "");
      rebars.place = card.at(line);
      std::string path = "layer." + part_of_path(rebars.name);
      for (int i = 2; !layer_paths_.insert(path).second; ++i)
        path = fmt::format("layer.{}_{}", part_of_path(rebars.name), i);
      rebars.area = note_number(deck_, path + ".area", InpQuantity::area, card, line, 1);
      rebars.spacing = note_number(deck_, path + ".spacing", InpQuantity::length, card, line, 2);
      if (line.fields.size() > 5 && !line.fields[5].empty())
        rebars.angle = note_number(deck_, path + ".angle", InpQuantity::angle, card, line, 5);
      deck_.rebars.push_back(std::move(rebars));
    }
  }

  void embedded(const InpCard& card) {
    InpEmbedding embedding{card.option("HOST ELSET", ""), {}, card.place};
    for (const InpLine& line : card.lines)
      embedding.elsets.insert(embedding.elsets.end(), line.fields.begin(), line.fields.end());
    deck_.embeddings.push_back(std::move(embedding));
  }

  void solid_section(const InpCard& card) {
    deck_.sections.push_back({card.option("ELSET"),
                              card.option("MATERIAL"),
                              card.option("ORIENTATION", ""),
                              card.place});
  }

  // Surfaces and contact ----------------------------------------------------------------------

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

  // Supports, loads and steps -----------------------------------------------------------------

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
      step.pressures.push_back(
          {faces(card, line, 'P'), card.number(line, 2), {line.number, 2, 1.0}});
  }

  void surface_pressure(const InpCard& card) {
    InpStep& step = current_step(card);
    for (const InpLine& line : card.lines) {
      if (card.text(line, 1) != "P")
        throw InputError(card.at(line),
                         fmt::format("load {} is not supported, expected a pressure P",
                                     line.fields[1].substr(0, 20)));
      for (const InpFaces& faces :
           find(deck_.surfaces, card.text(line, 0), "SURFACE", card.at(line)))
        step.pressures.push_back({faces, card.number(line, 2), {line.number, 2, 1.0}});
    }
  }

  /// Makes the pressure of the last static step the number "pressure"; all other pressures of the
  /// deck are proportional to it.
  void note_pressure() {
    const InpPressure* last = nullptr;
    for (const InpStep& step : deck_.steps)
      if (step.kind == InpStep::Kind::statics && !step.pressures.empty())
        last = &step.pressures.front();
    if (!last || last->value == 0.0) return;
    InpNumber number{"pressure", InpQuantity::stress, last->value, {}};
    std::set<int> lines;  // without repetition, because a surface of several sets has one line
    for (const InpStep& step : deck_.steps)
      for (const InpPressure& pressure : step.pressures)
        if (lines.insert(pressure.where.line).second)
          number.where.push_back(
              {pressure.where.line, pressure.where.field, pressure.value / last->value});
    deck_.pressure = static_cast<int>(deck_.numbers.size());
    deck_.numbers.push_back(std::move(number));
  }

  void end_step(const InpCard& card) {
    current_step(card);
    deck_.steps.push_back(std::move(*step_));
    step_.reset();
  }

  InpDeck deck_;
  InpMaterialCards materials_{deck_};
  InpEquations equations_;
  InpSprings springs_;
  InpInteraction* interaction_ = nullptr;
  std::optional<InpStep> step_;
  std::string surface_section_;
  std::set<std::string> layer_paths_;
};

}  // namespace

InpDeck parse_inp(std::string_view text, const std::string& file_name) {
  InpDeck deck = DeckReader(file_name).read(split_cards(text, file_name));
  if (const auto stated = stated_units(text, file_name)) {
    deck.units = *stated;
    deck.are_units_stated = true;
  } else {
    deck.units = units_by_size(deck);
  }
  deck.remarks = stated_remarks(text, file_name);
  return deck;
}

InpDeck read_inp(const std::filesystem::path& file) {
  return parse_inp(read_text_file(file, kLargestDeck), file.string());
}

}  // namespace latsch::formats
