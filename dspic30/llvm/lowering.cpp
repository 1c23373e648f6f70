// SPDX-License-Identifier: MIT
#include "dspic30/llvm/lowering.h"

#include <array>
#include <list>

#include "dspic30/llvm/subtarget.h"
#include "dspic30/llvm/target.h"
#include "llvm/CodeGen/MachineFrameInfo.h"

namespace llvm {

namespace {

/// The C name of a routine of the runtime as the linker knows it: with XC16's underscore.
const char* linker_name(const char* c_name) {
  static std::list<std::string> names;
  names.push_back(std::string("_") + c_name);
  return names.back().c_str();
}

}  // namespace

DSPICTargetLowering::DSPICTargetLowering(const TargetMachine& machine, const DSPICSubtarget& subtarget)
    : TargetLowering(machine) {
  addRegisterClass(MVT::i16, &DSPIC::WRegClass);
  computeRegisterProperties(subtarget.getRegisterInfo());
  setStackPointerRegisterToSaveRestore(DSPIC::W15);
  setBooleanContents(ZeroOrOneBooleanContent);
  setMinFunctionAlignment(Align(4));
  setMinimumJumpTableEntries(UINT_MAX);  // a chain of comparisons is shorter and, here, no slower
  setSchedulingPreference(Sched::RegPressure);
  setMaxAtomicSizeInBitsSupported(16);
  MaxStoresPerMemset = MaxStoresPerMemmove = 8;
  MaxStoresPerMemsetOptSize = MaxStoresPerMemmoveOptSize = 4;
  MaxStoresPerMemcpy = MaxStoresPerMemcpyOptSize = 3;  // more: copies.cpp

  const auto act = [this](std::initializer_list<unsigned> operations, MVT type, LegalizeAction action) {
    for (unsigned op : operations) setOperationAction(op, type, action);
  };
  // conditions: words and longs
  for (MVT t : {MVT::i16, MVT::i32}) {
    act({ISD::BR_CC, ISD::SELECT_CC, ISD::SETCC}, t, Custom);
    act({ISD::SELECT}, t, Expand);
  }
  act({ISD::BR_JT, ISD::BRCOND}, MVT::Other, Expand);
  setTargetDAGCombine(ISD::BRCOND);
  setTargetDAGCombine(ISD::SELECT);

  // addresses and the stack
  act({ISD::GlobalAddress, ISD::BlockAddress, ISD::ExternalSymbol, ISD::RETURNADDR, ISD::FRAMEADDR,
       ISD::DYNAMIC_STACKALLOC},
      MVT::i16, Custom);
  act({ISD::STACKSAVE, ISD::STACKRESTORE, ISD::VACOPY, ISD::VAEND}, MVT::Other, Expand);
  act({ISD::VASTART, ISD::VAARG, ISD::PREFETCH}, MVT::Other, Custom);
  for (MVT t : {MVT::i16, MVT::i32, MVT::i64})
    act({ISD::VAARG}, t, Custom);  // whole, or its words come swapped
  act({ISD::PREFETCH}, MVT::i32, Custom);

  // arithmetic
  act({ISD::SMUL_LOHI, ISD::UMUL_LOHI, ISD::MUL, ISD::SDIVREM, ISD::UDIVREM, ISD::ADDC, ISD::ADDE, ISD::SUBC,
       ISD::SUBE, ISD::BSWAP},
      MVT::i16, Legal);
  act({ISD::MULHS, ISD::MULHU, ISD::SDIV, ISD::UDIV, ISD::SREM, ISD::UREM, ISD::ROTL, ISD::ROTR, ISD::CTLZ,
       ISD::CTTZ, ISD::CTPOP, ISD::UADDO, ISD::USUBO, ISD::UADDSAT, ISD::USUBSAT},
      MVT::i16, Expand);
  act({ISD::SHL_PARTS, ISD::SRL_PARTS, ISD::SRA_PARTS}, MVT::i16, Custom);

  // bytes
  act({ISD::SIGN_EXTEND_INREG}, MVT::i1, Expand);
  act({ISD::SIGN_EXTEND_INREG}, MVT::i8, Legal);
  for (auto kind : {ISD::EXTLOAD, ISD::SEXTLOAD, ISD::ZEXTLOAD}) {
    setLoadExtAction(kind, MVT::i16, MVT::i1, Promote);
    setLoadExtAction(kind, MVT::i16, MVT::i8, Legal);
  }
  setTruncStoreAction(MVT::i16, MVT::i8, Legal);
  for (MVT t : {MVT::i8, MVT::i16}) {
    setIndexedLoadAction(ISD::POST_INC, t, Legal);
    setIndexedStoreAction(ISD::POST_INC, t, Legal);
  }

  static const auto names = [this] {
    std::array<const char*, RTLIB::UNKNOWN_LIBCALL> all{};
    for (int i = 0; i < RTLIB::UNKNOWN_LIBCALL; ++i)
      if (const char* name = getLibcallName(RTLIB::Libcall(i))) all[i] = linker_name(name);
    return all;
  }();
  for (int i = 0; i < RTLIB::UNKNOWN_LIBCALL; ++i) setLibcallName(RTLIB::Libcall(i), names[i]);
}

const char* DSPICTargetLowering::getTargetNodeName(unsigned opcode) const {
  static const char* const names[] = {"CALL",    "RETURN", "RETURN_FROM_INTERRUPT",
                                      "WRAP",    "CMP",    "CMPB",
                                      "BTST",    "BRANCH", "SELECT",
                                      "SELECT2", "SHLV",   "LSRV",
                                      "ASRV",    "COPY"};
  static_assert(std::size(names) == DSPICISD::END - DSPICISD::FIRST - 1, "one name a node");
  return opcode > DSPICISD::FIRST && opcode < DSPICISD::END ? names[opcode - DSPICISD::FIRST - 1] : nullptr;
}

bool DSPICTargetLowering::isLegalAddressingMode(const DataLayout&, const AddrMode& mode, Type* type, unsigned,
                                                Instruction*) const {
  const bool byte = type->isIntegerTy(8);
  if (mode.BaseGV) return !mode.HasBaseReg && !mode.Scale && type->isSized() && !byte;
  if (!mode.HasBaseReg) return mode.Scale == 0 || (mode.Scale == 1 && !mode.BaseOffs);
  if (mode.Scale == 1) return mode.BaseOffs == 0;  // [Ws+Wb], unscaled
  if (mode.Scale) return false;
  return byte ? isInt<10>(mode.BaseOffs) : isInt<11>(mode.BaseOffs) && !(mode.BaseOffs & 1);
}

bool DSPICTargetLowering::getPostIndexedAddressParts(SDNode* n, SDNode* op, SDValue& base, SDValue& offset,
                                                     ISD::MemIndexedMode& mode, SelectionDAG& dag) const {
  const EVT type = cast<LSBaseSDNode>(n)->getMemoryVT();
  if ((type != MVT::i8 && type != MVT::i16) || op->getOpcode() != ISD::ADD) return false;
  auto* step = dyn_cast<ConstantSDNode>(op->getOperand(1));
  if (!step || step->getSExtValue() != int64_t(type.getStoreSize())) return false;
  auto* load = dyn_cast<LoadSDNode>(n);
  if (load && type == MVT::i8 && load->getExtensionType() == ISD::NON_EXTLOAD) return false;
  base = op->getOperand(0);
  offset = dag.getConstant(step->getZExtValue(), SDLoc(n), MVT::i16);
  mode = ISD::POST_INC;
  return true;
}

SDValue DSPICTargetLowering::LowerOperation(SDValue op, SelectionDAG& dag) const {
  const SDLoc where(op);
  const auto wrap = [&](SDValue address) { return dag.getNode(DSPICISD::WRAP, where, MVT::i16, address); };
  // Addresses are wrapped, so that selection knows them; the others have functions of their own.
  switch (op.getOpcode()) {
    case ISD::GlobalAddress: {
      auto* g = cast<GlobalAddressSDNode>(op);
      return wrap(dag.getTargetGlobalAddress(g->getGlobal(), where, MVT::i16, g->getOffset()));
    }
    case ISD::ExternalSymbol:
      return wrap(dag.getTargetExternalSymbol(cast<ExternalSymbolSDNode>(op)->getSymbol(), MVT::i16));
    case ISD::BlockAddress: {
      auto* b = cast<BlockAddressSDNode>(op);
      return wrap(dag.getTargetBlockAddress(b->getBlockAddress(), MVT::i16, b->getOffset()));
    }
    case ISD::PREFETCH:
      return op.getOperand(0);  // there is no cache
    case ISD::RETURNADDR:
    case ISD::FRAMEADDR:
      return frame_or_return_address(op, dag);
    case ISD::BR_CC:
    case ISD::SETCC:
    case ISD::SELECT_CC:
      return lower_condition(op, dag);
    case ISD::SHL_PARTS:
    case ISD::SRL_PARTS:
    case ISD::SRA_PARTS:
      return shift_long(op, dag);
    case ISD::DYNAMIC_STACKALLOC:
      return grow_stack(op, dag);
    case ISD::VASTART:
      return start_variable_arguments(op, dag);
    case ISD::VAARG:
      return next_variable_argument(op, dag);
  }
  report_fatal_error("dsPIC: an operation is neither legal nor lowered");
}

void DSPICTargetLowering::ReplaceNodeResults(SDNode* n, SmallVectorImpl<SDValue>& results,
                                             SelectionDAG& dag) const {
  if (n->getOpcode() == ISD::VAARG) {
    SDValue value = next_variable_argument(SDValue(n, 0), dag);
    results.push_back(value);
    results.push_back(value.getValue(1));
  } else if (n->getOpcode() == ISD::SELECT_CC && n->getValueType(0) == MVT::i32) {
    if (SDValue value = select_long(n, dag)) results.push_back(value);
  }
}

// --- the stack

SDValue DSPICTargetLowering::frame_or_return_address(SDValue op, SelectionDAG& dag) const {
  constexpr unsigned kSavedFrame = 2, kReturnAddress = 6;  // below W14
  const SDLoc where(op);
  dag.getMachineFunction().getFrameInfo().setFrameAddressIsTaken(true);
  const auto below = [&](SDValue p, unsigned bytes) {
    SDValue at = dag.getNode(ISD::SUB, where, MVT::i16, p, dag.getConstant(bytes, where, MVT::i16));
    return dag.getLoad(MVT::i16, where, dag.getEntryNode(), at, MachinePointerInfo());
  };
  SDValue frame = dag.getCopyFromReg(dag.getEntryNode(), where, DSPIC::W14, MVT::i16);
  for (uint64_t depth = cast<ConstantSDNode>(op.getOperand(0))->getZExtValue(); depth; --depth)
    frame = below(frame, kSavedFrame);
  return op.getOpcode() == ISD::FRAMEADDR ? frame : below(frame, kReturnAddress);
}

SDValue DSPICTargetLowering::grow_stack(SDValue op, SelectionDAG& dag) const {
  const SDLoc where(op);
  const auto constant = [&](unsigned v) { return dag.getConstant(v, where, MVT::i16); };
  // the stack grows upwards: the block begins where W15 was
  SDValue block = dag.getCopyFromReg(op.getOperand(0), where, DSPIC::W15, MVT::i16);
  SDValue even =
      dag.getNode(ISD::AND, where, MVT::i16,
                  dag.getNode(ISD::ADD, where, MVT::i16, op.getOperand(1), constant(1)), constant(0xFFFE));
  SDValue chain = dag.getCopyToReg(block.getValue(1), where, DSPIC::W15,
                                   dag.getNode(ISD::ADD, where, MVT::i16, block, even));
  return dag.getMergeValues({block, chain}, where);
}

// --- variable arguments lie one below the other; va_list is the address above the next

SDValue DSPICTargetLowering::start_variable_arguments(SDValue op, SelectionDAG& dag) const {
  constexpr int kReturnAddress = 4;
  auto& mf = dag.getMachineFunction();
  const int named = mf.getInfo<DSPICFunctionInfo>()->named_stack_bytes;
  const int object = mf.getFrameInfo().CreateFixedObject(2, -kReturnAddress - named, true);
  return dag.getStore(op.getOperand(0), SDLoc(op), dag.getFrameIndex(object, MVT::i16), op.getOperand(1),
                      MachinePointerInfo(cast<SrcValueSDNode>(op.getOperand(2))->getValue()));
}

SDValue DSPICTargetLowering::next_variable_argument(SDValue op, SelectionDAG& dag) const {
  const SDLoc where(op);
  const EVT type = op.getValueType();
  SDValue list = op.getOperand(1);
  SDValue above = dag.getLoad(MVT::i16, where, op.getOperand(0), list, MachinePointerInfo());
  SDValue size = dag.getConstant(alignTo(type.getStoreSize(), 2), where, MVT::i16);
  SDValue at = dag.getNode(ISD::SUB, where, MVT::i16, above, size);
  SDValue stored = dag.getStore(above.getValue(1), where, at, list, MachinePointerInfo());
  return dag.getLoad(type, where, stored, at, MachinePointerInfo());
}

// --- inline assembler

TargetLowering::ConstraintType DSPICTargetLowering::getConstraintType(StringRef constraint) const {
  if (constraint.size() == 1 && StringRef(kDspicRegisterLetters).contains(constraint[0]))
    return C_RegisterClass;
  if (constraint.size() == 1 && StringRef(kDspicNumberLetters).contains(constraint[0])) return C_Immediate;
  return TargetLowering::getConstraintType(constraint);
}

/// The front end has checked the range; what is left is any number.
void DSPICTargetLowering::LowerAsmOperandForConstraint(SDValue value, std::string& constraint,
                                                       std::vector<SDValue>& operands,
                                                       SelectionDAG& dag) const {
  std::string number = "n";
  const bool is_number = getConstraintType(constraint) == C_Immediate && constraint != "i";
  TargetLowering::LowerAsmOperandForConstraint(value, is_number ? number : constraint, operands, dag);
}

std::pair<unsigned, const TargetRegisterClass*> DSPICTargetLowering::getRegForInlineAsmConstraint(
    const TargetRegisterInfo* tri, StringRef constraint, MVT type) const {
  struct Letter {
    char letter;
    unsigned reg;  // 0: any of the class
    const TargetRegisterClass* of;
  };
  static const Letter kLetters[] = {
      {'a', DSPIC::W0, &DSPIC::WRegClass},    {'b', DSPIC::W1, &DSPIC::WRegClass},
      {'c', DSPIC::W2, &DSPIC::WRegClass},    {'d', 0, &DSPIC::WConstraintDRegClass},
      {'e', 0, &DSPIC::WGE2RegClass},         {'r', 0, &DSPIC::WRegClass},
      {'t', DSPIC::W7, &DSPIC::WRegClass},    {'u', 0, &DSPIC::WConstraintURegClass},
      {'v', DSPIC::W13, &DSPIC::WRegClass},   {'x', 0, &DSPIC::WConstraintXRegClass},
      {'y', 0, &DSPIC::WConstraintYRegClass}, {'z', 0, &DSPIC::WConstraintZRegClass}};
  for (const Letter& l : kLetters)
    if (constraint.size() == 1 && constraint[0] == l.letter) return {l.reg, l.of};
  return TargetLowering::getRegForInlineAsmConstraint(tri, constraint, type);
}

}  // namespace llvm
