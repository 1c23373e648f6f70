// SPDX-License-Identifier: MIT
// Comparisons, and selects, which become a branch (lowering.cpp). CPB takes the borrow of a CP and leaves Z set only
// if it was: so CP and CPB compare longs, for all fourteen conditions.
class Compare<bits<9> op, bits<3> p, dag i, string a, list<dag> pat> : I<(outs), i, a, pat> {
  bits<4> b; bits<4> s; let Inst{23-15} = op; let Inst{14-11} = b; let Inst{10-7} = 0; let Inst{6-4} = p; let Inst{3-0} = s; }
class CompareLit5<bits<9> op, dag i, string a, list<dag> pat> : I<(outs), i, a, pat> {
  bits<4> b; bits<5> k; let Inst{23-15} = op; let Inst{14-11} = b; let Inst{10-7} = 0; let Inst{6-5} = 3; let Inst{4-0} = k; }
let Defs = [SR], isCompare = 1 in {
  def CPrr : Compare<0b111000010, 0, (ins W:$b, W:$s), "cp\t$b, $s", [(cmp W:$b, W:$s)]>;
  def CPri : CompareLit5<0b111000010, (ins W:$b, lit5:$k), "cp\t$b, $k", [(cmp W:$b, lit5:$k)]>;
  let mayLoad = 1 in {
    def CPrm : Compare<0b111000010, 1, (ins W:$b, W:$s), "cp\t$b, [$s]", [(cmp W:$b, (load addrind:$s))]>;
    def CP0m : Compare<0b111000000, 1, (ins W:$s), "cp0\t[$s]", [(cmp (load addrind:$s), 0)]> { let b = 0; }
    let AddedComplexity = 10 in
    def CP0f : I<(outs), (ins near:$f), "cp0\t$f", [(cmp (load addrnear:$f), 0)]> { bits<13> f; let Inst{23-13} = 0b11100010000; let Inst{12-0} = f; }
  }
  def CP0r : Compare<0b111000000, 0, (ins W:$s), "cp0\t$s", [(cmp W:$s, 0)]> { let b = 0; }
  let Uses = [SR] in {
    def CPBrr : Compare<0b111000011, 0, (ins W:$b, W:$s), "cpb\t$b, $s", [(cmpb W:$b, W:$s)]>;
    def CPBri : CompareLit5<0b111000011, (ins W:$b, lit5:$k), "cpb\t$b, $k", [(cmpb W:$b, lit5:$k)]>;
  }
  def BTSTr : BitOfRegister<0xA3, "btst.z\t$d, $k", (outs), (ins W:$d, bitno:$k), [(btst W:$d, imm:$k)]> { let Inst{11} = 1; }
  let mayLoad = 1, AddedComplexity = 30 in def BTSTf : BitOfNear<0xAB, "btst", []>;
}
let AddedComplexity = 30 in def : Pat<(btst (load addrnear:$f), imm:$k), (BTSTf addrnear:$f, imm:$k)>;
let usesCustomInserter = 1, Uses = [SR] in {
  def SELECT  : Pseudo<(outs W:$d), (ins W:$t, W:$f, i16imm:$cc), [(set W:$d, (select_ W:$t, W:$f, timm:$cc))]>;
  def SELECT2 : Pseudo<(outs W:$d, W:$d2), (ins W:$t, W:$t2, W:$f, W:$f2, i16imm:$cc)>;
}
