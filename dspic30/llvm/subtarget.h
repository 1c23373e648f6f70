// SPDX-License-Identifier: MIT
// One chip: instructions, frames and lowering in one place, as LLVM asks for them.
#pragma once
#include "dspic30/llvm/frames.h"
#include "dspic30/llvm/instructions.h"
#include "dspic30/llvm/lowering.h"
#include "llvm/CodeGen/SelectionDAGTargetInfo.h"

namespace llvm {

/// Copies of a size that is known.
class DSPICSelectionInfo : public SelectionDAGTargetInfo {
 public:
  SDValue EmitTargetCodeForMemcpy(SelectionDAG& dag, const SDLoc& where, SDValue chain, SDValue to,
                                  SDValue from, SDValue bytes, Align align, bool is_volatile,
                                  bool always_inline, MachinePointerInfo to_info,
                                  MachinePointerInfo from_info) const override;
};

class DSPICSubtarget : public DSPICGenSubtargetInfo {
 public:
  DSPICSubtarget(const Triple& triple, StringRef cpu, StringRef features, const TargetMachine& machine);
  const DSPICInstrInfo* getInstrInfo() const override { return &instructions_; }
  const DSPICFrameLowering* getFrameLowering() const override { return &frames_; }
  const DSPICTargetLowering* getTargetLowering() const override { return &lowering_; }
  const SelectionDAGTargetInfo* getSelectionDAGInfo() const override { return &selection_; }
  const DSPICRegisterInfo* getRegisterInfo() const override { return &instructions_.registers(); }

 private:
  void ParseSubtargetFeatures(StringRef cpu, StringRef tune, StringRef features);  // made by llvm-tblgen
  DSPICInstrInfo instructions_;
  DSPICFrameLowering frames_;
  DSPICTargetLowering lowering_;
  DSPICSelectionInfo selection_;
};

}  // namespace llvm
