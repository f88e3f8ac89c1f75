// SPDX-License-Identifier: Apache-2.0
// For tests: samples of every kind of test, which together contain every key of the test, with the
// files they name. A kind without a sample, or a key in no sample, fails
// identity_of_tests_test.cpp.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace latsch::experiment {

struct TestSample {
  std::string keys;                                // TOML, including the kind
  std::map<std::string, std::string> others = {};  // path -> another text, if the key has no
                                                   // choices
};

/// Two files with different content.
struct SampleFile {
  std::string name, text, other;
};

/// Four posts that move in every mode at all frequencies up to 50 Hz: heights drawn for each of
/// them. `last`: mm, added to the last height.
inline std::string heights_of_posts(double last) {
  std::string text = "time [s],post_FL [mm],post_FR [mm],post_RL [mm],post_RR [mm]\n";
  constexpr int kSamples = 401;
  unsigned drawn = 1;
  for (int i = 0; i < kSamples; ++i) {
    text += std::to_string(0.01 * i);
    for (int post = 0; post < 4; ++post) {
      drawn = drawn * 1664525u + 1013904223u;
      const double height = static_cast<double>(drawn >> 16) / 65536.0;
      text += "," + std::to_string(height + (i + 1 == kSamples && post == 3 ? last : 0.0));
    }
    text += "\n";
  }
  return text;
}

inline const std::vector<SampleFile>& sample_files() {
  static const std::string crg =
      "$ROAD_CRG\nreference_line_increment = 1\n$\n$KD_DEFINITION\n#:LRFI\n"
      "D:long section at v = -1,m\nD:long section at v = 1,m\n$\n$$$$\n"
      " 0.1000000 0.1000000\n 0.2000000 0.";
  static const std::vector<SampleFile> files = {
      {"states.csv",
       "time [s],Fz [N],alpha [deg]\n0,4000,5\n0.1,4000,-4\n",
       "time [s],Fz [N],alpha [deg]\n0,4000,5\n0.1,4000,-4.1\n"},
      {"heights.csv", heights_of_posts(0.0), heights_of_posts(0.1)},
      {"surface.crg", crg + "2000000\n", crg + "3000000\n"},
      {"track.crg", "$ROAD_CRG_FILE\n surface.crg\n$\n", ""},
      {"track.rdf",
       "[MDI_HEADER]\n FILE_TYPE = 'rdf'\n FILE_VERSION = 5.00\n FILE_FORMAT = 'ASCII'\n"
       "[UNITS]\n LENGTH = 'meter'\n FORCE = 'newton'\n ANGLE = 'radian'\n MASS = 'kg'\n"
       " TIME = 'sec'\n[MODEL]\n METHOD = '2D'\n ROAD_TYPE = 'plank'\n[PARAMETERS]\n"
       " HEIGHT = 0.02\n START = 1.0\n LENGTH = 0.5\n BEVEL_EDGE_LENGTH = 0.0\n MU = 1.0\n "
       "DIRECTION = 0.0\n",
       "[MDI_HEADER]\n FILE_TYPE = 'rdf'\n FILE_VERSION = 5.00\n FILE_FORMAT = 'ASCII'\n"
       "[UNITS]\n LENGTH = 'meter'\n FORCE = 'newton'\n ANGLE = 'radian'\n MASS = 'kg'\n"
       " TIME = 'sec'\n[MODEL]\n METHOD = '2D'\n ROAD_TYPE = 'plank'\n[PARAMETERS]\n"
       " HEIGHT = 0.03\n START = 1.0\n LENGTH = 0.5\n BEVEL_EDGE_LENGTH = 0.0\n MU = 1.0\n "
       "DIRECTION = 0.0\n"},
      {"track.toml", "kind = \"flat\"\nfriction = 0.9\n", "kind = \"flat\"\nfriction = 0.8\n"},
  };
  return files;
}

inline const std::vector<TestSample>& test_samples() {
  static const std::string drum =
      "kind = \"drum_cleat\"\nspeed = \"36 km/h\"\npressure = \"2.2 bar\"\ncamber = \"1 deg\"\n"
      "drum_diameter = \"2 m\"\nwheel_inertia = \"1.2 kg m^2\"\nrun_in = \"0.1 s\"\n"
      "duration = \"0.2 s\"\nlead = \"0.05 s\"\nstep = \"0.5 ms\"\nsample_step = \"1 ms\"\n"
      "passages = 2\nwheel_step = \"10 deg\"\nwheel_start = \"5 deg\"\nframe = [\"C\", \"W\"]\n";
  static const std::string cleat =
      "[cleat]\nheight = \"10 mm\"\nlength = \"30 mm\"\nbevel = \"2 mm\"\nangle = \"10 deg\"\n";
  static const std::string sweep =
      "kind = \"slip_sweep\"\nspeed = \"20 m/s\"\nload = \"4 kN\"\npressure = \"2.2 bar\"\n"
      "camber = \"1 deg\"\naxle = \"load\"\nframe = [\"W\"]\nrun_in = \"0.2 s\"\n"
      "duration = \"0.4 s\"\nstep = \"0.5 ms\"\nsample_step = \"1 ms\"\n";
  static const std::string six =
      "Fx = [\"0 N\", \"100 N\"]\nFy = [\"0 N\", \"200 N\"]\nFz = [\"1 kN\", \"2 kN\"]\n"
      "Mx = \"10 N m\"\nMy = \"20 N m\"\nMz = \"30 N m\"\n";
  static const std::string kinematics =
      "kind = \"kinematics\"\nmode = \"opposed\"\n"
      "at = \"wheel_center\"\nrates = true\nanti_roll_bar = true\nouter_share = 0.6\n"
      "axle = \"rear\"\nwheelbase = \"1.5 m\"\ncg_height = \"0.3 m\"\nbrake_share = 0.6\n"
      "drive_share = 0.1\nbrakes = \"inboard\"\nrack_per_turn = \"85 mm\"\n";
  static const std::string posts =
      "kind = \"four_post\"\nmode = \"pitch\"\nstep = \"0.2 ms\"\nsample_step = \"1 ms\"\n"
      "spectra = true\nsegment = \"1 s\"\nband = [\"2 Hz\", \"20 Hz\"]\n";
  static const std::string kerb_run =
      "kind = \"kerb\"\nspeed = \"20 m/s\"\nline = \"10 mm\"\nrun_in = \"0.1 s\"\n"
      "duration = \"0.2 s\"\nstep = \"0.2 ms\"\nsample_step = \"1 ms\"\narea = true\n";
  static const std::string loaders =
      "[loaders]\npoints = [[\"2 m\", \"0.4 m\"], [\"2 m\", \"-0.4 m\"], [\"-0.2 m\", \"0 m\"]]\n";
  static const std::string placed =
      "[road]\nstart = [\"1 m\", \"0.1 m\"]\nheading = \"5 deg\"\nbeyond_edge = \"continue\"\n";
  static const auto kerb = [](const std::string& shape) {
    return "[kerb]\nkind = \"kerb\"\n" + shape +
           "pitch = \"800 mm\"\nwidth = \"600 mm\"\nheight = \"25 mm\"\ncount = 6\n"
           "ramp = \"50 mm\"\nstart = [\"0 m\", \"0.4 m\"]\nangle = \"2 deg\"\nfriction = 0.9\n"
           "obstacle_friction = 0.8\n";
  };
  static const std::string axle =
      "kind = \"axle_kc\"\naxle = \"front\"\nsprings = \"locked\"\nat = \"wheel_center\"\n"
      "rack = [\"1 mm\", \"2 mm\"]\n";
  static const auto of_wheel = [](const std::string& side) {
    return "Fx" + side + " = [\"0 N\", \"100 N\"]\nFy" + side + " = \"20 N\"\nFz" + side +
           " = [\"1 kN\", \"2 kN\"]\nMx" + side + " = \"10 N m\"\nMy" + side + " = \"20 N m\"\nMz" +
           side + " = \"30 N m\"\ntravel" + side + " = [\"1 mm\", \"2 mm\"]\n";
  };
  static const std::map<std::string, std::string> frames = {{"frame", "[\"H\"]"}};
  static const std::vector<TestSample> samples = {
      {drum + "load = \"4 kN\"\n" + cleat, frames},
      {drum + "deflection = \"15 mm\"\n" + cleat, frames},
      {sweep + "alpha = [\"-6 deg\", \"6 deg\"]\n", frames},
      {sweep + "kappa = [-0.1, 0.1]\n", frames},
      {"kind = \"rolling_stiffness\"\nload = \"4 kN\"\nspeed = \"20 m/s\"\npressure = \"2 bar\"\n"
       "slip = 0.004\nangle = \"0.2 deg\"\ncamber = \"1 deg\"\nstep = \"0.4 ms\"\n"
       "measures = [\"slip\", \"camber\"]\n",
       {{"measures", "[\"slip\"]"}}},
      {"kind = \"uniformity\"\nload = \"4 kN\"\npressure = \"2 bar\"\ndrum_diameter = \"0.85 m\"\n"
       "speed = \"5 m/s\"\nwheel_inertia = \"1.2 kg m^2\"\nharmonics = 8\nstep = \"1 ms\"\n"},
      {"kind = \"static_stiffness\"\ndeflections = [\"5 mm\", \"10 mm\"]\npressure = \"2 bar\"\n"
       "friction = 0.8\ntravel = \"2 mm\"\ntwist = \"0.2 deg\"\n" +
       cleat},
      {"kind = \"static_stiffness\"\nload = \"4 kN\"\ndirections = [\"vertical\", \"lateral\"]\n"
       "camber = \"1 deg\"\n",
       {{"directions", "[\"vertical\"]"}}},
      {"kind = \"footprint\"\nloads = [\"2 kN\", \"4 kN\"]\ncamber = \"1 deg\"\n"
       "pressure = \"2 bar\"\nfriction = 0.8\nsensor = \"10 mm\"\n"
       "sensors = [[\"1 mm\", \"2 mm\"], [\"3 mm\", \"4 mm\"]]\nelements = [\"7 mm\", \"8 mm\"]\n"},
      {"kind = \"footprint\"\ndeflections = [\"5 mm\", \"10 mm\"]\n"},
      {"kind = \"modes\"\npressure = \"2 bar\"\nfriction = 0.8\nload = \"4 kN\"\n"
       "camber = \"1 deg\"\ncount = 9\npoints = [[\"0 m\", \"50 mm\", \"310 mm\"]]\n"},
      {"kind = \"modes\"\ndeflection = \"15 mm\"\n"},
      {"kind = \"steady_states\"\nstates = \"states.csv\"\nlimits = \"off\"\n"
       "angles = \"tangent\"\nturn_slip = \"on\"\nside = \"other\"\n"},
      {"kind = \"slip_history\"\nstates = \"states.csv\"\n"},
      {"kind = \"load_deflection\"\npressure = \"2 bar\"\nfriction = 0.8\n"
       "deflections = [\"5 mm\", \"10 mm\"]\n"},
      {"kind = \"load_deflection\"\nloaded_radii = [\"310 mm\", \"300 mm\"]\n"},
      {"kind = \"kc\"\nat = \"wheel_center\"\nslopes_by = \"Fz\"\nwindow = [\"-5 kN\", \"5 "
       "kN\"]\n" +
       six},
      {"kind = \"kc\"\nloads = {from = \"measurement.rig\"}\n"},
      {kinematics +
       "rack = [\"0 mm\", \"1 mm\", \"2 mm\"]\ntravel = [\"-30 mm\", \"0 mm\", \"30 mm\"]\n"},
      {kinematics + "rack = \"1 mm\"\nfrom = \"-30 mm\"\nto = \"30 mm\"\npoints = 3\n"},
      {posts + "from = \"1 Hz\"\nto = \"25 Hz\"\nduration = \"4 s\"\namplitude = \"3 mm\"\n"
               "velocity = \"0.1 m/s\"\n"},
      {posts + "posts = \"heights.csv\"\n"},
      {kerb_run + "[wander]\nspeed = \"0.5 m/s\"\nline = \"20 mm\"\nperiod = \"1 s\"\nseed = 2\n" +
       kerb("shape = \"sine\"\n") + loaders + "downforce = [\"1 kN\", \"1 kN\", \"2 kN\"]\n"},
      {kerb_run + kerb("shape = \"block\"\nlength = \"400 mm\"\nbevel = \"10 mm\"\n")},
      {kerb_run + loaders +
       "pushrods = {from = \"measurement.rig\"}\nstretch = [\"0 s\", \"0.05 s\"]\n"},
      {kerb_run + placed + "file = \"track.crg\"\n"},
      {kerb_run + placed + "file = \"track.rdf\"\n"},
      {kerb_run + placed + "file = \"track.toml\"\n"},
      {axle +
       "mode = \"opposed\"\ntravel = \"3 mm\"\nslopes_by = \"Fz\"\n"
       "window = [\"-5 kN\", \"5 kN\"]\n" +
       six},
      {axle + of_wheel("_L") + of_wheel("_R")},
      {"kind = \"axle_kc\"\naxle = \"rear\"\nloads = {from = \"measurement.rig\"}\n"},
      {"kind = \"mass_properties\"\npressure = \"2 bar\"\n"},
      {"kind = \"inflation\"\npressures = [\"1 bar\", \"2 bar\"]\n"},
  };
  return samples;
}

}  // namespace latsch::experiment
