// SPDX-License-Identifier: MIT
// What the selection graph may contain, and how it gets there. One type is legal, the word: bytes are
// widened, longs and floats split into words, floats computed by the runtime.
//
//   lowering.cpp    which operations are legal; addresses, stack, variable arguments
//   comparisons.cpp comparisons, branches and selects
//   long_shifts.cpp shifts of longs by a variable amount
//   calls.cpp       the calling convention
#pragma once
#include "llvm/CodeGen/MachineFunction.h"
#include "llvm/CodeGen/SelectionDAG.h"
#include "llvm/CodeGen/TargetLowering.h"

namespace llvm {

class DSPICSubtarget;

/// Nodes that only this chip has.
namespace DSPICISD {
enum Node : unsigned {
  FIRST = ISD::BUILTIN_OP_END,
  CALL,
  RETURN,
  RETURN_FROM_INTERRUPT,
  WRAP,     // an address as a value
  CMP,      // flags of l - r
  CMPB,     // flags of l - r - borrow, Z only if it was set
  BTST,     // Z: this bit is clear
  BRANCH,   // if the flags say so
  SELECT,   // one of two words by the flags
  SELECT2,  // one of two longs
  SHLV,     // shifts whose amount may be 16 to 31
  LSRV,
  ASRV,
  COPY,  // words or bytes from one address on to another, by REPEAT
  END
};
}

/// What one function's lowering leaves for later steps.
struct DSPICFunctionInfo : MachineFunctionInfo {
  explicit DSPICFunctionInfo(MachineFunction&) {}
  int named_stack_bytes = 0;  // of a variadic function's named arguments; the others lie above
};

class DSPICTargetLowering : public TargetLowering {
 public:
  DSPICTargetLowering(const TargetMachine& machine, const DSPICSubtarget& subtarget);
  const char* getTargetNodeName(unsigned opcode) const override;
  SDValue LowerOperation(SDValue op, SelectionDAG& dag) const override;
  void ReplaceNodeResults(SDNode* n, SmallVectorImpl<SDValue>& results, SelectionDAG& dag) const override;
  SDValue PerformDAGCombine(SDNode* n, DAGCombinerInfo& info) const override;
  MachineBasicBlock* EmitInstrWithCustomInserter(MachineInstr& mi, MachineBasicBlock* block) const override;

  SDValue LowerFormalArguments(SDValue chain, CallingConv::ID id, bool variadic,
                               const SmallVectorImpl<ISD::InputArg>& ins, const SDLoc& where,
                               SelectionDAG& dag, SmallVectorImpl<SDValue>& values) const override;
  SDValue LowerCall(CallLoweringInfo& call, SmallVectorImpl<SDValue>& values) const override;
  SDValue LowerReturn(SDValue chain, CallingConv::ID id, bool variadic,
                      const SmallVectorImpl<ISD::OutputArg>& outs, const SmallVectorImpl<SDValue>& values,
                      const SDLoc& where, SelectionDAG& dag) const override;
  bool CanLowerReturn(CallingConv::ID, MachineFunction&, bool, const SmallVectorImpl<ISD::OutputArg>& outs,
                      LLVMContext&) const override;

  // what loop and address passes ask
  bool isLegalAddressingMode(const DataLayout&, const AddrMode& mode, Type* type, unsigned,
                             Instruction*) const override;
  bool getPostIndexedAddressParts(SDNode* n, SDNode* op, SDValue& base, SDValue& offset,
                                  ISD::MemIndexedMode& mode, SelectionDAG& dag) const override;
  bool isOffsetFoldingLegal(const GlobalAddressSDNode*) const override { return true; }
  bool isLegalICmpImmediate(int64_t v) const override { return v >= 0 && v < 32; }
  bool isLegalAddImmediate(int64_t v) const override { return v > -1024 && v < 1024; }
  // what counts must stay an addition: loops look for one, and the carry is in no register that C can ask
  bool shouldFormOverflowOp(unsigned, EVT, bool) const override { return false; }
  bool isSelectSupported(SelectSupportKind) const override {
    return false;
  }  // a branch, as early as possible
  bool isTruncateFree(Type*, Type*) const override { return true; }
  bool isTruncateFree(EVT, EVT) const override { return true; }
  MVT getScalarShiftAmountTy(const DataLayout&, EVT) const override { return MVT::i16; }
  EVT getSetCCResultType(const DataLayout&, LLVMContext&, EVT) const override { return MVT::i16; }
  MVT::SimpleValueType getCmpLibcallReturnType() const override { return MVT::i16; }

  // inline assembler: "r" any register, "w" as XC16 writes it, "a" W0 and so on
  std::pair<unsigned, const TargetRegisterClass*> getRegForInlineAsmConstraint(const TargetRegisterInfo* tri,
                                                                               StringRef constraint,
                                                                               MVT type) const override;
  ConstraintType getConstraintType(StringRef constraint) const override;
  void LowerAsmOperandForConstraint(SDValue value, std::string& constraint, std::vector<SDValue>& operands,
                                    SelectionDAG& dag) const override;

 private:
  /// Emits the comparison; `condition` is what BRA must ask. The last node's glue are the flags.
  SDValue compare(SDValue l, SDValue r, ISD::CondCode code, unsigned& condition, const SDLoc& where,
                  SelectionDAG& dag) const;
  SDValue compare_words(SDValue l, SDValue r, ISD::CondCode code, const SDLoc& where,
                        SelectionDAG& dag) const;
  SDValue compare_longs(SDValue l, SDValue r, ISD::CondCode code, const SDLoc& where,
                        SelectionDAG& dag) const;
  SDValue lower_condition(SDValue op, SelectionDAG& dag) const;
  SDValue select_long(SDNode* n, SelectionDAG& dag) const;
  SDValue shift_long(SDValue op, SelectionDAG& dag) const;
  SDValue frame_or_return_address(SDValue op, SelectionDAG& dag) const;
  SDValue grow_stack(SDValue op, SelectionDAG& dag) const;
  SDValue start_variable_arguments(SDValue op, SelectionDAG& dag) const;
  SDValue next_variable_argument(SDValue op, SelectionDAG& dag) const;
};

}  // namespace llvm
