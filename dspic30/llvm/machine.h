// SPDX-License-Identifier: MIT
// The target machine: which passes run between the IR and the words.
#pragma once
#include "dspic30/llvm/subtarget.h"
#include "dspic30/llvm/target.h"
#include "llvm/CodeGen/TargetLoweringObjectFileImpl.h"
#include "llvm/Target/TargetMachine.h"

namespace llvm {

class DSPICTargetMachine : public LLVMTargetMachine {
 public:
  DSPICTargetMachine(const Target& target, const Triple& triple, StringRef cpu, StringRef features,
                     const TargetOptions& options, Optional<Reloc::Model>, Optional<CodeModel::Model>,
                     CodeGenOpt::Level level, bool);
  const DSPICSubtarget* getSubtargetImpl(const Function&) const override { return &subtarget_; }
  TargetLoweringObjectFile* getObjFileLowering() const override { return sections_.get(); }
  TargetPassConfig* createPassConfig(PassManagerBase& passes) override;
  TargetTransformInfo getTargetTransformInfo(const Function& f) override;

 private:
  std::unique_ptr<TargetLoweringObjectFile> sections_;
  DSPICSubtarget subtarget_;
};

FunctionPass* create_dspic_selection(TargetMachine& machine, CodeGenOpt::Level level);
/// Drops a CP0 whose flags are there already.
FunctionPass* create_dspic_flag_reuse();
FunctionPass* create_dspic_unoptimised();
FunctionPass* create_dspic_long_flag_reuse();
FunctionPass* create_dspic_tail_calls();
std::unique_ptr<TargetLoweringObjectFile> create_dspic_sections();

}  // namespace llvm
