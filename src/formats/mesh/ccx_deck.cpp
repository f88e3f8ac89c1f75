// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/ccx_deck.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "formats/mesh/ccx_cords.h"
#include "formats/mesh/hexahedron.h"

namespace latsch::formats {
namespace {

using fe_tire::Element;

constexpr double kMillimeters = 1e3;         // millimeters per meter
constexpr double kMegapascals = 1e-6;        // megapascals per pascal
constexpr double kTonnes = 1e-3;             // tonnes per kilogram
constexpr double kTonnesPerCubicMm = 1e-12;  // tonnes per mm^3 for 1 kg/m^3
constexpr double kMegapascalsPerMm = 1e-9;   // MPa/mm for 1 Pa/m
constexpr double kGroundLength = 0.16, kGroundWidth = 0.17, kGroundDepth = 0.02;  // m, half sizes
constexpr int kGroundNodes = 8;
constexpr double kSameWidth = 1e-12;  // rad

class DeckWriter {
 public:
  DeckWriter(std::ostream& out,
             const fe_tire::Mesh& mesh,
             const fe_tire::Materials& materials,
             const CcxRun& run)
      : out_(out),
        mesh_(run.ground ? mesh : mesh.evenly_divided()),
        planes_(mesh.theta),
        corners_(corners_of(mesh)),
        materials_(materials),
        run_(run) {}

  void write() {
    print("*HEADING\n{}\n** units: mm, N, tonne\n", run_.title);
    nodes();
    elements();
    ties();
    cords();
    sets();
    remarks();
    material_cards();
    if (run_.ground) contact();
    print("*BOUNDARY\nRIM,1,3\n");
    if (run_.ground) print("GROUND,1,3\n");
    inflation_step();
    if (run_.modes > 0 && !run_.loaded_modes) frequency_step();
    if (run_.ground) load_step();
    if (run_.modes > 0 && run_.loaded_modes) frequency_step();
  }

 private:
  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::print(out_, format, std::forward<Arguments>(arguments)...);
  }

  int node_number(int sector, int node) const {
    const int n = mesh_.nodes_per_sector();
    return 1 + (sector + node / n) % mesh_.sectors * n + node % n;
  }
  int tied() const { return static_cast<int>(corners_.tied.size()); }
  int tied_number(int plane, int corner) const {
    return 1 + mesh_.nodes() + plane % mesh_.sectors * tied() + corner;
  }
  /// Returns the node number of a corner of the sector's element.
  int corner_number(int sector, int corner) const {
    const int n = mesh_.nodes_per_sector(), plane = sector + corner / (n + tied());
    const int own = corner % (n + tied());
    return own < n ? node_number(plane, own) : tied_number(plane, own - n);
  }
  int tire_nodes() const { return mesh_.nodes() + mesh_.sectors * tied(); }
  int element_number(int sector, int element) const {
    return 1 + sector * static_cast<int>(mesh_.elements.size()) + element;
  }

  void nodes() {
    print("*NODE,NSET=TIRENODES\n");
    for (int s = 0; s < mesh_.sectors; ++s)
      for (int i = 0; i < mesh_.nodes_per_sector(); ++i)
        node(node_number(s, i), mesh_.frame(s) * mesh_.X.col(i));
    for (int s = 0; s < mesh_.sectors; ++s)
      for (int i = 0; i < tied(); ++i) {
        const fe_tire::Corners::Tied& at = corners_.tied[i];
        const Eigen::Vector3d lower = mesh_.X.col(at.lower), upper = mesh_.X.col(at.upper);
        node(tied_number(s, i), mesh_.frame(s) * (lower + at.at * (upper - lower)));
      }
    if (!run_.ground) return;
    print("*NODE,NSET=GROUND\n");
    const double top = -run_.ground->radius, x = kGroundLength, y = kGroundWidth;
    int number = tire_nodes();
    for (const double z : {top - kGroundDepth, top})
      for (const auto& [sx, sy] : {std::pair{-1, 1}, {-1, -1}, {1, -1}, {1, 1}})
        node(++number, {sx * x, sy * y, z});
  }

  /// Writes a node. Axes of the deck: x forward, y up, and z = -y of the wheel frame along the spin
  /// axis.
  void node(int number, const Eigen::Vector3d& x) {
    const Eigen::Vector3d mm = kMillimeters * x;
    print("{},{:.12g},{:.12g},{:.12g}\n", number, mm.x(), mm.z(), -mm.y());
  }

  void elements() {
    print("*ELEMENT,TYPE={},ELSET=TIRE\n", element_type());
    for (int s = 0; s < mesh_.sectors; ++s)
      for (int e = 0; e < static_cast<int>(mesh_.elements.size()); ++e) {
        print("{}", element_number(s, e));
        for (int corner : corners_.of_element[e]) print(",{}", corner_number(s, corner));
        print("\n");
      }
    if (!run_.ground) return;
    print("*ELEMENT,TYPE={},ELSET=GROUNDBLOCK\n{}", element_type(), ground_element());
    for (int i = 1; i <= 8; ++i) print(",{}", tire_nodes() + i);
    print("\n");
  }

  const char* element_type() const {
    return run_.element == fe_tire::ElementKind::full_integration ? "C3D8" : "C3D8I";
  }

  /// Writes the cords: two nodes for each spring, their ties to the element, and a mass at each
  /// node. Sectors of equal width have equal springs.
  void cords() {
    std::vector<bool> written(mesh_.sectors, false);
    int node = tire_nodes() + kGroundNodes + 1, element = ground_element() + 1, group = 0;
    for (int first = 0; first < mesh_.sectors; ++first) {
      if (written[first]) continue;
      std::vector<int> alike;
      for (int s = first; s < mesh_.sectors; ++s)
        if (!written[s] && std::abs(width(s) - width(first)) < kSameWidth) alike.push_back(s);
      for (const int s : alike) written[s] = true;
      for (const CordSpring& spring : cord_springs(mesh_, materials_, first)) {
        const int nodes = node;
        for (const int s : alike)
          for (const CordSpring::End& end : spring.ends) end_of_spring(node++, s, end);
        print("*ELEMENT,TYPE=SPRINGA,ELSET=CORDS{}\n", group);
        for (std::size_t i = 0; i < alike.size(); ++i)
          print("{},{},{}\n", element++, nodes + 2 * i, nodes + 2 * i + 1);
        print("*SPRING,ELSET=CORDS{},NONLINEAR\n\n", group);
        for (const auto& [force, elongation] : force_law(materials_.layers[spring.layer], spring))
          print("{:.12g},{:.12g}\n", force, elongation * kMillimeters);
        if (spring.mass > 0.0) {
          print("*ELEMENT,TYPE=MASS,ELSET=MASS{}\n", group);
          for (int i = nodes; i < node; ++i) print("{},{}\n", element++, i);
          print("*MASS,ELSET=MASS{}\n{:.12g}\n", group, 0.5 * spring.mass * kTonnes);
        }
        ++group;
      }
    }
  }

  double width(int sector) const { return mesh_.angle(sector + 1) - mesh_.angle(sector); }

  void end_of_spring(int number, int sector, const CordSpring::End& end) {
    print("*NODE\n");
    node(number, mesh_.frame(sector) * end.x);
    tie(number, sector, end);
  }

  void tie(int number, int sector, const CordSpring::End& end) {
    for (int k = 1; k <= 3; ++k) {
      print("*EQUATION\n{}\n{},{},1.", end.weights.size() + 1, number, k);
      int written = 1;
      for (const auto& [node, weight] : end.weights) {
        print("{}{},{},{:.12g}",
              written % 4 == 0 ? "\n" : ",",
              node_number(sector, node),
              k,
              -weight);
        ++written;
      }
      print("\n");
    }
  }

  /// Writes the equations of corners that lie on the straight line between two nodes.
  void ties() {
    for (int s = 0; s < mesh_.sectors; ++s)
      for (int i = 0; i < tied(); ++i) {
        const fe_tire::Corners::Tied& at = corners_.tied[i];
        for (int k = 1; k <= 3; ++k)
          print("*EQUATION\n3\n{},{},1.,{},{},{:.12g},{},{},{:.12g}\n",
                tied_number(s, i),
                k,
                node_number(s, at.lower),
                k,
                at.at - 1.0,
                node_number(s, at.upper),
                k,
                -at.at);
      }
  }

  int ground_element() const { return mesh_.element_count() + 1; }

  void sets() {
    std::vector<int> rim;
    for (int s = 0; s < mesh_.sectors; ++s)
      for (int i : mesh_.clamped) rim.push_back(node_number(s, i));
    set("*NSET,NSET=RIM", rim);
    std::vector<int> sensors;
    for (int i : mesh_.sensors) sensors.push_back(node_number(0, i));
    set("*NSET,NSET=SENSORS", sensors);
    element_set("INNER", [](int, const Element& e) { return e.inner; });
    for (int solid = 0; solid < static_cast<int>(materials_.solids.size()); ++solid)
      element_set(fmt::format("SOLID{}", solid),
                  [=](int, const Element& e) { return e.solid == solid; });
    if (run_.ground)
      element_set("TREAD", [this](int s, const Element& e) { return e.tread && lower_half(s); });
  }

  /// Writes the comments for properties that CalculiX has no card for, so that Latsch reads the
  /// deck as the same tire.
  void remarks() {
    const double kDegrees = 180.0 / std::numbers::pi;
    element_set("TREADS", [](int, const Element& e) { return e.tread; });
    print("** latsch tread: TREADS\n");
    std::map<std::pair<double, int>, std::vector<int>> walls;
    for (int e = 0; e < static_cast<int>(mesh_.elements.size()); ++e) {
      const Element& element = mesh_.elements[e];
      if (element.wall > 0.0 || element.layer_rows > 0)
        walls[{element.wall, element.layer_rows}].push_back(e);
    }
    int number = 0;
    for (const auto& [wall, elements] : walls) {
      const std::string name = fmt::format("WALL{}", number++);
      std::vector<int> members;
      for (int s = 0; s < mesh_.sectors; ++s)
        for (const int e : elements) members.push_back(element_number(s, e));
      set("*ELSET,ELSET=" + name, members);
      print("** latsch wall: {}, {:.17g}, {}\n", name, wall.first * kMillimeters, wall.second);
    }
    for (std::size_t i = 0; i < planes_.size(); ++i)
      print("{}{:.17g}{}",
            i % 4 == 0 ? "** latsch planes: " : ", ",
            planes_[i] * kDegrees,
            i % 4 == 3 || i + 1 == planes_.size() ? "\n" : "");
  }

  /// True for sectors that can touch the ground. Without the others CalculiX needs half the time to
  /// search for contact.
  bool lower_half(int sector) const {
    return mesh_.sectors == 1 || std::cos(mesh_.angle(sector)) > 0.0 ||
           std::cos(mesh_.angle(sector + 1)) > 0.0;
  }

  template <class Choice>
  void element_set(const std::string& name, Choice chosen) {
    std::vector<int> members;
    for (int s = 0; s < mesh_.sectors; ++s)
      for (int e = 0; e < static_cast<int>(mesh_.elements.size()); ++e)
        if (chosen(s, mesh_.elements[e])) members.push_back(element_number(s, e));
    set("*ELSET,ELSET=" + name, members);
  }

  void set(const std::string& card, const std::vector<int>& members) {
    if (members.empty()) return;
    print("{}\n", card);
    for (std::size_t i = 0; i < members.size(); ++i)
      print("{}{}", members[i], i % 12 == 11 || i + 1 == members.size() ? ",\n" : ",");
  }

  void material_cards() {
    print("*ORIENTATION,NAME=WHEEL,SYSTEM=CYLINDRICAL\n0,0,0,0,0,1\n");
    for (int i = 0; i < static_cast<int>(materials_.solids.size()); ++i) {
      const fe_tire::Solid& solid = materials_.solids[i];
      if (!used(i)) continue;
      print("*MATERIAL,NAME=SOLID{}\n", i);
      const bool oriented =
          std::visit([this](const auto& law) { return write_law(law); }, solid.law);
      print("*DENSITY\n{:.12g}\n", solid.density * kTonnesPerCubicMm);
      print("*SOLID SECTION,ELSET=SOLID{},MATERIAL=SOLID{}{}\n",
            i,
            i,
            oriented ? ",ORIENTATION=WHEEL" : "");
    }
    if (!run_.ground) return;
    print("*MATERIAL,NAME=RIGID\n*ELASTIC\n210000,0.3\n*DENSITY\n7.8e-9\n");
    print("*SOLID SECTION,ELSET=GROUNDBLOCK,MATERIAL=RIGID\n");
  }

  bool used(int solid) const {
    for (const Element& element : mesh_.elements)
      if (element.solid == solid) return true;
    return false;
  }

  bool write_law(const fe_tire::Hyperelastic& law) {
    const double D1 = 2.0 / (law.K * kMegapascals);
    if (law.C01 == 0.0)
      print("*HYPERELASTIC,NEO HOOKE\n{:.15g},{:.15g}\n", law.C10 * kMegapascals, D1);
    else
      print("*HYPERELASTIC,MOONEY-RIVLIN\n{:.15g},{:.15g},{:.15g}\n",
            law.C10 * kMegapascals,
            law.C01 * kMegapascals,
            D1);
    return false;
  }

  /// Writes the upper triangle of the elasticity matrix column by column in CalculiX' order 11 22
  /// 33 12 13 23.
  bool write_law(const fe_tire::StVenantKirchhoff& law) {
    print("*ELASTIC,TYPE=ANISO\n");
    int count = 0;
    for (int column = 0; column < 6; ++column)
      for (int row = 0; row <= column; ++row)
        print("{:.12g}{}",
              law.D(kVoigtOfCalculix[row], kVoigtOfCalculix[column]) * kMegapascals,
              ++count % 8 == 0 || count == 21 ? "\n" : ",");
    return true;
  }

  void contact() {
    print("*SURFACE,NAME=STREAD,TYPE=ELEMENT\nTREAD,S2\n");
    print("*SURFACE,NAME=SGROUND,TYPE=ELEMENT\n{},S2\n", ground_element());
    const double k = run_.ground->stiffness * kMegapascalsPerMm;
    print(
        "*SURFACE INTERACTION,NAME=TOUCH\n*SURFACE "
        "BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n{:.12g},,\n",
        k);
    if (run_.ground->mu > 0.0) print("*FRICTION\n{:.12g},{:.12g}\n", run_.ground->mu, 0.5 * k);
    print("*CONTACT PAIR,INTERACTION=TOUCH,TYPE=SURFACE TO SURFACE\nSTREAD,SGROUND\n");
  }

  void inflation_step() {
    print("*STEP,NLGEOM,INC=100\n*STATIC,SOLVER=SPOOLES\n0.25,1.,1e-5,1.\n");
    print("*DLOAD\nINNER,P1,{:.12g}\n", run_.pressure * kMegapascals);
    if (!mesh_.sensors.empty()) print("*NODE PRINT,NSET=SENSORS\nU\n");
    print("*NODE FILE,FREQUENCY=100\nU\n*END STEP\n");
  }

  void load_step() {
    const double step = 1.0 / run_.load_increments;
    print("*STEP,NLGEOM,INC=200\n*STATIC,SOLVER=SPOOLES\n{:.12g},1.,1e-4,{:.12g}\n", step, step);
    print("*BOUNDARY\nGROUND,2,2,{:.12g}\n", run_.ground->travel * kMillimeters);
    print("*DLOAD,OP=NEW\nINNER,P1,{:.12g}\n", run_.pressure * kMegapascals);
    print("*NODE PRINT,NSET=GROUND,TOTALS=ONLY\nRF\n*NODE FILE,FREQUENCY=100\nU\n*END STEP\n");
  }

  void frequency_step() {
    print("*STEP,PERTURBATION\n*FREQUENCY,SOLVER=SPOOLES\n{}\n", run_.modes);
    print("** half the pressure: CalculiX 2.20 counts its load stiffness twice here\n");
    print("*DLOAD,OP=NEW\nINNER,P1,{:.12g}\n", 0.5 * run_.pressure * kMegapascals);
    print("*NODE FILE\nU\n*END STEP\n");
  }

  std::ostream& out_;
  const fe_tire::Mesh mesh_;
  const std::vector<double> planes_;
  const fe_tire::Corners corners_;
  const fe_tire::Materials& materials_;
  const CcxRun& run_;
};

}  // namespace

void write_ccx_deck(std::ostream& out,
                    const fe_tire::Mesh& mesh,
                    const fe_tire::Materials& materials,
                    const CcxRun& run) {
  DeckWriter(out, mesh, materials, run).write();
}

void write_ccx_deck(const std::filesystem::path& file,
                    const fe_tire::Mesh& mesh,
                    const fe_tire::Materials& materials,
                    const CcxRun& run) {
  write_file(file, [&](std::ostream& out) { write_ccx_deck(out, mesh, materials, run); });
}

}  // namespace latsch::formats
