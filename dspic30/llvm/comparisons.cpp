// SPDX-License-Identifier: MIT
// Comparisons. CP subtracts and keeps the flags; CPB goes on with the borrow, and leaves Z set
// only if it was set. So CP of the low words and CPB of the high ones have all fourteen conditions
// of a long ready. What is neither a branch nor needs none becomes one: a select is two blocks and
// a PHI (EmitInstrWithCustomInserter).
#include "dspic30/llvm/subtarget.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"

namespace llvm {

namespace {

bool is_literal5(const APInt& v) { return v.ult(32); }

/// x > c is x >= c+1, and x < c is x <= c-1: takes the form whose literal is short.
void shorten_literal(SDValue& r, ISD::CondCode& code, const SDLoc& where, SelectionDAG& dag) {
  auto* c = dyn_cast<ConstantSDNode>(r);
  if (!c || is_literal5(c->getAPIntValue())) return;
  const APInt v = c->getAPIntValue();
  ISD::CondCode other = ISD::SETCC_INVALID;
  APInt moved = v + 1;
  if (is_literal5(moved)) {
    other = code == ISD::SETGT ? ISD::SETGE : code == ISD::SETLE ? ISD::SETLT : ISD::SETCC_INVALID;
  } else if (is_literal5(moved = v - 1)) {
    switch (code) {
      case ISD::SETLT:
        other = ISD::SETLE;
        break;
      case ISD::SETGE:
        other = ISD::SETGT;
        break;
      case ISD::SETULT:
        other = ISD::SETULE;
        break;
      case ISD::SETUGE:
        other = ISD::SETUGT;
        break;
      default:
        break;
    }
  }
  if (other == ISD::SETCC_INVALID) return;
  code = other;
  r = dag.getConstant(moved, where, r.getValueType());
}

unsigned condition_of(ISD::CondCode code) {
  switch (code) {
    case ISD::SETEQ:
      return DSPICCC::Z;
    case ISD::SETNE:
      return DSPICCC::NZ;
    case ISD::SETLT:
      return DSPICCC::LT;
    case ISD::SETLE:
      return DSPICCC::LE;
    case ISD::SETGT:
      return DSPICCC::GT;
    case ISD::SETGE:
      return DSPICCC::GE;
    case ISD::SETULT:
      return DSPICCC::LTU;
    case ISD::SETULE:
      return DSPICCC::LEU;
    case ISD::SETUGT:
      return DSPICCC::GTU;
    case ISD::SETUGE:
      return DSPICCC::GEU;
    default:
      report_fatal_error("dsPIC: a condition integers do not have");
  }
}

SDValue half(SDValue v, unsigned n, const SDLoc& where, SelectionDAG& dag) {
  return dag.getNode(ISD::EXTRACT_ELEMENT, where, MVT::i16, v, dag.getIntPtrConstant(n, where));
}

bool is_zero(SDValue v) {
  auto* c = dyn_cast<ConstantSDNode>(v);
  return c && c->isZero();
}

}  // namespace

SDValue DSPICTargetLowering::compare(SDValue l, SDValue r, ISD::CondCode code, unsigned& condition,
                                     const SDLoc& where, SelectionDAG& dag) const {
  if (isa<ConstantSDNode>(l)) {
    std::swap(l, r);
    code = ISD::getSetCCSwappedOperands(code);
  }
  shorten_literal(r, code, where, dag);
  condition = condition_of(code);
  return l.getValueType() == MVT::i16 ? compare_words(l, r, code, where, dag)
                                      : compare_longs(l, r, code, where, dag);
}

SDValue DSPICTargetLowering::compare_words(SDValue l, SDValue r, ISD::CondCode code, const SDLoc& where,
                                           SelectionDAG& dag) const {
  const bool of_equality = code == ISD::SETEQ || code == ISD::SETNE;
  if (is_zero(r) && of_equality && l.getOpcode() == ISD::AND && l.hasOneUse()) {
    auto* mask = dyn_cast<ConstantSDNode>(l.getOperand(1));
    if (mask && mask->getAPIntValue().isPowerOf2()) {
      SDValue bit = dag.getConstant(mask->getAPIntValue().logBase2(), where, MVT::i16);
      return dag.getNode(DSPICISD::BTST, where, MVT::Glue, l.getOperand(0), bit);
    }
  }
  return dag.getNode(DSPICISD::CMP, where, MVT::Glue, l, r);
}

SDValue DSPICTargetLowering::compare_longs(SDValue l, SDValue r, ISD::CondCode code, const SDLoc& where,
                                           SelectionDAG& dag) const {
  const bool of_sign = is_zero(r) && (code == ISD::SETLT || code == ISD::SETGE);
  SDValue high_l = half(l, 1, where, dag), high_r = half(r, 1, where, dag);
  if (of_sign) return dag.getNode(DSPICISD::CMP, where, MVT::Glue, high_l, high_r);
  SDValue low = dag.getNode(DSPICISD::CMP, where, MVT::Glue, half(l, 0, where, dag), half(r, 0, where, dag));
  return dag.getNode(DSPICISD::CMPB, where, MVT::Glue, high_l, high_r, low);
}

SDValue DSPICTargetLowering::lower_condition(SDValue op, SelectionDAG& dag) const {
  const SDLoc where(op);
  const auto flags_of = [&](unsigned l, unsigned r, unsigned code, SDValue& condition) {
    unsigned c;
    SDValue flags = compare(op.getOperand(l), op.getOperand(r),
                            cast<CondCodeSDNode>(op.getOperand(code))->get(), c, where, dag);
    condition = dag.getTargetConstant(c, where, MVT::i16);
    return flags;
  };
  SDValue c;
  if (op.getOpcode() == ISD::BR_CC) {
    SDValue flags = flags_of(2, 3, 1, c);
    return dag.getNode(DSPICISD::BRANCH, where, MVT::Other, op.getOperand(0), op.getOperand(4), c, flags);
  }
  if (op.getOpcode() == ISD::SETCC) {
    SDValue flags = flags_of(0, 1, 2, c);
    return dag.getNode(DSPICISD::SELECT, where, MVT::i16, dag.getConstant(1, where, MVT::i16),
                       dag.getConstant(0, where, MVT::i16), c, flags);
  }
  if (op.getValueType() != MVT::i16) return SDValue();  // ReplaceNodeResults() takes longs
  SDValue flags = flags_of(0, 1, 4, c);
  return dag.getNode(DSPICISD::SELECT, where, MVT::i16, op.getOperand(2), op.getOperand(3), c, flags);
}

SDValue DSPICTargetLowering::select_long(SDNode* n, SelectionDAG& dag) const {
  const SDLoc where(n);
  const auto code = cast<CondCodeSDNode>(n->getOperand(4))->get();
  SDValue l = n->getOperand(0), r = n->getOperand(1);
  if (l.getValueType() != MVT::i16 && l.getValueType() != MVT::i32) {
    if (l.getScalarValueSizeInBits() > 32) return SDValue();  // the legalizer narrows it first
    const unsigned extend = ISD::isSignedIntSetCC(code) ? ISD::SIGN_EXTEND : ISD::ZERO_EXTEND;
    l = dag.getNode(extend, where, MVT::i16, l);
    r = dag.getNode(extend, where, MVT::i16, r);
  }
  unsigned condition;
  SDValue flags = compare(l, r, code, condition, where, dag);
  SDValue yes = n->getOperand(2), no = n->getOperand(3);
  SDValue words =
      dag.getNode(DSPICISD::SELECT2, where, dag.getVTList(MVT::i16, MVT::i16),
                  {half(yes, 0, where, dag), half(yes, 1, where, dag), half(no, 0, where, dag),
                   half(no, 1, where, dag), dag.getTargetConstant(condition, where, MVT::i16), flags});
  return dag.getNode(ISD::BUILD_PAIR, where, MVT::i32, words, words.getValue(1));
}

/// The generic combiner joins a comparison with its branch only for legal types; CP and CPB
/// compare longs as well.
SDValue DSPICTargetLowering::PerformDAGCombine(SDNode* n, DAGCombinerInfo& info) const {
  SelectionDAG& dag = info.DAG;
  const bool is_branch = n->getOpcode() == ISD::BRCOND;
  SDValue c = n->getOperand(is_branch ? 1 : 0);
  const bool inverted = c.getOpcode() == ISD::XOR && isOneConstant(c.getOperand(1));
  if (inverted) c = c.getOperand(0);
  if (!info.isBeforeLegalize() || c.getOpcode() != ISD::SETCC || c.getOperand(0).getValueType() != MVT::i32)
    return SDValue();
  auto code = cast<CondCodeSDNode>(c.getOperand(2))->get();
  if (inverted) code = ISD::getSetCCInverse(code, MVT::i32);
  SDValue l = c.getOperand(0), r = c.getOperand(1);
  if (is_branch)
    return dag.getNode(ISD::BR_CC, SDLoc(n), MVT::Other, n->getOperand(0), dag.getCondCode(code), l, r,
                       n->getOperand(2));
  return dag.getNode(ISD::SELECT_CC, SDLoc(n), n->getValueType(0), l, r, n->getOperand(1), n->getOperand(2),
                     dag.getCondCode(code));
}

MachineBasicBlock* DSPICTargetLowering::EmitInstrWithCustomInserter(MachineInstr& mi,
                                                                    MachineBasicBlock* block) const {
  // block: BRA cc, join; other: falls through; join: PHI of both
  auto& mf = *block->getParent();
  const auto& ii = *mf.getSubtarget().getInstrInfo();
  const DebugLoc where = mi.getDebugLoc();
  auto* other = mf.CreateMachineBasicBlock(block->getBasicBlock());
  auto* join = mf.CreateMachineBasicBlock(block->getBasicBlock());
  const auto at = std::next(block->getIterator());
  mf.insert(at, other);
  mf.insert(at, join);
  join->splice(join->begin(), block, std::next(MachineBasicBlock::iterator(mi)), block->end());
  join->transferSuccessorsAndUpdatePHIs(block);
  block->addSuccessor(other);
  block->addSuccessor(join);
  other->addSuccessor(join);

  const unsigned words = mi.getOpcode() == DSPIC::SELECT2 ? 2 : 1;
  BuildMI(block, where, ii.get(DSPIC::BRAcc)).addMBB(join).addImm(mi.getOperand(3 * words).getImm());
  for (unsigned i = 0; i < words; ++i)
    BuildMI(*join, join->begin(), where, ii.get(DSPIC::PHI), mi.getOperand(i).getReg())
        .addReg(mi.getOperand(words + i).getReg())
        .addMBB(block)
        .addReg(mi.getOperand(2 * words + i).getReg())
        .addMBB(other);
  mi.eraseFromParent();
  return join;
}

}  // namespace llvm
