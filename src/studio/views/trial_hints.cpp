// SPDX-License-Identifier: Apache-2.0
#include "studio/views/trial_hints.h"

namespace latsch::studio {

std::string words_of(Cause cause) {
  switch (cause) {
    case Cause::point:
      return "the model at this point";
    case Cause::timeout:
      return "the time limit";
    case Cause::bad_output:
      return "an answer that cannot be used";
    case Cause::transient:
    case Cause::not_begun:
      return "a lost worker";
  }
  return "";
}

std::string hint_for(Cause cause) {
  switch (cause) {
    case Cause::point:
      return "Look at the point: latsch simulate shows what happens there. Narrow the bounds if "
             "many such points are close together";
    case Cause::timeout:
      return "Raise timeout in [run], or find out why such points take so long; a raised limit "
             "lets "
             "them be tried again";
    case Cause::bad_output:
      return "The model or program wrote something other than requested: compare its output with "
             "what "
             "the experiments name";
    case Cause::transient:
    case Cause::not_begun:
      return "This says nothing about the point: it is tried again automatically";
  }
  return "";
}

}  // namespace latsch::studio
