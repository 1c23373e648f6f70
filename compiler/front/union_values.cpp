// SPDX-License-Identifier: MIT
// clang has an expression that says "this value, then these members of it": what it makes of designators that
// overwrite one another. With a union of zeros as the value it says what gcc does. Constant initialisers need
// nothing: their bytes are copied whole.
#include "union_values.h"

#include "clang/AST/ASTContext.h"
#include "clang/AST/Decl.h"
#include "clang/AST/Expr.h"
#include "clang/AST/Stmt.h"

namespace cc {
namespace {

using namespace clang;

/// Does the member that gets the value leave bytes over?
bool is_partial(InitListExpr& list, ASTContext& context) {
  const FieldDecl* field = list.getInitializedFieldInUnion();
  if (!list.getType()->isUnionType() || !field || list.getNumInits() == 0) return false;
  const auto bits =
      field->isBitField() ? field->getBitWidthValue(context) : context.getTypeSize(field->getType());
  return bits < context.getTypeSize(list.getType());
}

/// `at_run_time`: within a list of values that are not all constants.
void clear_within(Stmt*& slot, bool at_run_time, ASTContext& context) {
  if (!slot) return;
  auto* list = dyn_cast<InitListExpr>(slot);
  at_run_time = list && (at_run_time || !list->isConstantInitializer(context, /*ForRef=*/false));
  for (Stmt*& child : slot->children()) clear_within(child, at_run_time, context);
  if (!at_run_time || !is_partial(*list, context)) return;
  auto* zeros = new (context) ImplicitValueInitExpr(list->getType());
  auto* both =
      new (context) DesignatedInitUpdateExpr(context, list->getLBraceLoc(), zeros, list->getRBraceLoc());
  both->setUpdater(list);
  slot = both;
}

}  // namespace

void clear_unions(Decl* decl, ASTContext& context) {
  auto* function = dyn_cast<FunctionDecl>(decl);
  if (!function || !function->doesThisDeclarationHaveABody()) return;
  Stmt* body = function->getBody();
  clear_within(body, false, context);
}

}  // namespace cc
