// SPDX-License-Identifier: MIT
// How wide arithmetic on bit-fields is: gcc's rules instead of clang's.
#pragma once

namespace clang {
class ASTContext;
class Decl;
}  // namespace clang

namespace cc {

/// Between clang's semantic analysis and its code generator, C only: a bit-field wider than int keeps its own
/// width in the operations it takes part in, as with gcc; clang computes in the declared type. A declaration
/// is to be handed over once.
void compute_in_field_widths(clang::Decl* decl, clang::ASTContext& context);

}  // namespace cc
