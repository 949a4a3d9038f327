#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A scene that fades into another: the last frame that is the first one's alone, and the first frame that is the
/// second one's alone, counted from the film's first frame.
struct FoundDissolve {
  std::int64_t last_before = 0, first_after = 0;
  friend bool operator==(const FoundDissolve&, const FoundDissolve&) = default;
};

/// Finds dissolves of 8 to 96 frames between two cuts. In a dissolve, each frame is nearly a mixture of the first and
/// the last one, which look different, the share of the last one grows evenly, and in the middle edges are weak. What
/// moves makes no mixtures, and edges stay as they are. A scene that only becomes lighter or darker, or fades out, is
/// left alone.
class DissolveFinder {
 public:
  /// Takes the film's next frame. Keeps 7 kB of it.
  void add(ImageView<const Rgb8> frame);

  /// The dissolves in the frames since the last cut, in order. The next frame begins another scene.
  std::vector<FoundDissolve> end_scene();

 private:
  static constexpr int columns = 32, rows = 18;
  struct SmallFrame {
    std::array<float, std::size_t{3} * columns * rows> colours;  ///< mean colours of the parts of a frame
    float detail = 0;                                            ///< sum of the squares of the frame's slopes
  };
  friend class DissolvesOfScene;

  std::vector<SmallFrame> frames_;
  std::int64_t first_ = 0;  ///< of these, in the film
};

}  // namespace wheatstone
