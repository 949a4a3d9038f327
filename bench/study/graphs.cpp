// Drawing a new pair of views of a graph, as a study's display does when a head moves.

#include <fmt/format.h>

#include "stopwatch.h"
#include "wheatstone/study/draw_graph.h"

int main() {
  using namespace wheatstone;
  const StudyScreen screen;
  const PathGraph graph = make_path_graph({}, 1, true);
  StereoPair pair;
  const double seconds = bench::median_seconds(
      [&] {
        pair = draw_for_eyes(graph, screen, {.views_per_10cm = 8}, {30, 700});
      },
      21);
  // The answer is checked before its time is printed.
  if (pair.left == pair.right) {
    fmt::print("both eyes see the same\n");
    return 1;
  }
  fmt::print("graph of 90 nodes, two views of 1024x768: {:.1f} pairs a second (limit 30)\n", 1 / seconds);
}
