// SPDX-License-Identifier: Apache-2.0
// The part of the tread that may touch the ground, represented by contact points that move with the
// nodes of the mesh.
//
// Faces of the mesh are flat, but a tread is curved. On flat faces (facets) contact would spread
// sector by sector, and the length and pressures of a footprint would jump. Therefore a smooth
// surface passes through the displaced nodes, by cubic Hermite interpolation around the
// circumference and across,
//   x(u, v) = sum_i sum_j W_i(u) V_j(v) x_ij,   i, j: the four planes and four nodes around a face
// The slopes are those of the parabola through each node and its two neighbors (one-sided at the
// tread's edges). The surface has continuous tangents, is exact on circles to fourth order in the
// sectors' width, and is flat where the ground has made it flat. Contact is computed at points that
// are averages of this surface. An average is weighted by a hat function N_a, bilinear and as wide
// as the elements. In each direction there are four such points per face, one at a node and three
// between two nodes:
//   x_a = int N_a x dA / int N_a dA + n_a s c_a,   s = 0.53                                   (T.1)
// Each point represents a sixteenth of a face, as in mortar methods. Pressures then vary only over
// lengths that the nodes can resist; pressures that vary over shorter lengths would act against
// each other. The error that remains at the edge of the patch changes its sign while the edge moves
// from a point to the middle between two points, and is proportional to the square of their
// distance. With points at nodes only, Fz was up to 5 % off in the first millimeters of deflection,
// and 1 to 2 % at 10 mm. The average of an arc lies inside the point of the arc that touches first,
// by the sag
//   c_a = n_a . (X_a - int N_a X dA / int N_a dA)                                             (T.2)
// where X_a is the middle of the arc without load and n_a its normal there. The average of a part
// that the ground has made flat has no such offset. At the edge of a patch, where the offset
// matters, the share s of the sag is a compromise. Across the tread, the sag is limited to its
// value around the tire, because at the shoulders the faces are too long to resolve their arc.
// Forces are distributed to the nodes by the same weights, so they are the gradient of an energy.
//
// Under a uniform pressure the nodes would receive forces proportional to int W_a dA, but the
// elements need int N_a dA. The two differ at nodes between faces of different lengths, by a sixth
// at the last face before one of twice its length, and the pressure at the node would differ
// likewise. The point at a node therefore represents the area
//   dA_a = 1/16 int N_a dA (1 + 4 (1 - int W_a dA / int N_a dA)),                             (T.3)
// both around and across, which reproduces a uniform pressure to first order.
//   [Wriggers, Computational Contact Mechanics, Springer 2006: smoothing, mortar methods;
//   Puso & Laursen 2004, CMAME 193: a mortar segment-to-segment contact method]
//
// Flat facets, each with 12x12 points, are used for comparison with programs that use them, and for
// meshes without sectors.
//
// The surface extends to a given angle on both sides of the lowest point of the tire.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "models/fe_tire/contact/tread_means.h"
#include "models/fe_tire/ring/ring_unknowns.h"

namespace latsch::fe_tire {

enum class TreadShape { facets, smooth };

class TreadSurface {
 public:
  TreadSurface(const RingUnknowns& unknowns, TreadShape shape, double half_angle);

  /// A node of the mesh. If half of the ring represents all of it, this may also be the image of a
  /// node.
  struct Place {
    int node;  // index into nodes(); -1 if the rim holds the node
    // Rotation of displacements from the axes of the node's unknowns to the wheel frame.
    Eigen::Matrix3d T;
    Eigen::Vector3d X;  // m, position without load, in the wheel frame
    int plane, section_node;
  };
  struct Weight {
    int place;
    double w, by_u, by_v;  // weight and its derivatives by the face's parameters u and v
  };
  /// A contact point, or a sampling point of the surface, that moves with the nodes.
  struct Point {
    int first_weight, weights;  // first weight and number of weights in weights()
    double share;               // For a sampling point: its share of the face's parameter square.
    double dA;                  // m^2, area of the undeformed surface that the point represents
    double around;              // m, length of that area around the tire
    // Offset added by (T.1), in the wheel frame, m.
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    bool is_own_image = false;  // true: half of the point belongs to its image
    int cell = 0;               // index of the cell; all points of a cell depend on the same nodes
    int first_around = 0, arounds = 0;  // range of the averages across whose sum is the point
  };
  static constexpr int kSamples = 8;  // number of sampling points along each side of a face

  TreadShape shape() const { return shape_; }
  bool empty() const { return nodes_.empty(); }
  int nodes() const { return static_cast<int>(nodes_.size()); }
  /// Index of the first of each node's three unknowns, divided by 3.
  const std::vector<int>& block_rows() const { return nodes_; }
  const std::vector<Place>& places() const { return places_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Point>& samples() const { return samples_; }
  /// Returns true if all numbers in `some` are indices of points().
  bool has_points(const std::vector<int>& some) const {
    return std::ranges::all_of(
        some, [this](int point) { return point >= 0 && point < std::ssize(points_); });
  }
  /// Return the indices of the sampling points, grouped in lines around the tire (from -x to x) or
  /// across the tread.
  std::vector<std::vector<int>> lines_around() const;
  std::vector<std::vector<int>> lines_across() const;
  /// Returns the weights of a contact point or sampling point.
  const Weight* weights(const Point& point) const { return weights_.data() + point.first_weight; }
  /// Returns the size of the whole ring divided by that of the computed part: 1 or 2.
  double multiplicity() const { return unknowns_.multiplicity(); }

  /// Returns the nodes on which the points of each cell depend.
  const std::vector<std::vector<int>>& cell_nodes() const { return cell_nodes_; }
  /// Returns the unknowns that contact couples in each cell, in the format of the connectivity() of
  /// the ring's elements.
  std::vector<std::vector<int>> connectivity() const;
  /// Returns the nodes on which a point depends.
  std::vector<int> nodes_of(const Point& point) const;

  /// Returns the displacements of the nodes [3 x nodes] for the unknowns x, in the axes of these
  /// unknowns.
  Eigen::Matrix3Xd displacements(const Eigen::VectorXd& x) const;
  /// Returns the positions of nodes and their images in the wheel frame [3 x places], m.
  Eigen::Matrix3Xd positions(const Eigen::Matrix3Xd& displacements) const;
  Eigen::Vector3d at(const Point& point, const Eigen::Matrix3Xd& positions) const {
    Eigen::Vector3d x = point.offset;
    for (int k = 0; k < point.weights; ++k) {
      const Weight& weight = weights_[point.first_weight + k];
      x += weight.w * positions.col(weight.place);
    }
    return x;
  }
  /// Returns the positions of all contact points [3 x points]. Averages across the tread are
  /// computed once for all points that share them.
  Eigen::Matrix3Xd points_at(const Eigen::Matrix3Xd& positions) const;
  /// Returns the displacements of all contact points [3 x points] in the wheel frame, for a
  /// displacement of the whole ring [3 x nodes] in sector frames.
  Eigen::Matrix3Xd motions(const Eigen::Matrix3Xd& shape) const;
  /// Returns the area of the deformed surface that a sampling point represents, m^2.
  double area(const Point& point, const Eigen::Matrix3Xd& positions) const;
  /// Returns the positions in the wheel frame of the tread nodes outside this surface [3 x number
  /// of nodes]. They serve to check that none of them touches the ground.
  Eigen::Matrix3Xd beyond(const Eigen::VectorXd& x) const;

 private:
  struct Face {
    std::array<int, 4> corner;  // indices of the corner nodes, counterclockwise from u = v = -1
    int first_sample;  // index of the first sampling point; there are kSamples rows along u
  };
  /// Weights of up to sixteen nodes, and their derivatives by the face's parameters.
  struct Tangents {
    std::array<double, 16> value, by_u, by_v;
  };
  using Grid = std::vector<int>;  // indices of nodes; -1: no node
  using Weights = std::function<Tangents(double u, double v)>;
  /// For each section plane and node: true if a face covers the node.
  using Covered = std::vector<std::vector<bool>>;
  bool is_halved() const { return unknowns_.multiplicity() > 1.0; }
  int planes() const;
  void add_faces(const std::vector<TreadStrip>& strips, double half_angle, Covered& covered);
  void add_single_faces(double half_angle, Covered& covered);
  void add_means(const std::vector<TreadStrip>& strips, double half_angle, Covered& covered);
  void find_beyond(Covered& covered);
  int place_of(int plane, int node);
  void add_facet(const std::array<std::pair<int, int>, 4>& corners);
  std::pair<Grid, Weights> smooth_face(int sector, int face, const TreadStrip& strip);
  int add_line(int plane, const std::vector<MeanAcross>& means, const TreadStrip& strip);
  void add_mean_points(const MeanAround& around,
                       const std::vector<MeanAcross>& means,
                       const TreadStrip& strip,
                       int first_cell,
                       std::vector<int>& lines);
  void find_cell_nodes();
  void add_samples(const std::array<int, 4>& corner, const Grid& grid, const Weights& weights_at);
  std::vector<std::vector<int>> rows_of_faces(std::array<int, 2> back,
                                              std::array<int, 2> front) const;
  Point point_at(const Grid& grid, const Tangents& at, double share);

  const RingUnknowns& unknowns_;
  TreadShape shape_;
  std::vector<int> nodes_;
  std::vector<Place> places_;
  // Index of a node by section plane and node number, used while the surface is built.
  std::vector<std::vector<int>> place_index_;
  std::vector<Weight> weights_;
  std::vector<Point> points_, samples_;
  // A weighted term of a sum. Every contact point is a sum of averages across the tread, and every
  // average is a sum over nodes; points share the averages.
  struct Part {
    int of;
    double w;
  };
  std::vector<Part> around_, across_;
  // Index of the first term of each average, and the total number.
  std::vector<int> first_across_{0};
  std::vector<std::vector<int>> cell_nodes_;
  std::vector<Face> faces_;
  // Section plane and node of the tread nodes outside the surface.
  std::vector<std::pair<int, int>> beyond_;
};

}  // namespace latsch::fe_tire
