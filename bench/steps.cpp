// SPDX-License-Identifier: MIT
// The yardstick of bench/python_steps.py: a world stepped tick by tick, with a look at all poses and
// sensors after each, without Python. Usage: bench_steps WORLD SECONDS; prints seconds of processor
// time and the digest.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>

#include "python/core/world.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::stringstream text;
  text << std::ifstream(argv[1]).rdbuf();
  python::Opening opening;
  opening.text = text.str();
  opening.file = argv[1];
  std::vector<std::string> problems;
  const auto world = python::World::open(opening, problems);
  for (const std::string& problem : problems) std::fprintf(stderr, "%s\n", problem.c_str());
  if (!world) return 2;
  python::Arrays arrays(static_cast<std::size_t>(world->twin().robots()));
  const std::clock_t began = std::clock();
  auto& simulation = world->simulation();
  const sim::Clicks end = sim::from_seconds(std::atof(argv[2]));
  double sum = 0;
  while (simulation.now() < end) {
    world->run(simulation.now() + 1, nullptr, true);
    world->refresh(arrays, true, true, false);
    sum += arrays.poses[0] + arrays.proximity[0];
  }
  std::printf("%.4f %016llx %.1f\n", static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC,
              static_cast<unsigned long long>(simulation.digest()), sum);
}
