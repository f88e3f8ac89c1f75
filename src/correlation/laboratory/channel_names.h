// SPDX-License-Identifier: Apache-2.0
// What laboratories call the channels of a tire test, and what we call them.
//
//   ours            unit   consortia   TYDEX         others
//   time            s      ET          RUNTIME
//   Vx              m/s    V           LONGVEL
//   omega           rad/s  N           WHROTSPD
//   alpha           rad    SA          SLIPANGL
//   gamma           rad    IA          INCLANGL
//   kappa           1      SR          LONGSLIP
//   p               Pa     P           INFLPRES
//   loaded_radius   m      RL          DSTGRWHC      R_l
//   R_e             m      RE
//   tread           K                  TRDTEMP
//   tread_inner     K      TSTI
//   tread_center    K      TSTC
//   tread_outer     K      TSTO
//   road            K      RST         TRCKTEMP
//   ambient         K      AMBTMP      AMBITEMP
//   Fx ... Mz       N, N m FX ... MZ   FXW ... MZC   in any case
//
// SR is the slip whose zero is free rolling; SL, of the loaded radius, keeps its
// name, as everything else does. A name counts where its unit is of that dimension.
#pragma once

#include <string>
#include <vector>

namespace latsch::correlation {

/// Our name of what a file calls `name`, in the SI unit `unit`; `name` where we have none.
std::string our_name(const std::string& name, const std::string& unit);

/// "Fy", "FyW", "MZH" -> "Fy", "Fy", "Mz"; empty for what is no force or moment.
std::string force_without_frame(const std::string& name);

/// A channel among others; the name of a force or moment may say its frame: "Fy", "FyW", "FZH".
struct NamedChannel {
  std::string name, frame;  // empty: there is none
};
/// The one that `wanted` means: called so, a synonym of it, or with a frame behind it.
NamedChannel find_named(const std::vector<std::string>& names, const std::string& wanted);

}  // namespace latsch::correlation
