// SPDX-License-Identifier: MIT
// Single bits, of registers and of near memory. XC16's programs count on the latter: LATAbits.LATA6 = 1 is one
// BSET, which no interrupt can split.
class Tied<dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> { bits<4> d; let Constraints = "$d = $n"; }
def SWAP : Tied<(outs W:$d), (ins W:$n), "swap\t$d", [(set W:$d, (bswap W:$n))]> { let Inst{23-4} = 0xFD800; let Inst{3-0} = d; }
class BitOfRegister<bits<8> op, string mn, dag o, dag i, list<dag> pat> : I<o, i, mn, pat> {
  bits<4> k; bits<4> d; let Inst{23-16} = op; let Inst{15-12} = k; let Inst{11-4} = 0; let Inst{3-0} = d; }
let Constraints = "$d = $n", AddedComplexity = -5 in {
  def BSETr : BitOfRegister<0xA0, "bset\t$d, $k", (outs W:$d), (ins W:$n, bitno:$k), []>;
  def BCLRr : BitOfRegister<0xA1, "bclr\t$d, $k", (outs W:$d), (ins W:$n, bitno:$k), []>;
  def BTGr  : BitOfRegister<0xA2, "btg\t$d, $k", (outs W:$d), (ins W:$n, bitno:$k), []>;
}
def : Pat<(or W:$n, onebit:$k), (BSETr W:$n, (log2_x $k))>;
def : Pat<(and W:$n, nobit:$k), (BCLRr W:$n, (clog2_x $k))>;
def : Pat<(xor W:$n, onebit:$k), (BTGr W:$n, (log2_x $k))>;
class BitOfNear<bits<8> op, string mn, list<dag> pat> : I<(outs), (ins nearbit:$f), mn#"\t$f", pat> {
  bits<16> f; let Inst{23-16} = op; let Inst{15-0} = f; }
let mayLoad = 1, mayStore = 1 in {
  def BSETf : BitOfNear<0xA8, "bset", []>;
  def BCLRf : BitOfNear<0xA9, "bclr", []>;
  def BTGf  : BitOfNear<0xAA, "btg", []>;
}
let AddedComplexity = 40 in {
  def : Pat<(store (or (load addrnear:$f), onebit:$k), addrnear:$f), (BSETf addrnear:$f, (log2_x $k))>;
  def : Pat<(store (and (load addrnear:$f), nobit:$k), addrnear:$f), (BCLRf addrnear:$f, (clog2_x $k))>;
  def : Pat<(store (xor (load addrnear:$f), onebit:$k), addrnear:$f), (BTGf addrnear:$f, (log2_x $k))>;
}
