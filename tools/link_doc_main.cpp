// SPDX-License-Identifier: MIT
// Prints the table of the link's records, or writes it into docs/connecting.md: link_doc [PAGE]
#include "tools/doc_part.h"
#include "tools/link_doc.h"

int main(int argc, char** argv) { return tools::write_doc_part(argc, argv, "records", tools::link_table()); }
