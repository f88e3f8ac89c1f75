// SPDX-License-Identifier: Apache-2.0
// Tests filters, spectra and correlations against an independent program: scipy.signal, to 1e-12 of
// the largest value.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "numerics/signals/bilinear.h"
#include "numerics/signals/butterworth.h"
#include "numerics/signals/fft.h"
#include "numerics/signals/time_delay.h"
#include "numerics/signals/welch.h"

namespace latsch::numerics {
namespace {

constexpr const char* kSignalsPython = "/usr/bin/python3";
constexpr const char* kSignalsScript = R"py(
import numpy as np
from scipy import signal
x, y = np.loadtxt("x"), np.loadtxt("y")
rate = 2000.0
def put(name, values):
    values = np.atleast_1d(values)
    if np.iscomplexobj(values):
        values = np.column_stack([values.real, values.imag])
    np.savetxt(name, values.ravel(), fmt="%.17g")
bands = {"lowpass": 60.0, "highpass": 60.0, "bandpass": [60.0, 150.0], "bandstop": [60.0, 150.0]}
for band, edges in bands.items():
    for order in (1, 2, 3, 4, 5, 8):
        b, a = signal.butter(order, edges, band, fs=rate)
        put(f"{band}{order}_b", b)
        put(f"{band}{order}_a", a)
    sos = signal.butter(5, edges, band, fs=rate, output="sos")
    put(f"{band}_sosfilt", signal.sosfilt(sos, x))
    put(f"{band}_sosfiltfilt", signal.sosfiltfilt(sos, x))
b, a = signal.butter(4, 60.0, fs=rate)
put("lfilter", signal.lfilter(b, a, x))
put("zi", signal.lfilter_zi(b, a))
put("filtfilt", signal.filtfilt(b, a, x))
put("fft", np.fft.rfft(x, 3000))
put("odd", np.fft.irfft(np.fft.rfft(x[:1001]), 1001))
put("welch", signal.welch(x, rate)[1])
put("welch_frequency", signal.welch(x, rate)[0])
put("welch_odd", signal.welch(x, rate, "hamming", 301, 100, 512, "linear")[1])
put("octave", signal.welch(x - x.mean(), rate, signal.get_window("hamming", 64, False), 64, detrend=False)[1])
n = int(len(x) / 4.5)
put("matlab", signal.welch(x, rate, signal.get_window("hamming", n, False), n, nfft=512, detrend=False)[1])
put("csd", signal.csd(x, y, rate, nperseg=200)[1])
put("coherence", signal.coherence(x, y, rate, nperseg=200)[1])
put("autocorrelation", signal.correlate(x, x, "full", "direct")[len(x) - 1:])
b, a = signal.bilinear([0.55, 0.3, 2.0], [1.0, 4.0, 9.0], 50.0)
put("bilinear_b", b)
put("bilinear_a", a)
)py";

constexpr double kRate = 2000.0;
constexpr int kSamples = 1600;

std::vector<double> split(const std::vector<std::complex<double>>& values) {
  std::vector<double> parts;
  for (const auto& value : values) {
    parts.push_back(value.real());
    parts.push_back(value.imag());
  }
  return parts;
}

class SciPySignal : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string ask = fmt::format("{} -c 'import scipy.signal' 2>/dev/null", kSignalsPython);
    installed_ = std::system(ask.c_str()) == 0;
    if (!installed_) return;
    folder_ = std::filesystem::temp_directory_path() / fmt::format("latsch_signal_{}", getpid());
    std::filesystem::create_directory(folder_);
    RandomStream random(7, 0);
    for (int i = 0; i < kSamples; ++i) {
      x_.push_back(3.0 + std::sin(0.3 * i) + random.normal());
      y_.push_back((i > 4 ? x_[i - 4] : 0.0) + 0.5 * random.normal());
    }
    write("x", x_);
    write("y", y_);
    std::ofstream(folder_ / "oracle.py") << kSignalsScript;
    const auto run = fmt::format("cd '{}' && {} oracle.py", folder_.string(), kSignalsPython);
    ran_ = std::system(run.c_str()) == 0;
  }
  static void TearDownTestSuite() {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  void SetUp() override {
    if (!installed_) GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
    ASSERT_TRUE(ran_);
  }

  static void write(const char* name, const std::vector<double>& values) {
    std::ofstream out(folder_ / name);
    for (const double value : values) out << fmt::format("{:.17g}\n", value);
  }

  /// Compares with SciPy's values to 1e-12 of the largest.
  static void agrees(const std::string& name, const std::vector<double>& ours) {
    std::ifstream in(folder_ / name);
    std::vector<double> theirs;
    for (double value; in >> value;) theirs.push_back(value);
    ASSERT_EQ(ours.size(), theirs.size()) << name;
    double largest = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      largest = std::max(largest, std::abs(theirs[i]));
      difference = std::max(difference, std::abs(ours[i] - theirs[i]));
    }
    EXPECT_LE(difference, 1e-12 * largest) << name;
  }

  static inline bool installed_ = false, ran_ = false;
  static inline std::filesystem::path folder_;
  static inline std::vector<double> x_, y_;
};

struct NamedBand {
  const char* name;
  FilterBand band;
  std::vector<double> edges;
};

const std::vector<NamedBand> kBands{{"lowpass", FilterBand::low_pass, {60.0}},
                                    {"highpass", FilterBand::high_pass, {60.0}},
                                    {"bandpass", FilterBand::band_pass, {60.0, 150.0}},
                                    {"bandstop", FilterBand::band_stop, {60.0, 150.0}}};

TEST_F(SciPySignal, DesignsTheSameButterworthFilters) {
  for (const auto& [name, band, edges] : kBands) {
    for (const int order : {1, 2, 3, 4, 5, 8}) {
      const auto f = polynomials_of(butterworth(order, band, edges, kRate));
      agrees(fmt::format("{}{}_a", name, order), f.a);
      agrees(fmt::format("{}{}_b", name, order), f.b);
    }
  }
}

TEST_F(SciPySignal, FiltersBySectionsForwardAndBothWays) {
  for (const auto& [name, band, edges] : kBands) {
    const auto sections = sections_of(butterworth(5, band, edges, kRate));
    agrees(fmt::format("{}_sosfilt", name), filter(sections, x_));
    agrees(fmt::format("{}_sosfiltfilt", name), filter_forward_backward(sections, x_));
  }
}

TEST_F(SciPySignal, FiltersByPolynomials) {
  const auto f = polynomials_of(butterworth(4, FilterBand::low_pass, {60.0}, kRate));
  agrees("lfilter", filter(f, x_));
  agrees("zi", steady_state(f));
  agrees("filtfilt", filter_forward_backward(f, x_));
}

TEST_F(SciPySignal, TransformsLikeNumPy) {
  agrees("fft", split(real_fft(x_, 3000)));
  const std::span<const double> odd(x_.data(), 1001);
  agrees("odd", inverse_real_fft(real_fft(odd, 1001), 1001));
}

TEST_F(SciPySignal, WelchIsTheSameInEveryConvention) {
  const auto scipy = power_density(x_, kRate, welch_settings(Convention::scipy, kSamples));
  agrees("welch", scipy.value);
  agrees("welch_frequency", scipy.frequency);
  agrees("welch_odd",
         power_density(
             x_, kRate, {301, 100, 512, SpectralWindow::hamming_periodic, Detrend::segment_line})
             .value);
  const auto octave = welch_settings(Convention::octave, kSamples);
  EXPECT_EQ(octave.segment, 64);  // the next power of two above sqrt(1600) = 40
  agrees("octave", power_density(x_, kRate, octave).value);
  const auto matlab = welch_settings(Convention::matlab, kSamples);
  // At most eight segments are used; 355 of 1600 samples fit seven times.
  EXPECT_EQ(segment_count(kSamples, matlab), 7);
  agrees("matlab", power_density(x_, kRate, matlab).value);
}

TEST_F(SciPySignal, CrossDensityAndCoherenceAreTheSame) {
  const auto s = densities(x_, y_, kRate, welch_settings(Convention::scipy, kSamples, 200));
  agrees("csd", split(s.xy));
  agrees("coherence", coherence(s));
}

TEST_F(SciPySignal, AutocorrelationIsTheSame) {
  agrees("autocorrelation", autocorrelation(x_, kSamples));
}

TEST_F(SciPySignal, TransformsFromSToZTheSame) {
  const auto f = bilinear({{2.0, 0.3, 0.55}, {9.0, 4.0, 1.0}}, 50.0);
  agrees("bilinear_b", f.b);
  agrees("bilinear_a", f.a);
}

}  // namespace
}  // namespace latsch::numerics
