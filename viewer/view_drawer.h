#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "content.h"
#include "model_drawer.h"
#include "particle_scene.h"
#include "view_state.h"
#include "wheatstone/depth/view_position.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/multiview/scene.h"

namespace wheatstone::viewer {

/// Which part of the views is wanted: pixels of the picture, `scale` times as large.
struct WantedPart {
  double scale = 1;
  int left = 0, top = 0, width = 0, height = 0;
  friend bool operator==(const WantedPart&, const WantedPart&) = default;
};

/// Pictures of views, with disparity 0 where it is in the content. They show at least what was wanted where the content
/// reaches so far.
struct DrawnViews {
  std::vector<Image<Rgb8>> pictures;    ///< of one size
  std::vector<ViewPosition> positions;  ///< that they show: where there are pictures only, the nearest to those wanted
  double scale = 1;
  int left = 0, top = 0;                 ///< of the pictures' corner, in pixels of the content `scale` times as large
  bool preliminary = false;              ///< drawn quickly: another drawing with all effort shows more
  std::optional<Brightness> brightness;  ///< of particles
  std::shared_ptr<const std::vector<Image<float>>> depth = {};  ///< of a model: DrawnModel::depth
};

/// Draws views of what is open, and keeps what the next drawing can use again. Of one thread.
class ViewDrawer {
 public:
  /// What is open as placed_content has it. Until the next call.
  const Content& placed(const Content& content, const ViewState& state);
  /// Such content as bent_content has it. Until the next call.
  const Content& bent(const Content& content, const ViewState& state);

  /// The painting, or where there is none what it would be painted from.
  const DrawnViews& painted(const Content& content, const ViewState& state, const WantedPart& part,
                            const std::vector<ViewPosition>& positions, Effort effort = Effort::whole);

  /// The photograph, under its disparity in false colours where `with_depth` says so; none where the content has none.
  const DrawnViews* photographed(const Content& content, const WantedPart& part,
                                 const std::vector<ViewPosition>& positions, bool with_depth);

  /// All views of the state's display, of its size, as `wheatstone paint --display` makes them. Throws Error where the
  /// content cannot be drawn for more than two views.
  const std::vector<Image<Rgb8>>& display_views(const Content& content, const ViewState& state);

 private:
  DrawnViews draw_painting(const std::shared_ptr<const Painting>& painting, const Slicing& slicing,
                           const WantedPart& part, const std::vector<ViewPosition>& positions);

  /// Whether the views that were drawn last are these of the painting that is prepared.
  bool shows_prepared(const std::vector<ViewPosition>& positions) const;

  /// The slices as deep as the state has them.
  const SliceStack& placed_slices(const SlicesContent& content, const ViewState& state);

  /// What of a state decides the pictures of particles and slices; of paintings it is the same for all.
  struct Placing {
    wheatstone::Framing orbit;
    ParticleLook look;
    std::string display;
    std::vector<DepthRegion> regions;
    friend bool operator==(const Placing&, const Placing&) = default;
  };
  static Placing placing_of(const Content& content, const ViewState& state);

  struct Prepared {
    std::shared_ptr<const Painting> painting;
    WantedPart part;
    Slicing slicing;
    PreparedPainting ready;
  };
  struct Drawn {
    Content content;
    WantedPart part;
    Slicing slicing;
    Placing placing;
    std::vector<ViewPosition> wanted;
    DrawnViews views;
  };
  struct DisplayDrawn {
    Content content;
    std::string display;
    float zero_parallax_px = 0;
    Placing placing;
    std::vector<Image<Rgb8>> views;
  };
  struct Placed {
    Content content;
    std::vector<DepthRegion> regions;
    std::string display;
    bool for_display = false;
    Content placed;
  };
  std::optional<Placed> placed_;
  struct Bent {
    Content content;
    DepthAround around;
    bool for_display = false;
    Content bent;
  };
  std::optional<Bent> bent_;
  std::optional<Prepared> prepared_;
  std::optional<Drawn> drawn_, photographed_;
  bool photographed_with_depth_ = false;
  std::optional<DisplayDrawn> display_;
  ParticleDrawer particles_;
  ModelDrawer models_;
  struct PlacedSlices {
    SlicesContent content;
    Placing placing;
    SliceStack slices;
  };
  std::optional<PlacedSlices> placed_slices_;
};

}  // namespace wheatstone::viewer
