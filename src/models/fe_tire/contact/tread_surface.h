// SPDX-License-Identifier: Apache-2.0
// The part of the tread that may touch the ground: points that follow its nodes.
//
// Faces of the mesh are flat, a tread is not: on facets contact comes sector by sector, and length
// and pressures of a footprint jump. So a smooth surface is laid through the nodes, as they are
// displaced, by Hermite's cubics around the circumference and across,
//   x(u, v) = sum_i sum_j W_i(u) V_j(v) x_ij,   i, j: the four planes and four nodes around a face
// with slopes of the parabola through each node and its two neighbors (one-sided at the tread's
// edges): continuous tangents, exact on circles to fourth order in the sectors' width, flat where
// the ground has made it flat. The ground sees its means over hats N_a, bilinear and as wide as the
// elements' own, around places four to a face, around and across (the nodes and what lies between),
//   x_a = int N_a x dA / int N_a dA + n_a s c_a,   s = 0.53                                   (T.1)
// each standing for a sixteenth of the surface, as in mortar methods: pressures no shorter than
// nodes can answer, where others would fight each other. What the edge of a patch cuts off is wrong
// by turns as it passes a place and the middle between two, by the square of their distance: with
// nodes alone Fz was up to 5 % off in the first millimeters, 1 to 2 % at 10 mm.
// The mean of an arc lies behind the place that touches first, by its sag
//   c_a = n_a . (X_a - int N_a X dA / int N_a dA)                                             (T.2)
// (undeformed, n_a its normal, X_a in its middle), that of a part the ground has made flat does
// not: at the edge of a patch, where it matters, it is something between. Across, it counts up to
// as much as around: at shoulders faces are too long to know their arc.
// Forces go to the nodes by the same weights, so they are the gradient of an energy. Under a
// uniform pressure a node would get int W_a dA so, elements want int N_a dA. Where faces of other
// lengths begin the two differ, by a sixth at the last face before one of twice its length, and
// the node's pressure would: a mean around a node stands for
//   dA_a = 1/16 int N_a dA (1 + 4 (1 - int W_a dA / int N_a dA)),                             (T.3)
// around and across, what gives a uniform pressure back to first order.
//   [Wriggers, Computational Contact Mechanics, Springer 2006: smoothing, mortar methods;
//   Puso & Laursen 2004, CMAME 193: a mortar segment-to-segment contact method]
// Facets, each with 12x12 points, are there for comparison with programs that see them, and for
// meshes without sectors.
//
// What lies farther than the half angle from the lowest place is no part of it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "models/fe_tire/ring/ring_unknowns.h"

namespace latsch::fe_tire {

enum class TreadShape { facets, smooth };

class TreadSurface {
 public:
  TreadSurface(const RingUnknowns& unknowns, TreadShape shape, double half_angle);

  /// A node of the mesh, or its image where half the ring stands for all of it.
  struct Place {
    int node;           // of nodes(), -1 where the rim holds it
    Eigen::Matrix3d T;  // turns a displacement of the node's unknowns into the wheel frame
    Eigen::Vector3d X;  // m, undeformed, wheel frame
    int plane, section_node;
  };
  struct Weight {
    int place;
    double w, by_u, by_v;  // and its derivatives along the face
  };
  /// A point that follows the surface.
  struct Point {
    int first_weight, weights;                         // of weights()
    double share;                                      // of the parameters' square, of a sample
    double dA;                                         // m^2 of the undeformed surface
    double around;                                     // m of it around the tire
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // m, wheel frame: what (T.1) adds
    bool is_own_image = false;                         // half of it is that of the image
    int cell = 0;                                      // points of a cell move by the same nodes
    int first_around = 0, arounds = 0;                 // of the means across it is a sum of
  };
  static constexpr int kSamples = 8;  // of the surface along each side of a face

  TreadShape shape() const { return shape_; }
  bool empty() const { return nodes_.empty(); }
  int nodes() const { return static_cast<int>(nodes_.size()); }
  /// Of every node: its three unknowns are 3 block_row, ...
  const std::vector<int>& block_rows() const { return nodes_; }
  const std::vector<Place>& places() const { return places_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Point>& samples() const { return samples_; }
  /// Whether these are indices of points().
  bool has_points(const std::vector<int>& some) const {
    return std::ranges::all_of(
        some, [this](int point) { return point >= 0 && point < std::ssize(points_); });
  }
  /// Samples one behind the other from -x to x, and one beside the other across.
  std::vector<std::vector<int>> lines_around() const;
  std::vector<std::vector<int>> lines_across() const;
  /// Of a point or sample.
  const Weight* weights(const Point& point) const { return &weights_[point.first_weight]; }
  /// How many times what is here the whole ring has.
  double multiplicity() const { return unknowns_.multiplicity(); }

  /// Nodes that move the points of every cell.
  const std::vector<std::vector<int>>& cell_nodes() const { return cell_nodes_; }
  /// Unknowns that contact couples in every cell, as connectivity() of the ring's elements.
  std::vector<std::vector<int>> connectivity() const;
  /// Nodes that move a point.
  std::vector<int> nodes_of(const Point& point) const;

  /// Displacements of the nodes in x [3 x nodes], in the frames of their unknowns.
  Eigen::Matrix3Xd displacements(const Eigen::VectorXd& x) const;
  /// Places in the wheel frame [3 x places], m.
  Eigen::Matrix3Xd positions(const Eigen::Matrix3Xd& displacements) const;
  Eigen::Vector3d at(const Point& point, const Eigen::Matrix3Xd& positions) const {
    Eigen::Vector3d x = point.offset;
    for (int k = 0; k < point.weights; ++k) {
      const Weight& weight = weights_[point.first_weight + k];
      x += weight.w * positions.col(weight.place);
    }
    return x;
  }
  /// All points [3 x points]: means across once for all places beside each other around.
  Eigen::Matrix3Xd points_at(const Eigen::Matrix3Xd& positions) const;
  /// Motions of all points [3 x points], wheel frame, by one of the whole ring [3 x nodes], sector
  /// frames.
  Eigen::Matrix3Xd motions(const Eigen::Matrix3Xd& shape) const;
  /// m^2 that a sample stands for as it is.
  double area(const Point& point, const Eigen::Matrix3Xd& positions) const;
  /// Nodes of the tread outside of it [3 x any], in the wheel frame: whether something else
  /// touches.
  Eigen::Matrix3Xd beyond(const Eigen::VectorXd& x) const;

 private:
  struct Strip;
  struct MeanAround;
  struct MeanAcross;
  struct Face {
    std::array<int, 4> corner;  // places, counterclockwise from u = v = -1
    int first_sample;           // of kSamples rows along u
  };
  static std::vector<Strip> strips_of(const Mesh& mesh);
  /// Weights of up to sixteen places and their derivatives along the face.
  struct Tangents {
    std::array<double, 16> value, by_u, by_v;
  };
  using Grid = std::vector<int>;  // places, -1: none
  using Weights = std::function<Tangents(double u, double v)>;
  int place_of(int plane, int node);
  void add_facet(const std::array<std::pair<int, int>, 4>& corners);
  std::pair<Grid, Weights> smooth_face(int sector, int face, const Strip& strip);
  MeanAround mean_around(int place) const;
  std::vector<MeanAcross> means_across(const Strip& strip) const;
  int add_line(int plane, const std::vector<MeanAcross>& means, const Strip& strip);
  void add_mean_points(const MeanAround& around,
                       const std::vector<MeanAcross>& means,
                       const Strip& strip,
                       int first_cell,
                       std::vector<int>& lines);
  void find_cell_nodes();
  double angle(int plane) const;
  void add_samples(const std::array<int, 4>& corner, const Grid& grid, const Weights& weights_at);
  std::vector<std::vector<int>> rows_of_faces(std::array<int, 2> back,
                                              std::array<int, 2> front) const;
  Point point_at(const Grid& grid, const Tangents& at, double share);

  const RingUnknowns& unknowns_;
  TreadShape shape_;
  std::vector<int> nodes_;
  std::vector<Place> places_;
  std::vector<std::vector<int>> place_index_;  // by plane and node, while it is built
  std::vector<Weight> weights_;
  std::vector<Point> points_, samples_;
  // A point is a sum of means across, a mean across one of places: so they are the same weights.
  struct Part {
    int of;
    double w;
  };
  std::vector<Part> around_, across_;
  std::vector<int> first_across_{0};  // of every mean across, and the end
  std::vector<std::vector<int>> cell_nodes_;
  std::vector<Face> faces_;
  std::vector<std::pair<int, int>> beyond_;  // plane, node
};

}  // namespace latsch::fe_tire
