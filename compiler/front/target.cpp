// SPDX-License-Identifier: MIT
// clang has no dsPIC30F. A TargetInfo of our own gives it the widths and the layout, and attributes of XC16
// become either notes on functions or names of sections, which the later stages read.
#include <map>

#include "chip.h"
#include "clang/AST/ASTContext.h"
#include "clang/AST/Attr.h"
#include "clang/AST/Decl.h"
#include "clang/AST/Expr.h"
#include "clang/Basic/MacroBuilder.h"
#include "clang/Basic/TargetInfo.h"
#include "clang/Sema/ParsedAttr.h"
#include "clang/Sema/Sema.h"
#include "dspic30/llvm/target.h"
#include "dspic30/memory/irqs.h"
#include "llvm/ADT/StringExtras.h"

namespace {

using namespace clang;

// TargetInfo::TargetOpts is private and must not stay empty; an explicit instantiation may name it
std::shared_ptr<TargetOptions>& options_of(TargetInfo& target);
template <std::shared_ptr<TargetOptions> TargetInfo::*member>
struct OptionsKey {
  friend std::shared_ptr<TargetOptions>& options_of(TargetInfo& target) { return target.*member; }
};
template struct OptionsKey<&TargetInfo::TargetOpts>;

class ChipTarget : public TargetInfo {
 public:
  explicit ChipTarget(std::shared_ptr<TargetOptions> options) : TargetInfo(llvm::Triple(llvm::kDspicTriple)) {
    options_of(*this) = std::move(options);
    TLSSupported = BigEndian = false;
    PointerWidth = PointerAlign = IntWidth = IntAlign = 16;
    LongWidth = 32, LongLongWidth = 64;
    LongAlign = LongLongAlign = FloatAlign = DoubleAlign = LongDoubleAlign = SuitableAlign = 16;
    DefaultAlignForAttributeAligned = 16;
    DoubleWidth = 32, DoubleFormat = &llvm::APFloat::IEEEsingle();
    LongDoubleWidth = 64, LongDoubleFormat = &llvm::APFloat::IEEEdouble();
    SizeType = UnsignedInt;
    PtrDiffType = IntPtrType = SigAtomicType = Int16Type = SignedInt;
    WCharType = UnsignedShort, WIntType = UnsignedInt, Char32Type = UnsignedLong;
    Int64Type = IntMaxType = SignedLongLong;
    MaxAtomicPromoteWidth = MaxAtomicInlineWidth = 16;
    resetDataLayout(llvm::kDspicDataLayout);
  }
  void getTargetDefines(const LangOptions&, MacroBuilder&) const override {}
  ArrayRef<Builtin::Info> getTargetBuiltins() const override { return {}; }
  BuiltinVaListKind getBuiltinVaListKind() const override { return CharPtrBuiltinVaList; }
  const char* getClobbers() const override { return ""; }
  ArrayRef<const char*> getGCCRegNames() const override {
    static const char* const names[] = {"w0",  "w1",  "w2",  "w3",  "w4",  "w5",  "w6", "w7", "w8", "w9",
                                        "w10", "w11", "w12", "w13", "w14", "w15", "sr", "A",  "B"};
    return names;
  }
  ArrayRef<GCCRegAlias> getGCCRegAliases() const override { return {}; }
  bool validateAsmConstraint(const char*& name, ConstraintInfo& info) const override {
    if (StringRef(llvm::kDspicNumberLetters).contains(*name)) return require_number(*name, info);
    if (!StringRef(llvm::kDspicRegisterLetters).contains(*name)) return false;
    info.setAllowsRegister();
    return true;
  }
  bool hasBitIntType() const override { return true; }

 private:
  static bool require_number(char letter, ConstraintInfo& info) {
    struct Range {
      char letter;
      int least, most;
    };
    static constexpr Range kRanges[] = {{'I', 1, 1},      {'J', 0, 1023}, {'K', 0, 15},
                                        {'M', -1023, -1}, {'N', -31, -1}, {'O', 0, 0},
                                        {'P', 0, 31},     {'W', -16, 16}, {'Z', -8, 7}};
    for (const Range& range : kRanges)
      if (range.letter == letter) info.setRequiresImmediate(range.least, range.most);
    if (letter == 'L') info.setRequiresImmediate({-2, -1, 1, 2});
    if (letter == 'Y') info.setRequiresImmediate({-6, -4, -2, 2, 4, 6});
    return true;
  }
};

// --- attributes

/// What the attributes of one variable say of its place.
struct Placement {
  std::string space;  // "", "near", "far", "xmemory", "ymemory", "eedata", "prog", "psv", "persistent"
  unsigned address = 0;
};
// attributes come before the declaration is complete: kept until place_variables()
std::map<VarDecl*, Placement>& pending() {
  static std::map<VarDecl*, Placement> all;
  return all;
}

std::string section_of(const Placement& place, bool has_value) {
  const char* name = llvm::StringSwitch<const char*>(place.space)
                         .Case("near", has_value ? ".ndata" : ".nbss")
                         .Case("xmemory", has_value ? ".xdata" : ".xbss")
                         .Case("ymemory", has_value ? ".ydata" : ".ybss")
                         .Case("persistent", ".pbss")
                         .Case("eedata", ".eedata")
                         .Case("prog", ".prog")
                         .Cases("psv", "auto_psv", "const", ".const")
                         .Default(has_value ? ".data" : ".bss");
  return place.address ? std::string(name) + "@" + llvm::utohexstr(place.address) : name;
}

bool is_in_ram(const Placement& place) {
  return !llvm::StringSwitch<bool>(place.space)
              .Cases("psv", "auto_psv", "const", "prog", "eedata", true)
              .Default(false);
}

/// __save__(a,b), __preprologue__("...") and __irq__(n) inside interrupt(...): calls, as the parser sees them.
void note_interrupt_argument(Expr* argument, FunctionDecl* function, ASTContext& context);

void note(Decl* decl, const std::string& what, ASTContext& context) {
  decl->addAttr(AnnotateAttr::CreateImplicit(context, cc::kNote + what, nullptr, 0));
}

/// irq(3): the function is the handler of the vector's normal entry, altirq(3): of its alternate one.
void note_vector(StringRef table, const CallExpr* call, FunctionDecl* function, ASTContext& context) {
  Expr::EvalResult value;
  const Expr* number = call->getNumArgs() == 1 ? call->getArg(0) : nullptr;
  const bool is_constant = number && !number->isValueDependent() && number->EvaluateAsInt(value, context);
  const std::int64_t irq = is_constant ? value.Val.getInt().getExtValue() : -1;
  if (irq >= 0 && irq < dspic::kIrqs) {
    function->addAttr(UsedAttr::CreateImplicit(context));  // nobody calls it
    return note(function, table.str() + "=" + std::to_string(irq), context);
  }
  auto& d = context.getDiagnostics();
  d.Report(call->getBeginLoc(), d.getCustomDiagID(DiagnosticsEngine::Error, "%0"))
      << (table + ": got " + (is_constant ? "interrupt " + std::to_string(irq) : "no number known here") +
          ", expected one of the vector table, 0 to " + std::to_string(dspic::kIrqs - 1) + " (" +
          std::to_string(dspic::irq::T1) + " is T1's)")
             .str();
}

void note_interrupt_argument(Expr* argument, FunctionDecl* function, ASTContext& context) {
  auto* call = dyn_cast<CallExpr>(argument->IgnoreParenImpCasts());
  auto* callee = call ? call->getDirectCallee() : nullptr;
  if (!callee) return;
  const StringRef kind = callee->getName();
  for (const char* table : {"irq", "altirq"})
    if (kind == std::string(cc::kAttributePrefix) + table) return note_vector(table, call, function, context);
  std::string names;
  for (Expr* e : call->arguments()) {
    e = e->IgnoreParenCasts();
    if (auto* text = dyn_cast<StringLiteral>(e))
      names += text->getString();
    else if (auto* variable = dyn_cast<DeclRefExpr>(e))
      names += (names.empty() ? "_" : ",_") + variable->getDecl()->getName().str();
  }
  if (kind.contains("save")) note(function, "save=" + names, context);
  if (kind.contains("preprologue")) note(function, "preprologue=" + names, context);
}

/// Takes every attribute that the token filter of the front end has marked with kAttributePrefix.
class ChipAttribute : public ParsedAttrInfo {
 public:
  ChipAttribute() {
    constexpr unsigned kAnyNumber = 15;
    OptArgs = kAnyNumber;
    static constexpr Spelling kSpellings[] = {
        {ParsedAttr::AS_GNU, "tp_interrupt"}, {ParsedAttr::AS_GNU, "tp_shadow"},
        {ParsedAttr::AS_GNU, "tp_auto_psv"},  {ParsedAttr::AS_GNU, "tp_no_auto_psv"},
        {ParsedAttr::AS_GNU, "tp_space"},     {ParsedAttr::AS_GNU, "tp_near"},
        {ParsedAttr::AS_GNU, "tp_far"},       {ParsedAttr::AS_GNU, "tp_persistent"},
        {ParsedAttr::AS_GNU, "tp_address"}};
    Spellings = kSpellings;
  }
  AttrHandling handleDeclAttribute(Sema& sema, Decl* decl, const ParsedAttr& attribute) const override {
    const StringRef name =
        attribute.getAttrName()->getName().drop_front(StringRef(cc::kAttributePrefix).size());
    if (auto* function = dyn_cast<FunctionDecl>(decl)) {
      note(function, name.str(), sema.Context);
      for (unsigned i = 0; i < attribute.getNumArgs(); ++i)
        if (attribute.isArgExpr(i))
          note_interrupt_argument(attribute.getArgAsExpr(i), function, sema.Context);
    } else if (auto* variable = dyn_cast<VarDecl>(decl)) {
      place(pending()[variable], name, attribute, sema.Context);
    }
    return AttributeApplied;
  }

 private:
  static void place(Placement& place, StringRef name, const ParsedAttr& attribute, ASTContext& context) {
    const unsigned count = attribute.getNumArgs();
    if (name == "space" && count == 1 && attribute.isArgIdent(0)) {
      place.space = attribute.getArgAsIdent(0)->Ident->getName().trim('_').str();
    } else if (name == "address" && count == 1 && attribute.isArgExpr(0)) {
      if (auto value = attribute.getArgAsExpr(0)->getIntegerConstantExpr(context))
        place.address = value->getZExtValue();
    } else if (place.space.empty()) {
      place.space = name.str();
    }
  }
};
ParsedAttrInfoRegistry::Add<ChipAttribute> registered("dspic", "attributes of XC16");

}  // namespace

namespace cc {

clang::TargetInfo* make_chip_target(std::shared_ptr<clang::TargetOptions> options) {
  return new ChipTarget(std::move(options));
}

void note_accumulators(clang::Decl* decl, clang::ASTContext& context) {
  auto* function = dyn_cast<FunctionDecl>(decl);
  if (!function || !function->doesThisDeclarationHaveABody()) return;
  for (Decl* inside : function->decls()) {
    auto* variable = dyn_cast<VarDecl>(inside);
    auto* label = variable ? variable->getAttr<AsmLabelAttr>() : nullptr;
    if (!label || (label->getLabel() != "A" && label->getLabel() != "B")) continue;
    note(variable, kAccumulatorNote + label->getLabel().str(), context);
  }
}

void place_variables(clang::ASTContext& context) {
  for (auto& [variable, place] : pending()) {
    if (variable->hasAttr<SectionAttr>()) continue;
    const std::string section = section_of(place, variable->hasInit());
    variable->addAttr(SectionAttr::CreateImplicit(context, section));
    // of a section that clang knows nothing of it thinks that it cannot be written, so stores would go
    if (is_in_ram(place))
      context.SectionInfos[section].SectionFlags |= ASTContext::PSF_Read | ASTContext::PSF_Write;
  }
  pending().clear();
}

}  // namespace cc
