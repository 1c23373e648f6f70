// SPDX-License-Identifier: MIT
#include "program_checks.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "chip.h"
#include "clang/AST/ASTContext.h"
#include "clang/AST/Attr.h"
#include "clang/AST/Decl.h"
#include "clang/AST/Expr.h"
#include "clang/AST/RecursiveASTVisitor.h"
#include "clang/AST/Stmt.h"
#include "clang/Basic/Diagnostic.h"
#include "clang/Basic/SourceManager.h"
#include "dspic30/memory/irqs.h"

namespace cc {
namespace {

using namespace clang;

constexpr unsigned kAtomicBits = 16;  // what one instruction reads

// --- vectors

std::vector<std::string> handler_names() {
  std::vector<std::string> all;
  for (const char* table : {"_", "_Alt"}) {
    for (const char* trap : {"OscillatorFail", "AddressError", "StackError", "MathError"})
      all.push_back(std::string(table) + trap);
    for (int i = 0; i < dspic::kIrqs; ++i)
      if (dspic::irq_name(i)[0] != '?') all.push_back(std::string(table) + dspic::irq_name(i) + "Interrupt");
  }
  all.push_back("_DefaultInterrupt");
  return all;
}

/// The handler's name most like this one, so many letters apart at most; "": none is.
std::string handler_like(StringRef name, unsigned most) {
  std::string best;
  unsigned least = most + 1;
  for (const std::string& handler : handler_names()) {
    const unsigned edits = name.edit_distance(handler, true, least);
    if (edits < least) least = edits, best = handler;
  }
  return best;
}

bool has_note(const Decl* decl, StringRef what) {
  for (const auto* note : decl->specific_attrs<AnnotateAttr>())
    if (note->getAnnotation() == std::string(kNote) + what.str()) return true;
  return false;
}

// --- functions of the library

/// What a function takes as its argument of that number, and what becomes of anything else.
struct Range {
  const char* function;
  unsigned argument;
  int least, most;
  const char* what;
  const char* then;
};
constexpr const char* kReturns0 = "the library returns 0, but for 8 and 9 of a turret at selector 10";
constexpr const char* kTakesNearest = "the library takes the nearest of these";
constexpr Range kRanges[] = {
    {"e_set_led", 0, 0, 8, "LED", "the library sets all eight"},
    {"e_get_prox", 0, 0, 7, "sensor", kReturns0},
    {"e_get_calibrated_prox", 0, 0, 7, "sensor", kReturns0},
    {"e_get_ambient_light", 0, 0, 7, "sensor", kReturns0},
    {"e_set_speed_left", 0, -1000, 1000, "speed", kTakesNearest},
    {"e_set_speed_right", 0, -1000, 1000, "speed", kTakesNearest},
};

/// What e_set_speed() does with two speeds whose magnitudes are together too large; empty: they are not. The
/// library adds in 16 bits, where what goes beyond them becomes negative, and passes.
std::string after_both_speeds(std::int64_t linear, std::int64_t angular) {
  constexpr std::int64_t kMostSpeed = 1000;
  const std::int64_t all = std::abs(linear) + std::abs(angular);
  if (all <= kMostSpeed) return "";
  const auto in_16_bits = [](std::int64_t n) { return std::int64_t(std::int16_t(n)); };
  const auto wheel = [&](std::int64_t n) {
    return std::to_string(std::clamp(in_16_bits(n), -kMostSpeed, kMostSpeed));
  };
  const std::int64_t seen = in_16_bits(all);
  return "got speeds " + std::to_string(linear) + " and " + std::to_string(angular) +
         ", expected magnitudes of together at most " + std::to_string(kMostSpeed) + "; " +
         (seen > kMostSpeed
              ? "the library leaves the speed as it is"
              : "in 16 bits their sum is " + std::to_string(seen) + ", so the library sets " +
                    wheel(linear - angular) + " left and " + wheel(linear + angular) + " right");
}

bool blocks(StringRef name) {
  for (const char* slow :
       {"printf", "puts", "putchar", "scanf", "wait", "e_send_uart1_char", "e_send_uart2_char"})
    if (name == slow) return true;
  return false;
}

const FunctionDecl* callee_of(const CallExpr* call) { return call->getDirectCallee(); }

const VarDecl* variable_of(const Expr* e) {
  const auto* ref = e ? dyn_cast<DeclRefExpr>(e->IgnoreParenImpCasts()) : nullptr;
  return ref ? dyn_cast<VarDecl>(ref->getDecl()) : nullptr;
}

/// What one function does, with its callees' names.
struct Uses {
  std::map<const VarDecl*, SourceLocation> read, written;
  std::map<const VarDecl*, SourceLocation> constants;
  std::set<const FunctionDecl*> calls;
  std::vector<std::pair<StringRef, SourceLocation>> slow;
  bool masks = false;  // interrupts, somewhere
};

class UseFinder : public RecursiveASTVisitor<UseFinder> {
 public:
  explicit UseFinder(Uses& uses) : uses_(uses) {}
  bool VisitBinaryOperator(BinaryOperator* b) {
    if (b->isAssignmentOp()) note_write(b->getLHS());
    if (b->isAssignmentOp() && masks(b)) uses_.masks = true;
    return true;
  }
  bool VisitUnaryOperator(UnaryOperator* u) {
    if (u->isIncrementDecrementOp()) note_write(u->getSubExpr());
    return true;
  }
  bool VisitDeclRefExpr(DeclRefExpr* ref) {
    if (const auto* function = dyn_cast<FunctionDecl>(ref->getDecl()))
      uses_.calls.insert(function->getCanonicalDecl());
    const auto* v = dyn_cast<VarDecl>(ref->getDecl());
    if (!v) return true;
    if (!v->hasGlobalStorage()) return true;
    v = v->getCanonicalDecl();
    if (is_constant(v))
      uses_.constants.emplace(v, ref->getLocation());
    else
      uses_.read.emplace(v, ref->getLocation());
    return true;
  }
  bool VisitGCCAsmStmt(GCCAsmStmt* s) {
    uses_.masks |= s->getAsmString()->getString().contains("disi");
    return true;
  }
  bool VisitCallExpr(CallExpr* call) {
    const FunctionDecl* f = callee_of(call);
    if (!f || !f->getIdentifier()) return true;
    const StringRef name = f->getName();
    uses_.masks |= name == "__builtin_disi" || name == "e_pause_agenda" || name == "e_end_agendas_processing";
    if (blocks(name)) uses_.slow.push_back({name, call->getBeginLoc()});
    return true;
  }

 private:
  /// IEC0bits.T1IE = 0, IEC0 &= ..., SRbits.IPL = 7, DISICNT = 20.
  static bool masks(const BinaryOperator* b) {
    const Expr* to = b->getLHS()->IgnoreParenImpCasts();
    while (const auto* member = dyn_cast<MemberExpr>(to)) to = member->getBase()->IgnoreParenImpCasts();
    const VarDecl* v = variable_of(to);
    if (!v) return false;
    const StringRef name = v->getName();
    if (name.startswith("SRbits") || name == "SR" || name.startswith("DISICNT")) return true;
    const auto* zero = dyn_cast<IntegerLiteral>(b->getRHS()->IgnoreParenImpCasts());
    return name.startswith("IEC") && (b->getOpcode() == BO_AndAssign || (zero && zero->getValue() == 0));
  }
  static bool is_constant(const VarDecl* v) {
    QualType type = v->getType();
    if (const auto* array = type->getAsArrayTypeUnsafe()) type = array->getElementType();
    return type.isConstQualified() && !type.isVolatileQualified();
  }
  void note_write(Expr* to) {
    if (const VarDecl* v = variable_of(to); v && v->hasGlobalStorage())
      uses_.written.emplace(v->getCanonicalDecl(), to->getBeginLoc());
  }
  Uses& uses_;
};

class Checker : public RecursiveASTVisitor<Checker> {
 public:
  Checker(ASTContext& context, bool strict) : context_(context), strict_(strict) {}

  void run() {
    TraverseDecl(context_.getTranslationUnitDecl());
    if (strict_) check_handlers();
  }

  bool VisitFunctionDecl(FunctionDecl* f) {
    if (!f->doesThisDeclarationHaveABody() || !is_of_program(f)) return true;
    UseFinder(uses_[f->getCanonicalDecl()]).TraverseStmt(f->getBody());
    bodies_.push_back(f);
    const bool is_handler = has_note(f, "interrupt");
    if (is_handler) handlers_.push_back(f);
    check_name(f, is_handler);
    return true;
  }

  bool VisitCallExpr(CallExpr* call) {
    const FunctionDecl* f = callee_of(call);
    if (!f || !f->getIdentifier() || !is_of_program_at(call->getBeginLoc())) return true;
    const StringRef name = f->getName();
    if (name == "e_activate_agenda" && call->getNumArgs() > 0) note_agenda(call->getArg(0));
    if (f->getDefinition()) return true;  // the program's own
    const auto number = [&](unsigned n, std::int64_t& got) {
      const Expr* argument = call->getArg(n)->IgnoreParenImpCasts();
      Expr::EvalResult value;
      if (argument->isValueDependent() || !argument->EvaluateAsInt(value, context_)) return false;
      got = value.Val.getInt().getExtValue();
      return true;
    };
    std::int64_t got = 0, angular = 0;
    if (name == "e_set_speed" && call->getNumArgs() == 2 && number(0, got)) {
      // of the second one that is known only as the program runs, 0 is taken
      number(1, angular);
      if (const std::string wrong = after_both_speeds(got, angular); !wrong.empty())
        warn(call->getArg(0)->getBeginLoc(), "e_set_speed(): " + wrong);
    }
    for (const Range& range : kRanges) {
      if (name != range.function || call->getNumArgs() <= range.argument) continue;
      const Expr* argument = call->getArg(range.argument)->IgnoreParenImpCasts();
      if (!number(range.argument, got)) continue;
      if (got >= range.least && got <= range.most) continue;
      warn(argument->getBeginLoc(),
           (name + "(): got " + range.what + " " + std::to_string(got) + ", expected " +
            std::to_string(range.least) + " to " + std::to_string(range.most) + "; " + range.then)
               .str());
    }
    return true;
  }

  // x == 1.0: sums of tenths never are
  bool VisitBinaryOperator(BinaryOperator* b) {
    if (!b->isEqualityOp() || !is_of_program_at(b->getOperatorLoc())) return true;
    const Expr *left = b->getLHS()->IgnoreParenImpCasts(), *right = b->getRHS()->IgnoreParenImpCasts();
    if (!b->getLHS()->getType()->isRealFloatingType() || left->isValueDependent() ||
        right->isValueDependent())
      return true;
    const auto constant = [&](const Expr* e, bool& is_zero) {
      Expr::EvalResult value;
      if (!e->EvaluateAsRValue(value, context_)) return false;
      is_zero =
          value.Val.isFloat() ? value.Val.getFloat().isZero() : value.Val.isInt() && value.Val.getInt() == 0;
      return true;
    };
    bool is_zero = false;
    const bool has_constant = constant(left, is_zero) || constant(right, is_zero);
    const bool same = variable_of(left) && variable_of(left) == variable_of(right);  // is it a number?
    if (is_zero || same || (!has_constant && !strict_)) return true;
    warn(b->getOperatorLoc(),
         "got a comparison of floating-point numbers for equality, expected < or >: computed values hardly "
         "ever "
         "meet exactly");
    return true;
  }

  // char name[3] = "abc" has no room for the 0 that ends it
  bool VisitVarDecl(VarDecl* v) {
    const Expr* init = v->getInit();
    if (!init || !is_of_program_at(v->getLocation())) return true;
    const auto* text = dyn_cast<clang::StringLiteral>(init->IgnoreParenImpCasts());
    const auto* array = context_.getAsConstantArrayType(v->getType());
    if (text && array && array->getSize() == text->getLength())
      warn(v->getLocation(), v->getNameAsString() + ": got room for " + std::to_string(text->getLength()) +
                                 " characters, expected " + std::to_string(text->getLength() + 1) +
                                 ": the 0 that ends the string is left out, and whoever prints it reads on");
    return true;
  }

  // for (i = 0; i <= 10; i++) a[i] of int a[10]
  bool VisitForStmt(ForStmt* loop) {
    // Is this a loop that counts one variable up to a known end?
    const auto* condition =
        dyn_cast_or_null<BinaryOperator>(loop->getCond() ? loop->getCond()->IgnoreParenImpCasts() : nullptr);
    if (!condition || !loop->getBody() || !is_of_program_at(loop->getBeginLoc())) return true;
    const VarDecl* counter = variable_of(condition->getLHS());
    const auto* step =
        dyn_cast_or_null<UnaryOperator>(loop->getInc() ? loop->getInc()->IgnoreParenImpCasts() : nullptr);
    Expr::EvalResult bound;
    if (!counter || !step || !step->isIncrementOp() || variable_of(step->getSubExpr()) != counter)
      return true;
    if (condition->getOpcode() != BO_LT && condition->getOpcode() != BO_LE) return true;
    if (!condition->getRHS()->EvaluateAsInt(bound, context_)) return true;
    const std::int64_t last = bound.Val.getInt().getExtValue() - (condition->getOpcode() == BO_LT ? 1 : 0);
    // Its body: does it leave early, or change the counter, and does it index an array of a known size?
    struct Indices : RecursiveASTVisitor<Indices> {
      Checker& checker;
      const VarDecl* counter;
      std::int64_t last;
      bool leaves = false, changes = false;
      const ArraySubscriptExpr* beyond = nullptr;
      std::int64_t size = 0;
      Indices(Checker& c, const VarDecl* v, std::int64_t n) : checker(c), counter(v), last(n) {}
      bool VisitBreakStmt(BreakStmt*) { return leaves = true; }
      bool VisitReturnStmt(ReturnStmt*) { return leaves = true; }
      bool VisitGotoStmt(GotoStmt*) { return leaves = true; }
      bool VisitIfStmt(IfStmt*) { return leaves = true; }  // may look at the counter
      bool VisitConditionalOperator(ConditionalOperator*) { return leaves = true; }
      bool VisitBinaryOperator(BinaryOperator* b) {
        if (b->isAssignmentOp() && variable_of(b->getLHS()) == counter) changes = true;
        if (b->isLogicalOp()) leaves = true;
        return true;
      }
      bool VisitUnaryOperator(UnaryOperator* u) {
        if ((u->isIncrementDecrementOp() || u->getOpcode() == UO_AddrOf) &&
            variable_of(u->getSubExpr()) == counter)
          changes = true;
        return true;
      }
      bool VisitArraySubscriptExpr(ArraySubscriptExpr* a) {
        const Expr* base = a->getBase()->IgnoreParenImpCasts();
        const auto* array = checker.context_.getAsConstantArrayType(base->getType());
        if (!array || variable_of(a->getIdx()) != counter || beyond) return true;
        size = array->getSize().getSExtValue();
        if (last >= size && size > 1) beyond = a;  // one element at a struct's end stands for more
        return true;
      }
    } indices(*this, counter, last);
    indices.TraverseStmt(loop->getBody());
    if (indices.beyond && !indices.leaves && !indices.changes)
      warn(indices.beyond->getBeginLoc(),
           counter->getNameAsString() + ": got an index that reaches " + std::to_string(last) +
               ", expected at most " + std::to_string(indices.size - 1) + ": the array has " +
               std::to_string(indices.size) + " elements, and what lies behind it is overwritten or read");
    return true;
  }

 private:
  /// A handler whose name is no interrupt's, or a function that is named like one but is none. One that is nearly
  /// named so is meant only where the file does not call it.
  void check_name(const FunctionDecl* f, bool is_handler) {
    if (!f->getIdentifier()) return;
    const std::string name = f->getNameAsString();
    const auto all = handler_names();
    const bool is_vector = std::find(all.begin(), all.end(), name) != all.end();
    if (is_vector && !is_handler)
      warn(f->getLocation(), name +
                                 "(): got a function with an interrupt's name, expected a handler: without "
                                 "__attribute__((interrupt, auto_psv)) it saves no registers, and RETURN "
                                 "leads out of it instead of RETFIE");
    if (is_vector || (is_handler ? has_other_vector(f) : name[0] != '_' || f->isReferenced())) return;
    const std::string meant = handler_like(name, is_handler ? 3 : 2);
    if (!is_handler && meant.empty()) return;
    warn(f->getLocation(),
         name + "(): got a " + (is_handler ? "handler" : "function like a handler") +
             " whose name is no interrupt's, expected one such as _T1Interrupt: nothing will "
             "ever call it" +
             (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
  bool is_of_program_at(SourceLocation at) const {
    const auto& sources = context_.getSourceManager();
    const SourceLocation place = sources.getExpansionLoc(at);
    return sources.isInMainFile(place) || !sources.isInSystemHeader(place);
  }
  bool is_of_program(const Decl* decl) const { return is_of_program_at(decl->getLocation()); }
  /// interrupt(irq(n)) puts any name into a vector (lower.cpp).
  static bool has_other_vector(const FunctionDecl* f) {
    for (const auto* note : f->specific_attrs<AnnotateAttr>())
      if (note->getAnnotation().contains("irq=")) return true;
    return false;
  }
  void note_agenda(Expr* function) {
    const Expr* e = function->IgnoreParenCasts();
    if (const auto* address = dyn_cast<UnaryOperator>(e)) e = address->getSubExpr()->IgnoreParenCasts();
    if (const auto* ref = dyn_cast<DeclRefExpr>(e))
      if (const auto* f = dyn_cast<FunctionDecl>(ref->getDecl())) agendas_.push_back(f->getCanonicalDecl());
  }

  /// The function and all that it calls in this file.
  std::set<const FunctionDecl*> within(const FunctionDecl* f) const {
    std::set<const FunctionDecl*> all;
    std::vector<const FunctionDecl*> open = {f->getCanonicalDecl()};
    while (!open.empty()) {
      const FunctionDecl* next = open.back();
      open.pop_back();
      const auto known = uses_.find(next);
      if (known == uses_.end() || !all.insert(next).second) continue;
      open.insert(open.end(), known->second.calls.begin(), known->second.calls.end());
    }
    return all;
  }

  void check_handlers() {
    // What handlers and agendas may run, and which variables they write.
    std::vector<const FunctionDecl*> interrupting(handlers_.begin(), handlers_.end());
    interrupting.insert(interrupting.end(), agendas_.begin(), agendas_.end());
    std::set<const FunctionDecl*> inside;
    std::map<const VarDecl*, const FunctionDecl*> writer;
    for (const FunctionDecl* f : interrupting)
      for (const FunctionDecl* g : within(f)) {
        inside.insert(g);
        for (const auto& [v, at] : uses_[g].written) writer.emplace(v, f);
      }
    // What is slow, or wrong, within a handler.
    for (const FunctionDecl* f : handlers_) {
      for (const FunctionDecl* g : within(f)) {
        for (const auto& [name, at] : uses_[g].slow)
          warn(at, (name + "() is called in the handler " + f->getName() +
                    "(): it takes milliseconds, in which other interrupts are missed; set a flag, and let "
                    "main() do it")
                       .str());
        if (has_note(f, "no_auto_psv"))
          for (const auto& [v, at] : uses_[g].constants)
            warn(at, (v->getName() + ": read in the handler " + f->getName() +
                      "(), which has no_auto_psv: constants are seen through PSVPAG, which the code that it "
                      "interrupts may have changed; write auto_psv")
                         .str());
      }
    }
    // What the rest of the program reads of a handler's variables in more than one piece.
    for (const FunctionDecl* f : bodies_) {
      const FunctionDecl* key = f->getCanonicalDecl();
      const Uses& uses = uses_[key];
      if (inside.count(key) || uses.masks) continue;
      for (const auto& [v, at] : uses.read) {
        const auto by = writer.find(v);
        const QualType type = v->getType();
        if (by == writer.end() || type->isDependentType() || !type->isArithmeticType()) continue;
        const auto bits = context_.getTypeSize(type);
        if (bits <= kAtomicBits || !told_.insert(v).second) continue;
        warn(at, (v->getName() + ": got a variable of " + std::to_string(bits) + " bits that " +
                  by->second->getName() + "() writes, expected at most 16 bits or a mask: " + f->getName() +
                  "() takes more than one instruction for it, and the interrupt may come in between")
                     .str());
      }
    }
  }

  void warn(SourceLocation at, const std::string& text) {
    auto& d = context_.getDiagnostics();
    d.Report(at, d.getCustomDiagID(DiagnosticsEngine::Warning, "%0")) << text;
  }

  ASTContext& context_;
  const bool strict_;
  std::map<const FunctionDecl*, Uses> uses_;
  std::vector<const FunctionDecl*> bodies_, handlers_, agendas_;
  std::set<const VarDecl*> told_;
};

}  // namespace

void check_program(clang::ASTContext& context, bool strict) { Checker(context, strict).run(); }

}  // namespace cc
