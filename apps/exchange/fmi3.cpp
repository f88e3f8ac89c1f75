// SPDX-License-Identifier: Apache-2.0
#include "exchange/fmi3.h"

#include <memory>
#include <string>

#include "exchange/loading.h"

namespace latsch::exchange::fmi3 {
namespace {

Status from(exchange::CallStatus status) { return static_cast<Status>(static_cast<int>(status)); }

Instance* of(Handle handle) { return static_cast<Instance*>(handle); }

/// Calls `work` with the instance and returns its status; `error` if there is no instance.
template <class Work>
Status with(Handle handle, const Work& work) {
  return handle ? from(work(*of(handle))) : error;
}

Status refused(Handle handle, const char* what) {
  return with(handle, [&](Instance& instance) { return instance.refuse(what); });
}

/// Status of a call for variables of a type that the unit lacks: only an empty list succeeds.
Status none(Handle handle, std::size_t count) {
  return count == 0 && handle ? ok : refused(handle, "has only variables of type Float64");
}

Status no_clocks(Handle handle) { return refused(handle, "has no clocks"); }
Status no_events(Handle handle) { return refused(handle, "has no events"); }
Status no_bytes(Handle handle) { return refused(handle, "does not write its states as bytes"); }
Status no_derivatives(Handle handle) { return refused(handle, "does not tell derivatives"); }
Status no_model_exchange(Handle handle) { return refused(handle, "is only for co-simulation"); }

Instance::Log log_to(Environment environment, LogMessage logger) {
  if (!logger) return nullptr;
  return [=](exchange::CallStatus status, const char* category, const std::string& message) {
    logger(environment, from(status), category, message.c_str());
  };
}

Handle not_there(Environment environment, LogMessage logger) {
  if (logger) logger(environment, error, kLogError, "is only for co-simulation");
  return nullptr;
}

}  // namespace

extern "C" {

Text fmi3GetVersion() { return "3.0"; }

Status fmi3SetDebugLogging(Handle handle, bool, std::size_t, const Text[]) {
  return handle ? ok : error;  // errors are always logged, and there are no other categories
}

Handle fmi3InstantiateCoSimulation(Text,
                                   Text token,
                                   Text resources,
                                   bool,
                                   bool,
                                   bool,
                                   bool,
                                   const Reference[],
                                   std::size_t intermediate_count,
                                   Environment environment,
                                   LogMessage logger,
                                   IntermediateUpdate) {
  try {
    const auto log = log_to(environment, logger);
    if (intermediate_count > 0) {
      if (log) log(exchange::CallStatus::error, kLogError, "has no variables within a step");
      return nullptr;
    }
    return load_instance(resources ? resources : "", token ? token : "", log).release();
  } catch (...) {  // out of memory
    return nullptr;
  }
}
Handle fmi3InstantiateModelExchange(
    Text, Text, Text, bool, bool, Environment environment, LogMessage logger) {
  return not_there(environment, logger);
}
Handle fmi3InstantiateScheduledExecution(Text,
                                         Text,
                                         Text,
                                         bool,
                                         bool,
                                         Environment environment,
                                         LogMessage logger,
                                         ClockUpdate,
                                         Lock,
                                         Lock) {
  return not_there(environment, logger);
}
void fmi3FreeInstance(Handle handle) { delete of(handle); }

Status fmi3EnterInitializationMode(
    Handle handle, bool, double, double start, bool with_stop, double stop) {
  return with(handle, [&](Instance& instance) {
    const auto status = instance.set_up(start, with_stop ? std::optional(stop) : std::nullopt);
    return status == exchange::CallStatus::ok ? instance.begin_initialization() : status;
  });
}
Status fmi3ExitInitializationMode(Handle handle) {
  return with(handle, [](Instance& instance) { return instance.end_initialization(); });
}
Status fmi3Terminate(Handle handle) {
  return with(handle, [](Instance& instance) { return instance.terminate(); });
}
Status fmi3Reset(Handle handle) {
  return with(handle, [](Instance& instance) { return instance.reset(); });
}

Status fmi3GetFloat64(Handle handle,
                      const Reference references[],
                      std::size_t count,
                      double values[],
                      std::size_t places) {
  return with(handle, [&](Instance& instance) {
    return places == count ? instance.get(references, count, values)
                           : instance.refuse("every variable has one value");
  });
}
Status fmi3SetFloat64(Handle handle,
                      const Reference references[],
                      std::size_t count,
                      const double values[],
                      std::size_t places) {
  return with(handle, [&](Instance& instance) {
    return places == count ? instance.set(references, count, values)
                           : instance.refuse("every variable has one value");
  });
}

#define LATSCH_TYPE(Name, Value)                                                         \
  Status fmi3Get##Name(Handle handle,                                                    \
                       const Reference[],                                                \
                       std::size_t count,                                                \
                       [[maybe_unused]] Value values[],                                  \
                       std::size_t) {                                                    \
    return none(handle, count);                                                          \
  }                                                                                      \
  Status fmi3Set##Name(                                                                  \
      Handle handle, const Reference[], std::size_t count, const Value[], std::size_t) { \
    return none(handle, count);                                                          \
  }
LATSCH_TYPE(Float32, float)
LATSCH_TYPE(Int8, std::int8_t)
LATSCH_TYPE(UInt8, std::uint8_t)
LATSCH_TYPE(Int16, std::int16_t)
LATSCH_TYPE(UInt16, std::uint16_t)
LATSCH_TYPE(Int32, std::int32_t)
LATSCH_TYPE(UInt32, std::uint32_t)
LATSCH_TYPE(Int64, std::int64_t)
LATSCH_TYPE(UInt64, std::uint64_t)
LATSCH_TYPE(Boolean, bool)
LATSCH_TYPE(String, Text)
#undef LATSCH_TYPE
Status fmi3GetBinary(
    Handle handle, const Reference[], std::size_t count, std::size_t[], Binary[], std::size_t) {
  return none(handle, count);
}
Status fmi3SetBinary(Handle handle,
                     const Reference[],
                     std::size_t count,
                     const std::size_t[],
                     const Binary[],
                     std::size_t) {
  return none(handle, count);
}
Status fmi3GetClock(Handle handle, const Reference[], std::size_t count, bool[]) {
  return none(handle, count);
}
Status fmi3SetClock(Handle handle, const Reference[], std::size_t count, const bool[]) {
  return none(handle, count);
}

// modelDescription.xml states the dependencies between variables, and they do not change.
Status fmi3GetNumberOfVariableDependencies(Handle handle, Reference, std::size_t*) {
  return refused(handle, "has no dependencies of elements");
}
Status fmi3GetVariableDependencies(Handle handle,
                                   Reference,
                                   std::size_t[],
                                   Reference[],
                                   std::size_t[],
                                   DependencyKind[],
                                   std::size_t) {
  return refused(handle, "has no dependencies of elements");
}

Status fmi3GetFMUState(Handle handle, State* state) {
  return with(handle, [&](Instance& instance) { return instance.copy_state(state); });
}
Status fmi3SetFMUState(Handle handle, State state) {
  return with(handle, [&](Instance& instance) { return instance.restore_state(state); });
}
Status fmi3FreeFMUState(Handle handle, State* state) {
  Instance::free_state(state);
  return handle ? ok : error;
}
Status fmi3SerializedFMUStateSize(Handle handle, State, std::size_t*) { return no_bytes(handle); }
Status fmi3SerializeFMUState(Handle handle, State, std::uint8_t[], std::size_t) {
  return no_bytes(handle);
}
Status fmi3DeserializeFMUState(Handle handle, const std::uint8_t[], std::size_t, State*) {
  return no_bytes(handle);
}

Status fmi3GetDirectionalDerivative(Handle handle,
                                    const Reference[],
                                    std::size_t,
                                    const Reference[],
                                    std::size_t,
                                    const double[],
                                    std::size_t,
                                    double[],
                                    std::size_t) {
  return no_derivatives(handle);
}
Status fmi3GetAdjointDerivative(Handle handle,
                                const Reference[],
                                std::size_t,
                                const Reference[],
                                std::size_t,
                                const double[],
                                std::size_t,
                                double[],
                                std::size_t) {
  return no_derivatives(handle);
}

Status fmi3EnterConfigurationMode(Handle handle) {
  return refused(handle, "has no structural parameters");
}
Status fmi3ExitConfigurationMode(Handle handle) {
  return refused(handle, "has no structural parameters");
}
Status fmi3EnterEventMode(Handle handle) { return no_events(handle); }
Status fmi3EnterStepMode(Handle handle) { return no_events(handle); }
Status fmi3GetIntervalDecimal(
    Handle handle, const Reference[], std::size_t, double[], IntervalQualifier[]) {
  return no_clocks(handle);
}
Status fmi3GetIntervalFraction(Handle handle,
                               const Reference[],
                               std::size_t,
                               std::uint64_t[],
                               std::uint64_t[],
                               IntervalQualifier[]) {
  return no_clocks(handle);
}
Status fmi3GetShiftDecimal(Handle handle, const Reference[], std::size_t, double[]) {
  return no_clocks(handle);
}
Status fmi3GetShiftFraction(
    Handle handle, const Reference[], std::size_t, std::uint64_t[], std::uint64_t[]) {
  return no_clocks(handle);
}
Status fmi3SetIntervalDecimal(Handle handle, const Reference[], std::size_t, const double[]) {
  return no_clocks(handle);
}
Status fmi3SetIntervalFraction(
    Handle handle, const Reference[], std::size_t, const std::uint64_t[], const std::uint64_t[]) {
  return no_clocks(handle);
}
Status fmi3SetShiftDecimal(Handle handle, const Reference[], std::size_t, const double[]) {
  return no_clocks(handle);
}
Status fmi3SetShiftFraction(
    Handle handle, const Reference[], std::size_t, const std::uint64_t[], const std::uint64_t[]) {
  return no_clocks(handle);
}
Status fmi3EvaluateDiscreteStates(Handle handle) { return no_events(handle); }
Status fmi3UpdateDiscreteStates(Handle handle, bool*, bool*, bool*, bool*, bool*, double*) {
  return no_events(handle);
}

Status fmi3EnterContinuousTimeMode(Handle handle) { return no_model_exchange(handle); }
Status fmi3CompletedIntegratorStep(Handle handle, bool, bool*, bool*) {
  return no_model_exchange(handle);
}
Status fmi3SetTime(Handle handle, double) { return no_model_exchange(handle); }
Status fmi3SetContinuousStates(Handle handle, const double[], std::size_t) {
  return no_model_exchange(handle);
}
Status fmi3GetContinuousStateDerivatives(Handle handle, double[], std::size_t) {
  return no_model_exchange(handle);
}
Status fmi3GetEventIndicators(Handle handle, double[], std::size_t) {
  return no_model_exchange(handle);
}
Status fmi3GetContinuousStates(Handle handle, double[], std::size_t) {
  return no_model_exchange(handle);
}
Status fmi3GetNominalsOfContinuousStates(Handle handle, double[], std::size_t) {
  return no_model_exchange(handle);
}
Status fmi3GetNumberOfEventIndicators(Handle handle, std::size_t*) {
  return no_model_exchange(handle);
}
Status fmi3GetNumberOfContinuousStates(Handle handle, std::size_t*) {
  return no_model_exchange(handle);
}

Status fmi3GetOutputDerivatives(Handle handle,
                                const Reference[],
                                std::size_t count,
                                const std::int32_t[],
                                double[],
                                std::size_t) {
  return count == 0 && handle ? ok : no_derivatives(handle);
}

Status fmi3DoStep(Handle handle,
                  double time,
                  double step,
                  bool,
                  bool* event,
                  bool* terminate,
                  bool* early,
                  double* reached) {
  return with(handle, [&](Instance& instance) {
    for (bool* answer : {event, terminate, early})
      if (answer) *answer = false;
    const auto status = instance.step(time, step);
    if (reached) *reached = instance.time();
    return status;
  });
}

Status fmi3ActivateModelPartition(Handle handle, Reference, double) { return no_clocks(handle); }

}  // extern "C"

}  // namespace latsch::exchange::fmi3
