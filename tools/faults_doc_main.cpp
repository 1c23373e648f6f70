// SPDX-License-Identifier: MIT
// Prints the signals and kinds of faults, or writes them into docs/testing.md: faults_doc [PAGE]
#include "hal_sim/faults/kinds.h"
#include "tools/doc_part.h"

int main(int argc, char** argv) { return tools::write_doc_part(argc, argv, "faults", faults::page()); }
