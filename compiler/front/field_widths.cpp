// SPDX-License-Identifier: MIT
// The type of a bit-field is, for gcc, an integer of the field's width. One narrower than int is promoted to
// int, as clang does too. A wider one stays what it is: `long x : 20; x + 1` has 20 bits, and 20 bits beside
// a long give a long, signed even if the field is not. Only a conversion to a whole type ends that.
//
// Every expression is visited after its operands. visit() says what width gcc gives it; where clang's type
// differs, the operation is rebuilt in the next whole type and cut to its width. Invariant: an expression's
// value in its clang type is gcc's value, so whatever converts it further converts the right value. What no
// wide field takes part in is left alone.
#include "field_widths.h"

#include <set>

#include "clang/AST/ASTContext.h"
#include "clang/AST/Decl.h"
#include "clang/AST/Expr.h"
#include "clang/AST/Stmt.h"
#include "llvm/ADT/Optional.h"

namespace cc {
namespace {

using namespace clang;

/// An integer type as gcc sees it.
struct Width {
  unsigned bits;
  bool is_unsigned;
  bool operator==(const Width& o) const { return bits == o.bits && is_unsigned == o.is_unsigned; }
};
using MaybeWidth = llvm::Optional<Width>;

class FieldWidths {
 public:
  explicit FieldWidths(ASTContext& context) : context_(context) {}

  /// A statement, or an expression whose type must not change.
  void settle(Stmt*& slot) {
    if (!slot) return;
    auto* expression = dyn_cast<Expr>(slot);
    if (!expression) return visit_statement(slot);
    const QualType type = expression->getType();
    visit(slot);
    convert(slot, type);
  }

 private:
  void visit_statement(Stmt* statement) {
    if (auto* choice = dyn_cast<SwitchStmt>(statement)) return visit_switch(choice);
    for (Stmt*& child : statement->children()) settle(child);
  }

  /// Labels are converted to the width of what is switched on.
  void visit_switch(SwitchStmt* choice) {
    Stmt* condition = choice->getCond();
    const QualType type = choice->getCond()->getType();
    const MaybeWidth width = visit_operand(condition);
    if (!width || promoted(*width) == width_of(type)) {
      convert(condition, type);
    } else {
      make(condition, *width, promoted(*width));
      convert_labels(choice, promoted(*width));
    }
    choice->setCond(cast<Expr>(condition));
    Stmt* body = choice->getBody();
    settle(body);
    choice->setBody(body);
  }
  void convert_labels(SwitchStmt* choice, Width w) {
    std::set<llvm::APSInt> taken;
    for (SwitchCase* c = choice->getSwitchCaseList(); c; c = c->getNextSwitchCase()) {
      auto* label = dyn_cast<CaseStmt>(c);
      if (!label) continue;
      label->setLHS(cut_constant(label->getLHS(), w));
      if (label->getRHS()) label->setRHS(cut_constant(label->getRHS(), w));
      if (taken.insert(label->getLHS()->EvaluateKnownConstInt(context_)).second) continue;
      auto& d = context_.getDiagnostics();
      d.Report(label->getBeginLoc(), d.getCustomDiagID(DiagnosticsEngine::Error,
                                                       "case value is there already, in the field's width"));
    }
  }
  Expr* cut_constant(Expr* e, Width w) {
    Stmt* slot = e;
    cut(slot, w);
    return cast<Expr>(slot);
  }

  // --- expressions

  /// May change the node in `slot` and its type; none: as wide as its type says.
  MaybeWidth visit(Stmt*& slot) {
    auto* e = cast<Expr>(slot);
    if (auto* paren = dyn_cast<ParenExpr>(e)) return visit_through(paren);
    if (auto* conversion = dyn_cast<CastExpr>(e)) return visit_cast(conversion);
    if (auto* unary = dyn_cast<UnaryOperator>(e)) return visit_unary(slot, unary);
    if (auto* compound = dyn_cast<CompoundAssignOperator>(e)) return visit_compound(compound);
    if (auto* binary = dyn_cast<BinaryOperator>(e)) return visit_binary(slot, binary);
    if (auto* choice = dyn_cast<ConditionalOperator>(e)) return visit_conditional(choice);
    if (auto* choice = dyn_cast<BinaryConditionalOperator>(e)) return visit_short_conditional(choice);
    if (auto* block = dyn_cast<StmtExpr>(e)) return visit_block(block);
    if (auto* call = dyn_cast<CallExpr>(e)) return visit_call(call);
    if (isa<ArraySubscriptExpr>(e)) {
      for (Stmt*& child : e->children()) visit(child);  // an index may have any type
      return llvm::None;
    }
    visit_statement(e);
    return llvm::None;
  }

  template <typename Through>
  MaybeWidth visit_through(Through* e) {
    Stmt*& inner = *e->child_begin();
    const MaybeWidth width = visit(inner);
    if (e->isPRValue()) e->setType(cast<Expr>(inner)->getType());
    return width;
  }

  /// A conversion, of the program's or of clang's, is to a whole type.
  MaybeWidth visit_cast(CastExpr* e) {
    Stmt*& inner = *e->child_begin();
    switch (e->getCastKind()) {
      case CK_IntegralCast:
      case CK_IntegralToBoolean:
      case CK_IntegralToFloating:
      case CK_IntegralToPointer:
      case CK_ToVoid:
        visit(inner);  // takes any integer
        return llvm::None;
      case CK_LValueToRValue:
        settle(inner);
        return width_of_field(e->getSubExpr());
      default:
        settle(inner);
        return llvm::None;
    }
  }

  MaybeWidth visit_unary(Stmt*& slot, UnaryOperator* e) {
    Stmt*& inner = *e->child_begin();
    switch (e->getOpcode()) {
      case UO_Extension:
        return visit_through(e);
      case UO_PreInc:
      case UO_PreDec:
      case UO_PostInc:
      case UO_PostDec:
        settle(inner);
        return width_of_field(e->getSubExpr());
      case UO_Plus:
      case UO_Minus:
      case UO_Not: {
        const QualType type = e->getType();
        const MaybeWidth operand = visit_operand(inner);
        if (!operand || !type->isIntegerType() || promoted(*operand) == width_of(type)) {
          convert(inner, type);
          return llvm::None;
        }
        const Width w = promoted(*operand);
        make(inner, *operand, w);
        e->setType(whole(w));
        cut(slot, w);
        return w;
      }
      default:
        settle(inner);
        return llvm::None;
    }
  }

  MaybeWidth visit_binary(Stmt*& slot, BinaryOperator* e) {
    Stmt*& left = *e->child_begin();
    Stmt*& right = *std::next(e->child_begin());
    if (e->getOpcode() == BO_Comma) {
      settle(left);
      const MaybeWidth width = visit(right);
      e->setType(cast<Expr>(right)->getType());
      return width;
    }
    // An assignment has the width of the field that it stores to.
    if (e->getOpcode() == BO_Assign) {
      settle(left);
      settle(right);
      return width_of_field(e->getLHS());
    }
    const bool counts = e->getLHS()->getType()->isIntegerType() && e->getRHS()->getType()->isIntegerType();
    if (e->isLogicalOp() || (!counts && !e->isAdditiveOp())) {
      settle(left);
      settle(right);
      return llvm::None;
    }
    if (!counts) {  // a pointer takes any integer
      visit(left);
      visit(right);
      return llvm::None;
    }
    // A shift has the width of its left side alone.
    const QualType type = e->getLHS()->getType();
    const MaybeWidth a = visit_operand(left);
    if (e->isShiftOp()) {
      settle(right);
      if (!a || promoted(*a) == width_of(type)) {
        convert(left, type);
        return llvm::None;
      }
      make(left, *a, promoted(*a));
      e->setType(whole(promoted(*a)));
      if (e->getOpcode() == BO_Shl) cut(slot, promoted(*a));
      return promoted(*a);
    }
    // All others have a width that holds both sides; where that is clang's own, nothing is to be done.
    const MaybeWidth b = visit_operand(right);
    const MaybeWidth both = make_alike(left, right, a, b, type);
    if (!both || e->isComparisonOp()) return llvm::None;
    const Width w = *both;
    e->setType(whole(w));
    // Carries out of the width have to go, as they do in gcc.
    const bool stays_inside =
        e->isBitwiseOp() || e->getOpcode() == BO_Rem || (e->getOpcode() == BO_Div && w.is_unsigned);
    if (!stays_inside) cut(slot, w);
    return w;
  }

  /// The code generator converts the left side and the result. It stores the low bits only, so cutting
  /// matters to a quotient alone.
  MaybeWidth visit_compound(CompoundAssignOperator* e) {
    Stmt*& left = *e->child_begin();
    Stmt*& right = *std::next(e->child_begin());
    settle(left);
    const QualType type = e->getComputationLHSType();
    const bool counts = type->isIntegerType() && e->getRHS()->getType()->isIntegerType();
    if (!counts || e->isShiftAssignOp()) {
      if (type->isPointerType())
        visit(right);
      else
        settle(right);
      return width_of_field(e->getLHS());
    }
    const MaybeWidth field = width_of_field(e->getLHS());
    const Width a = field ? *field : width_of(e->getLHS()->getType());
    const MaybeWidth b = visit_operand(right);
    const Width w = b ? common(a, *b) : width_of(type);
    if (w == width_of(type)) {
      convert(right, type);
      return field;
    }
    make(right, *b, w);
    const bool divides = e->getOpcode() == BO_DivAssign || e->getOpcode() == BO_RemAssign;
    const QualType in = divides && cuts(w) ? context_.getBitIntType(w.is_unsigned, w.bits) : whole(w);
    convert(right, in);
    e->setComputationLHSType(in);
    e->setComputationResultType(in);
    return field;
  }

  MaybeWidth visit_conditional(ConditionalOperator* e) {
    Stmt** parts = &*e->child_begin();
    settle(parts[0]);
    return choose(e, parts[1], parts[2]);
  }

  /// a ?: b: the value of a is kept, tested and used.
  MaybeWidth visit_short_conditional(BinaryConditionalOperator* e) {
    Stmt*& kept = *e->child_begin();  // the value of a; condition and first result refer to it
    Stmt*& first = *std::next(e->child_begin(), 2);
    Stmt*& second = *std::next(e->child_begin(), 3);
    MaybeWidth width = visit(kept);
    const QualType type = cast<Expr>(kept)->getType();
    e->getOpaqueValue()->setType(type);
    if (!width && type->isIntegerType()) width = width_of(type);
    return choose(e, first, second, width);
  }

  /// The type of c ? a : b. `known`: a's width, if it has been visited.
  /// Both of the width that holds them; none where that is clang's own, of `type`.
  MaybeWidth make_alike(Stmt*& first, Stmt*& second, MaybeWidth a, MaybeWidth b, QualType type) {
    const Width w = a && b ? common(*a, *b) : width_of(type);
    if (w == width_of(type)) {
      convert(first, type);
      convert(second, type);
      return llvm::None;
    }
    make(first, *a, w);
    make(second, *b, w);
    return w;
  }

  MaybeWidth choose(Expr* e, Stmt*& first, Stmt*& second, MaybeWidth known = llvm::None) {
    const QualType type = e->getType();
    if (!type->isIntegerType()) {
      settle(first);
      settle(second);
      return llvm::None;
    }
    if (known) peel(first);
    const MaybeWidth a = known ? known : visit_operand(first);
    const MaybeWidth b = visit_operand(second);
    const MaybeWidth both = make_alike(first, second, a, b, type);
    if (both) e->setType(whole(*both));
    return both;
  }

  /// ({ ...; x; }) is as wide as x.
  MaybeWidth visit_block(StmtExpr* e) {
    CompoundStmt* body = e->getSubStmt();
    MaybeWidth width;
    for (Stmt*& child : body->children()) {
      if (child != body->body_back() || !isa<Expr>(child)) {
        settle(child);
        continue;
      }
      width = visit(child);
      if (width) e->setType(cast<Expr>(child)->getType());
    }
    if (!width && !body->body_empty() && isa<Expr>(body->body_back())) {
      Stmt*& last = *std::prev(body->body_end());
      if (e->getType()->isIntegerType()) convert(last, e->getType());
    }
    return width;
  }

  /// Where no prototype says a type, the value travels in the next whole one.
  MaybeWidth visit_call(CallExpr* e) {
    const FunctionDecl* callee = e->getDirectCallee();
    const auto* prototype = [&]() -> const FunctionProtoType* {
      QualType type = e->getCallee()->getType();
      if (const auto* pointer = type->getAs<PointerType>()) type = pointer->getPointeeType();
      return type->getAs<FunctionProtoType>();
    }();
    const unsigned known = prototype ? prototype->getNumParams() : 0;
    const bool is_builtin = callee && callee->getBuiltinID() != 0;
    int index = -1;  // of the argument; the function itself comes first
    for (Stmt*& child : e->children()) {
      const bool is_open = index >= 0 && unsigned(index) >= known && !is_builtin;
      ++index;
      if (!is_open) {
        settle(child);
        continue;
      }
      const QualType type = cast<Expr>(child)->getType();
      const MaybeWidth width = visit(child);
      convert(child,
              width && promoted(*width).bits > context_.getIntWidth(context_.IntTy) ? whole(*width) : type);
    }
    return llvm::None;
  }

  // --- widths

  MaybeWidth width_of_field(const Expr* lvalue) const {
    const FieldDecl* field = const_cast<Expr*>(lvalue)->getSourceBitField();
    if (!field) return llvm::None;
    return Width{field->getBitWidthValue(context_), field->getType()->isUnsignedIntegerOrEnumerationType()};
  }
  Width width_of(QualType type) const {
    return {context_.getIntWidth(type), type->isUnsignedIntegerOrEnumerationType()};
  }
  Width promoted(Width w) const {
    const unsigned int_bits = context_.getIntWidth(context_.IntTy);
    return w.bits < int_bits ? Width{int_bits, false} : w;
  }
  Width common(Width a, Width b) const {
    a = promoted(a), b = promoted(b);
    if (a.bits != b.bits) return a.bits > b.bits ? a : b;
    return {a.bits, a.is_unsigned || b.is_unsigned};
  }
  /// The smallest whole type from int on that holds it.
  QualType whole(Width w) const {
    if (w.bits <= context_.getIntWidth(context_.IntTy))
      return w.is_unsigned ? context_.UnsignedIntTy : context_.IntTy;
    if (w.bits <= context_.getIntWidth(context_.LongTy))
      return w.is_unsigned ? context_.UnsignedLongTy : context_.LongTy;
    return w.is_unsigned ? context_.UnsignedLongLongTy : context_.LongLongTy;
  }
  bool cuts(Width w) const { return w.bits < context_.getIntWidth(whole(w)); }

  // --- trees

  /// Without the conversion to the common type that clang has put around an operand.
  static void peel(Stmt*& slot) {
    while (auto* c = dyn_cast<ImplicitCastExpr>(slot)) {
      if (c->getCastKind() != CK_IntegralCast) return;
      slot = c->getSubExpr();
    }
  }

  /// The width that an operand brings to an operation. Its conversions are taken away if clang's may be
  /// others than gcc's; whoever calls puts the right ones in their place.
  MaybeWidth visit_operand(Stmt*& slot) {
    peel(slot);
    const MaybeWidth width = visit(slot);
    const QualType type = cast<Expr>(slot)->getType();
    return width ? width : type->isIntegerType() ? MaybeWidth(width_of(type)) : llvm::None;
  }

  void convert(Stmt*& slot, QualType type) {
    auto* e = cast<Expr>(slot);
    if (!e->isPRValue() || context_.hasSameUnqualifiedType(e->getType(), type)) return;
    if (!e->getType()->isIntegerType() || !type->isIntegerType()) return;
    slot = ImplicitCastExpr::Create(context_, type, CK_IntegralCast, e, nullptr, VK_PRValue,
                                    FPOptionsOverride());
  }
  /// Keeps the low bits of a value, in the whole type.
  void cut(Stmt*& slot, Width w) {
    if (cuts(w)) convert(slot, context_.getBitIntType(w.is_unsigned, w.bits));
    convert(slot, whole(w));
  }
  /// A value of width `from` as one of width `w`.
  void make(Stmt*& slot, Width from, Width w) {
    const bool fits =
        from.is_unsigned == w.is_unsigned ? from.bits <= w.bits : from.is_unsigned && from.bits < w.bits;
    if (fits)
      convert(slot, whole(w));
    else
      cut(slot, w);
  }

  ASTContext& context_;
};

}  // namespace

void compute_in_field_widths(Decl* decl, ASTContext& context) {
  auto* function = dyn_cast<FunctionDecl>(decl);
  if (!function || !function->doesThisDeclarationHaveABody()) return;
  Stmt* body = function->getBody();
  FieldWidths(context).settle(body);
}

}  // namespace cc
