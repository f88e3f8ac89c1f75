// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_tire.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "formats/mesh/element_axes.h"
#include "formats/mesh/inp_cords.h"
#include "formats/mesh/inp_ground.h"
#include "formats/mesh/inp_losses.h"
#include "formats/mesh/inp_materials.h"
#include "formats/mesh/mesh_surface.h"
#include "formats/mesh/rotational_symmetry.h"
#include "formats/mesh/tied_corners.h"

namespace latsch::formats {
namespace {

using fe_tire::Element;
using fe_tire::Mesh;

class TireReader {
 public:
  explicit TireReader(const InpDeck& deck) : deck_(deck), units_(deck.units) {}

  InpTire read() {
    take_held();
    const InpGroundBodies ground = ground_bodies(deck_, held_);
    ground_elements_ = ground.elements;
    ground_nodes_ = ground.nodes;
    place_frame();
    take_nodes_and_elements();
    take_solids();
    take_faces();
    align();
    take_rebars();
    take_remarks();
    take_supports();
    assemble();
    take_ground();
    for (const InpStep& step : deck_.steps) tire_.modes = std::max(tire_.modes, step.modes);
    if (deck_.element_type == "C3D8") tire_.element = fe_tire::ElementKind::full_integration;
    tire_.materials = materials_of(tire_, deck_);
    tire_.losses = losses_of(tire_, deck_);
    return std::move(tire_);
  }

 private:
  /// Collects for every supported node which directions are fixed, as bits.
  void take_held() {
    const auto take = [&](const InpSupport& support) {
      for (int node : support.nodes) {
        if (!deck_.nodes.count(node))
          throw InputError(support.place, fmt::format("node {} is not defined", node));
        for (int d = support.first; d <= support.last; ++d) held_[node] |= 1 << (d - 1);
      }
    };
    for (const InpSupport& support : deck_.supports) take(support);
    for (const InpStep& step : deck_.steps)
      for (const InpSupport& support : step.supports) take(support);
  }

  void place_frame() {
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
    bool found = false;
    const auto take = [&](const std::string& name, const Place& place) {
      if (name.empty()) return;
      const InpOrientation& o = deck_.orientations.at(name);
      if (!o.cylindrical) return;
      const Eigen::Vector3d direction = (o.b - o.a).normalized();
      if (found && ((direction - axis).norm() > 1e-9 || (o.a - center_).cross(axis).norm() > 1e-9))
        throw InputError(place, "a second cylindrical axis, expected one: the tire's spin axis");
      axis = direction;
      center_ = o.a;
      found = true;
    };
    for (const InpSection& section : deck_.sections) take(section.orientation, section.place);
    for (const InpRebars& rebars : deck_.rebars) take(rebars.orientation, rebars.place);
    Eigen::Vector3d down = ground_point() - center_;
    down -= down.dot(axis) * axis;
    if (down.norm() < 1e-9) down = axis.unitOrthogonal();
    down.normalize();
    // The cross product of radial and circumferential direction, the axial direction, points along
    // -y of the wheel frame.
    R_.row(1) = -axis.transpose();
    R_.row(2) = -down.transpose();
    R_.row(0) = (-axis).cross(-down).transpose();
  }

  /// Returns the middle of the ground in the file's frame; a point below the axis if there is no
  /// ground.
  Eigen::Vector3d ground_point() const {
    return middle_of_ground(deck_).value_or(center_ - Eigen::Vector3d::UnitY());
  }

  Eigen::Vector3d to_wheel(const Eigen::Vector3d& x) const {
    return units_.length * (R_ * (x - center_));
  }

  void take_nodes_and_elements() {
    std::set<int> used;
    for (const auto& [number, element] : deck_.elements) {
      if (ground_elements_.count(number)) continue;
      element_index_[number] = static_cast<int>(elements_.size());
      element_numbers_.push_back(number);
      elements_.push_back(element.node);
      used.insert(element.node.begin(), element.node.end());
    }
    if (elements_.empty())
      throw InputError({deck_.file, 0}, "has no elements of a tire, expected some of type C3D8");
    ring_.X.resize(3, static_cast<Eigen::Index>(used.size()));
    for (int number : used) {
      const int index = static_cast<int>(node_index_.size());
      node_index_[number] = index;
      ring_.X.col(index) = to_wheel(deck_.nodes.at(number));
    }
    take_ties();
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      Hex x;
      for (int a = 0; a < 8; ++a) {
        elements_[e][a] = node_index_.at(elements_[e][a]);
        x.col(a) = ring_.X.col(elements_[e][a]);
      }
      if (!(smallest_corner_volume(x) > 0.0)) {
        const InpElement& element = deck_.elements.at(element_numbers_[e]);
        throw InputError(element.place,
                         fmt::format("element {} is inverted or degenerate", element.number));
      }
    }
  }

  void take_ties() {
    for (const auto& [number, tie] : deck_.ties) {
      const auto node = node_index_.find(number);
      if (node == node_index_.end()) continue;  // the node belongs to no element of the tire
      const auto lower = node_index_.find(tie.lower), upper = node_index_.find(tie.upper);
      if (lower == node_index_.end() || upper == node_index_.end())
        throw InputError(
            tie.place,
            fmt::format("node {} is tied to a node that is not part of the tire", number));
      if (held_.count(number) && held_.at(number) != 0)
        throw InputError(tie.place, fmt::format("node {} is tied and held", number));
      ties_[node->second] = {lower->second, upper->second, tie.at};
    }
  }

  void take_solids() {
    solid_.assign(elements_.size(), -1);
    for (const InpSection& section : deck_.sections) {
      const InpMaterial& material = deck_.materials.at(section.material);
      const InpSolid solid{material.name, has_directions(material) ? section.orientation : ""};
      for (int number : deck_.element_sets.at(section.elset)) {
        const auto element = element_index_.find(number);
        if (element == element_index_.end()) continue;  // the element belongs to the ground
        auto at = std::find(tire_.solids.begin(), tire_.solids.end(), solid);
        if (at == tire_.solids.end()) {
          tire_.mesh.region_names.push_back(material.name);
          at = tire_.solids.insert(at, solid);
        }
        solid_[element->second] = static_cast<int>(at - tire_.solids.begin());
      }
    }
    for (std::size_t e = 0; e < elements_.size(); ++e)
      if (solid_[e] < 0) {
        const InpElement& element = deck_.elements.at(element_numbers_[e]);
        throw InputError(
            element.place,
            fmt::format("element {} is in no *SOLID SECTION, expected one", element.number));
      }
  }

  /// Reads the pressure of the last static step and the contact surface of the tire.
  void take_faces() {
    for (const InpStep& step : deck_.steps) {
      if (step.kind != InpStep::Kind::statics || step.pressures.empty()) continue;
      inner_.clear();
      for (const InpPressure& pressure : step.pressures) {
        if (pressure.value != step.pressures.front().value)
          throw InputError(pressure.faces.place,
                           "a second pressure, expected the same one on all inner faces");
        add_faces(pressure.faces, true, inner_);
      }
    }
    tire_.pressure = pressure_of(deck_);
    if (inner_.empty())
      throw InputError(
          {deck_.file, 0},
          "no *DLOAD pressure in a static step: inside and outside cannot be told apart");
    for (const InpContact& contact : deck_.contacts)
      for (const InpFaces& faces : deck_.surfaces.at(contact.slave))
        add_faces(faces, false, outer_);
  }

  void add_faces(const InpFaces& faces, bool inner, std::vector<KnownFace>& known) const {
    for (int number : faces.elements) {
      const auto element = element_index_.find(number);
      if (element == element_index_.end())
        throw InputError(faces.place, fmt::format("element {} is not part of the tire", number));
      known.push_back({element->second, face_direction(faces.face), inner});
    }
  }

  void align() {
    std::vector<KnownFace> known = inner_;
    known.insert(known.end(), outer_.begin(), outer_.end());
    inner_faces_ = corner_sets(inner_);
    outer_faces_ = corner_sets(outer_);
    const Alignment alignment = align_elements(ring_.X, elements_, known);
    if (alignment.buried >= 0) {
      const InpElement& element = deck_.elements.at(element_numbers_[alignment.buried]);
      throw InputError(element.place,
                       fmt::format("element {} has pressure or contact on a face inside the wall",
                                   element.number));
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const InpElement& element = deck_.elements.at(element_numbers_[e]);
      if (!alignment.reached[e])
        throw InputError(
            element.place,
            fmt::format("element {} is not connected to the inflated wall", element.number));
      check_side(e, inner_faces_, {2, -1}, "pressure", element);
      check_side(e, outer_faces_, {2, 1}, "contact", element);
    }
  }

  // faces as sets of nodes, for each element
  using FaceSet = std::map<int, std::set<std::set<int>>>;

  FaceSet corner_sets(const std::vector<KnownFace>& known) const {
    FaceSet sets;
    for (const KnownFace& face : known)
      sets[face.element].insert(nodes_of(face.element, face.outward));
    return sets;
  }

  std::set<int> nodes_of(int e, LocalDirection outward) const {
    std::set<int> nodes;
    for (int corner : face_corners(outward)) nodes.insert(elements_[e][corner]);
    return nodes;
  }

  void check_side(int e,
                  const FaceSet& faces,
                  LocalDirection outward,
                  const char* what,
                  const InpElement& element) const {
    const auto found = faces.find(e);
    if (found == faces.end()) return;
    for (const std::set<int>& face : found->second)
      if (face != nodes_of(e, outward))
        throw InputError(element.place,
                         fmt::format("element {} has {} on a face that is not its {} one",
                                     element.number,
                                     what,
                                     outward.sign < 0 ? "inner" : "outer"));
  }

  void take_rebars() {
    const InpHosts hosts{ring_.X, elements_, element_index_, node_index_};
    const auto place = [&](int node) { return to_wheel(deck_.nodes.at(node)); };
    placed_ = place_rebars(deck_, hosts, place);
    const auto line = [&](int corner) -> std::array<int, 2> {
      const auto tie = ties_.find(corner);
      if (tie == ties_.end()) return {corner, corner};
      return {tie->second.lower, tie->second.upper};
    };
    place_cords(deck_, hosts, place, line, placed_);
    tire_.layers = placed_.layers;
    tire_.cords = placed_.cords;
  }

  /// Reads the comments about walls and tread, element by element.
  void take_remarks() {
    wall_.assign(elements_.size(), -1);
    for (std::size_t i = 0; i < deck_.remarks.walls.size(); ++i)
      for (const int e : members(deck_.remarks.walls[i].elset, deck_.remarks.walls[i].place))
        wall_[static_cast<std::size_t>(e)] = static_cast<int>(i);
    for (const InpRemarks::Tread& tread : deck_.remarks.treads)
      for (const int e : members(tread.elset, tread.place)) treads_.insert(e);
  }

  /// Returns the indices of the tire's elements in the element set `name`, which a comment of the
  /// deck (`** latsch: ...`) mentions.
  std::vector<int> members(const std::string& name, const Place& place) const {
    const auto set = deck_.element_sets.find(name);
    if (set == deck_.element_sets.end())
      throw InputError(place, fmt::format("element set {} is not defined", name));
    std::vector<int> found;
    for (const int number : set->second) {
      const auto element = element_index_.find(number);
      if (element == element_index_.end())
        throw InputError(place, fmt::format("element {} is not part of the tire", number));
      found.push_back(element->second);
    }
    return found;
  }

  /// Encodes solid, pressure, rebars and comments of each element as one number, which is equal for
  /// equal elements.
  void take_kinds() {
    constexpr double kDepths = 1e4;  // number of depths in half an element that are distinguished
    std::map<std::vector<std::int64_t>, std::int64_t> kinds;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const int index = static_cast<int>(e);
      std::vector<std::int64_t> kind{
          solid_[e], inner_faces_.count(index) ? 1 : 0, wall_[e], treads_.count(index) ? 1 : 0};
      for (const fe_tire::RebarPlacement& rebar : placed_.of_element[e]) {
        kind.push_back(rebar.layer);
        kind.push_back(std::llround(rebar.zeta * kDepths));
      }
      for (const int node : elements_[e])
        if (const auto tie = ties_.find(node); tie != ties_.end())
          kind.push_back(std::llround(tie->second.at * kDepths));
      ring_.kind.push_back(kinds.emplace(kind, kinds.size()).first->second);
    }
  }

  void take_supports() {
    const auto check = [&](const InpSupport& support) {
      for (int node : support.nodes)
        if (support.value != 0.0 && !ground_nodes_.count(node))
          throw InputError(support.place,
                           fmt::format("node {} of the tire is moved, expected a fixed rim", node));
    };
    for (const InpSupport& support : deck_.supports) check(support);
    for (const InpStep& step : deck_.steps)
      for (const InpSupport& support : step.supports) check(support);
    ring_.held.assign(ring_.X.cols(), 0);
    for (const auto& [node, directions] : held_) {
      const auto index = node_index_.find(node);
      if (index == node_index_.end() || directions == 0) continue;
      if (directions != kHeldInAllDirections)
        throw InputError(
            {deck_.file, 0},
            fmt::format("node {} is held in some directions only, expected all three or none",
                        node));
      ring_.held[index->second] = 1;
    }
    for (int node : ground_nodes_)
      if (held_[node] != kHeldInAllDirections)
        throw InputError(
            {deck_.file, 0},
            fmt::format("node {} of the ground is free, expected a rigid ground", node));
  }

  void assemble() {
    ring_.elements = elements_;
    take_kinds();
    const Sector sector = find_sector(ring_);
    Mesh& mesh = tire_.mesh;
    mesh.sectors = sector.sectors;
    mesh.theta = sector.theta;
    divide(mesh);
    const SectorNodes nodes = nodes_of(sector);
    mesh.X.resize(3, nodes.count);
    for (std::size_t i = 0; i < sector.nodes.size(); ++i) {
      if (nodes.own[i] < 0) continue;
      mesh.X.col(nodes.own[i]) = ring_.X.col(sector.nodes[i]);
      if (ring_.held[sector.nodes[i]]) mesh.clamped.push_back(nodes.own[i]);
    }
    const std::set<std::pair<double, double>> treads = tread_places();
    for (std::size_t i = 0; i < sector.elements.size(); ++i) {
      const int e = sector.elements[i];
      Element element;
      place_corners(sector, nodes, static_cast<int>(i), element);
      element.solid = element.region = solid_[e];
      element.inner = inner_faces_.count(e) > 0;
      element.rebars = placed_.of_element[static_cast<std::size_t>(e)];
      element.tread = !treads_.empty()     ? treads_.count(e) > 0
                      : sector.sectors > 1 ? near(treads, place(e))
                                           : outer_faces_.count(e) > 0;
      if (const int wall = wall_[static_cast<std::size_t>(e)]; wall >= 0) {
        const InpRemarks::Wall& stated = deck_.remarks.walls[static_cast<std::size_t>(wall)];
        element.wall = stated.thickness * units_.length;
        element.layer_rows = stated.layer_rows;
      }
      mesh.elements.push_back(element);
    }
    if (outer_.empty() && treads_.empty()) mark_tread(mesh);
    mesh.sensors = choose_sensors(mesh);
    try {
      fe_tire::check(mesh);
      // The reader of the deck does not know the file's name, so it is added here.
    } catch (const InputError& error) {
      throw InputError({deck_.file, 0}, error.what());
    }
  }

  /// Divides a tire with equal sectors by the planes that the deck states for the tire in contact
  /// with the ground.
  void divide(Mesh& mesh) const {
    const std::vector<double>& planes = deck_.remarks.planes;
    if (planes.empty() || !mesh.theta.empty()) return;
    if (mesh.sectors != static_cast<int>(planes.size()))
      throw InputError(deck_.remarks.planes_place,
                       fmt::format("{} planes are stated, expected one for each of the {} equal "
                                   "sectors of the tire",
                                   planes.size(),
                                   mesh.sectors));
    mesh.theta = planes;
  }

  /// The nodes of a sector that are not tied to a line, and their numbers in the sector.
  struct SectorNodes {
    std::vector<int> own;
    std::map<int, int> local;  // number in the sector by number in the ring
    int count = 0;
  };

  SectorNodes nodes_of(const Sector& sector) const {
    SectorNodes nodes;
    for (const int node : sector.nodes) {
      nodes.local[node] = static_cast<int>(nodes.own.size());
      nodes.own.push_back(ties_.count(node) ? -1 : nodes.count++);
    }
    return nodes;
  }

  /// Sets the corners of an element of the sector: each is a node, or a position on the line
  /// between two nodes.
  void place_corners(const Sector& sector,
                     const SectorNodes& nodes,
                     int element_of_sector,
                     Element& element) const {
    const InpElement& written = deck_.elements.at(
        element_numbers_[static_cast<std::size_t>(sector.elements[element_of_sector])]);
    const int n = static_cast<int>(sector.nodes.size());
    const auto tie_of = [&](int corner) -> std::optional<TiedNode> {
      const auto tie = ties_.find(sector.nodes[corner % n]);
      if (tie == ties_.end()) return std::nullopt;
      const auto lower = nodes.local.find(tie->second.lower);
      const auto upper = nodes.local.find(tie->second.upper);
      if (lower == nodes.local.end() || upper == nodes.local.end())
        throw InputError(written.place,
                         fmt::format("element {} has a corner tied to nodes of another plane of "
                                     "the tire",
                                     written.number));
      const int plane = corner - corner % n;
      return TiedNode{lower->second + plane, upper->second + plane, tie->second.at};
    };
    const auto placed = tied_element(sector.connectivity[element_of_sector], tie_of);
    if (!placed)
      throw InputError(written.place,
                       fmt::format("element {} has tied corners other than those on one edge "
                                   "of its thickness, alike in both planes",
                                   written.number));
    for (int a = 0; a < 8; ++a) {
      const int corner = placed->node[a];
      element.node[a] = nodes.own[corner % n] + (corner >= n ? nodes.count : 0);
    }
    element.tie = placed->tie;
  }

  /// Returns the position of the middle of an element in the cross section: (y, r).
  std::pair<double, double> place(int e) const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int node : elements_[e])
      sum += Eigen::Vector2d(ring_.X(1, node), std::hypot(ring_.X(0, node), ring_.X(2, node)));
    return {sum[0] / 8.0, sum[1] / 8.0};
  }

  std::set<std::pair<double, double>> tread_places() const {
    std::set<std::pair<double, double>> places;
    for (const auto& [e, faces] : outer_faces_) {
      const auto p = place(e);
      if (!near(places, p)) places.insert(p);
    }
    return places;
  }

  static bool near(const std::set<std::pair<double, double>>& places, std::pair<double, double> p) {
    constexpr double kTolerance = 1e-6;  // m, far smaller than any element
    const auto from = places.lower_bound({p.first - kTolerance, -1.0});
    for (auto it = from; it != places.end() && it->first <= p.first + kTolerance; ++it)
      if (std::abs(it->second - p.second) <= kTolerance) return true;
    return false;
  }

  void take_ground() {
    if (deck_.contacts.empty()) return;
    const InpContact& contact = deck_.contacts.front();
    const double stress = units_.force / (units_.length * units_.length);
    const InpInteraction& interaction = deck_.interactions.at(contact.interaction);
    if (!(interaction.stiffness > 0.0))
      throw InputError(contact.place,
                       fmt::format("interaction {} has no *SURFACE BEHAVIOR", contact.interaction));
    InpGround ground;
    ground.stiffness = interaction.stiffness * stress / units_.length;
    ground.mu = interaction.mu;
    ground.radius = -to_wheel(ground_point()).z();
    for (int node : ground_face_nodes(deck_))
      if (std::abs(-to_wheel(deck_.nodes.at(node)).z() - ground.radius) > 1e-6 * ground.radius)
        throw InputError(contact.place, "the ground is not flat and parallel to the spin axis");
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (const InpStep& step : deck_.steps)
      for (const InpSupport& support : step.supports)
        if (!support.nodes.empty() && ground_nodes_.count(support.nodes.front()))
          for (int d = support.first; d <= support.last; ++d) moved[d - 1] = support.value;
    const Eigen::Vector3d travel = units_.length * (R_ * moved);
    if (std::hypot(travel.x(), travel.y()) > 1e-9)
      throw InputError(contact.place, "the ground moves sideways, expected only toward the tire");
    ground.travel = travel.z();
    tire_.ground = ground;
  }

  const InpDeck& deck_;
  const InpUnits units_;
  InpTire tire_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  // rotates vectors from the file's frame to the wheel frame
  Eigen::Matrix3d R_ = Eigen::Matrix3d::Identity();
  std::map<int, int> held_;  // bits of the fixed directions by node number
  std::set<int> ground_elements_, ground_nodes_;
  std::map<int, int> node_index_, element_index_;
  std::map<int, TiedNode> ties_;  // ties by node index
  std::vector<int> element_numbers_;
  std::vector<HexNodes> elements_;
  std::vector<int> solid_;
  // for each element, the index of its wall in the comments of the deck; -1: none
  std::vector<int> wall_;
  std::set<int> treads_;  // elements that a comment calls tread
  std::vector<KnownFace> inner_, outer_;
  FaceSet inner_faces_, outer_faces_;
  InpPlacedRebars placed_;
  RingOfNodes ring_;
};

}  // namespace

InpTire tire_from(const InpDeck& deck) { return TireReader(deck).read(); }

InpTire read_inp_tire(const std::filesystem::path& file) { return tire_from(read_inp(file)); }

fe_tire::Materials materials_of(const InpTire& tire, const InpDeck& deck) {
  fe_tire::Materials materials;
  for (const InpSolid& solid : tire.solids)
    materials.solids.push_back(
        solid_from(deck,
                   deck.materials.at(solid.material),
                   solid.orientation.empty() ? nullptr : &deck.orientations.at(solid.orientation)));
  for (const InpLayer& layer : tire.layers)
    materials.layers.push_back(
        layer.cords >= 0
            ? tire.cords[static_cast<std::size_t>(layer.cords)]
            : layer_from(deck, deck.rebars[static_cast<std::size_t>(layer.rebars)], layer.sign));
  return materials;
}

double pressure_of(const InpDeck& deck) {
  if (deck.pressure < 0) return 0.0;
  return to_si(deck.value(deck.pressure), InpQuantity::stress, deck.units);
}

}  // namespace latsch::formats
