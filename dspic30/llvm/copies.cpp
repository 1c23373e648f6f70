// SPDX-License-Identifier: MIT
// Copies whose size is known: by REPEAT, one cycle a word or byte, where that takes less than a load and a
// store each; what is smaller one by one (MaxStoresPerMemcpy), the rest by a call of the library.
#include "dspic30/llvm/subtarget.h"

namespace llvm {

SDValue DSPICSelectionInfo::EmitTargetCodeForMemcpy(SelectionDAG& dag, const SDLoc& where, SDValue chain,
                                                    SDValue to, SDValue from, SDValue bytes, Align align,
                                                    bool, bool, MachinePointerInfo to_info,
                                                    MachinePointerInfo from_info) const {
  // two pointers and REPEAT: 3 instructions and 3 + n cycles, against 2 n and 2 n
  constexpr uint64_t kFewest = 4, kMost = 1u << 14;
  const auto* size = dyn_cast<ConstantSDNode>(bytes);
  if (!size) return SDValue();
  const unsigned step = align < 2 ? 1 : 2;
  const uint64_t rounds = size->getZExtValue() / step;
  if (rounds < kFewest || rounds > kMost) return SDValue();
  // no memory operand: it stays before and behind whatever else touches memory
  SDValue copied = dag.getNode(DSPICISD::COPY, where, MVT::Other,
                               {chain, to, from, dag.getTargetConstant(rounds, where, MVT::i16),
                                dag.getTargetConstant(step, where, MVT::i16)});
  const uint64_t last = rounds * step;
  if (size->getZExtValue() == last) return copied;
  const auto behind = [&](SDValue p) {
    return dag.getNode(ISD::ADD, where, MVT::i16, p, dag.getConstant(last, where, MVT::i16));
  };
  SDValue byte = dag.getExtLoad(ISD::ZEXTLOAD, where, MVT::i16, copied, behind(from),
                                from_info.getWithOffset(last), MVT::i8, Align(1));
  return dag.getTruncStore(byte.getValue(1), where, byte, behind(to), to_info.getWithOffset(last), MVT::i8,
                           Align(1));
}

}  // namespace llvm
