// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 3.0, as other programs call them [Functional Mock-up Interface 3.0.2, 2.2
// and 4.2]: names, arguments and values of the standard, declared anew. All of them exist, as the
// standard requires; those that our co-simulation units do not need (types other than Float64,
// clocks, events, derivatives, states as bytes, model exchange, scheduled execution) log and return
// `error`.
#pragma once

#include <cstddef>
#include <cstdint>

#include "exchange/exported.h"

namespace latsch::exchange::fmi3 {

enum Status : int { ok, warning, discard, error, fatal };
enum DependencyKind : int { independent, constant, fixed, tunable, discrete, dependent };
enum IntervalQualifier : int { not_yet_known, unchanged, changed };

using Handle = void*;
using State = void*;
using Environment = void*;
using Reference = std::uint32_t;
using Text = const char*;
using Binary = const std::uint8_t*;

using LogMessage = void (*)(Environment, Status, Text category, Text message);
using ClockUpdate = void (*)(Environment);
using Lock = void (*)();
using IntermediateUpdate = void (*)(Environment,
                                    double time,
                                    bool set_requested,
                                    bool get_allowed,
                                    bool step_finished,
                                    bool can_return_early,
                                    bool* return_early,
                                    double* return_time);

extern "C" {
#define LATSCH_C LATSCH_EXPORTED
LATSCH_C Text fmi3GetVersion();
LATSCH_C Status fmi3SetDebugLogging(Handle, bool on, std::size_t count, const Text categories[]);

LATSCH_C Handle fmi3InstantiateCoSimulation(Text name,
                                            Text token,
                                            Text resources,
                                            bool visible,
                                            bool logging,
                                            bool event_mode,
                                            bool early_return,
                                            const Reference intermediate[],
                                            std::size_t intermediate_count,
                                            Environment,
                                            LogMessage,
                                            IntermediateUpdate);
LATSCH_C Handle fmi3InstantiateModelExchange(
    Text name, Text token, Text resources, bool visible, bool logging, Environment, LogMessage);
LATSCH_C Handle fmi3InstantiateScheduledExecution(Text name,
                                                  Text token,
                                                  Text resources,
                                                  bool visible,
                                                  bool logging,
                                                  Environment,
                                                  LogMessage,
                                                  ClockUpdate,
                                                  Lock,
                                                  Lock);
LATSCH_C void fmi3FreeInstance(Handle);
LATSCH_C Status fmi3EnterInitializationMode(
    Handle, bool with_tolerance, double tolerance, double start, bool with_stop, double stop);
LATSCH_C Status fmi3ExitInitializationMode(Handle);
LATSCH_C Status fmi3Terminate(Handle);
LATSCH_C Status fmi3Reset(Handle);

// Declares the getter and setter of one type. All types have the same arguments: value references
// and values, with their counts.
#define LATSCH_TYPE(Name, Value)                                                             \
  LATSCH_C Status fmi3Get##Name(                                                             \
      Handle, const Reference[], std::size_t references, Value values[], std::size_t count); \
  LATSCH_C Status fmi3Set##Name(                                                             \
      Handle, const Reference[], std::size_t references, const Value values[], std::size_t count);
LATSCH_TYPE(Float32, float)
LATSCH_TYPE(Float64, double)
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
LATSCH_C Status fmi3GetBinary(
    Handle, const Reference[], std::size_t, std::size_t sizes[], Binary values[], std::size_t);
LATSCH_C Status fmi3SetBinary(Handle,
                              const Reference[],
                              std::size_t,
                              const std::size_t sizes[],
                              const Binary values[],
                              std::size_t);
LATSCH_C Status fmi3GetClock(Handle, const Reference[], std::size_t, bool values[]);
LATSCH_C Status fmi3SetClock(Handle, const Reference[], std::size_t, const bool values[]);

LATSCH_C Status fmi3GetNumberOfVariableDependencies(Handle, Reference, std::size_t* count);
LATSCH_C Status fmi3GetVariableDependencies(Handle,
                                            Reference,
                                            std::size_t elements[],
                                            Reference independents[],
                                            std::size_t independent_elements[],
                                            DependencyKind kinds[],
                                            std::size_t count);

LATSCH_C Status fmi3GetFMUState(Handle, State*);
LATSCH_C Status fmi3SetFMUState(Handle, State);
LATSCH_C Status fmi3FreeFMUState(Handle, State*);
LATSCH_C Status fmi3SerializedFMUStateSize(Handle, State, std::size_t* size);
LATSCH_C Status fmi3SerializeFMUState(Handle, State, std::uint8_t bytes[], std::size_t size);
LATSCH_C Status fmi3DeserializeFMUState(Handle,
                                        const std::uint8_t bytes[],
                                        std::size_t size,
                                        State*);

LATSCH_C Status fmi3GetDirectionalDerivative(Handle,
                                             const Reference unknowns[],
                                             std::size_t,
                                             const Reference knowns[],
                                             std::size_t,
                                             const double seed[],
                                             std::size_t,
                                             double sensitivity[],
                                             std::size_t);
LATSCH_C Status fmi3GetAdjointDerivative(Handle,
                                         const Reference unknowns[],
                                         std::size_t,
                                         const Reference knowns[],
                                         std::size_t,
                                         const double seed[],
                                         std::size_t,
                                         double sensitivity[],
                                         std::size_t);

LATSCH_C Status fmi3EnterConfigurationMode(Handle);
LATSCH_C Status fmi3ExitConfigurationMode(Handle);
LATSCH_C Status fmi3EnterEventMode(Handle);
LATSCH_C Status fmi3EnterStepMode(Handle);
LATSCH_C Status fmi3GetIntervalDecimal(
    Handle, const Reference[], std::size_t, double intervals[], IntervalQualifier[]);
LATSCH_C Status fmi3GetIntervalFraction(Handle,
                                        const Reference[],
                                        std::size_t,
                                        std::uint64_t counters[],
                                        std::uint64_t resolutions[],
                                        IntervalQualifier[]);
LATSCH_C Status fmi3GetShiftDecimal(Handle, const Reference[], std::size_t, double shifts[]);
LATSCH_C Status fmi3GetShiftFraction(
    Handle, const Reference[], std::size_t, std::uint64_t counters[], std::uint64_t resolutions[]);
LATSCH_C Status fmi3SetIntervalDecimal(Handle,
                                       const Reference[],
                                       std::size_t,
                                       const double intervals[]);
LATSCH_C Status fmi3SetIntervalFraction(Handle,
                                        const Reference[],
                                        std::size_t,
                                        const std::uint64_t counters[],
                                        const std::uint64_t resolutions[]);
LATSCH_C Status fmi3SetShiftDecimal(Handle, const Reference[], std::size_t, const double shifts[]);
LATSCH_C Status fmi3SetShiftFraction(Handle,
                                     const Reference[],
                                     std::size_t,
                                     const std::uint64_t counters[],
                                     const std::uint64_t resolutions[]);
LATSCH_C Status fmi3EvaluateDiscreteStates(Handle);
LATSCH_C Status fmi3UpdateDiscreteStates(
    Handle, bool* again, bool* terminate, bool* nominals, bool* states, bool* timed, double* next);

LATSCH_C Status fmi3EnterContinuousTimeMode(Handle);
LATSCH_C Status fmi3CompletedIntegratorStep(Handle, bool, bool* event, bool* terminate);
LATSCH_C Status fmi3SetTime(Handle, double);
LATSCH_C Status fmi3SetContinuousStates(Handle, const double[], std::size_t);
LATSCH_C Status fmi3GetContinuousStateDerivatives(Handle, double[], std::size_t);
LATSCH_C Status fmi3GetEventIndicators(Handle, double[], std::size_t);
LATSCH_C Status fmi3GetContinuousStates(Handle, double[], std::size_t);
LATSCH_C Status fmi3GetNominalsOfContinuousStates(Handle, double[], std::size_t);
LATSCH_C Status fmi3GetNumberOfEventIndicators(Handle, std::size_t*);
LATSCH_C Status fmi3GetNumberOfContinuousStates(Handle, std::size_t*);

LATSCH_C Status fmi3GetOutputDerivatives(
    Handle, const Reference[], std::size_t, const std::int32_t orders[], double[], std::size_t);
LATSCH_C Status fmi3DoStep(Handle,
                           double time,
                           double step,
                           bool never_goes_back,
                           bool* event,
                           bool* terminate,
                           bool* early,
                           double* reached);
LATSCH_C Status fmi3ActivateModelPartition(Handle, Reference clock, double time);
#undef LATSCH_C
}

}  // namespace latsch::exchange::fmi3
