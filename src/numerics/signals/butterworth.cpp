// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/butterworth.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::numerics {
namespace {

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;

struct Analog {
  Roots zeros, poles;
  double gain = 1.0;
};

/// Returns poles on the left half of the unit circle.
Analog prototype(int order) {
  Analog analog;
  for (int m = 1 - order; m < order; m += 2) {
    // The real pole of an odd order is set exactly.
    analog.poles.push_back(m == 0 ? Complex(-1.0)
                                  : -std::polar(1.0, std::numbers::pi * m / (2.0 * order)));
  }
  return analog;
}

double product_of_negatives(const Roots& roots) {
  Complex product = 1.0;
  for (const Complex& root : roots) product *= -root;
  return product.real();
}

/// Substitutes s -> s / w.
void to_low_pass(Analog& analog, double w) {
  for (Complex& pole : analog.poles) pole *= w;
  analog.gain *= std::pow(w, static_cast<double>(analog.poles.size()));
}

/// Substitutes s -> w / s.
void to_high_pass(Analog& analog, double w) {
  analog.gain /= product_of_negatives(analog.poles);
  for (Complex& pole : analog.poles) pole = w / pole;
  analog.zeros.assign(analog.poles.size(), 0.0);
}

/// Adds both solutions s of s^2 - 2 half s + w0^2 = 0.
void add_roots(Roots& roots, Complex half, double w0) {
  const Complex root = std::sqrt(half * half - w0 * w0);
  roots.push_back(half + root);
  roots.push_back(half - root);
}

/// Substitutes s -> (s^2 + w0^2) / (width s).
void to_band_pass(Analog& analog, double w0, double width) {
  Roots poles;
  for (const Complex& pole : analog.poles) add_roots(poles, pole * width / 2.0, w0);
  const std::size_t order = analog.poles.size();
  analog = {Roots(order, 0.0), poles, std::pow(width, static_cast<double>(order))};
}

/// Substitutes s -> width s / (s^2 + w0^2).
void to_band_stop(Analog& analog, double w0, double width) {
  Roots poles, zeros;
  const double gain = 1.0 / product_of_negatives(analog.poles);
  for (const Complex& pole : analog.poles) {
    add_roots(poles, width / 2.0 / pole, w0);
    zeros.emplace_back(0.0, w0);
    zeros.emplace_back(0.0, -w0);
  }
  analog = {zeros, poles, gain};
}

/// Substitutes s = 2 rate (z - 1) / (z + 1). Zeros at infinity move to z = -1.
ZerosAndPoles bilinear(const Analog& analog, double rate) {
  const double k = 2.0 * rate;
  ZerosAndPoles digital;
  Complex gain = analog.gain;
  for (const Complex& zero : analog.zeros) {
    digital.zeros.push_back((k + zero) / (k - zero));
    gain *= k - zero;
  }
  for (const Complex& pole : analog.poles) {
    digital.poles.push_back((k + pole) / (k - pole));
    gain /= k - pole;
  }
  digital.zeros.resize(digital.poles.size(), -1.0);
  digital.gain = gain.real();
  return digital;
}

/// Returns the coefficients of prod (1 - root / z); both of two conjugate roots must be given.
std::vector<double> polynomial(const Roots& roots) {
  Roots c{1.0};
  for (const Complex& root : roots) {
    c.push_back(0.0);
    for (std::size_t i = c.size() - 1; i > 0; --i) c[i] -= root * c[i - 1];
  }
  std::vector<double> real;
  for (const Complex& value : c) real.push_back(value.real());
  return real;
}

/// Two roots whose polynomial is real, or a single real root.
using RootPair = std::vector<Complex>;

/// Returns the conjugate pairs first, then pairs of real roots, each of the smallest and the
/// largest one left; a single root comes last.
std::vector<RootPair> pairs_of(const Roots& roots) {
  // Largest imaginary part of a real root, which is due to rounding.
  constexpr double kReal = 1e-12;
  std::vector<RootPair> pairs;
  std::vector<double> real;
  for (const Complex& root : roots) {
    if (std::abs(root.imag()) < kReal) {
      real.push_back(root.real());
    } else if (root.imag() > 0.0) {
      pairs.push_back({root, std::conj(root)});
    }
  }
  std::sort(real.begin(), real.end());
  std::size_t first = 0, last = real.size();
  while (last - first >= 2) pairs.push_back({real[first++], real[--last]});
  if (first < last) pairs.push_back({real[first]});
  return pairs;
}

double distance_to_circle(const RootPair& pair) { return 1.0 - std::abs(pair.front()); }

}  // namespace

ZerosAndPoles butterworth(int order,
                          FilterBand band,
                          const std::vector<double>& edges,
                          double rate) {
  assert(order >= 1 && !edges.empty());
  const auto warped = [&](double frequency) {
    assert(frequency > 0.0 && frequency < rate / 2.0);
    return 2.0 * rate * std::tan(std::numbers::pi * frequency / rate);
  };
  Analog analog = prototype(order);
  if (band == FilterBand::low_pass) {
    to_low_pass(analog, warped(edges[0]));
  } else if (band == FilterBand::high_pass) {
    to_high_pass(analog, warped(edges[0]));
  } else {
    assert(edges.size() == 2 && edges[0] < edges[1]);
    const double w1 = warped(edges[0]), w2 = warped(edges[1]);
    const double w0 = std::sqrt(w1 * w2), width = w2 - w1;
    band == FilterBand::band_pass ? to_band_pass(analog, w0, width)
                                  : to_band_stop(analog, w0, width);
  }
  return bilinear(analog, rate);
}

std::vector<FilterSection> sections_of(const ZerosAndPoles& filter) {
  std::vector<RootPair> poles = pairs_of(filter.poles), zeros = pairs_of(filter.zeros);
  std::vector<FilterSection> sections;
  // Pole pairs are combined with the zeros at the same index, and a single pole with the single
  // zero.
  assert(poles.size() == zeros.size());
  for (std::size_t i = 0; i < poles.size(); ++i) {
    std::vector<double> b = polynomial(zeros[i]), a = polynomial(poles[i]);
    b.resize(3, 0.0);
    a.resize(3, 0.0);
    sections.push_back({b[0], b[1], b[2], a[1], a[2]});
  }
  std::vector<std::size_t> order(poles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return distance_to_circle(poles[i]) > distance_to_circle(poles[j]);
  });
  std::vector<FilterSection> sorted;
  sorted.reserve(order.size());
  for (const std::size_t i : order) sorted.push_back(sections[i]);
  sorted.front().b0 *= filter.gain;
  sorted.front().b1 *= filter.gain;
  sorted.front().b2 *= filter.gain;
  return sorted;
}

RationalFilter polynomials_of(const ZerosAndPoles& filter) {
  RationalFilter f{polynomial(filter.zeros), polynomial(filter.poles)};
  for (double& b : f.b) b *= filter.gain;
  return f;
}

}  // namespace latsch::numerics
