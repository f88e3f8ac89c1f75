// SPDX-License-Identifier: Apache-2.0
#include "exchange/sti.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "base/utf8.h"
#include "exchange/loading.h"
#include "exchange/own_arithmetic.h"
#include "exchange/unit/stepped_tire.h"
#include "exchange/unit/tire_unit.h"
#include "formats/road/road_file.h"

namespace latsch::exchange::sti {
namespace {

using Eigen::Vector3d;

enum Job { normal = 0, sizes = 1, initialize = 2, reset = 3, step_is_over = 4, difference = 5 };
constexpr int kInitialConditions = 6, kActualSizes = 11, kEnd = 99;
constexpr int kGood = 0, kNoResult = 2;
constexpr int kParameters = 7, kAnswers = 15, kModelText = 256;

struct Seat {
  std::mutex busy;
  std::unique_ptr<SteppedTire> tire;
  std::string description;
  std::shared_ptr<const road::Road> road;  // set if the road is read from a file
  std::string message;
};

/// Returns the tire with this IDTYRE, the number that the calling program gives each tire of the
/// process.
std::shared_ptr<Seat> seat(int idtyre) {
  static std::mutex busy;
  static std::map<int, std::shared_ptr<Seat>> seats;
  const std::lock_guard lock(busy);
  auto& found = seats[idtyre];
  if (!found) found = std::make_shared<Seat>();
  return found;
}

std::string file_name(const char* text, int length, const char* what) {
  const std::string name(
      trimmed(std::string_view(text, static_cast<std::size_t>(std::max(length, 0)))));
  if (name.empty()) throw InputError(std::string(what) + " names no file");
  return name;
}

void load(Seat& seat, const std::string& file, const std::string& road) {
  const std::filesystem::path path = path_of_utf8(file);
  const TireFromFolder found = path.filename() == kUnitFile
                                   ? read_tire_of_unit(path.parent_path(), models_of_library())
                                   : tire_as_written(path);
  seat.tire = std::make_unique<SteppedTire>(found.tire.rolls->tire());
  seat.description = "Latsch: " + found.kind;
  seat.road =
      road.empty() ? nullptr : std::shared_ptr(formats::read_road_file(path_of_utf8(road)).road);
}

/// The arguments of the subroutine DTYRE, unchanged.
struct Call {
  const double *time, *dis, *tramat, *angtwc, *vel, *omega, *omegar;
  int* ntypar;
  double* typarr;
  const int* nchtds;
  const char* chtdst;
  RoadCall* road;
  const int *idtyre, *idroad, *nropar;
  const double* ropar;
  const int* nchrds;
  const char* chrdst;
  double *force, *torque;
  char* tyrmod;
  int* nvars;
  double* varinf;
};

WheelMotion motion_of(const Call& call) {
  WheelMotion motion;
  motion.center = Eigen::Map<const Vector3d>(call.dis);
  motion.carrier = Eigen::Map<const Eigen::Matrix3d>(call.tramat);
  motion.velocity = motion.carrier * Eigen::Map<const Vector3d>(call.vel);
  motion.angular_velocity = motion.carrier * Eigen::Map<const Vector3d>(call.omega);
  motion.spin = *call.angtwc;
  motion.spin_rate = *call.omegar;
  return motion;
}

void begin(Seat& seat, const Call& call) {
  load(seat,
       file_name(call.chtdst, *call.nchtds, "CHTDST"),
       call.road ? "" : file_name(call.chrdst, *call.nchrds, "CHRDST, with no ROAD,"));
  std::memset(call.tyrmod, ' ', kModelText);
  std::memcpy(call.tyrmod,
              seat.description.data(),
              std::min<std::size_t>(kModelText, seat.description.size()));
  if (*call.ntypar < kParameters) return;
  std::fill_n(call.typarr, *call.ntypar, 0.0);
  call.typarr[6] = seat.tire->free_radius();
}

void tell(const Call& call, double radius, double free_radius, const WheelMotion& motion) {
  if (*call.nvars < kAnswers) return;
  std::fill_n(call.varinf, *call.nvars, 0.0);
  call.varinf[9] = free_radius - radius;
  call.varinf[11] = radius;
  Eigen::Map<Vector3d>(call.varinf + 12) = motion.center - radius * motion.carrier.col(2);
}

void evaluate(Seat& seat, const Call& call, bool keep) {
  if (!seat.tire) throw InputError("there is no such tire: JOBFLG = 2 reads it");
  const CalledRoad called(
      call.road, call.idtyre, call.idroad, call.nropar, call.ropar, call.nchrds, call.chrdst);
  if (!call.road && !seat.road) throw InputError("there is no ROAD, and was none at JOBFLG = 2");
  const road::Road& road = call.road ? static_cast<const road::Road&>(called) : *seat.road;
  const WheelMotion motion = motion_of(call);
  if (const Status fit = check_motion(motion); !fit) throw InputError(fit.failure().reason);
  if (!std::isfinite(*call.time)) throw InputError("TIME is not finite");
  const auto hub = seat.tire->forces(motion, road, *call.time, keep);
  if (!hub) throw InputError(hub.failure().reason);
  Eigen::Map<Vector3d>(call.force) = hub->force;
  Eigen::Map<Vector3d>(call.torque) = hub->moment;
  tell(call, loaded_radius(motion, road, *call.time), seat.tire->free_radius(), motion);
}

void run(Seat& seat, int job, const Call& call) {
  switch (job) {
    case normal:
    case difference:
      return evaluate(seat, call, job == normal);
    case initialize:
    case reset:
      return begin(seat, call);
    case step_is_over:
    case kInitialConditions:
      return;
    case kEnd:
      seat.tire.reset();
      return;
    default:
      throw InputError(fmt::format("JOBFLG is {}, expected one of 0 to 6, 11, 99", job));
  }
}

}  // namespace

extern "C" {

void dtyre_(const int*,
            const int*,
            const int* jobflg,
            const int* idtyre,
            const double* time,
            const double dis[3],
            const double tramat[9],
            const double* angtwc,
            const double vel[3],
            const double omega[3],
            const double* omegar,
            int* ndeqvr,
            const double[],
            int* ntypar,
            double typarr[],
            const int* nchtds,
            const char* chtdst,
            RoadCall* road,
            const int* idroad,
            const int* nropar,
            const double ropar[],
            const int* nchrds,
            const char* chrdst,
            double force[3],
            double torque[3],
            double[],
            double[],
            char tyrmod[256],
            int* nvars,
            double varinf[],
            int* nwork,
            double[],
            int* niwork,
            int[],
            int* ierr) {
  *ierr = kGood;
  const OwnArithmetic own;
  try {
    const std::shared_ptr<Seat> mine = seat(*idtyre);
    const std::lock_guard lock(mine->busy);
    mine->message.clear();
    if (*jobflg == sizes || *jobflg == kActualSizes) {
      *ndeqvr = *nwork = *niwork = 0;
      *ntypar = kParameters;
      *nvars = kAnswers;
      return;
    }
    try {
      run(*mine, *jobflg, {time,   dis,    tramat, angtwc, vel,    omega,  omegar, ntypar,
                           typarr, nchtds, chtdst, road,   idtyre, idroad, nropar, ropar,
                           nchrds, chrdst, force,  torque, tyrmod, nvars,  varinf});
    } catch (const std::exception& error) {
      *ierr = kNoResult;
      mine->message = error.what();
      std::fprintf(stderr, "latsch, tire %d: %s\n", *idtyre, error.what());
    }
  } catch (...) {  // out of memory
    *ierr = kNoResult;
  }
}

[[gnu::alias("dtyre_")]] Dtyre dtyre;

const char* latsch_sti_message(const int* idtyre) {
  try {
    return seat(*idtyre)->message.c_str();
  } catch (...) {
    return "";
  }
}

}  // extern "C"

}  // namespace latsch::exchange::sti
