// SPDX-License-Identifier: Apache-2.0
// Feeds a million damaged files to every reader: each must give numbers or an InputError, nothing
// else.
//
//   ./bench.sh fuzz [--inputs N] [--reader NAME] [--first I]
//
// Small good files are damaged by one to four changes each (base/spoiled_text_testing.h), the i-th
// input always in the same way; the result is then used as a program uses it. Every reader runs in
// a separate process with 4 GB of memory. A crash, ten seconds without a result, and any exception
// except InputError are counted and reported with the number of the input; `--first I --inputs 1`
// repeats an input.
//
// With the sanitizers, whose complaints end the process and count as crashes:
//   cmake --preset asan && cmake --build --preset asan --target bench_fuzz
//   build/asan/bin/bench_fuzz
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <new>
#include <thread>

#include "base/document.h"
#include "base/error.h"
#include "base/file.h"
#include "base/spoiled_text_testing.h"
#include "base/text.h"
#include "formats/car/bus_file.h"
#include "formats/deck/inp_deck.h"
#include "formats/mesh/inp_tire.h"
#include "formats/recorders/mdf_file.h"
#include "formats/recorders/motec_file.h"
#include "formats/recorders/rpc_file.h"
#include "formats/recorders/tdms_file.h"
#include "formats/recorders/uff_file.h"
#include "formats/road/open_crg.h"
#include "formats/road/road_file.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/recording.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/teim_orbit.h"
#include "formats/tire/tir_file.h"
#include "models/road/road_reader.h"
#include "table.h"

#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __ubsan_default_options() { return "halt_on_error=1"; }
#endif

namespace latsch::benchmarks {
namespace {

constexpr std::uint64_t kSeed = 20260;
constexpr rlim_t kMemory = 4ul << 30;  // bytes
constexpr auto kHang = std::chrono::seconds(10);
constexpr int kMostNamed = 5;  // inputs of one reader listed on the terminal

struct Reader {
  std::string name;
  std::vector<std::string> seeds;
  std::vector<std::string> pieces;
  std::function<void(const std::string&)> use;
};

/// Shared state of a reader's process. The watching process can read it after the reader's process
/// has died.
struct Progress {
  std::atomic<long> next;  // current input
  std::atomic<long> rejected;
  std::atomic<long> unclassified;
};

[[noreturn]] void broken(const std::string& promise) { throw std::logic_error(promise); }

void use_channels(const Channels& channels, bool gaps) {
  for (const Channel& channel : channels.all()) {
    if (channel.values.size() != channels.all().front().values.size()) broken("unequal channels");
    for (const double value : channel.values) {
      if (std::isinf(value) || (!gaps && std::isnan(value))) broken("a number that is not finite");
    }
  }
}

void use_road(const road::Road& road) {
  for (const auto& [x, y] : std::initializer_list<std::pair<double, double>>{
           {0.0, 0.0}, {1.3, -0.2}, {-50.0, 3.0}, {7e3, -2e4}}) {
    const road::GroundPoint ground = road.at(x, y, 0.1);
    if (!std::isfinite(ground.height) || !ground.normal.allFinite())
      broken("a road without height");
  }
}

const std::vector<std::string> kNumbers = {
    "nan", "inf", "-inf", "1e999", "-1e308", "1e-320", "0", "-1", "2147483648", "1e18", "0x10"};

std::vector<std::string> with_numbers(std::vector<std::string> pieces) {
  pieces.insert(pieces.end(), kNumbers.begin(), kNumbers.end());
  pieces.insert(pieces.end(),
                {"\n", "\r\n", " ", "\t", std::string(1, '\0'), "\xff", "\xef\xbb\xbf"});
  return pieces;
}

Reader csv_reader() {
  return {"CSV",
          {"# rig 3\nd [mm],F [N],type\n5.0,812,1\n10.0,1743.5,2\n20,4012,3\n",
           "Weg;Kraft\r\nmm;kN\r\n5,0;0,812\r\n10,0;1,7435\r\n"},
          with_numbers({",", ";", "\"", "[mm]", "[", "]", "#", "kN"}),
          [](const std::string& text) {
            use_channels(formats::CsvTable::parse(text, "spoiled").channels(), false);
          }};
}

Reader recording_reader() {
  return {"recording",
          {"# rig 3\ntime [ms],speed [km/h],Fz [N]\n0,36,4000\n0.5,36.1,4012.5\n1,36,-2e3\n",
           "time;Fz\r\ns;kN\r\n0,5;1,5\r\n0,6;1,6\r\n"},
          with_numbers({",", ";", "\"", "[ms]", "[", "]", "#", "kN"}),
          [](const std::string& text) {
            use_channels(formats::parse_recording(text, "spoiled"), false);
          }};
}

Reader tydex_reader() {
  return {
      "TYDEX",
      {"**HEADER\nRELEASE   Release                                 1.3\n**COMMENTS\n! x\n"
       "**CONSTANTS\nINFLPRES  Pressure                      bar       2.5\n"
       "**MEASURCHANNELS\nRUNTIME   time                          s         1         0         0\n"
       "FZW       Vertical force                kN        1         0         0\n"
       "**MEASURDATA\n0         1.5\n0.1       NOTAVAIL\n       0.2-1.5D+0\n**END\n"},
      with_numbers({"**END\n", "**MODELPARAMETERS\n", "**MEASURDATA\n", "NOTAVAIL", "deg C", "!"}),
      [](const std::string& text) {
        const auto file = formats::TydexFile::parse(text, "spoiled");
        use_channels(file.channels, true);
        file.constant("INFLPRES", "Pa");
      }};
}

Reader tir_reader() {
  return {
      ".tir",
      {"[MDI_HEADER]\nFILE_TYPE = 'tir'\n[UNITS]\nLENGTH = 'mm'\nFORCE = 'newton'\nANGLE = "
       "'degree'\n"
       "MASS = 'kg'\nTIME = 'second'\n[MODEL]\nFITTYP = 61 $ version\nTYRESIDE = 'LEFT'\n"
       "[DIMENSION]\nUNLOADED_RADIUS = 320\n[OPERATING_CONDITIONS]\nINFLPRES = 0.2\n[VERTICAL]\n"
       "FNOMIN = 4000\nVERTICAL_STIFFNESS = 200\n[SHAPE]\n{radial width}\n1.0 0.0\n1.0 0.4\n"
       "[LATERAL_COEFFICIENTS]\nPCY1 = 1.3\nPDY1 = -0.9\nPKY1 = -20\n"},
      with_numbers({"[", "]", "=", "'", "$", "!", "{", "}", "(A)", "FITTYP = 62\n", "[UNITS]\n"}),
      [](const std::string& text) { formats::parse_tir(text, "spoiled"); }};
}

std::string big_endian(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, 4);
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift);
  return bytes;
}

Reader crg_reader() {
  const std::string head =
      "$CT\nroad\n$\n$ROAD_CRG\nreference_line_start_u = 0\nreference_line_end_u = 3\n"
      "reference_line_increment = 1\nlong_section_v_right = -1\n"
      "long_section_v_increment = 1\n$\n$ROAD_CRG_OPTS\nborder_mode_u = 3\nborder_mode_v = 4\n"
      "border_smooth_ubeg = 1\nrefline_continuation = 1\n$\n$ROAD_CRG_MODS\ngrid_nan_mode = 0\n"
      "scale_length = 2\nrefpoint_u_fraction = 0.5\nrefpoint_phi = 1\n$\n$KD_Definition\n";
  const std::string channels =
      "D:reference line phi,rad\nD:reference line slope,m/m\nD:reference line banking,m/m\n"
      "D:long section 1,m\nD:long section 2,m\nD:long section 3,m\n$\n$$$$\n";
  std::string digits, binary;
  for (int row = 0; row < 4; ++row) {
    digits += row == 0 ? "**unused****unused** 0.0100000 0.1000000 *missing*-0.1000000\n"
                       : " 0.1000000 0.0100000 0.0000000 0.1000000 0.2000000-0.1000000\n";
    for (int i = 0; i < 6; ++i) binary += big_endian(0.01f * static_cast<float>(row + i));
  }
  return {"OpenCRG",
          {head + "#:LRFI\n" + channels + digits, head + "#:KRBI\n" + channels + binary},
          with_numbers({"$",
                        "$$$$\n",
                        "=",
                        "!",
                        "*",
                        "D:long section at v = 2,m\n",
                        "#:KDBI\n",
                        "scale_curvature = 3\n",
                        "reference_line_end_x = 2\n",
                        "*missing*"}),
          [](const std::string& text) {
            const road::CrgRoad road(formats::OpenCrg::parse(text, "spoiled").grid);
            use_road(road);
            for (const double u : {0.5, -7.0, 1e6}) road.elevation({u, 0.3});
          }};
}

/// Returns an element of a MAT file: type, length, and contents padded to eight bytes, in the byte
/// order of this machine.
std::string mat_element(std::uint32_t type, const std::string& contents, bool padded = true) {
  std::string bytes(8, '\0');
  const auto size = static_cast<std::uint32_t>(contents.size());
  std::memcpy(bytes.data(), &type, 4);
  std::memcpy(bytes.data() + 4, &size, 4);
  bytes += contents;
  if (padded) bytes.resize((bytes.size() + 7) / 8 * 8, '\0');
  return bytes;
}

template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), std::data(numbers), bytes.size());
  return bytes;
}

std::string mat_array(
    std::uint32_t kind, int rows, int columns, const std::string& name, const std::string& rest) {
  return mat_element(14,
                     mat_element(6, bytes_of<std::uint32_t>({kind, 0})) +
                         mat_element(5, bytes_of<std::int32_t>({rows, columns})) +
                         mat_element(1, name) + rest);
}

Reader mat_reader() {
  const std::string vector =
      mat_array(6, 3, 1, "Fz", mat_element(9, bytes_of<double>({1.0, 2.0, 3.0})));
  const std::string text =
      mat_array(4, 1, 2, "", mat_element(4, bytes_of<std::uint16_t>({'k', 'N'})));
  std::string names = "data";
  names.resize(8, '\0');
  names += std::string("unit\0\0\0\0", 8);
  const std::string owner =
      mat_array(2,
                1,
                1,
                "run",
                mat_element(5, bytes_of<std::int32_t>({8})) + mat_element(1, names) +
                    mat_array(12, 1, 2, "", mat_element(5, bytes_of<std::int32_t>({4, 5}))) + text);
  std::string head(124, ' ');
  head += bytes_of<std::uint16_t>({0x0100, 0x4d49});
  std::string packed(compressBound(vector.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()),
           &size,
           reinterpret_cast<const Bytef*>(vector.data()),
           vector.size());
  packed.resize(size);
  return {"MAT",
          {head + vector + owner,
           head + mat_element(15, packed, false) + vector,
           head + mat_array(1, 1, 2, "c", vector + owner)},
          with_numbers({vector,
                        text,
                        bytes_of<std::uint32_t>({14, 0xffffffff}),
                        bytes_of<std::uint32_t>({15, 16}),
                        bytes_of<std::int32_t>({1 << 30, 1 << 30}),
                        std::string(8, '\0')}),
          [](const std::string& bytes) {
            const auto file = formats::MatFile::parse(bytes, "spoiled");
            file.channels();
          }};
}

/// Returns files that the independent writer of the tests writes.
std::vector<std::string> written_recordings(std::initializer_list<const char*> names) {
  static const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("latsch_fuzz_{}", ::getpid());
  const std::string command =
      fmt::format("python3 {}/verification/recorders/write_recordings.py {}",
                  LATSCH_SOURCE_DIR,
                  folder.string());
  if (std::system(command.c_str()) != 0) throw InputError("python3 cannot write recordings");
  std::vector<std::string> files;
  for (const char* name : names) files.push_back(read_text_file(folder / name, 1u << 20));
  std::filesystem::remove_all(folder);
  return files;
}

void use_recorded(const formats::RecordedFile& file) {
  for (const formats::RecordedGroup& group : file.groups)
    for (const formats::RecordedChannel& channel : group.channels) {
      if (channel.values.size() != group.samples()) broken("unequal channels");
      for (const double value : channel.values)
        if (std::isinf(value)) broken("a number that is not finite");
    }
}

Reader uff_reader() {
  return {"UFF",
          written_recordings({"text_2_even.uff",
                              "text_4_uneven.uff",
                              "text_6_uneven.uff",
                              "binary_5_uneven_2.uff",
                              "binary_4_even_1.uff",
                              "functions.uff"}),
          with_numbers({"    -1\n", "    58\n", "    58b", "   164\n", "  2411\n", "NONE", "D+00"}),
          [](const std::string& bytes) { use_recorded(formats::parse_uff(bytes, "spoiled")); }};
}

Reader mdf_reader() {
  return {"MDF",
          written_recordings({"plain.mf4",
                              "headed.mf4",
                              "rules.mf4",
                              "unsorted_2.mf4",
                              "columns.mf4",
                              "unfinished.mf4"}),
          with_numbers({"##DT",
                        "##DZ",
                        "##CN",
                        "UnFinMF ",
                        std::string(8, '\0'),
                        bytes_of<std::uint64_t>({std::uint64_t{1} << 63}),
                        bytes_of<std::uint64_t>({64}),
                        bytes_of<std::uint32_t>({65}),
                        bytes_of<double>({NAN, INFINITY})}),
          [](const std::string& bytes) { use_recorded(formats::parse_mdf(bytes, "spoiled")); }};
}

Reader tdms_reader() {
  return {"TDMS",
          written_recordings({"segments_little.tdms",
                              "segments_big.tdms",
                              "interleaved_little.tdms",
                              "kinds_big.tdms",
                              "groups.tdms",
                              "open.tdms"}),
          with_numbers({"TDSm",
                        "/'hub'",
                        "'",
                        std::string(4, '\xff'),
                        bytes_of<std::uint64_t>({std::uint64_t{1} << 63}),
                        bytes_of<std::uint64_t>({~std::uint64_t{0}}),
                        bytes_of<std::uint32_t>({0x20}),
                        bytes_of<std::uint32_t>({0x0b}),
                        bytes_of<double>({NAN, INFINITY})}),
          [](const std::string& bytes) { use_recorded(formats::parse_tdms(bytes, "spoiled")); }};
}

Reader rpc_reader() {
  return {"RPC III",
          written_recordings({"integers.rsp", "integers.tim", "reals_rsp.rsp", "short_group.rsp"}),
          with_numbers({"FORMAT",
                        "CHANNELS",
                        "PTS_PER_GROUP",
                        "SAMPLES",
                        "SCALE.CHAN_1",
                        "BINARY_IEEE_BIG_END",
                        "FLOATING_POINT",
                        "9999999999",
                        std::string(4, '\0'),
                        bytes_of<float>({NAN, INFINITY})}),
          [](const std::string& bytes) { use_recorded(formats::parse_rpc(bytes, "spoiled")); }};
}

Reader motec_reader() {
  return {"MoTeC",
          written_recordings({"log.ld"}),
          with_numbers({bytes_of<std::uint32_t>({0x40}),
                        bytes_of<std::uint32_t>({0x722}),
                        bytes_of<std::uint32_t>({~std::uint32_t{0}}),
                        std::string(2, '\0'),
                        bytes_of<float>({NAN, INFINITY})}),
          [](const std::string& bytes) { use_recorded(formats::parse_motec(bytes, "spoiled")); }};
}

Reader rdf_reader() {
  const std::string units =
      "[UNITS]\nLENGTH = 'mm'\nFORCE = 'newton'\nANGLE = 'degree'\nMASS = 'kg'\nTIME = "
      "'sec'\n[MODEL]\n";
  const std::string road = units + "METHOD = '2D'\nROAD_TYPE = ";
  return {
      ".rdf",
      {units +
           "METHOD = '3D'\n[REFSYS]\nOFFSET = 0.0 1.0 0.0\nROTATION_ANGLE_XY_PLANE = 5\n[NODES]\n"
           "NUMBER_OF_NODES = 4\n{ node x y z }\n1 0 0 0\n2 1e3 0 0\n3 0 1e3 9\n4 1e3 1e3 0\n"
           "[ELEMENTS]\nNUMBER_OF_ELEMENTS = 2\n{ a b c mu }\n1 2 3 1.0\n2 4 3 0.8\n",
       road + "'plank'\n[PARAMETERS]\nMU = 1\nOFFSET = 2\nHEIGHT = 20\nSTART = 1000\nLENGTH = 50\n"
              "BEVEL_EDGE_LENGTH = 5\nDIRECTION = 30\n",
       road + "'drum'\n[PARAMETERS]\nDIAMETER = -2500\nV = 1e4\nNUMBER_CLEATS = 2\n"
              "CLEAT_STARTING_ANGLE = 90\n(XZR_DATA)\n0 0 0\n0 20 10\n40 20 10\n40 0 0\n",
       road + "'poly_line'\n[PARAMETERS]\n(XZ_DATA)\n0 0 0\n900 10 5\n1000 0 0\n",
       road + "'sweep'\n[PARAMETERS]\nAMPLITUDE_AT_START = 9\nAMPLITUDE_AT_END = 1\nSTART = 0\n"
              "END = 9000\nWAVE_LENGTH_AT_START = 3000\nWAVE_LENGTH_AT_END = 500\nSWEEP_TYPE = 0\n",
       units + "METHOD = '3D_SPLINE'\n[GLOBAL_PARAMETERS]\nCLOSED_ROAD = 'YES'\nWIDTH = 4e3\n"
               "ROAD_VERTICAL = '0.0 0.0 1.0'\nMU_LEFT = 1.2\n[DATA_POINTS]\n"
               "{X Y Z WIDTH BANK MU_LEFT MU_RIGHT OBSTACLES}\n0 0 0 0 0 0.9\n9e3 0 100 5e3 0\n"
               "9e3 9e3 50 0 0 1 0.7\n0 9e3 0\n"},
      with_numbers({"[", "]", "=", "'", "$", "{", "}", "(XZ_DATA)\n", "drum", "roof", "1 2 3 1\n"}),
      [](const std::string& text) {
        use_road(*formats::read_rdf(formats::TeimOrbit::parse(text, "spoiled")).road);
      }};
}

Reader bus_reader() {
  multibody::BushingParameters bushing{Eigen::Vector3d(1e7, 0.0, 2e7),
                                       Eigen::Vector3d(200.0, 0.0, 50.0)};
  for (const int axis : {1, 4})
    bushing.parts.push_back({axis,
                             multibody::ElasticCurve{multibody::ForceCharacteristic(
                                 {{-2e-3, -9e3}, {-1e-3, -2e3}, {0.0, 0.0}, {1e-3, 2500.0}})}});
  return {".bus",
          {formats::bus_text(bushing, "bushing")},
          with_numbers({"[", "]", "=", "'", "$", "{", "}", "[FX_CURVE]\n", "'mm'", "'degrees'"}),
          [](const std::string& text) {
            formats::bus_file_from(formats::TeimOrbit::parse(text, "spoiled"));
          }};
}

/// Returns a reader that parses only the sections and keys of the file, as callers do that know the
/// sections.
Reader teim_orbit_reader() {
  Reader reader = tir_reader();
  reader.name = "TeimOrbit";
  reader.seeds.insert(reader.seeds.end(),
                      {"[MDI_HEADER]\n FILE_TYPE = 'bus'\n(COMMENTS)\n{comment_string}\n'text'\n"
                       "[UNITS]\nLENGTH = 'mm'\nFORCE = 'newton'\nANGLE = 'deg'\nMASS = 'kg'\n"
                       "TIME = 'sec'\n[DAMPING]\nFX_DAMPING = 1.5D1 $ N s/mm\n[FX_CURVE]\n"
                       "{ x fx }\n-2.0 -900.0\n0 0\n2.0 900.0\n"});
  reader.use = [](const std::string& text) {
    const auto file = formats::TeimOrbit::parse(text, "spoiled");
    for (const auto& section : file.sections()) {
      for (const auto& entry : section.entries()) {
        if (entry.begin > entry.end || entry.end > file.source().size()) broken("a value outside");
      }
      for (const auto& table : section.tables()) {
        for (const auto& row : table.rows) section.numbers(row, table.heads.size());
      }
    }
    file.units();
  };
  return reader;
}

Reader inp_reader() {
  return {
      ".inp",
      {"*NODE,NSET=ALL\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
       "*ELEMENT,TYPE=C3D8,ELSET=E\n1,1,2,3,4,5,6,7,8\n*NSET,NSET=B,GENERATE\n1,4,1\n"
       "*MATERIAL,NAME=R\n*HYPERELASTIC,MOONEY-RIVLIN\n1.,0.,0.01\n*DENSITY\n1.1e-9\n"
       "*SOLID SECTION,ELSET=E,MATERIAL=R\n*SURFACE,NAME=S\nE,S1\n*BOUNDARY\nB,1,3\n"
       "*STEP,NLGEOM\n*STATIC\n*DLOAD\nE,P1,0.26\n*END "
       "STEP\n*STEP,PERTURBATION\n*FREQUENCY\n6\n*END STEP\n"},
      with_numbers(
          {"*", ",", "*NSET,NSET=C\nB\n", "*ELEMENT,TYPE=C3D8\n", "*ORIENTATION,NAME=O\n", "="}),
      [](const std::string& text) { formats::tire_from(formats::parse_inp(text, "spoiled")); }};
}

Reader toml_reader() {
  return {"TOML",
          {"kind = \"drum\"\ndiameter = \"2.5 m\"\nspeed = \"60 km/h\"\ncleats = 2\nheight = \"20 "
           "mm\"\n"
           "length = \"25 mm\"\nbevel = \"5 mm\"\nstarting_angle = \"90 deg\"\n",
           "kind = \"kerb\"\nshape = \"block\"\npitch = \"800 mm\"\nwidth = \"0.8 m\"\nheight = "
           "\"-25 mm\"\n"
           "count = 4\nlength = \"400 mm\"\nstart = {unit = \"m\", values = [0, -0.4]}\n"},
          with_numbers({"[",
                        "]",
                        "{",
                        "}",
                        "\"",
                        "'",
                        "=",
                        ".",
                        ",",
                        "#",
                        "\\u00e4",
                        "true",
                        "inner = true\n",
                        " mm",
                        "^9999",
                        "[a.b]\n",
                        "\"2.6 bar\""}),
          [](const std::string& text) {
            const Document document = Document::parse(text, "spoiled");
            for (const std::string& path : document.paths()) document.get(path);
            use_road(*road::read_road(document.root()));
          }};
}

std::string input(const Reader& reader, long number) {
  RandomStream random(kSeed, static_cast<std::uint64_t>(number));
  const std::string& seed = reader.seeds[random.below(reader.seeds.size())];
  return spoiled(seed, reader.pieces, random);
}

/// Reads the inputs from number `progress.next` to `end`, in the reader's process.
[[noreturn]] void work(const Reader& reader, long end, Progress& progress) {
// the shadow memory of the address sanitizer needs terabytes of addresses
#if !defined(__SANITIZE_ADDRESS__)
  const rlimit limit{kMemory, kMemory};
  ::setrlimit(RLIMIT_AS, &limit);
#endif
  const rlimit no_dump{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_dump);
  for (long i = progress.next; i < end; progress.next = ++i) {
    const std::string text = input(reader, i);
    try {
      reader.use(text);
      continue;
    } catch (const InputError& error) {
      ++progress.rejected;
      if (std::string_view(error.what()).starts_with("spoiled")) continue;
      fmt::print(stderr, "{}: input {} is not named: {}\n", reader.name, i, error.what());
    } catch (const std::exception& error) {
      if (progress.unclassified < kMostNamed) {
        fmt::print(stderr, "{}: input {}: {}\n", reader.name, i, error.what());
      }
    }
    ++progress.unclassified;
  }
  ::_exit(0);
}

/// Waits until the reader's process ends or makes no progress. Returns true if it makes no
/// progress.
bool hung(pid_t child, const Progress& progress, int& status) {
  auto since = std::chrono::steady_clock::now();
  long last = progress.next;
  for (;;) {
    if (::waitpid(child, &status, WNOHANG) == child) return false;
    const auto now = std::chrono::steady_clock::now();
    if (progress.next != last) {
      last = progress.next;
      since = now;
    } else if (now - since > kHang) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void run(const Reader& reader, long first, long inputs, Table& table) {
  void* shared =
      ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw std::bad_alloc();
  auto& progress = *new (shared) Progress{};
  progress.next = first;
  const auto begin = std::chrono::steady_clock::now();
  long crashes = 0, hangs = 0;
  while (progress.next < first + inputs) {
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) work(reader, first + inputs, progress);
    int status = 0;
    const bool hangs_now = hung(child, progress, status);
    if (!hangs_now && WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
    (hangs_now ? hangs : crashes) += 1;
    fmt::print(stderr,
               "{}: input {} {}\n",
               reader.name,
               progress.next.load(),
               hangs_now ? "hangs" : "crashes");
    ++progress.next;
    if (crashes + hangs > 100) break;  // further crashes are not worth counting
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const long tried = progress.next - first;
  const long bad = crashes + hangs + progress.unclassified;
  table.row(fmt::format("{}: crashes, hangs, other exceptions", reader.name),
            fmt::format("{} + {} + {}", crashes, hangs, progress.unclassified.load()),
            "0",
            bad == 0 && tried == inputs);
  table.note(
      fmt::format("{}: inputs, rejected, seconds", reader.name),
      fmt::format("{}, {:.0f} %, {:.1f}",
                  tried,
                  100.0 * static_cast<double>(progress.rejected) / static_cast<double>(tried),
                  seconds));
  ::munmap(shared, sizeof(Progress));
}

int fuzz(const Options& options) {
  const long inputs = options.integer("--inputs", options.size(1'000'000, 500));
  const long first = options.integer("--first", 0);
  const std::string only = options.text("--reader");
  Table table("fuzz", options);
  for (const Reader& reader : {csv_reader(),
                               recording_reader(),
                               tydex_reader(),
                               teim_orbit_reader(),
                               tir_reader(),
                               bus_reader(),
                               crg_reader(),
                               rdf_reader(),
                               mat_reader(),
                               uff_reader(),
                               mdf_reader(),
                               tdms_reader(),
                               rpc_reader(),
                               motec_reader(),
                               inp_reader(),
                               toml_reader()}) {
    if (only.empty() || only == reader.name) run(reader, first, inputs, table);
  }
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc,
                                           argv,
                                           {{"--inputs", "N", "of every reader"},
                                            {"--reader", "NAME", "that one alone"},
                                            {"--first", "I", "number of the first input"}},
                                           latsch::benchmarks::fuzz);
}
