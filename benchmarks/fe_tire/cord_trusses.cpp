// SPDX-License-Identifier: Apache-2.0
#include "cord_trusses.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <vector>

namespace latsch::benchmarks {
namespace {

using fe_tire::CordLayer;
using fe_tire::Element;
using fe_tire::Mesh;

// number of nodes of the ground below the tire, which is one solid element
constexpr int kGroundNumbers = 8;
constexpr double kMm = 1e3;              // per meter
constexpr double kMm2 = 1e6;             // per m^2
constexpr double kMPa = 1e-6;            // per Pa
constexpr double kTonnesPerMm3 = 1e-12;  // per kg/m^3
// least sine of the cord angle for which trusses can be placed, except for hoops, whose angle is 0
constexpr double kSteep = 0.05;

/// Signs of xi, eta, zeta at the corners (mesh.h).
constexpr double kSigns[8][3] = {{-1, -1, -1},
                                 {1, -1, -1},
                                 {1, 1, -1},
                                 {-1, 1, -1},
                                 {-1, -1, 1},
                                 {1, -1, 1},
                                 {1, 1, 1},
                                 {-1, 1, 1}};

struct Place {
  double xi, eta, zeta;
};

std::array<double, 8> weights(const Place& p) {
  std::array<double, 8> w;
  for (int a = 0; a < 8; ++a)
    w[a] = 0.125 * (1 + kSigns[a][0] * p.xi) * (1 + kSigns[a][1] * p.eta) *
           (1 + kSigns[a][2] * p.zeta);
  return w;
}

using Corners = Eigen::Matrix<double, 3, 8>;

Eigen::Vector3d position(const Corners& X, const Place& p) {
  const auto w = weights(p);
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int a = 0; a < 8; ++a) x += w[a] * X.col(a);
  return x;
}

/// Direction of the cord through a point on the facet zeta = const.
struct Course {
  double slope;         // dxi / deta
  double width_per_xi;  // distance, m, between two cords whose xi differ by 1
};

Course course(const Corners& X, const Place& p, double angle) {
  // step of the central differences, which are exact because X is linear along xi and along eta
  constexpr double h = 0.5;
  const Eigen::Vector3d along_xi =
      (position(X, {p.xi + h, p.eta, p.zeta}) - position(X, {p.xi - h, p.eta, p.zeta}));
  const Eigen::Vector3d along_eta =
      (position(X, {p.xi, p.eta + h, p.zeta}) - position(X, {p.xi, p.eta - h, p.zeta}));
  const Eigen::Vector3d n = along_xi.cross(along_eta).normalized();
  const Eigen::Vector3d x = position(X, p);
  // The direction of the circle about the y axis through x, in the facet, toward increasing theta.
  Eigen::Vector3d circle(-x.z(), 0.0, x.x());
  circle = (circle - n * n.dot(circle)).normalized();
  const Eigen::Vector3d cord = std::cos(angle) * circle + std::sin(angle) * n.cross(circle);
  // Find a and b such that the cord direction is a along_xi + b along_eta.
  Eigen::Matrix<double, 3, 2> facet;
  facet << along_xi, along_eta;
  const Eigen::Matrix2d metric = facet.transpose() * facet;
  const Eigen::Vector2d right = facet.transpose() * cord;
  const double determinant = metric(0, 0) * metric(1, 1) - metric(0, 1) * metric(1, 0);
  const double a = (metric(1, 1) * right[0] - metric(0, 1) * right[1]) / determinant;
  const double b = (metric(0, 0) * right[1] - metric(1, 0) * right[0]) / determinant;
  return {a / b, along_xi.cross(cord).norm()};
}

/// A piece of a cord in an element, in every sector.
struct Piece {
  int element, layer;
  Place from, to;
  double area;  // m^2
};

class Drawing {
 public:
  Drawing(const Mesh& mesh, const fe_tire::Materials& materials, const CordFamily& family)
      : mesh_(mesh), materials_(materials), family_(family) {
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
      for (const fe_tire::RebarPlacement& rebar : mesh.elements[e].rebars) {
        assert(mesh.elements[e].tie.eta == 0);
        const CordLayer& layer = materials.layers[rebar.layer];
        assert(layer.E_tension == layer.E_compression && layer.pretension == 0.0);
        if (layer.angle == 0.0) {
          draw_hoops(e, rebar);
          continue;
        }
        assert(std::abs(std::sin(layer.angle)) > kSteep);
        for (int k = 0; k < family.a_sector; ++k)
          draw(e, rebar, (2 * k + 1.0) / family.a_sector - 1.0);
      }
  }

  const std::vector<Piece>& pieces() const { return pieces_; }
  double length(const Piece& piece) const {
    const Corners X = mesh_.coordinates(mesh_.elements[piece.element]);
    return (position(X, piece.to) - position(X, piece.from)).norm();
  }

 private:
  /// Places cords that run around the tire in the circumferential direction.
  void draw_hoops(int element, const fe_tire::RebarPlacement& rebar) {
    const Corners X = mesh_.coordinates(mesh_.elements[element]);
    for (int k = 0; k < family_.along; ++k) {
      const double eta = (2 * k + 1.0) / family_.along - 1.0, zeta = rebar.zeta;
      const Eigen::Vector3d across = position(X, {0, eta + 1.0 / family_.along, zeta}) -
                                     position(X, {0, eta - 1.0 / family_.along, zeta});
      pieces_.push_back({element,
                         rebar.layer,
                         {-1, eta, zeta},
                         {1, eta, zeta},
                         materials_.layers[rebar.layer].thickness * across.norm()});
    }
  }

  /// Places a cord from the edge eta = -1 to the opposite edge. Where it leaves the sector, it
  /// continues on the other side of the sector as its own copy, rotated by one sector.
  void draw(int element, const fe_tire::RebarPlacement& rebar, double xi) {
    const CordLayer& layer = materials_.layers[rebar.layer];
    const Corners X = mesh_.coordinates(mesh_.elements[element]);
    const double step = 2.0 / family_.along;
    for (int i = 0; i < family_.along; ++i) {
      double eta = -1.0 + i * step, left = step;
      while (left > 1e-9) {
        const double slope = middle_slope(X, {xi, eta, rebar.zeta}, left, layer.angle);
        double end = xi + slope * left, taken = left;
        if (std::abs(end) > 1.0) {
          end = std::copysign(1.0, end);
          taken = (end - xi) / slope;
        }
        add(X, element, rebar, {xi, eta, rebar.zeta}, {end, eta + taken, rebar.zeta});
        xi = taken < left ? -end : end;
        eta += taken;
        left -= taken;
      }
    }
  }

  /// Returns the slope of the cord by the midpoint rule. The point halfway along may be in the next
  /// sector, where the cord has the same direction.
  static double middle_slope(const Corners& X, const Place& from, double step, double angle) {
    const double first = course(X, from, angle).slope;
    double xi = from.xi + 0.5 * step * first;
    while (xi > 1.0) xi -= 2.0;
    while (xi < -1.0) xi += 2.0;
    return course(X, {xi, from.eta + 0.5 * step, from.zeta}, angle).slope;
  }

  void add(const Corners& X,
           int element,
           const fe_tire::RebarPlacement& rebar,
           const Place& from,
           const Place& to) {
    // share of an element below which a piece of cord in its corner is ignored
    constexpr double kNothing = 1e-6;
    if (to.eta - from.eta < kNothing) return;
    const CordLayer& layer = materials_.layers[rebar.layer];
    const Place middle{0.5 * (from.xi + to.xi), 0.5 * (from.eta + to.eta), from.zeta};
    const double strip = course(X, middle, layer.angle).width_per_xi * 2.0 / family_.a_sector;
    pieces_.push_back({element, rebar.layer, from, to, layer.thickness * strip});
  }

  const Mesh& mesh_;
  const fe_tire::Materials& materials_;
  const CordFamily family_;
  std::vector<Piece> pieces_;
};

class Cards {
 public:
  Cards(const Mesh& mesh, const Drawing& drawing, CordPiece piece)
      : mesh_(mesh),
        drawing_(drawing),
        pieces_(drawing.pieces()),
        piece_(piece),
        first_node_(mesh.nodes() + kGroundNumbers + 1) {}

  std::string write(const fe_tire::Materials& materials) {
    add("*NODE\n");
    each_end([this](int s, int number, const Piece& piece, const Place& place) {
      const Eigen::Vector3d x =
          mesh_.frame(s) * position(mesh_.coordinates(mesh_.elements[piece.element]), place);
      // Frame of the deck (ccx_deck.h): its y is our z, and its z is our -y.
      add("{},{:.12g},{:.12g},{:.12g}\n", number, kMm * x.x(), kMm * x.z(), -kMm * x.y());
    });
    for (int p = 0; p < count(); ++p) {
      add("*ELEMENT,TYPE={},ELSET=CORD{}\n", piece_ == CordPiece::spring ? "SPRINGA" : "T3D2", p);
      for (int s = 0; s < mesh_.sectors; ++s)
        add("{},{},{}\n",
            mesh_.element_count() + 2 + s * count() + p,
            node(s, p, 0),
            node(s, p, 1));
    }
    each_end([this](int s, int number, const Piece& piece, const Place& place) {
      tie(s, number, mesh_.elements[piece.element], place);
    });
    if (piece_ == CordPiece::spring)
      add_springs(materials);
    else
      add_sections(materials);
    return std::move(text_);
  }

 private:
  void add_sections(const fe_tire::Materials& materials) {
    for (std::size_t i = 0; i < materials.layers.size(); ++i) {
      const CordLayer& layer = materials.layers[i];
      add("*MATERIAL,NAME=CORDS{}\n*ELASTIC\n{:.12g},0.\n", i, layer.E_tension * kMPa);
      add("*DENSITY\n{:.12g}\n", layer.density * kTonnesPerMm3);
    }
    for (int p = 0; p < count(); ++p)
      add("*SOLID SECTION,ELSET=CORD{},MATERIAL=CORDS{}\n{:.12g}\n",
          p,
          pieces_[p].layer,
          pieces_[p].area * kMm2);
  }

  /// Adds springs, whose force over elongation is linear between closely spaced points.
  void add_springs(const fe_tire::Materials& materials) {
    constexpr int kPoints = 20;       // number of points on either side of zero
    constexpr double kStrain = 0.05;  // largest strain
    for (int p = 0; p < count(); ++p) {
      const double EA = materials.layers[pieces_[p].layer].E_tension * pieces_[p].area;
      add("*SPRING,ELSET=CORD{},NONLINEAR\n\n", p);
      for (int i = -kPoints; i <= kPoints; ++i) {
        const double strain = kStrain * i / kPoints, lambda = 1.0 + strain;
        add("{:.12g},{:.12g}\n",
            0.5 * EA * (lambda * lambda - 1.0) * lambda,
            kMm * drawing_.length(pieces_[p]) * strain);
      }
    }
  }

  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }

  int count() const { return static_cast<int>(pieces_.size()); }
  int node(int sector, int piece, int end) const {
    return first_node_ + 2 * (sector * count() + piece) + end;
  }

  template <class Action>
  void each_end(Action action) {
    for (int s = 0; s < mesh_.sectors; ++s)
      for (int p = 0; p < count(); ++p) {
        action(s, node(s, p, 0), pieces_[p], pieces_[p].from);
        action(s, node(s, p, 1), pieces_[p], pieces_[p].to);
      }
  }

  int corner(int sector, int node) const {
    const int n = mesh_.nodes_per_sector();
    return 1 + (sector + node / n) % mesh_.sectors * n + node % n;
  }

  void tie(int sector, int number, const Element& element, const Place& place) {
    const auto w = weights(place);
    int terms = 1;
    for (double weight : w) terms += weight != 0.0;
    for (int direction = 1; direction <= 3; ++direction) {
      add("*EQUATION\n{}\n{},{},1.", terms, number, direction);
      int written = 1;
      for (int a = 0; a < 8; ++a) {
        if (w[a] == 0.0) continue;
        add("{}{},{},{:.12g}",
            written % 4 == 0 ? "\n" : ",",
            corner(sector, element.node[a]),
            direction,
            -w[a]);
        ++written;
      }
      add("\n");
    }
  }

  const Mesh& mesh_;
  const Drawing& drawing_;
  const std::vector<Piece>& pieces_;
  const CordPiece piece_;
  const int first_node_;
  std::string text_;
};

}  // namespace

CordTrusses cord_trusses(const Mesh& mesh,
                         const fe_tire::Materials& materials,
                         const CordFamily& family) {
  const Drawing drawing(mesh, materials, family);
  CordTrusses trusses;
  trusses.cards = Cards(mesh, drawing, family.piece).write(materials);
  trusses.count = mesh.sectors * static_cast<int>(drawing.pieces().size());
  for (const Piece& piece : drawing.pieces())
    trusses.volume += mesh.sectors * piece.area * drawing.length(piece);
  return trusses;
}

}  // namespace latsch::benchmarks
