// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/channel_words.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"
#include "base/units.h"

namespace latsch {
namespace {

constexpr std::array kMeanings = {
    ChannelMeaning{"time", "s", "time"},
    ChannelMeaning{"Vx", "m/s", "longitudinal velocity"},
    ChannelMeaning{"Vy", "m/s", "lateral velocity"},
    ChannelMeaning{"omega", "rad/s", "rotational speed of the wheel"},
    ChannelMeaning{"alpha", "rad", "slip angle"},
    ChannelMeaning{"gamma", "rad", "inclination angle"},
    ChannelMeaning{"kappa", "1", "longitudinal slip"},
    ChannelMeaning{"phit", "1/m", "turn slip"},
    ChannelMeaning{"p", "Pa", "inflation pressure"},
    ChannelMeaning{"loaded_radius", "m", "loaded radius"},
    ChannelMeaning{"R_e", "m", "effective rolling radius"},
    ChannelMeaning{"deflection", "m", "deflection"},
    ChannelMeaning{"tread", "K", "temperature of the tread"},
    ChannelMeaning{"tread_inner", "K", "temperature of the tread, inner"},
    ChannelMeaning{"tread_center", "K", "temperature of the tread, middle"},
    ChannelMeaning{"tread_outer", "K", "temperature of the tread, outer"},
    ChannelMeaning{"road", "K", "temperature of the road"},
    ChannelMeaning{"ambient", "K", "ambient temperature"},
    ChannelMeaning{"Fx", "N", "longitudinal force"},
    ChannelMeaning{"Fy", "N", "lateral force"},
    ChannelMeaning{"Fz", "N", "vertical load"},
    ChannelMeaning{"Mx", "N m", "overturning moment"},
    ChannelMeaning{"My", "N m", "rolling resistance moment"},
    ChannelMeaning{"Mz", "N m", "aligning moment"},
    ChannelMeaning{"dx", "m", "longitudinal displacement"},
    ChannelMeaning{"dy", "m", "lateral displacement"},
    ChannelMeaning{"dz", "m", "vertical displacement"},
    ChannelMeaning{"toe", "rad", "toe angle"},
    ChannelMeaning{"camber", "rad", "camber of a suspension"},
    ChannelMeaning{"caster", "rad", "caster angle"},
    ChannelMeaning{"steer", "rad", "steer angle"},
    ChannelMeaning{"travel", "m", "wheel travel"},
    ChannelMeaning{"rack", "m", "displacement of the rack"},
    ChannelMeaning{"frequency", "Hz", "frequency"},
    ChannelMeaning{"SL", "1", "slip of the loaded radius"},
    ChannelMeaning{"NFX", "1", "longitudinal force over load"},
    ChannelMeaning{"NFY", "1", "lateral force over load"},
};

/// A spelling of a channel's name, in lower case without blanks and signs, and the channel.
struct Spelling {
  std::string_view written, channel;
  bool keeps_name = false;
};

constexpr std::array kSpellings = {
    Spelling{"et", "time"},
    Spelling{"runtime", "time"},
    Spelling{"elapsedtime", "time"},
    Spelling{"zeit", "time"},
    Spelling{"messzeit", "time"},
    Spelling{"t", "time"},
    Spelling{"v", "Vx"},
    Spelling{"longvel", "Vx"},
    Spelling{"vlong", "Vx"},
    Spelling{"velocity", "Vx", true},
    Spelling{"speed", "Vx", true},
    Spelling{"longitudinalvelocity", "Vx"},
    Spelling{"longitudinalspeed", "Vx"},
    Spelling{"forwardvelocity", "Vx"},
    Spelling{"roadspeed", "Vx", true},
    Spelling{"beltspeed", "Vx", true},
    Spelling{"geschwindigkeit", "Vx"},
    Spelling{"fahrgeschwindigkeit", "Vx"},
    Spelling{"laengsgeschwindigkeit", "Vx"},
    Spelling{"n", "omega"},
    Spelling{"whrotspd", "omega"},
    Spelling{"wheelspeed", "omega", true},
    Spelling{"rotationalspeed", "omega"},
    Spelling{"angularvelocity", "omega"},
    Spelling{"drehzahl", "omega"},
    Spelling{"raddrehzahl", "omega"},
    Spelling{"sa", "alpha"},
    Spelling{"slipangl", "alpha"},
    Spelling{"slipangle", "alpha"},
    Spelling{"sideslipangle", "alpha"},
    Spelling{"lateralslipangle", "alpha"},
    Spelling{"schraeglaufwinkel", "alpha"},
    Spelling{"schraglaufwinkel", "alpha"},
    Spelling{"schraeglauf", "alpha"},
    Spelling{"ia", "gamma"},
    Spelling{"inclangl", "gamma"},
    Spelling{"inclinationangle", "gamma"},
    Spelling{"inclination", "gamma"},
    Spelling{"camberangle", "gamma"},
    Spelling{"camber", "gamma", true},
    Spelling{"sturz", "gamma"},
    Spelling{"sturzwinkel", "gamma"},
    Spelling{"radsturz", "gamma"},
    Spelling{"sr", "kappa"},
    Spelling{"longslip", "kappa"},
    Spelling{"slipratio", "kappa"},
    Spelling{"longitudinalslip", "kappa"},
    Spelling{"longitudinalslipratio", "kappa"},
    Spelling{"laengsschlupf", "kappa"},
    Spelling{"umfangsschlupf", "kappa"},
    Spelling{"schlupf", "kappa"},
    Spelling{"turnslip", "phit"},
    Spelling{"phit", "phit"},
    Spelling{"p", "p"},
    Spelling{"inflpres", "p"},
    Spelling{"inflationpressure", "p"},
    Spelling{"inflationpress", "p"},
    Spelling{"pressure", "p", true},
    Spelling{"tirepressure", "p"},
    Spelling{"tyrepressure", "p"},
    Spelling{"druck", "p"},
    Spelling{"luftdruck", "p"},
    Spelling{"fuelldruck", "p"},
    Spelling{"innendruck", "p"},
    Spelling{"reifendruck", "p"},
    Spelling{"reifeninnendruck", "p"},
    Spelling{"reifenfuelldruck", "p"},
    Spelling{"rl", "loaded_radius"},
    Spelling{"dstgrwhc", "loaded_radius"},
    Spelling{"loadedradius", "loaded_radius"},
    Spelling{"statischerhalbmesser", "loaded_radius"},
    Spelling{"re", "R_e"},
    Spelling{"effectiveradius", "R_e"},
    Spelling{"effectiverollingradius", "R_e"},
    Spelling{"rollingradius", "R_e"},
    Spelling{"rollradius", "R_e"},
    Spelling{"einfederung", "deflection"},
    Spelling{"radialdeflection", "deflection"},
    Spelling{"verticaldeflection", "deflection"},
    Spelling{"trdtemp", "tread"},
    Spelling{"treadtemperature", "tread"},
    Spelling{"laufflaechentemperatur", "tread"},
    Spelling{"tsti", "tread_inner"},
    Spelling{"tstc", "tread_center"},
    Spelling{"tsto", "tread_outer"},
    Spelling{"rst", "road"},
    Spelling{"trcktemp", "road"},
    Spelling{"roadtemperature", "road"},
    Spelling{"ambtmp", "ambient"},
    Spelling{"ambitemp", "ambient"},
    Spelling{"ambienttemperature", "ambient"},
    Spelling{"umgebungstemperatur", "ambient"},
    Spelling{"longitudinalforce", "Fx"},
    Spelling{"laengskraft", "Fx"},
    Spelling{"umfangskraft", "Fx"},
    Spelling{"lateralforce", "Fy"},
    Spelling{"sideforce", "Fy"},
    Spelling{"corneringforce", "Fy"},
    Spelling{"seitenkraft", "Fy"},
    Spelling{"querkraft", "Fy"},
    Spelling{"verticalforce", "Fz"},
    Spelling{"verticalload", "Fz"},
    Spelling{"normalforce", "Fz"},
    Spelling{"normalload", "Fz"},
    Spelling{"wheelload", "Fz"},
    Spelling{"tireload", "Fz"},
    Spelling{"tyreload", "Fz"},
    Spelling{"load", "Fz", true},
    Spelling{"radlast", "Fz"},
    Spelling{"aufstandskraft", "Fz"},
    Spelling{"vertikalkraft", "Fz"},
    Spelling{"normalkraft", "Fz"},
    Spelling{"overturningmoment", "Mx"},
    Spelling{"overturningtorque", "Mx"},
    Spelling{"kippmoment", "Mx"},
    Spelling{"sturzmoment", "Mx"},
    Spelling{"rollingresistancemoment", "My"},
    Spelling{"rollingresistancetorque", "My"},
    Spelling{"rollwiderstandsmoment", "My"},
    Spelling{"aligningmoment", "Mz"},
    Spelling{"aligningtorque", "Mz"},
    Spelling{"selfaligningmoment", "Mz"},
    Spelling{"selfaligningtorque", "Mz"},
    Spelling{"rueckstellmoment", "Mz"},
    Spelling{"longitudinaldisplacement", "dx"},
    Spelling{"lateraldisplacement", "dy"},
    Spelling{"verticaldisplacement", "dz"},
    Spelling{"toeangle", "toe"},
    Spelling{"spurwinkel", "toe"},
    Spelling{"vorspur", "toe"},
    Spelling{"casterangle", "caster"},
    Spelling{"castor", "caster"},
    Spelling{"steerangle", "steer"},
    Spelling{"steeringangle", "steer"},
    Spelling{"lenkwinkel", "steer"},
    Spelling{"wheeltravel", "travel"},
    Spelling{"radhub", "travel"},
    Spelling{"frequenz", "frequency"},
    Spelling{"eigenfrequenz", "frequency"},
};

bool is_plain_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

/// Returns the text in lower case with umlauts and Greek letters as words and all other characters
/// removed: "Schräglauf-Winkel" becomes "schraeglaufwinkel".
std::string folded(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kLetters = {
      {{"ä", "ae"},
       {"ö", "oe"},
       {"ü", "ue"},
       {"Ä", "ae"},
       {"Ö", "oe"},
       {"Ü", "ue"},
       {"ß", "ss"},
       {"α", "alpha"},
       {"γ", "gamma"},
       {"κ", "kappa"},
       {"ω", "omega"},
       {"Α", "alpha"},
       {"Γ", "gamma"},
       {"Κ", "kappa"},
       {"Ω", "omega"}}};
  std::string result;
  while (!text.empty()) {
    const bool is_ascii = static_cast<unsigned char>(text.front()) < 0x80;
    const auto letter = is_ascii
                            ? kLetters.end()
                            : std::find_if(kLetters.begin(), kLetters.end(), [&](const auto& one) {
                                return text.starts_with(one.first);
                              });
    if (letter != kLetters.end()) {
      result += letter->second;
      text.remove_prefix(letter->first.size());
      continue;
    }
    char c = text.front();
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (is_plain_letter(c)) result += c;
    text.remove_prefix(1);
  }
  return result;
}

/// Returns the length in bytes of a character that a name may contain without another meaning: a
/// letter, a digit, a mark between words; 0 for any other. An operator changes the quantity: "-SA",
/// "|SA|", "ΔSA" and "Fy/Fz" are not what they contain.
std::size_t plain_character(std::string_view text) {
  constexpr std::array<std::string_view, 21> kOthers = {
      "ä", "ö", "ü", "Ä", "Ö",      "Ü",      "ß",      "α",      "γ",      "κ",     "ω",
      "Α", "Γ", "Κ", "Ω", "\u00a0", "\u0308", "\u2010", "\u2011", "\u202f", "\ufeff"};
  const char c = text.front();
  const bool is_capital = c >= 'A' && c <= 'Z';
  if (is_capital || is_plain_letter(c) ||
      std::string_view(" \t-_.:{}\\$\"").find(c) != std::string_view::npos)
    return 1;
  for (const std::string_view other : kOthers)
    if (text.starts_with(other)) return other.size();
  return 0;
}

/// True for a name without operators; a name may not begin with a mark between words such as "-".
bool is_plain_name(std::string_view text) {
  if (text.starts_with('-')) return false;
  while (!text.empty()) {
    const std::size_t size = plain_character(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

/// Turns "fyw" into "FyW"; returns "" if the word is no force or moment.
std::string force_of(const std::string& word) {
  const auto among = [&](std::size_t i, std::string_view letters) {
    return letters.find(word[i]) != letters.npos;
  };
  const bool is_framed = word.size() == 3 && among(2, "whc");
  if (!(word.size() == 2 || is_framed) || !among(0, "fm") || !among(1, "xyz")) return "";
  std::string name = word;
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}})
    if (i < name.size()) name[i] = static_cast<char>(name[i] - 'a' + 'A');
  return name;
}

/// Recognizes a whole word after unit and wheel have been removed from it.
std::optional<RecognizedName> word(std::string_view text) {
  const std::string key = folded(text);
  if (key.empty() || !is_plain_name(trimmed(text))) return std::nullopt;
  const bool is_our_own = find_meaning(text) != nullptr;
  for (const Spelling& spelling : kSpellings)
    if (spelling.written == key)
      return RecognizedName{find_meaning(spelling.channel),
                            std::string(spelling.channel),
                            "",
                            spelling.keeps_name || (is_our_own && text != spelling.channel)};
  if (const std::string force = force_of(key); !force.empty())
    return RecognizedName{find_meaning(force.substr(0, 2)), force, ""};
  static const std::vector<std::string> kFolded = [] {
    std::vector<std::string> names;
    for (const ChannelMeaning& meaning : kMeanings) names.push_back(folded(meaning.name));
    return names;
  }();
  for (std::size_t i = 0; i < kMeanings.size(); ++i)
    if (kFolded[i] == key) return RecognizedName{&kMeanings[i], std::string(kMeanings[i].name), ""};
  return std::nullopt;
}

/// Splits a name with a unit in brackets: "Alpha (deg)" into "Alpha" and "deg".
std::pair<std::string_view, std::string_view> split_brackets(std::string_view text) {
  text = trimmed(text);
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t at = text.ends_with(close) ? text.rfind(open) : text.npos;
    if (at != text.npos && at > 0)
      return {trimmed(text.substr(0, at)), trimmed(text.substr(at + 1, text.size() - at - 2))};
  }
  return {text, {}};
}

std::string without_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// Returns the unit written in a piece of a name if it has the dimension of `meaning`.
std::string unit_of(std::string_view piece, const ChannelMeaning& meaning) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kWritten = {
      {{"kmh", "km/h"},
       {"kph", "km/h"},
       {"mps", "m/s"},
       {"c", "degC"},
       {"nm", "N m"},
       {"rpm", "rpm"}}};
  const Unit expected = Unit::of(meaning.unit);
  std::string text(piece);
  for (const auto& [written, unit] : kWritten)
    if (without_case(piece) == written && Unit::of(unit).same_dimension(expected)) text = unit;
  for (const std::string_view usual :
       {"deg", "rad", "N", "kN", "Pa", "kPa", "bar", "psi", "mm", "m", "s", "ms", "K", "degC"})
    if (without_case(piece) == without_case(usual)) text = usual;
  const auto unit = Unit::find(text);
  return unit && !unit->dimensionless() && unit->same_dimension(expected) ? text : "";
}

bool is_wheel(std::string_view piece) {
  const std::string word = without_case(piece);
  return word == "l" || word == "r" || word == "fl" || word == "fr" || word == "rl" || word == "rr";
}

}  // namespace

const ChannelMeaning* find_meaning(std::string_view name) {
  const auto found = std::find_if(
      kMeanings.begin(), kMeanings.end(), [&](const auto& one) { return one.name == name; });
  return found == kMeanings.end() ? nullptr : &*found;
}

std::optional<RecognizedName> recognized(std::string_view written) {
  const auto [base, unit] = split_brackets(written);
  if (auto found = word(base)) {
    found->unit = unit;
    return found;
  }
  const std::size_t at = base.find_last_of("_ ");
  if (at == base.npos || at == 0) return std::nullopt;
  const std::string_view piece = base.substr(at + 1);
  auto found = word(base.substr(0, at));
  if (!found) return std::nullopt;
  if (is_wheel(piece)) {
    std::string wheel(piece);
    for (char& c : wheel)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    found->channel += "_" + wheel;
    found->unit = unit;
    return found;
  }
  found->unit = unit_of(piece, *found->meaning);
  if (found->unit.empty()) return std::nullopt;
  return found;
}

std::vector<std::string> channel_names() {
  std::vector<std::string> names;
  for (const ChannelMeaning& meaning : kMeanings) names.emplace_back(meaning.name);
  return names;
}

bool same_channel(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const auto one = recognized(a), other = recognized(b);
  return one && other && one->channel == other->channel;
}

std::string spellings_of(std::string_view channel) {
  constexpr std::size_t kMost = 5;
  std::string text(channel);
  std::size_t count = 1;
  for (const Spelling& spelling : kSpellings) {
    if (spelling.channel != channel || spelling.written == channel || ++count > kMost) continue;
    std::string capital(spelling.written);
    const bool is_code = capital.size() <= 2 || capital.size() == 8;
    for (char& c : capital)
      if (is_code && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    text += ", " + capital;
  }
  return count > kMost ? text + " ..." : text;
}

std::vector<std::string> look_like(std::string_view channel,
                                   const std::vector<std::string>& names) {
  constexpr int kMostEdits = 2;
  std::vector<std::string> spellings = {folded(channel)};
  for (const Spelling& spelling : kSpellings)
    if (spelling.channel == channel) spellings.emplace_back(spelling.written);
  std::vector<std::pair<int, std::string>> alike;
  for (const std::string& name : names) {
    // the name is recognized as another channel, or as one that was found before
    if (recognized(name)) continue;
    const std::string key = folded(split_brackets(name).first);
    int best = kMostEdits + 2;
    for (const std::string& spelling : spellings) {
      // Short codes such as SA and SR differ by one letter, so only longer spellings are compared.
      if (spelling.size() >= 5 && key.size() >= 4) {
        const int allowed = spelling.size() >= 8 ? kMostEdits : 1 + (spelling.size() > 4);
        const int edits = edit_distance(key, spelling);
        if (edits <= std::min(allowed, kMostEdits)) best = std::min(best, edits);
      }
      const std::size_t begin = std::min(name.find_first_not_of("_ -./(["), name.size());
      const std::size_t end = name.find_first_of("_ -./([", begin);
      const std::string first = folded(name.substr(begin, end - begin));
      if (first == spelling && first.size() >= 2) best = std::min(best, kMostEdits + 1);
    }
    if (best <= kMostEdits + 1) alike.emplace_back(best, name);
  }
  std::stable_sort(
      alike.begin(), alike.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> result;
  for (auto& [edits, name] : alike) result.push_back(std::move(name));
  return result;
}

}  // namespace latsch
