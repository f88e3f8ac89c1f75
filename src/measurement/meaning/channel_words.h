// SPDX-License-Identifier: Apache-2.0
// The vocabulary of channels: the spellings of laboratories and our name for each channel. Every
// reader and every test looks names up here.
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
// Some words are a channel of their own in one test and a channel of this table in another:
// "camber" is that of a suspension, or the inclination of a tire. Such a word keeps its name and is
// also found under the other name ("also" above).
//
// A name may end in a unit, in brackets or behind an underscore ("Alpha (deg)", "Fz[N]", "p_kPa"),
// in a wheel ("Fz_FL", "FZ_L") or, for a force, in its frame ("FYW"). SL, the slip of the loaded
// radius, is no kappa and keeps its name, as every unknown name does. A name with an operator is
// not known: "-SA", "|SA|", "ΔSA" and "Fy/Fz" are other quantities than those that they contain.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// A channel whose dimension and meaning the program knows.
struct ChannelMeaning {
  std::string_view name, unit;  // our name; SI unit
  std::string_view words;       // "slip angle"
};
/// Finds the meaning of a channel by Latsch's name, without frame and wheel; nullptr if the name is
/// not known.
const ChannelMeaning* find_meaning(std::string_view name);

struct RecognizedName {
  const ChannelMeaning* meaning = nullptr;  // never null
  std::string channel;                      // our name with frame or wheel: "alpha", "FyW", "Fz_FL"
  std::string unit;         // unit at the end of the name, such as "deg"; empty: none
  bool keeps_name = false;  // this spelling is another channel elsewhere, as is camber
};
/// Returns the channel a written name means; nothing if the name is not known. The caller has to
/// check that the unit of the values fits.
std::optional<RecognizedName> recognized(std::string_view written);

/// Returns our names of all channels of the vocabulary, without frames and wheels.
std::vector<std::string> channel_names();

/// True if two names mean the same channel: equal names, or two spellings of one channel.
bool same_channel(std::string_view a, std::string_view b);

/// Returns the known spellings of a channel, for messages: `alpha, SA, SLIPANGL ...`.
std::string spellings_of(std::string_view channel);

/// Returns those names in a file that resemble a channel without being recognized as any: a typing
/// error ("Alhpa"), a word with an addition ("alpha_corrected", "FZ tire"). The most similar one
/// comes first.
std::vector<std::string> look_like(std::string_view channel, const std::vector<std::string>& names);

}  // namespace latsch
