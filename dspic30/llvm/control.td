// SPDX-License-Identifier: MIT
// Branches, calls, frames, and single words that other parts put in.
let isBranch = 1, isTerminator = 1 in {
  let isBarrier = 1, hasSideEffects = 0 in
  def BRA : I<(outs), (ins brtarget:$t), "bra\t$t", [(br bb:$t)]> { bits<16> t; let Inst{23-16} = 0x37; let Inst{15-0} = t; }
  let Uses = [SR], hasSideEffects = 0 in
  def BRAcc : I<(outs), (ins brtarget:$t, ccop:$cc), "bra\t$cc, $t", [(dsbrcc bb:$t, timm:$cc)]> {
    bits<16> t; bits<4> cc; let Inst{23-20} = 3; let Inst{19-16} = cc; let Inst{15-0} = t; }
}
let isBranch = 1, isTerminator = 1, isBarrier = 1, isIndirectBranch = 1, hasSideEffects = 0 in
def GOTOW : I<(outs), (ins W:$s), "goto\t$s", [(brind W:$s)]> { bits<4> s; let Inst{23-4} = 0x01400; let Inst{3-0} = s; }
let isCall = 1, Defs = [SR], Uses = [W15] in {
  // what it does not reach it calls by way of a GOTO that the linker puts in reach
  def RCALL : I<(outs), (ins calltarget:$t, variable_ops), "rcall\t$t", []> { bits<16> t; let Inst{23-16} = 0x07; let Inst{15-0} = t; }
  def CALLW : I<(outs), (ins W:$s, variable_ops), "call\t$s", [(dscall W:$s)]> { bits<4> s; let Inst{23-4} = 0x01000; let Inst{3-0} = s; }
}
def : Pat<(dscall tglobaladdr:$t), (RCALL tglobaladdr:$t)>;
def : Pat<(dscall texternalsym:$t), (RCALL texternalsym:$t)>;
let isReturn = 1, isTerminator = 1, isBarrier = 1 in {
  // a call right before the return (tail_calls.cpp)
  def BRAtail : I<(outs), (ins calltarget:$t, variable_ops), "bra\t$t", []> { bits<16> t; let Inst{23-16} = 0x37; let Inst{15-0} = t; }
  def GOTOtail : I<(outs), (ins W:$s, variable_ops), "goto\t$s", []> { bits<4> s; let Inst{23-4} = 0x01400; let Inst{3-0} = s; }
  def RETURN : I<(outs), (ins), "return", [(dsret)]> { let Inst = 0x060000; }
  def RETFIE : I<(outs), (ins), "retfie", [(dsreti)]> { let Inst = 0x064000; }
}
let hasSideEffects = 1 in {
  let Defs = [W14, W15], Uses = [W14, W15] in {
    def LNK : I<(outs), (ins lit14:$k), "lnk\t$k"> { bits<14> k; let Inst{23-14} = 0b1111101000; let Inst{13-0} = k; }
    def ULNK : I<(outs), (ins), "ulnk"> { let Inst = 0xFA8000; }
  }
  let Defs = [W15], Uses = [W15] in {
    def PUSH : I<(outs), (ins W:$s), "push\t$s"> { bits<4> s; let Inst{23-4} = 0x781F8; let Inst{3-0} = s; }
    def POP : I<(outs W:$d), (ins), "pop\t$d"> { bits<4> d; let Inst{23-11} = 0b0111100000000; let Inst{10-7} = d; let Inst{6-0} = 0b1001111; }
    def PUSHD : I<(outs), (ins WP:$s), "push.d\t$s"> { bits<4> s; let Inst{23-4} = 0xBE9F8; let Inst{3-0} = s; }
    def POPD : I<(outs WP:$d), (ins), "pop.d\t$d"> { bits<4> d; let Inst{23-11} = 0b1011111000000; let Inst{10-8} = d{3-1}; let Inst{7-0} = 0x4F; }
    def PUSHf : I<(outs), (ins filetarget:$f), "push\t$f"> { bits<16> f; let Inst{23-16} = 0xF8; let Inst{15-0} = f; }
    def POPf : I<(outs), (ins filetarget:$f), "pop\t$f"> { bits<16> f; let Inst{23-16} = 0xF9; let Inst{15-0} = f; }
  }
  let Defs = [W0, W1, W2, W3, SR] in
  def POPS : I<(outs), (ins), "pop.s"> { let Inst = 0xFE8000; }
  def PUSHS : I<(outs), (ins), "push.s"> { let Inst = 0xFEA000; }
  def RAW : I<(outs), (ins i32imm:$w), ".pword\t$w"> { bits<24> w; let Inst = w; }   // a word from the assembler
  def NOP : I<(outs), (ins), "nop"> { let Inst = 0; }
  let Defs = [W15, SR], Uses = [W15] in {
    def ADJDOWN : Pseudo<(outs), (ins i16imm:$a, i16imm:$b), [(callseq_start timm:$a, timm:$b)]>;
    def ADJUP : Pseudo<(outs), (ins i16imm:$a, i16imm:$b), [(callseq_end timm:$a, timm:$b)]>;
  }
}
