// SPDX-License-Identifier: Apache-2.0
// Tests that every channel for which a test claims derivatives has them, for every kind of model
// with derivatives: the choice of a search method relies on this claim.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/language.h"

namespace latsch::experiment {
namespace {

const std::filesystem::path kShippedStudies = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies";

const std::vector<std::string> kTests = {
    "kind = \"load_deflection\"\ndeflections = [\"6 mm\"]\n",
    "kind = \"static_stiffness\"\ndeflections = [\"6 mm\"]\n",
    "kind = \"static_stiffness\"\nload = \"1 kN\"\ndirections = [\"vertical\"]\n",
    "kind = \"footprint\"\nloads = [\"1 kN\"]\nsensors = [[\"0 mm\", \"0 mm\"]]\n",
    "kind = \"footprint\"\ndeflections = [\"6 mm\"]\n",
    "kind = \"modes\"\ncount = 3\n",
    "kind = \"modes\"\ncount = 3\ndeflection = \"6 mm\"\n",
    "kind = \"modes\"\ncount = 3\nload = \"1 kN\"\n",
    "kind = \"mass_properties\"\n",
    "kind = \"inflation\"\npressures = [\"1 bar\", \"2 bar\"]\n",
    "kind = \"inflation\"\n",
    "kind = \"uniformity\"\nload = \"4 kN\"\ndrum_diameter = \"854 mm\"\nstep = \"4 ms\"\n",
    "kind = \"rolling_stiffness\"\nload = \"4 kN\"\nspeed = \"40 km/h\"\n",
    "kind = \"kc\"\nFz = [\"0 N\", \"1 kN\"]\nslopes_by = \"Fz\"\n",
    "kind = \"axle_kc\"\naxle = \"front\"\nFx = [\"0 N\", \"1 kN\"]\n",
    "kind = \"steady_states\"\nstates = \"states.csv\"\n",
};

TEST(ClaimedSlopes, AreTold) {
  const ScratchFolder folder;
  write_text_file(folder / "tire.tir",
                  tir_with_a_belt() + "[CONTACT_PATCH]\nQ_RA1 = 0.9\nQ_RB1 = 1.2\n");
  write_text_file(folder / "states.csv", "Fz [kN],alpha [deg]\n4,2\n4,-2\n");
  struct Model {
    const char* kind;
    std::filesystem::path file;
    std::string path;
  };
  const std::vector<Model> models = {
      {"fe_tire", kShippedStudies / "tires/race_16x7.5-10.toml", "pressure"},
      {"magic_formula", folder / "tire.tir", "VERTICAL_STIFFNESS"},
      {"suspension", kShippedStudies / "kerb/front.toml", "bushing.all.x"},
      {"car", kShippedStudies / "kerb/baseline.toml", "front_suspension.bushing.all.x"},
  };
  int claimed = 0;
  for (const auto& [name, file, path] : models) {
    const SpecimenKind& kind = *language().find_kind(name);
    const Document numbers = kind.read(file);
    if (!kind.knows_slopes_in(path)) ADD_FAILURE() << name << " " << path;
    for (const std::string& text : kTests) {
      write_text_file(folder / "test.toml", text);
      const auto test = language().read_test(folder / "test.toml");
      if (!can(kind, *test)) continue;
      std::vector<std::string> channels;
      bool tells = false;
      for (const ChannelInfo& channel : test->channels()) {
        channels.push_back(channel.name);
        tells = tells || test->tells_slopes(kind, channel.name);
      }
      if (!tells) continue;
      const auto recorded = test->run_with_slopes(*kind.build(numbers), {channels, {path}});
      ASSERT_TRUE(recorded) << name << " " << text << recorded.failure().reason;
      for (const ChannelInfo& info : test->channels()) {
        const Channel* channel = recorded->find(info.name);
        if (!channel || !info.is_compared || !test->tells_slopes(kind, info.name)) continue;
        ++claimed;
        EXPECT_EQ(channel->slopes.size(), channel->values.size())
            << name << " " << text << info.name;
      }
    }
  }
  EXPECT_GT(claimed, 60);
}

}  // namespace
}  // namespace latsch::experiment
