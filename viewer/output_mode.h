#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "view_state.h"
#include "wheatstone/depth/view_position.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone::viewer {

/// One eye's picture alone.
enum class SingleEye { left, right };
/// Views one after the other, there and back.
struct Wiggle {};
inline constexpr int wiggle_views = 5;
/// Every other picture that the screen shows is the other eye's.
struct PageFlip {};
/// All views of a display side by side, or under its lenses.
struct Quilt {};
struct Lenticular {};

/// A way in which what is open is put on the screen.
struct OutputMode {
  std::string_view name;  ///< as `wheatstone pack --to` has it, where it has it
  std::string text;       ///< for people
  std::variant<SingleEye, StereoLayout, const AnaglyphKind*, Wiggle, PageFlip, Quilt, Lenticular> kind;
};

/// All modes, in the order in which they are stepped through.
std::span<const OutputMode> output_modes();

/// Throws Error{wrong_usage} that lists the names.
const OutputMode& find_output_mode(std::string_view name);

/// Whether the mode shows all views of a display instead of two eyes.
bool shows_display_views(const OutputMode& mode);

/// What the mode puts rows, columns or squares of both eyes on a screen as; none where it does not.
std::optional<StereoLayout> interlaced_layout(const OutputMode& mode);

/// The same layout as it is to be filled from pixel (x, y) of a screen on, so that the eyes keep their places on it.
StereoLayout layout_from(StereoLayout layout, int x, int y);

/// The positions from which a state's two eyes look: with the lens simulator those of the display's views.
struct EyePositions {
  ViewPosition left, right;
};
EyePositions eye_positions(const ViewState& state);

/// What of a neighbouring view an eye sees as well.
struct LeakingView {
  ViewPosition view;
  float share = 0;
};

/// What crosstalk lets through to the left eye and to the right one: half of it of each of the neighbours of the
/// display's view that the lens simulator shows, else the other eye's view. Nothing without crosstalk.
struct Leaks {
  std::vector<LeakingView> left, right;
};
Leaks leaks_of(const ViewState& state);

/// Which of the display's views each eye sees, as one line; empty without the lens simulator.
std::string seen_views_told(const ViewState& state);

/// What somebody looks with, and how pictures are put on the screen for it.
struct LookingWith {
  std::string_view name;     ///< "red-cyan"
  std::string_view text;     ///< for people
  std::string_view mode;     ///< an output mode
  std::string_view display;  ///< a display preset; empty: any
};

/// The first is that of somebody who has not said anything: no glasses.
std::span<const LookingWith> devices();

/// Throws Error{wrong_usage} that lists the names.
const LookingWith& find_device(std::string_view name);

}  // namespace wheatstone::viewer
