// Writes the table of golden hashes: `golden_hashes FILE` (make golden), or to standard output.
#include <cstdio>

#include "support/golden_scenes.h"

using namespace brickfall;

int main(int argc, char** argv) {
  std::string text =
      "# What the shipped scenes must come to, bit for bit, in every build: scene, steps, state hash, and the step in "
      "which\n"
      "# an island first fell asleep (0: none did). Written by `make golden`, checked by `make test`.\n";
  for (const ShippedScene& scene : shippedScenes()) {
    test::Golden golden = test::runGolden(scene.name);
    if (!golden.problem.empty()) {
      std::fprintf(stderr, "golden_hashes: %s: %s\n", scene.name.c_str(), golden.problem.c_str());
      return 1;
    }
    text += test::toLine(golden) + "\n";
  }
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "wb") : stdout;
  bool fine = file && std::fputs(text.c_str(), file) >= 0;
  fine = file && std::fclose(file) == 0 && fine;
  if (!fine) std::fprintf(stderr, "golden_hashes: cannot write %s\n", argc > 1 ? argv[1] : "standard output");
  return fine ? 0 : 1;
}
