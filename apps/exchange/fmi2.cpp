// SPDX-License-Identifier: Apache-2.0
#include "exchange/fmi2.h"

#include <memory>
#include <string>

#include "exchange/loading.h"

namespace latsch::exchange::fmi2 {
namespace {

struct Fmu {
  std::unique_ptr<Instance> instance;
};

/// Escapes a message for FMI 2.0, which passes messages as printf formats in which # begins a value
/// reference [2.1.5].
std::string as_format(const std::string& message) {
  std::string result;
  for (const char c : message) {
    result += c;
    if (c == '%' || c == '#') result += c;
  }
  return result;
}

Status from(exchange::CallStatus status) { return static_cast<Status>(static_cast<int>(status)); }

/// Calls `work` with the instance and returns its status; `error` if there is no instance.
template <class Work>
Status with(Component component, const Work& work) {
  auto* fmu = static_cast<Fmu*>(component);
  return fmu ? from(work(*fmu->instance)) : error;
}

Status refused(Component component, const char* what) {
  return with(component, [&](Instance& instance) { return instance.refuse(what); });
}

/// Status of a call for variables of a type that the unit lacks: only an empty list succeeds.
Status none(Component component, std::size_t count, const char* what) {
  return count == 0 && component ? ok : refused(component, what);
}

constexpr const char* kRealsAlone = "has only variables of type Real";
constexpr const char* kNoDerivatives = "has no derivatives of inputs or outputs";
constexpr const char* kNoBytes = "does not write its states as bytes";
constexpr const char* kSynchronous = "steps are done when fmi2DoStep returns";

}  // namespace

extern "C" {

Text fmi2GetTypesPlatform() { return "default"; }
Text fmi2GetVersion() { return "2.0"; }

Status fmi2SetDebugLogging(Component component, int, std::size_t, const Text[]) {
  return component ? ok : error;  // errors are always logged, and no other categories exist
}

Component fmi2Instantiate(
    Text name, Type type, Text guid, Text resources, const Callbacks* callbacks, int, int) {
  try {
    Instance::Log log;
    if (callbacks && callbacks->logger)
      log = [logger = callbacks->logger,
             environment = callbacks->environment,
             own = std::string(name ? name : "")](
                exchange::CallStatus status, const char* category, const std::string& message) {
        logger(environment, own.c_str(), from(status), category, as_format(message).c_str());
      };
    if (type != co_simulation) {
      if (log) log(exchange::CallStatus::error, kLogError, "is only for co-simulation");
      return nullptr;
    }
    auto instance = load_instance(resources ? resources : "", guid ? guid : "", log);
    return instance ? new Fmu{std::move(instance)} : nullptr;
  } catch (...) {  // out of memory
    return nullptr;
  }
}

void fmi2FreeInstance(Component component) { delete static_cast<Fmu*>(component); }

Status fmi2SetupExperiment(
    Component component, int, double, double start, int with_stop, double stop) {
  return with(component, [&](Instance& instance) {
    return instance.set_up(start, with_stop ? std::optional(stop) : std::nullopt);
  });
}

Status fmi2EnterInitializationMode(Component component) {
  return with(component, [](Instance& instance) { return instance.begin_initialization(); });
}
Status fmi2ExitInitializationMode(Component component) {
  return with(component, [](Instance& instance) { return instance.end_initialization(); });
}
Status fmi2Terminate(Component component) {
  return with(component, [](Instance& instance) { return instance.terminate(); });
}
Status fmi2Reset(Component component) {
  return with(component, [](Instance& instance) { return instance.reset(); });
}

Status fmi2GetReal(Component component,
                   const Reference references[],
                   std::size_t count,
                   double values[]) {
  return with(component,
              [&](Instance& instance) { return instance.get(references, count, values); });
}
Status fmi2SetReal(Component component,
                   const Reference references[],
                   std::size_t count,
                   const double values[]) {
  return with(component,
              [&](Instance& instance) { return instance.set(references, count, values); });
}

Status fmi2GetInteger(Component component, const Reference[], std::size_t count, int[]) {
  return none(component, count, kRealsAlone);
}
Status fmi2SetInteger(Component component, const Reference[], std::size_t count, const int[]) {
  return none(component, count, kRealsAlone);
}
Status fmi2GetBoolean(Component component, const Reference[], std::size_t count, int[]) {
  return none(component, count, kRealsAlone);
}
Status fmi2SetBoolean(Component component, const Reference[], std::size_t count, const int[]) {
  return none(component, count, kRealsAlone);
}
Status fmi2GetString(Component component, const Reference[], std::size_t count, Text[]) {
  return none(component, count, kRealsAlone);
}
Status fmi2SetString(Component component, const Reference[], std::size_t count, const Text[]) {
  return none(component, count, kRealsAlone);
}

Status fmi2GetFMUstate(Component component, State* state) {
  return with(component, [&](Instance& instance) { return instance.copy_state(state); });
}
Status fmi2SetFMUstate(Component component, State state) {
  return with(component, [&](Instance& instance) { return instance.restore_state(state); });
}
Status fmi2FreeFMUstate(Component component, State* state) {
  Instance::free_state(state);
  return component ? ok : error;
}
Status fmi2SerializedFMUstateSize(Component component, State, std::size_t*) {
  return refused(component, kNoBytes);
}
Status fmi2SerializeFMUstate(Component component, State, char[], std::size_t) {
  return refused(component, kNoBytes);
}
Status fmi2DeSerializeFMUstate(Component component, const char[], std::size_t, State*) {
  return refused(component, kNoBytes);
}
Status fmi2GetDirectionalDerivative(Component component,
                                    const Reference[],
                                    std::size_t,
                                    const Reference[],
                                    std::size_t,
                                    const double[],
                                    double[]) {
  return refused(component, "does not tell directional derivatives");
}

Status fmi2SetRealInputDerivatives(
    Component component, const Reference[], std::size_t count, const int[], const double[]) {
  return none(component, count, kNoDerivatives);
}
Status fmi2GetRealOutputDerivatives(
    Component component, const Reference[], std::size_t count, const int[], double[]) {
  return none(component, count, kNoDerivatives);
}

Status fmi2DoStep(Component component, double time, double step, int) {
  return with(component, [&](Instance& instance) { return instance.step(time, step); });
}
Status fmi2CancelStep(Component component) { return refused(component, kSynchronous); }

Status fmi2GetStatus(Component component, StatusKind, Status*) {
  return component ? discard : error;  // steps are never asynchronous
}
Status fmi2GetRealStatus(Component component, StatusKind kind, double* value) {
  return with(component, [&](Instance& instance) {
    if (kind != last_successful_time || !value) return exchange::CallStatus::discard;
    *value = instance.time();
    return exchange::CallStatus::ok;
  });
}
Status fmi2GetIntegerStatus(Component component, StatusKind, int*) {
  return component ? discard : error;
}
Status fmi2GetBooleanStatus(Component component, StatusKind kind, int* value) {
  if (!component) return error;
  if (kind != terminated || !value) return discard;
  *value = 0;  // a unit never requests the end of the simulation
  return ok;
}
Status fmi2GetStringStatus(Component component, StatusKind, Text*) {
  return component ? discard : error;
}

}  // extern "C"

}  // namespace latsch::exchange::fmi2
