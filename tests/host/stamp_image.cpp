// SPDX-License-Identifier: MIT
// stamp_image FILE: makes a shared object an image, as far as its end is concerned.
#include <fstream>
#include <iterator>

#include "hal_sim/host/image_stamp.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ifstream in(argv[1], std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  in.close();
  std::ofstream(argv[1], std::ios::binary | std::ios::app) << host::image_stamp(bytes);
}
