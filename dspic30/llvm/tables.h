// SPDX-License-Identifier: MIT
// What llvm-tblgen made of dspic.td: numbers of registers and instructions, and the base
// classes built on them.
#pragma once
#include "llvm/CodeGen/TargetInstrInfo.h"
#include "llvm/CodeGen/TargetRegisterInfo.h"
#include "llvm/CodeGen/TargetSubtargetInfo.h"

#define GET_REGINFO_ENUM
#define GET_REGINFO_HEADER
#include "DSPICGenRegisterInfo.inc"
#define GET_INSTRINFO_ENUM
#define GET_INSTRINFO_HEADER
#include "DSPICGenInstrInfo.inc"
#define GET_SUBTARGETINFO_ENUM
#define GET_SUBTARGETINFO_HEADER
#include "DSPICGenSubtargetInfo.inc"

namespace llvm {

/// Conditions as BRA encodes them; bit 3 inverts.
namespace DSPICCC {
enum Condition { OV = 0, GEU, Z, N, LE, LT, LEU, ALWAYS, NOV, LTU, NZ, NN, GT, GE, GTU };
const char* name(unsigned condition);
}  // namespace DSPICCC

}  // namespace llvm
