// SPDX-License-Identifier: MIT
// muParser is loaded when somebody gives a condition: with OpenMP, which it brings, it takes longer to load
// than a fifth of a short run.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(muparser, mupCreate) X(muparser, mupDefineFun1) X(muparser, mupDefineFun2) X(muparser, mupDefineInfixOprt) \
  X(muparser, mupDefineVar) X(muparser, mupError) X(muparser, mupEval) X(muparser, mupEvalMulti) \
  X(muparser, mupGetErrorMsg) X(muparser, mupRelease) X(muparser, mupSetExpr)
// clang-format on

LAZY_LIBRARY(muparser, "libmuparser.so.2", CALLS)
