// SPDX-License-Identifier: MIT
// What the bytes of a union hold that its initialiser does not name: 0, as with gcc.
#pragma once

namespace clang {
class ASTContext;
class Decl;
}  // namespace clang

namespace cc {

/// Between clang's semantic analysis and its code generator, C only: a union within a function whose
/// value is made at run time is cleared first where the member that gets it leaves bytes over. clang
/// leaves them as they are.
void clear_unions(clang::Decl* decl, clang::ASTContext& context);

}  // namespace cc
