// SPDX-License-Identifier: Apache-2.0
// Converts between NumPy arrays and the types of the libraries. Arrays are copied: a turn of an
// optimizer copies some dozen numbers.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "optimization/problem/design_point.h"
#include "optimization/problem/design_space.h"

namespace latsch::python {

namespace py = pybind11;

/// A C-ordered NumPy array of doubles; any argument that NumPy can convert is accepted.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline Array array(const std::vector<double>& values) {
  return Array(static_cast<py::ssize_t>(values.size()), values.data());
}

inline Array array(const Eigen::VectorXd& values) { return Array(values.size(), values.data()); }

inline Array array(const Eigen::MatrixXd& matrix) {
  Array rows({matrix.rows(), matrix.cols()});
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      rows.mutable_data(), matrix.rows(), matrix.cols()) = matrix;
  return rows;
}

/// Returns an array with one row for each point; its shape is (0, variables) if there is none.
inline Array array(const std::vector<DesignPoint>& points, int variables) {
  Array rows({static_cast<py::ssize_t>(points.size()), static_cast<py::ssize_t>(variables)});
  double* to = rows.mutable_data();
  for (const DesignPoint& point : points)
    to = std::copy(point.values.begin(), point.values.end(), to);
  return rows;
}

inline std::vector<double> vector(const Array& values) {
  return {values.data(), values.data() + values.size()};
}

/// Reads a design point from an array of one value for each variable. Throws InputError for another
/// shape.
inline DesignPoint point(const Array& values, int variables) {
  if (values.ndim() != 1 || values.shape(0) != variables)
    throw InputError("a point has one value a variable, expected an array of the shape (" +
                     std::to_string(variables) + ",), found " +
                     py::str(values.attr("shape")).cast<std::string>());
  return {vector(values)};
}

/// Reads a point (n,) of the space. Throws InputError that names the first variable outside of its
/// bounds.
inline DesignPoint point_within(const DesignSpace& space, const Array& values) {
  DesignPoint read = point(values, space.size());
  for (int i = 0; i < space.size(); ++i) {
    const DesignVariable& variable = space[i];
    const double value = read.values[static_cast<std::size_t>(i)];
    if (!(value >= variable.lower && value <= variable.upper))
      throw InputError("the point has " + variable.name + " = " + format_number(value) +
                       ", outside of its bounds " + format_number(variable.lower) + " to " +
                       format_number(variable.upper));
  }
  return read;
}

/// Reads a matrix of `rows` x `columns`. Throws InputError, which names the argument, for another
/// shape.
inline Eigen::MatrixXd matrix(const Array& values,
                              py::ssize_t rows,
                              py::ssize_t columns,
                              const char* what) {
  if (values.ndim() != 2 || values.shape(0) != rows || values.shape(1) != columns)
    throw InputError(std::string(what) + " is of the shape " +
                     py::str(values.attr("shape")).cast<std::string>() + ", expected (" +
                     std::to_string(rows) + ", " + std::to_string(columns) + ")");
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), rows, columns);
}

}  // namespace latsch::python
