#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/app/render_particles.h"
#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/marks/mapped_depth.h"
#include "wheatstone/marks/slicing.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/retouch.h"

namespace wheatstone::viewer {

/// Where on the screen there is more depth than elsewhere: the options of `wheatstone render` of these names.
struct ScreenFocus {
  static constexpr float usual_radius = 0.25f, usual_gain = 1.5f;
  std::optional<std::array<float, 2>> at;  ///< from 0 to 1, from the upper left; none: the same depth everywhere
  float radius = usual_radius;             ///< as a share of the width
  float gain = usual_gain;
  friend bool operator==(const ScreenFocus&, const ScreenFocus&) = default;
};

/// What is read of a file of particles, as the options of `wheatstone render` have it.
struct ParticleChoice {
  std::string quantity;      ///< RenderParticlesOptions::quantity
  std::string where;         ///< the condition for particles that are kept; empty: all are
  std::string type_colours;  ///< types in colours of their own; empty: gas
  friend bool operator==(const ParticleChoice&, const ParticleChoice&) = default;
};

/// How particles look, and how deep they or slices stand: the options of `wheatstone render` of these names. Empty:
/// what `render` takes without the option.
struct ParticleLook {
  Look look = Look::mass;
  ParticleChoice choice;
  Stretch stretch = Stretch::asinh;
  /// Where the brightness of mass begins and ends. Empty until the first picture has found it.
  std::optional<float> least, most;
  /// What the light of the thesis's look is multiplied by. Empty until the first picture of all particles has found it.
  std::optional<float> exposure;
  bool annotated = false;                 ///< with a scale bar, a colour bar and the redshift
  std::string title;                      ///< of what is annotated
  float annotation_behind_mm = 0;         ///< where all of that stands, behind the screen
  std::optional<float> coldest, hottest;  ///< where the colours begin and end
  std::string colours;                    ///< a colour map's name
  float smallest_px = 2, largest_px = 6;  ///< diameter of a splat
  float opacity = 0.5f;
  bool opaque = false;
  std::optional<float> near_mm, far_mm;  ///< before and behind the display's screen
  ScreenFocus focus;
  friend bool operator==(const ParticleLook&, const ParticleLook&) = default;
};

/// The look that is drawn: opaque particles have that of the thesis.
inline Look drawn_look(const ParticleLook& look) { return look.opaque ? Look::thesis : look.look; }

/// Fills in what a picture of all particles has found.
inline void keep_brightness(ParticleLook& look, const Brightness& found) {
  if (drawn_look(look) == Look::thesis) {
    if (!look.exposure) look.exposure = found.exposure;
    return;
  }
  if (!look.least) look.least = found.least;
  if (!look.most) look.most = found.most;
}

/// Forgets what the first picture has found, for something else is shown.
inline void forget_brightness(ParticleLook& look) {
  look.exposure.reset();
  look.least.reset();
  look.most.reset();
}

/// What is seen of a photograph beside its painting.
enum class Comparison {
  painting,    ///< the painting alone
  photograph,  ///< the photograph instead
  split,       ///< the photograph in the left half of the screen
  depth,       ///< the photograph under its disparity in false colours
};

inline constexpr std::array<std::string_view, 4> comparison_names{"painting", "photograph", "split",
                                                                  "depth"};  ///< in their order

/// How the two eyes are brought onto the screen.
struct Adjustment {
  float zero_parallax_px = 0;  ///< disparity, in pixels of the picture, that lies on the screen plane
  float separation = 1;        ///< of the two eyes that look, in eye separations of the picture
  float vertical_px = 0;       ///< the right eye's picture lies so many screen pixels lower
  float roll_deg = 0;          ///< and is turned so far clockwise
  friend bool operator==(const Adjustment&, const Adjustment&) = default;
};

/// Which part of the picture is seen, and how large.
struct Framed {
  double zoom = 0;              ///< screen pixels for one of the picture; 0: as fits
  double pan_x = 0, pan_y = 0;  ///< of the picture's middle from the screen's, in pixels of the picture
  friend bool operator==(const Framed&, const Framed&) = default;
};

/// Everything that decides what is seen of what is open: plain data, which can be compared, kept and brought back.
struct ViewState {
  std::string mode = "left";  ///< an output mode
  bool swap = false;
  Adjustment adjustment;
  Framed framed;
  float head = 0;                       ///< of the viewer, in eye separations to the right of the middle
  bool quantised = false;               ///< eyes see the nearest of the display's views, as under its lenses
  std::string display = "desk-stereo";  ///< a display preset
  std::string screen;                   ///< calibration or name of a lenticular screen; empty: the display's
  Slicing slicing;                      ///< of strokes
  float layers_apart_deg = 0;           ///< a look from so far to the side at the layers of detail; 0: from the front
  float crosstalk = 0;  ///< share, 0..1, of the light in each eye that comes from the neighbouring views
  std::vector<DepthRegion> depth_regions;   ///< where the scene's parts are to seem; none: as in the photographs
  std::optional<DepthAround> depth_around;  ///< more depth where somebody looks; none: everywhere the same
  Comparison comparison = Comparison::painting;
  std::vector<Touch> touches;  ///< by hand, of what the photograph is painted with
  Style style;
  wheatstone::Framing orbit{.zoom = 1.2f};  ///< of particles
  ParticleLook look;
  double share = 0;  ///< of the time of a series of particles, or of a camera path: 0 its beginning, 1 its end
  int step = 0;      ///< of a wiggle
  friend bool operator==(const ViewState&, const ViewState&) = default;
};

}  // namespace wheatstone::viewer
