// SPDX-License-Identifier: Apache-2.0
// Tests DTYRE, the tire subroutine of the Standard Tyre Interface 1.4 (apps/exchange/sti.h): its
// results equal those of the tire called directly, whatever steps an integrator tries in between.
#include "exchange/sti.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "exchange/package/unit_folder.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "models/road/road.h"

extern "C" void roll_in_fortran(const int* idtyre,
                                const int* nfile,
                                const char* file,
                                const double* height,
                                const double* speed,
                                const double* spin,
                                const double* step,
                                const int* steps,
                                double* answers,
                                int* ierr);

namespace latsch::exchange::sti {
namespace {

constexpr const char* kRing = "ring_tires/passenger_205_55R16.toml";
constexpr const char* kMagicFormula = "tire_model_comparison/magic_formula.tir";
constexpr double kStep = 1e-3, kSpeed = 10.0, kSpin = 32.5;

std::string path_of(const std::string& model) {
  return (std::filesystem::path(LATSCH_SOURCE_DIR) / "studies" / model).string();
}

using Answer = std::array<double, 6>;

void expect_same_bits(const Answer& a, const Answer& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << i;
}

/// A road of height 0.01 m + 0.02 x, with derivatives if requested; there is no road beyond x = 50
/// m.
void slope_road(const double*,
                const double dis[2],
                const int*,
                const int*,
                const int*,
                const int*,
                const int*,
                const double[],
                const int*,
                const char*,
                const int*,
                int* nroad,
                double* z,
                double dz[2],
                double ddz[3],
                int* dflag,
                double prsurf[],
                int* ierr,
                long) {
  *nroad = 2;
  *z = 0.01 + 0.02 * dis[0];
  dz[0] = 0.02;
  dz[1] = ddz[0] = ddz[1] = ddz[2] = 0.0;
  *dflag = 1;
  prsurf[0] = 1.0;
  *ierr = dis[0] > 50.0 ? 2 : 0;
}

/// The road of slope_road, which returns the height alone.
void height_alone(const double* time,
                  const double dis[2],
                  const int* i,
                  const int* j,
                  const int* tire,
                  const int* road,
                  const int* n,
                  const double p[],
                  const int* c,
                  const char* file,
                  const int* m,
                  int* nroad,
                  double* z,
                  double dz[2],
                  double ddz[3],
                  int* dflag,
                  double prsurf[],
                  int* ierr,
                  long length) {
  slope_road(time,
             dis,
             i,
             j,
             tire,
             road,
             n,
             p,
             c,
             file,
             m,
             nroad,
             z,
             dz,
             ddz,
             dflag,
             prsurf,
             ierr,
             length);
  dz[0] = 4711.0;
  *dflag = 0;
}

/// A program that calls DTYRE for one tire.
struct Caller {
  int id;
  RoadCall* road = slope_road;
  double height = 0.0;
  std::string file = "", road_file = "";
  Answer hub{};
  double typarr[7]{}, varinf[15]{};
  char model[256]{};
  int ndeqvr = -1, ntypar = -1, nvars = -1, nwork = -1, niwork = -1;
  Dtyre* function = &dtyre;

  int call(int job, double time = 0.0, double lift = 0.0) {
    const int zero = 0, road_number = 5, file_length = static_cast<int>(file.size()),
              road_length = static_cast<int>(road_file.size());
    const double dis[3] = {kSpeed * time, 0.0, height + lift}, vel[3] = {kSpeed, 0.0, 0.0},
                 omega[3] = {}, angle = kSpin * time, spin = kSpin;
    const double tramat[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    double none[1] = {};
    int no_integers[1] = {}, ierr = -1;
    function(&zero,
             &zero,
             &job,
             &id,
             &time,
             dis,
             tramat,
             &angle,
             vel,
             omega,
             &spin,
             &ndeqvr,
             none,
             &ntypar,
             typarr,
             &file_length,
             file.c_str(),
             road,
             &road_number,
             &zero,
             none,
             &road_length,
             road_file.c_str(),
             hub.data(),
             hub.data() + 3,
             none,
             none,
             model,
             &nvars,
             varinf,
             &nwork,
             none,
             &niwork,
             no_integers,
             &ierr);
    return ierr;
  }
  std::string message() const { return latsch_sti_message(&id); }
  ~Caller() { call(99); }
};

/// The road of slope_road as a road of Latsch that answers only single points, not rectangles.
class Slope final : public road::Road {
 public:
  road::GroundPoint at(double x, double, double) const override {
    return {.height = 0.01 + 0.02 * x, .normal = Eigen::Vector3d(-0.02, 0.0, 1.0).normalized()};
  }
};

/// The tire called directly, without DTYRE.
struct Direct {
  explicit Direct(const std::string& model)
      : specimen([&] {
          const auto& kind = experiment::language().kind_of_file(path_of(model));
          return kind.build(kind.read(path_of(model)));
        }()),
        tire(specimen->find<Rolls>()->tire()),
        height(tire->free_radius() - 0.005) {}

  Answer at(double time, double step) {
    WheelMotion motion;
    motion.center = {kSpeed * time, 0.0, height};
    motion.velocity.x() = kSpeed;
    motion.spin = kSpin * time;
    motion.spin_rate = kSpin;
    const auto hub =
        step == 0.0 ? tire->settle(motion, road, time) : tire->advance(motion, road, time, step);
    EXPECT_TRUE(hub);
    if (!hub) return {};
    Answer answer;
    Eigen::Map<Eigen::Vector3d>(answer.data()) = hub->force;
    Eigen::Map<Eigen::Vector3d>(answer.data() + 3) = hub->moment;
    return answer;
  }

  std::unique_ptr<experiment::Specimen> specimen;
  std::unique_ptr<Tire> tire;
  double height;
  Slope road;
};

Caller caller_of(int id, const std::string& model) {
  return {.id = id, .height = Direct(model).height, .file = path_of(model)};
}

/// Tolerance as a share of the load. The error comes from derivatives by differences, 1e-13
/// (heights rounded to 1e-16 m, 2 mm apart), under loads of some kN, and it grows over the steps.
constexpr double kClose = 1e-6;

void expect_near(const Answer& a, const Answer& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], kClose * (1.0 + std::abs(b[2]))) << i;
}

class EveryTire : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Sti,
                         EveryTire,
                         testing::Values(kRing, kMagicFormula),
                         [](const auto& info) {
                           return std::string(info.param) == kRing ? "ring" : "magic_formula";
                         });

TEST_P(EveryTire, AnswersASlopeAsTheTireAskedDirectlyToTheLastBit) {
  Caller caller = caller_of(1, GetParam());
  ASSERT_EQ(caller.call(1), 0);
  ASSERT_EQ(caller.call(2), 0) << caller.message();
  Direct direct(GetParam());
  for (int i = 0; i <= 30; ++i) {
    ASSERT_EQ(caller.call(0, kStep * i), 0) << caller.message();
    expect_same_bits(caller.hub, direct.at(kStep * i, i == 0 ? 0.0 : kStep * i - kStep * (i - 1)));
  }
  EXPECT_GT(caller.hub[2], 1000.0);
}

TEST_P(EveryTire, AnswersTheSameBitsWhateverWasTriedInBetween) {
  Caller quiet = caller_of(1, GetParam()), busy = caller_of(2, GetParam());
  ASSERT_EQ(quiet.call(2), 0);
  ASSERT_EQ(busy.call(2), 0);
  for (int i = 0; i <= 20; ++i) {
    const double time = kStep * i;
    ASSERT_EQ(quiet.call(0, time), 0);
    ASSERT_EQ(busy.call(0, time + 2.0 * kStep), 0);  // a step that is too long and is abandoned
    ASSERT_EQ(busy.call(0, time + 0.5 * kStep), 0);  // another
    ASSERT_EQ(busy.call(0, time, 1e-3), 0);          // an iteration within the step
    ASSERT_EQ(busy.call(5, time, 1e-6), 0);          // a difference
    ASSERT_EQ(busy.call(0, time), 0);
    expect_same_bits(busy.hub, quiet.hub);
    ASSERT_EQ(busy.call(5, time + kStep, -1e-3), 0);  // an iteration ahead of the step
    ASSERT_EQ(busy.call(4, time), 0);
  }
}

TEST_P(EveryTire, GoesBackToAKeptStateAndOnToTheSameBits) {
  Caller caller = caller_of(1, GetParam());
  ASSERT_EQ(caller.call(2), 0);
  std::vector<Answer> first;
  for (int i = 0; i <= 30; ++i) {
    ASSERT_EQ(caller.call(0, kStep * i), 0);
    first.push_back(caller.hub);
  }
  for (int i = 10; i <= 30; ++i) {
    ASSERT_EQ(caller.call(0, kStep * i), 0);
    expect_same_bits(caller.hub, first[static_cast<std::size_t>(i)]);
  }
  ASSERT_EQ(caller.call(0, 0.0), 0);  // a return to the start
  expect_same_bits(caller.hub, first[0]);
}

TEST_P(EveryTire, RollsSteadilyOverARoadOfHeightsAloneAsOverOneWithSlopes) {
  // On a plane the difference of two heights gives the slope except for rounding, 1e-16 m over 1e-3
  // m.
  Caller slopes = caller_of(1, GetParam()), heights = caller_of(2, GetParam());
  heights.road = height_alone;
  ASSERT_EQ(slopes.call(2), 0);
  ASSERT_EQ(heights.call(2), 0);
  for (int i = 0; i <= 20; ++i) {
    ASSERT_EQ(slopes.call(0, kStep * i), 0);
    ASSERT_EQ(heights.call(0, kStep * i), 0);
    expect_near(heights.hub, slopes.hub);
  }
}

#ifdef LATSCH_FORTRAN
TEST_P(EveryTire, AnswersFortranAsItAnswersC) {
  constexpr int kSteps = 20;
  const std::string file = path_of(GetParam());
  const int id = 7, length = static_cast<int>(file.size()), steps = kSteps;
  const double height = Direct(GetParam()).height, speed = kSpeed, spin = kSpin, step = kStep;
  double answers[kSteps + 1][6] = {};
  int ierr = -1;
  roll_in_fortran(
      &id, &length, file.c_str(), &height, &speed, &spin, &step, &steps, answers[0], &ierr);
  ASSERT_EQ(ierr, 0) << latsch_sti_message(&id);
  Caller caller = caller_of(1, GetParam());
  ASSERT_EQ(caller.call(2), 0);
  for (int i = 0; i <= kSteps; ++i) {
    ASSERT_EQ(caller.call(0, kStep * i), 0);
    Answer fortran;
    std::copy_n(answers[i], 6, fortran.begin());
    expect_same_bits(fortran, caller.hub);
  }
}
#endif

/// The slim library, which shares no code at run time with the one that this program is linked to.
class SlimLibrary {
 public:
  SlimLibrary() : handle_(::dlopen(LATSCH_STI_SLIM, RTLD_NOW | RTLD_LOCAL)) {}
  ~SlimLibrary() {
    if (handle_) ::dlclose(handle_);
  }
  SlimLibrary(const SlimLibrary&) = delete;
  SlimLibrary& operator=(const SlimLibrary&) = delete;

  bool is_there() const { return handle_ != nullptr; }
  Dtyre* function() const { return reinterpret_cast<Dtyre*>(::dlsym(handle_, "dtyre")); }
  std::string message(int id) const {
    return reinterpret_cast<const char* (*)(const int*)>(::dlsym(handle_, "latsch_sti_message"))(
        &id);
  }

 private:
  void* handle_;
};

TEST_P(EveryTire, OfTheSlimLibraryHasTheSameBits) {
  const SlimLibrary slim_library;
  ASSERT_TRUE(slim_library.is_there()) << ::dlerror();
  const ScratchFolder folder;
  const auto& kind = experiment::language().kind_of_file(path_of(GetParam()));
  for (const auto& [name, bytes] : unit_files(kind, kind.read(path_of(GetParam()))))
    write_text_file(folder / name, bytes);
  Caller whole = caller_of(1, GetParam()), slim = caller_of(2, GetParam());
  slim.function = slim_library.function();
  slim.file = (folder / "unit.toml").string();
  ASSERT_NE(slim.function, whole.function);
  ASSERT_EQ(whole.call(2), 0);
  ASSERT_EQ(slim.call(2), 0) << slim_library.message(2);
  for (int i = 0; i <= 50; ++i) {
    ASSERT_EQ(whole.call(0, kStep * i), 0);
    ASSERT_EQ(slim.call(0, kStep * i), 0) << slim_library.message(2);
    expect_same_bits(slim.hub, whole.hub);
  }
  // The library with all models reads the folder, too.
  Caller of_folder = caller_of(3, GetParam());
  of_folder.file = slim.file;
  ASSERT_EQ(of_folder.call(2), 0) << of_folder.message();
  ASSERT_EQ(of_folder.call(0, 0.0), 0);
  whole.call(3);
  ASSERT_EQ(whole.call(0, 0.0), 0);
  expect_same_bits(of_folder.hub, whole.hub);
  slim.file = path_of(GetParam());
  EXPECT_EQ(slim.call(2), 2);
  EXPECT_NE(slim_library.message(2).find("latsch export TIRE --sti -o FOLDER"), std::string::npos)
      << slim_library.message(2);
}

TEST(Sti, TellsSizesRadiusAndModel) {
  Caller caller = caller_of(1, kMagicFormula);
  ASSERT_EQ(caller.call(1), 0);
  EXPECT_EQ(caller.ndeqvr, 0);
  EXPECT_EQ(caller.nwork, 0);
  EXPECT_EQ(caller.niwork, 0);
  EXPECT_EQ(caller.ntypar, 7);
  EXPECT_EQ(caller.nvars, 15);
  ASSERT_EQ(caller.call(2), 0);
  const double R = Direct(kMagicFormula).tire->free_radius();
  EXPECT_EQ(caller.typarr[6], R);
  EXPECT_EQ(std::string(caller.model, 6), "Latsch");
  EXPECT_EQ(caller.model[255], ' ');
  ASSERT_EQ(caller.call(0, 0.0), 0);
  // m, distance to the road at x = 0, in the plane of the wheel
  const double loaded = caller.height - 0.01;
  EXPECT_NEAR(caller.varinf[9], R - loaded, 1e-12);
  EXPECT_NEAR(caller.varinf[11], loaded, 1e-12);
  EXPECT_NEAR(caller.varinf[14], 0.01, 1e-12);
}

TEST(Sti, ReadsTheRoadItselfWhereNoneIsHandedOver) {
  Caller caller = caller_of(1, kMagicFormula);
  caller.road = nullptr;
  EXPECT_EQ(caller.call(2), 2);
  EXPECT_NE(caller.message().find("CHRDST"), std::string::npos) << caller.message();
  caller.road_file = path_of("no_road.toml");
  EXPECT_EQ(caller.call(2), 2);
  EXPECT_NE(caller.message().find("no_road.toml"), std::string::npos) << caller.message();
}

TEST(Sti, SaysWhatIsWrongAndGoesOn) {
  Caller caller = caller_of(1, kMagicFormula);
  const std::string file = caller.file;
  EXPECT_EQ(caller.call(0), 2);
  EXPECT_NE(caller.message().find("JOBFLG = 2"), std::string::npos) << caller.message();
  caller.file = "/no/such/tire.tir";
  EXPECT_EQ(caller.call(2), 2);
  EXPECT_NE(caller.message().find("/no/such/tire.tir"), std::string::npos) << caller.message();
  caller.file = path_of("kerb/front.toml");
  EXPECT_EQ(caller.call(2), 2);
  EXPECT_NE(caller.message().find("does not roll"), std::string::npos) << caller.message();
  caller.file = "";
  EXPECT_EQ(caller.call(2), 2);
  caller.file = file + "   ";  // padded with blanks as in Fortran
  ASSERT_EQ(caller.call(2), 0) << caller.message();
  ASSERT_EQ(caller.call(0, 0.0), 0);
  const Answer rest = caller.hub;
  EXPECT_EQ(caller.call(42, 0.0), 2);
  EXPECT_EQ(caller.call(0, NAN), 2);
  EXPECT_EQ(caller.call(0, 1e3), 2);  // there is no road
  EXPECT_NE(caller.message().find("ROAD answers IERR = 2"), std::string::npos) << caller.message();
  ASSERT_EQ(caller.call(0, 0.0), 0);
  expect_same_bits(caller.hub, rest);
  EXPECT_EQ(caller.message(), "");
}

TEST(Sti, RefusesATimeBeforeAllKeptStates) {
  Caller caller = caller_of(1, kMagicFormula);
  ASSERT_EQ(caller.call(2), 0);
  for (int i = 0; i <= 100; ++i) ASSERT_EQ(caller.call(0, kStep * i), 0);
  EXPECT_EQ(caller.call(0, 10.5 * kStep), 2);
  EXPECT_NE(caller.message().find("64 states"), std::string::npos) << caller.message();
  EXPECT_EQ(caller.call(0, 101.0 * kStep), 0);
  EXPECT_EQ(caller.call(0, 0.0), 0);  // a return to the start is always possible
}

}  // namespace
}  // namespace latsch::exchange::sti
