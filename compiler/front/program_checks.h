// SPDX-License-Identifier: MIT
// What compiles and cannot be meant, or works only until an interrupt comes at the wrong moment: found in the
// syntax tree of one file of a program for the chip. Each is a warning at its line.
//
//   build and lint   a handler whose name is no vector, or without its attribute; constants that a function of
//                    the library does not take; a loop that runs past an array's end; a string without room for
//                    its end
//   lint alone       a handler without auto_psv that reads constants; a variable of more than 16 bits that a
//                    handler writes; printf() and waits in a handler
//
// Names are those of one file: what another file's handler does is not seen.
#pragma once

namespace clang {
class ASTContext;
}

namespace cc {

/// Reports to the context's diagnostics. `strict`: lint.
void check_program(clang::ASTContext& context, bool strict);

}  // namespace cc
