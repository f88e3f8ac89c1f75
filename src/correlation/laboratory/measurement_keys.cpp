// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& measurement_keys() {
  static const experiment::KeySection section = {
      .heading = "[measurement.NAME]: what a laboratory recorded",
      .below = "measurement.*",
      .about = R"md(
Recordings of a laboratory, and the choice and processing of their samples. An experiment names a
recording as its measurement, a test takes its conditions from it. Nothing is done that is not
stated.

The steps are done in the order of the keys. Channels have Latsch's names and SI units, in iso axes,
whatever the file calls them: the vocabulary knows SA, SLIPANGL, slip angle and others as alpha.
Signs and ranges of the remaining samples are checked. Every file has a ledger of the meaning of
its columns.

Forces and moments are Fx Fy Fz Mx My Mz; with TYDEX the frame is appended: FyW. Gaps matter only
in channels that something needs.
)md",
      .sentences =
          {
              {"file",
               "File of the recording: .csv .txt .dat .mat .tdx .tda .tdb .uff .unv .mf4 .mdf "
               ".tdms "
               ".rsp .drv .tim .ld."},
              {"files",
               "Several files, one after the other, instead of `file`: `[\"a.dat\", ...]`."},
              {"virtual",
               "Table that says which test of which model `latsch run` records as the file, a "
               ".csv: `{model = \"tire.toml\", test = \"pressed\"}`. A file of other numbers or of "
               "another test is out of date; `latsch run` records it again.",
               "a laboratory has recorded the file"},
              {"virtual.model", "File of the model, of any kind that the test can be done with."},
              {"virtual.test", "Name of a `[test.NAME]` of this study, or the file of a test."},
              {"struct",
               "Struct of a .mat that has the channels, \"run1\" of run1.Fz; or what stands before "
               "the dot in the columns of a .csv.",
               "the only struct with known channels"},
              {"group",
               "Group of a .mf4, .uff, .tdms or .ld whose channels are read; `latsch show FILE` "
               "lists them.",
               "the only group with known channels, else the first one"},
              {"resample",
               "Step of time at which all groups of such a file are joined, linear between "
               "samples, over the time that all of them have; a value beside a gap is a gap.",
               "no joining"},
              {"axes", "Signs of the file.", "\"iso\""},
              {"frame", "Frame of forces and moments whose names omit it."},
              {"columns", "Table of our names and the file's columns."},
              {"columns.*",
               "Name of the column in the file, `Fz = \"LOAD\"`, with a unit where the file states "
               "none, `p = \"P_kPa [kPa]\"`; \"-LOAD\" changes the sign."},
              {"zero", "Table of channels that lose their means of a time or of a state."},
              {"zero.channels", "Channels from which the mean is subtracted."},
              {"zero.time", "Time of the mean: \"0 s .. 2 s\"."},
              {"zero.at",
               "Table of windows of channels that the samples of the mean meet: `{Fy = \"0 N +- 50 "
               "N\"}` for toe and camber of a K&C rig that records them as they are.",
               "all samples of the time"},
              {"zero.at.*", "Window of the channel, as in `select`."},
              {"in_frame",
               "Axes into which forces and moments are turned from those of `frame` or of the "
               "names, by the record's gamma and loaded_radius.",
               "none"},
              {"low_pass",
               "Cut-off frequency of a Butterworth filter of order 2, forward and backward: no "
               "delay, 6 dB down there; stretches between jumps of time are filtered by "
               "themselves.",
               "no filter"},
              {"shift",
               "Time that is added to the time of the file, to get onto that of the test.",
               "0"},
              {"sweep", "Table of channels of which one direction of a sweep is kept."},
              {"sweep.*", "Direction in which the channel moves in the samples that are kept."},
              {"select",
               "Table `[measurement.NAME.select]` of channels: only samples that meet all of these "
               "are kept."},
              {"select.*",
               "Window of the channel: `time = \"30 s ..\"` after the warm-up, `gamma = \"-0.3 .. "
               "0.3 deg\"`, `tread_center = \"50 degC .. 80 degC\"`; or one of several windows, "
               "`Fz = [\"1050 +- 100 N\", \"1610 +- 100 N\"]`."},
              {"every", "Thinning, last of all: 5 keeps every fifth of the samples left.", "1"},
              {"noise",
               "Table `[measurement.NAME.noise]` of channels, for experiments that state no "
               "noise."},
              {"noise.*",
               "Noise of the channel: \"20 N\". A share is \"3 %\" or a number up to 1: 20 without "
               "a unit is refused."},
          },
      .samples =
          {
              R"toml([measurement.cornering]
file = "cornering.csv"
axes = "iso"
frame = "H"
columns = {p = "P_kPa [kPa]"}
zero = {channels = ["Mx"], time = "0 s .. 0.01 s"}
in_frame = "W"
low_pass = "20 Hz"
shift = "-12 ms"
sweep = {alpha = "rising"}
every = 2
[measurement.cornering.select]
time = "0.1 s .."
Fz = ["4000 +- 100 N", "4100 +- 100 N"]
gamma = "-0.3 .. 0.3 deg"
[measurement.cornering.noise]
Fy = "20 N"
Fz = "2 %"
)toml",
              R"toml([measurement.pressed]
files = ["force.csv"]
)toml",
              R"toml([measurement.second]
file = "two_runs.csv"
struct = "run2"
zero = {channels = ["Fz"], at = {Fz = "4 kN .. 4.1 kN"}}
)toml",
              R"toml([measurement.logged]
file = "logged.uff"
group = "time 1"
)toml",
              R"toml([measurement.pressed]
file = "force.csv"
virtual = {model = "model.toml", test = "slow.toml"}
)toml",
              R"toml([measurement.joined]
file = "logged.uff"
resample = "1 ms"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
