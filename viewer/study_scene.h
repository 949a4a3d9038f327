#pragma once

#include <filesystem>
#include <variant>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/multiview/slice_stack.h"

namespace wheatstone::viewer {

/// A stimulus of a study that can be looked at from anywhere: a painting (.wst), whose nearest marks lie on the screen,
/// or slices of particles (.exr).
class StudyScene {
 public:
  /// Whether a file's name says that it is one.
  static bool is_named(const std::filesystem::path& path);
  /// Throws Error{bad_input}.
  explicit StudyScene(const std::filesystem::path& path);

  Image<Rgb8> draw(ViewPosition view) const;

 private:
  std::variant<PreparedPainting, SliceStack> scene_;
};

}  // namespace wheatstone::viewer
