// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 2.0 for co-simulation, as other programs call them [Functional Mock-up
// Interface 2.0.5, 2.1 and 4.2]: names, arguments and values of the standard, declared again in
// this header.
//
// Boolean is int, 0 or 1. Functions for features that Latsch's units lack (integers, texts,
// derivatives, serialized states) exist and return `error`. Functions that only model exchange
// needs do not exist: importers of co-simulation units do not look for them.
#pragma once

#include <cstddef>

#include "exchange/exported.h"

namespace latsch::exchange::fmi2 {

enum Status : int { ok, warning, discard, error, fatal, pending };
enum Type : int { model_exchange, co_simulation };
enum StatusKind : int { do_step_status, pending_status, last_successful_time, terminated };

using Component = void*;
using State = void*;
using Reference = unsigned;
using Text = const char*;

struct Callbacks {
  void (*logger)(void* environment, Text instance, Status, Text category, Text message, ...);
  void* (*allocate)(std::size_t count, std::size_t size);
  void (*free)(void* memory);
  void (*step_finished)(void* environment, Status);
  void* environment;
};

extern "C" {
#define LATSCH_C LATSCH_EXPORTED
LATSCH_C Text fmi2GetTypesPlatform();
LATSCH_C Text fmi2GetVersion();
LATSCH_C Status fmi2SetDebugLogging(Component, int on, std::size_t count, const Text categories[]);

LATSCH_C Component fmi2Instantiate(
    Text name, Type, Text guid, Text resources, const Callbacks*, int visible, int logging);
LATSCH_C void fmi2FreeInstance(Component);
LATSCH_C Status fmi2SetupExperiment(
    Component, int with_tolerance, double tolerance, double start, int with_stop, double stop);
LATSCH_C Status fmi2EnterInitializationMode(Component);
LATSCH_C Status fmi2ExitInitializationMode(Component);
LATSCH_C Status fmi2Terminate(Component);
LATSCH_C Status fmi2Reset(Component);

LATSCH_C Status fmi2GetReal(Component, const Reference[], std::size_t count, double values[]);
LATSCH_C Status fmi2SetReal(Component, const Reference[], std::size_t count, const double values[]);
LATSCH_C Status fmi2GetInteger(Component, const Reference[], std::size_t count, int values[]);
LATSCH_C Status fmi2SetInteger(Component, const Reference[], std::size_t count, const int values[]);
LATSCH_C Status fmi2GetBoolean(Component, const Reference[], std::size_t count, int values[]);
LATSCH_C Status fmi2SetBoolean(Component, const Reference[], std::size_t count, const int values[]);
LATSCH_C Status fmi2GetString(Component, const Reference[], std::size_t count, Text values[]);
LATSCH_C Status fmi2SetString(Component, const Reference[], std::size_t count, const Text values[]);

LATSCH_C Status fmi2GetFMUstate(Component, State*);
LATSCH_C Status fmi2SetFMUstate(Component, State);
LATSCH_C Status fmi2FreeFMUstate(Component, State*);
LATSCH_C Status fmi2SerializedFMUstateSize(Component, State, std::size_t* size);
LATSCH_C Status fmi2SerializeFMUstate(Component, State, char bytes[], std::size_t size);
LATSCH_C Status fmi2DeSerializeFMUstate(Component, const char bytes[], std::size_t size, State*);
LATSCH_C Status fmi2GetDirectionalDerivative(Component,
                                             const Reference unknowns[],
                                             std::size_t unknown_count,
                                             const Reference knowns[],
                                             std::size_t known_count,
                                             const double seed[],
                                             double sensitivity[]);

LATSCH_C Status fmi2SetRealInputDerivatives(
    Component, const Reference[], std::size_t count, const int orders[], const double values[]);
LATSCH_C Status fmi2GetRealOutputDerivatives(
    Component, const Reference[], std::size_t count, const int orders[], double values[]);
LATSCH_C Status fmi2DoStep(Component, double time, double step, int never_goes_back);
LATSCH_C Status fmi2CancelStep(Component);
LATSCH_C Status fmi2GetStatus(Component, StatusKind, Status* value);
LATSCH_C Status fmi2GetRealStatus(Component, StatusKind, double* value);
LATSCH_C Status fmi2GetIntegerStatus(Component, StatusKind, int* value);
LATSCH_C Status fmi2GetBooleanStatus(Component, StatusKind, int* value);
LATSCH_C Status fmi2GetStringStatus(Component, StatusKind, Text* value);
#undef LATSCH_C
}

}  // namespace latsch::exchange::fmi2
