// SPDX-License-Identifier: MIT
#include "tools/twinpuck.h"

int main(int argc, char** argv) { return tools::twinpuck(argc, argv); }
