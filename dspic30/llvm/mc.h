// SPDX-License-Identifier: MIT
// The machine-code layer's parts, one file each: printer.cpp (text), encoder.cpp (words), objects.cpp (ELF).
#pragma once
#include "dspic30/llvm/tables.h"

namespace llvm {
class MCAsmBackend;
class MCAsmInfo;
class MCCodeEmitter;
class MCContext;
class MCInstPrinter;
class MCInstrInfo;
class MCRegisterInfo;

MCInstPrinter* create_dspic_printer(const MCAsmInfo& syntax, const MCInstrInfo& instructions,
                                    const MCRegisterInfo& registers);
MCCodeEmitter* create_dspic_encoder(const MCInstrInfo& instructions, MCContext& context);
MCAsmBackend* create_dspic_object_backend();

}  // namespace llvm
