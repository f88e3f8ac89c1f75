// SPDX-License-Identifier: Apache-2.0
#include "fmu_testing.h"

#include <dlfcn.h>
#include <zip.h>

#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "base/file.h"
#include "exchange/fmi2.h"
#include "exchange/fmi3.h"

namespace latsch::exchange {

namespace fs = std::filesystem;

void unpack(const std::string& bytes, const fs::path& folder) {
  zip_error_t error;
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* zip = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
  if (!zip) throw std::runtime_error("no ZIP file");
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
    zip_stat_t entry;
    zip_stat_index(zip, static_cast<zip_uint64_t>(i), 0, &entry);
    std::string content(entry.size, '\0');
    zip_file_t* file = zip_fopen_index(zip, static_cast<zip_uint64_t>(i), 0);
    if (zip_fread(file, content.data(), content.size()) != static_cast<zip_int64_t>(entry.size))
      throw std::runtime_error("a file of the ZIP cannot be read");
    zip_fclose(file);
    fs::create_directories((folder / entry.name).parent_path());
    write_text_file(folder / entry.name, content);
  }
  zip_close(zip);
}

Binary::Binary(const fs::path& file) : handle_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw std::runtime_error(::dlerror());
}
Binary::~Binary() { ::dlclose(handle_); }
void* Binary::find(const std::string& name) const { return ::dlsym(handle_, name.c_str()); }

Package::Package(FmiVersion version,
                 const std::string& model,
                 const std::string& road,
                 const fs::path& library)
    : version(version) {
  const fs::path file = fs::path(LATSCH_SOURCE_DIR) / "studies" / model, made = folder / "made";
  const auto& kind = experiment::language().kind_of_file(file);
  fs::create_directories(made);
  if (!road.empty()) write_text_file(made / "road.toml", road);
  const UnitFiles files =
      unit_files(kind, kind.read(file), road.empty() ? fs::path() : made / "road.toml");
  for (const auto& [name, bytes] : files) write_text_file(made / name, bytes);
  variables = read_unit(made, SpecimenModels(experiment::language())).unit->variables();
  token = token_of(files);
  const bool two = version == FmiVersion::fmi2;
  const UnitTitle title{"a tire & 1", "<for a test>", token};
  unpack(fmu_package(version,
                     title,
                     variables,
                     {{library.empty() ? fs::path(two ? LATSCH_FMI2 : LATSCH_FMI3) : library}},
                     files),
         folder.path());
  binary = std::make_unique<Binary>(
      folder / (two ? "binaries/linux64/a_tire___1.so" : "binaries/x86_64-linux/a_tire___1.so"));
}

unsigned Package::reference(const std::string& variable) const {
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].name == variable) return reference_of(i);
  throw std::runtime_error("no variable " + variable);
}

namespace {

using Log = std::vector<std::pair<CallStatus, std::string>>;

/// Formats a message as importing programs do, which use the message as a printf format.
void log2(void* environment, fmi2::Text, fmi2::Status status, fmi2::Text, fmi2::Text format, ...) {
  char text[4096];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  static_cast<Log*>(environment)->emplace_back(static_cast<CallStatus>(status), text);
}

void log3(void* environment, fmi3::Status status, fmi3::Text, fmi3::Text message) {
  static_cast<Log*>(environment)->emplace_back(static_cast<CallStatus>(status), message);
}

#define CALL(version, name) binary_.function<decltype(version::name)>(#name)

class Slave2 final : public Slave {
 public:
  Slave2(const Package& package, const std::string& token, const std::string& resources)
      : binary_(*package.binary), callbacks_{log2, nullptr, nullptr, nullptr, &log} {
    component_ = CALL(fmi2, fmi2Instantiate)(
        "one", fmi2::co_simulation, token.c_str(), resources.c_str(), &callbacks_, 0, 0);
  }
  ~Slave2() override { CALL(fmi2, fmi2FreeInstance)(component_); }

  bool there() const override { return component_ != nullptr; }
  CallStatus enter(double start) override {
    const CallStatus status =
        from(CALL(fmi2, fmi2SetupExperiment)(component_, 0, 0.0, start, 0, 0.0));
    if (status != CallStatus::ok) return status;
    return from(CALL(fmi2, fmi2EnterInitializationMode)(component_));
  }
  CallStatus leave() override { return from(CALL(fmi2, fmi2ExitInitializationMode)(component_)); }
  CallStatus initialize(double start) override {
    const CallStatus status = enter(start);
    return status == CallStatus::ok ? leave() : status;
  }
  CallStatus set(unsigned reference, double value) override {
    return from(CALL(fmi2, fmi2SetReal)(component_, &reference, 1, &value));
  }
  CallStatus get(unsigned reference, double& value) override {
    return from(CALL(fmi2, fmi2GetReal)(component_, &reference, 1, &value));
  }
  CallStatus step(double time, double step) override {
    return from(CALL(fmi2, fmi2DoStep)(component_, time, step, 0));
  }
  CallStatus copy(void** state) override {
    return from(CALL(fmi2, fmi2GetFMUstate)(component_, state));
  }
  CallStatus restore(void* state) override {
    return from(CALL(fmi2, fmi2SetFMUstate)(component_, state));
  }
  CallStatus free(void** state) override {
    return from(CALL(fmi2, fmi2FreeFMUstate)(component_, state));
  }
  CallStatus terminate() override { return from(CALL(fmi2, fmi2Terminate)(component_)); }
  CallStatus reset() override { return from(CALL(fmi2, fmi2Reset)(component_)); }
  CallStatus ask_for_integer() override {
    const unsigned reference = 1;
    int value = 0;
    return from(CALL(fmi2, fmi2GetInteger)(component_, &reference, 1, &value));
  }

 private:
  static CallStatus from(fmi2::Status status) { return static_cast<CallStatus>(status); }

  const Binary& binary_;
  fmi2::Callbacks callbacks_;
  fmi2::Component component_;
};

class Slave3 final : public Slave {
 public:
  Slave3(const Package& package, const std::string& token, const std::string& resources)
      : binary_(*package.binary) {
    handle_ = CALL(fmi3, fmi3InstantiateCoSimulation)("one",
                                                      token.c_str(),
                                                      resources.c_str(),
                                                      false,
                                                      false,
                                                      false,
                                                      false,
                                                      nullptr,
                                                      0,
                                                      &log,
                                                      log3,
                                                      nullptr);
  }
  ~Slave3() override { CALL(fmi3, fmi3FreeInstance)(handle_); }

  bool there() const override { return handle_ != nullptr; }
  CallStatus enter(double start) override {
    return from(CALL(fmi3, fmi3EnterInitializationMode)(handle_, false, 0.0, start, false, 0.0));
  }
  CallStatus leave() override { return from(CALL(fmi3, fmi3ExitInitializationMode)(handle_)); }
  CallStatus initialize(double start) override {
    const CallStatus status = enter(start);
    return status == CallStatus::ok ? leave() : status;
  }
  CallStatus set(unsigned reference, double value) override {
    return from(CALL(fmi3, fmi3SetFloat64)(handle_, &reference, 1, &value, 1));
  }
  CallStatus get(unsigned reference, double& value) override {
    return from(CALL(fmi3, fmi3GetFloat64)(handle_, &reference, 1, &value, 1));
  }
  CallStatus step(double time, double step) override {
    bool event = true, terminate = true, early = true;
    double reached = 0.0;
    const CallStatus status = from(
        CALL(fmi3, fmi3DoStep)(handle_, time, step, false, &event, &terminate, &early, &reached));
    if (event || terminate || early) throw std::runtime_error("asks for what it has not");
    if (status == CallStatus::ok && reached != time + step)
      throw std::runtime_error("another time");
    return status;
  }
  CallStatus copy(void** state) override {
    return from(CALL(fmi3, fmi3GetFMUState)(handle_, state));
  }
  CallStatus restore(void* state) override {
    return from(CALL(fmi3, fmi3SetFMUState)(handle_, state));
  }
  CallStatus free(void** state) override {
    return from(CALL(fmi3, fmi3FreeFMUState)(handle_, state));
  }
  CallStatus terminate() override { return from(CALL(fmi3, fmi3Terminate)(handle_)); }
  CallStatus reset() override { return from(CALL(fmi3, fmi3Reset)(handle_)); }
  CallStatus ask_for_integer() override {
    const unsigned reference = 1;
    std::int32_t value = 0;
    return from(CALL(fmi3, fmi3GetInt32)(handle_, &reference, 1, &value, 1));
  }

 private:
  static CallStatus from(fmi3::Status status) { return static_cast<CallStatus>(status); }

  const Binary& binary_;
  fmi3::Handle handle_;
};

#undef CALL

}  // namespace

std::unique_ptr<Slave> instantiate(const Package& package,
                                   const std::string& token,
                                   const std::string& resources) {
  const std::string& own = token.empty() ? package.token : token;
  const std::string folder = package.file("resources").string();
  if (package.version == FmiVersion::fmi2)
    return std::make_unique<Slave2>(
        package, own, resources.empty() ? "file://" + folder : resources);
  return std::make_unique<Slave3>(package, own, resources.empty() ? folder + "/" : resources);
}

}  // namespace latsch::exchange
