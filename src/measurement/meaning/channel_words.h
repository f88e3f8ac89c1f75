// SPDX-License-Identifier: Apache-2.0
// The vocabulary of channels: how laboratories of several habits write a channel, and what we call
// it. Every reader and every test looks names up here.
//
//   ours            unit   written as (in any case, with blanks, hyphens or underscores)
//   time            s      ET, RUNTIME, Zeit
//   Vx              m/s    V, LONGVEL, velocity, Geschwindigkeit; also speed
//   omega           rad/s  N, WHROTSPD, Drehzahl; also wheel_speed
//   alpha           rad    SA, SLIPANGL, slip angle, Schräglaufwinkel
//   gamma           rad    IA, INCLANGL, inclination angle, Sturz; also camber
//   kappa           1      SR, LONGSLIP, slip ratio, Schlupf
//   phit            1/m    turn slip
//   p               Pa     P, INFLPRES, inflation pressure, Reifendruck; also pressure
//   loaded_radius   m      RL, DSTGRWHC, R_l
//   R_e             m      RE
//   tread, tread_inner, tread_center, tread_outer   K   TRDTEMP, TSTI, TSTC, TSTO
//   road, ambient   K      RST, TRCKTEMP; AMBTMP, AMBITEMP
//   Fx ... Mz       N, N m FX ... MZ, FXW ... MZC, lateral force, Seitenkraft, Radlast ...
//   dx, dy, dz      m      lateral displacement ...
//
// Some words are channels of their own in one test and a channel of this table in another: the
// camber of a suspension, the inclination of a tire. Such a word keeps its name and is found under
// the other name, too ("also" above).
//
// A name may end in a unit, in brackets or behind an underscore ("Alpha (deg)", "Fz[N]", "p_kPa"),
// or in a wheel ("Fz_FL", "FZ_L"), or, a force, in its frame ("FYW"). SL, the slip of the loaded
// radius, is no kappa and keeps its name, as every unknown name does.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// A channel of which the program knows the dimension and the meaning.
struct ChannelMeaning {
  std::string_view name, unit;  // ours; SI
  std::string_view words;       // "slip angle"
};
/// By our name, without frame and wheel; nullptr where it is not known.
const ChannelMeaning* find_meaning(std::string_view name);

struct RecognizedName {
  const ChannelMeaning* meaning = nullptr;  // never null
  std::string channel;      // ours, with the frame or wheel: "alpha", "FyW", "Fz_FL"
  std::string unit;         // that ends the name: "deg"; empty: none does
  bool keeps_name = false;  // a channel of its own elsewhere, as camber is
};
/// The channel a written name stands for; nothing where the name is not known. Whether the unit of
/// its values fits is for the caller to check.
std::optional<RecognizedName> recognized(std::string_view written);

/// Whether two names mean one channel: the same name, or two spellings of one.
bool same_channel(std::string_view a, std::string_view b);

/// The spellings of a channel that are known, for messages: `alpha, SA, SLIPANGL ...`.
std::string spellings_of(std::string_view channel);

/// Of the names in a file, those that look like a channel without being recognized as any: a typo
/// ("Alhpa"), a word with an addition ("alpha_corrected", "FZ tire"). The most alike comes first.
std::vector<std::string> look_like(std::string_view channel, const std::vector<std::string>& names);

}  // namespace latsch
