// SPDX-License-Identifier: MIT
// Shifts of longs by a variable amount, without a branch: a register shift looks at five bits of its amount,
// and 16 to 31 shift everything out. So for n in 0..31 the words of hi:lo << n are
//
//     lo << n          hi << n  |  lo >> (16 - n)  |  lo << (n - 16)
//
// where of the last two at most one is not zero, and for n = 16 both are the same.
#include "dspic30/llvm/subtarget.h"

namespace llvm {

SDValue DSPICTargetLowering::shift_long(SDValue op, SelectionDAG& dag) const {
  const SDLoc where(op);
  const auto node = [&](unsigned opcode, SDValue a, SDValue b) {
    return dag.getNode(opcode, where, MVT::i16, a, b);
  };
  SDValue lo = op.getOperand(0), hi = op.getOperand(1), n = op.getOperand(2);
  SDValue k16 = dag.getConstant(16, where, MVT::i16);
  SDValue back = node(ISD::SUB, k16, n), over = node(ISD::SUB, n, k16);

  if (op.getOpcode() == ISD::SHL_PARTS) {
    SDValue crossing = node(ISD::OR, node(DSPICISD::LSRV, lo, back), node(DSPICISD::SHLV, lo, over));
    SDValue high = node(ISD::OR, node(DSPICISD::SHLV, hi, n), crossing);
    return dag.getMergeValues({node(DSPICISD::SHLV, lo, n), high}, where);
  }
  const bool is_signed = op.getOpcode() == ISD::SRA_PARTS;
  SDValue high = node(is_signed ? DSPICISD::ASRV : DSPICISD::LSRV, hi, n);
  SDValue far = node(DSPICISD::LSRV, hi, over);
  if (is_signed) {
    // an arithmetic shift by 16 and more leaves the sign, not zero: it counts for n >= 16 only
    unsigned condition;
    SDValue flags = compare(n, k16, ISD::SETUGE, condition, where, dag);
    far = dag.getNode(DSPICISD::SELECT, where, MVT::i16, node(DSPICISD::ASRV, hi, over),
                      dag.getConstant(0, where, MVT::i16), dag.getTargetConstant(condition, where, MVT::i16),
                      flags);
  }
  SDValue crossing = node(ISD::OR, node(DSPICISD::SHLV, hi, back), far);
  SDValue low = node(ISD::OR, node(DSPICISD::LSRV, lo, n), crossing);
  return dag.getMergeValues({low, high}, where);
}

}  // namespace llvm
