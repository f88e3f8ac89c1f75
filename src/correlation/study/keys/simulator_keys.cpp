// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& simulator_keys() {
  static const experiment::KeySection section = {
      .heading = "[simulator]: an outside program in the model's place",
      .below = "simulator",
      .about = R"md(
[simulator] in a study, in place of `model`: an outside program evaluates the points. A variable
of such a study has no path; its unit is that of `initial`, or the key `unit`.
)md",
      .sentences =
          {
              {"command",
               "Program and its arguments; `{study}` is the folder of the study, `{latsch}` this "
               "program."},
              {"inputs",
               "Templates beside the study, in which the name of a variable in braces stands for "
               "its value."},
              {"files", "Files that are copied as they are.", "none"},
              {"timeout",
               "Time limit of the program; `[run]` has that of the whole trial.",
               "none"},
              {"keep_failed", "`true`: folders of failed trials stay in STUDY.scratch."},
              {"output", "Tables `[simulator.output.NAME]`: what the program writes."},
              {"output.*.file", "File that the program writes."},
              {"output.*.reader",
               "Form of the file: a table, columns without names, lines with keys, a pattern, or "
               "TYDEX, whose channels and constants are found by their names."},
              {"output.*.quantities",
               "Names with their units. In a table they are names of columns, and the file has the "
               "units."},
              {"output.*.samples", "Number of samples; fewer or more are a failure.", "any number"},
              {"output.*.columns",
               "Positions of the quantities, with the reader \"columns\": `[1, 3]`.",
               "",
               "from 1"},
              {"output.*.keys",
               "Words in front of the values, with the reader \"keys\".",
               "the names of the quantities"},
              {"output.*.pattern",
               "Regular expression with a group for each quantity, with the reader \"pattern\"."},
              {"output.*.after",
               "Text behind which the pattern is searched.",
               "the beginning of the file"},
          },
      .samples =
          {
              R"toml([simulator]
command = ["python3", "{study}/spring.py", "spring.txt"]
inputs = ["spring.txt"]
files = ["force.csv"]
timeout = "30 s"
keep_failed = true
[simulator.output.response]
file = "response.csv"
reader = "table"
quantities = ["time [s]", "z [mm]"]
[simulator.output.tip]
file = "beam.dat"
reader = "pattern"
pattern = '^\s*\d+\s+(\S+)\s+(\S+)\s+(\S+)\s*$'
after = "displacements"
quantities = ["ux [mm]", "uy [mm]", "uz [mm]"]
samples = 1
[simulator.output.sums]
file = "sums.txt"
reader = "columns"
columns = [1, 3]
quantities = ["force [N]", "moment [N m]"]
[simulator.output.totals]
file = "totals.txt"
reader = "keys"
keys = ["k", "c"]
quantities = ["stiffness [N/m]", "damping [N s/m]"]
[simulator.output.sweep]
file = "sweep.tdx"
reader = "tydex"
quantities = ["SLIPANGL [deg]", "FYW [N]"]
[variable.modulus]
lower = "100 GPa"
upper = "300 GPa"
initial = "150 GPa"
[experiment.step]
kind = "curve"
x = "response/time"
y = "response/z"
measurement = "step.csv"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
