// SPDX-License-Identifier: MIT
#include "dspic30/llvm/mc.h"

#include "dspic30/llvm/target.h"
#include "llvm/MC/MCAsmBackend.h"
#include "llvm/MC/MCAsmInfoELF.h"
#include "llvm/MC/MCCodeEmitter.h"
#include "llvm/MC/MCInstPrinter.h"
#include "llvm/MC/MCInstrInfo.h"
#include "llvm/MC/MCRegisterInfo.h"
#include "llvm/MC/MCSubtargetInfo.h"

#define GET_REGINFO_MC_DESC
#include "DSPICGenRegisterInfo.inc"
#define GET_INSTRINFO_MC_DESC
#include "DSPICGenInstrInfo.inc"
#define GET_SUBTARGETINFO_MC_DESC
#include "DSPICGenSubtargetInfo.inc"

namespace llvm {

namespace {

/// The syntax of assembler text and of debugging information.
class AsmSyntax : public MCAsmInfoELF {
 public:
  AsmSyntax() {
    CodePointerSize = 4;  // of debugging information; machine.cpp says why
    CalleeSaveStackSlotSize = 2;
    MinInstAlignment = 4;
    MaxInstLength = 8;
    CommentString = ";";
    SeparatorString = "\n";
    Data16bitsDirective = "\t.word\t";
    Data32bitsDirective = "\t.long\t";
    PrivateGlobalPrefix = PrivateLabelPrefix = ".L";
    UsesELFSectionDirectiveForBSS = true;
    SupportsDebugInformation = true;
  }
};

}  // namespace

void register_dspic_mc(Target& t) {
  using Registry = TargetRegistry;
  Registry::RegisterMCAsmInfo(t,
                              [](const MCRegisterInfo&, const Triple&, const MCTargetOptions&) -> MCAsmInfo* {
                                return new AsmSyntax;
                              });
  Registry::RegisterMCInstrInfo(t, [] {
    auto* info = new MCInstrInfo;
    InitDSPICMCInstrInfo(info);
    return info;
  });
  Registry::RegisterMCRegInfo(t, [](const Triple&) {
    auto* info = new MCRegisterInfo;
    InitDSPICMCRegisterInfo(info, DSPIC::W0);
    return info;
  });
  Registry::RegisterMCSubtargetInfo(t, [](const Triple& triple, StringRef cpu, StringRef features) {
    return createDSPICMCSubtargetInfoImpl(triple, cpu, cpu, features);
  });
  Registry::RegisterMCInstPrinter(
      t, [](const Triple&, unsigned, const MCAsmInfo& syntax, const MCInstrInfo& ii,
            const MCRegisterInfo& ri) { return create_dspic_printer(syntax, ii, ri); });
  Registry::RegisterMCCodeEmitter(t, [](const MCInstrInfo& ii, const MCRegisterInfo&, MCContext& context) {
    return create_dspic_encoder(ii, context);
  });
  Registry::RegisterMCAsmBackend(t, [](const Target&, const MCSubtargetInfo&, const MCRegisterInfo&,
                                       const MCTargetOptions&) { return create_dspic_object_backend(); });
}

}  // namespace llvm
