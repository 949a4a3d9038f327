#include "wheatstone/share/share_painting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "wheatstone/app/present_pair.h"
#include "wheatstone/app/redraw.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/disparity_code.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/mark_parts_internal.h"

namespace wheatstone {
namespace {

using Json = nlohmann::ordered_json;

constexpr int still_quality = 60;
constexpr std::size_t most_plans = 16;  // page/strokes.ts: mostPlans

/// Disparities in fewer steps than a painting file has. They tell what hides marks, where far more than this counts.
Image<float> rounded(const Image<float>& disparity) {
  constexpr float steps_a_px = 4;
  Image<float> result(disparity.width(), disparity.height());
  std::ranges::transform(disparity.pixels(), result.pixels().begin(),
                         [](float d) { return std::round(d * steps_a_px) / steps_a_px; });
  return result;
}

/// Surfaces as parts, and what is told of them.
Json add_surfaces(const Surfaces& surfaces, std::vector<PagePart>& parts) {
  Json seen = Json::array();
  for (const Surface& surface : surfaces.seen) {
    parts.push_back({fmt::format("surface-{}", seen.size()), encode_disparities(rounded(surface.disparity))});
    seen.push_back({{"view", surface.view.eye_separations()},
                    {"left", surface.left_px},
                    {"width", surface.disparity.width()},
                    {"height", surface.disparity.height()},
                    {"continued", surface.continued}});
  }
  return {{"tolerance", surfaces.tolerance_px}, {"seen", seen}};
}

Json facts_of(const Plans& plans) {
  if (plans.all().size() > most_plans)
    throw Error(ErrorKind::bad_input,
                fmt::format("the painting's marks were planned in {} different ways, expected at most {}",
                            plans.all().size(), most_plans));
  Json facts = Json::array();
  for (const Planned& planned : plans.all())
    facts.push_back({{"reference", planned.reference.eye_separations()},
                     {"first", planned.views.first.eye_separations()},
                     {"last", planned.views.last.eye_separations()}});
  return facts;
}

void add_marks(const StrokePainting& painting, const Rounding& rounding, Json& facts, std::vector<PagePart>& parts) {
  facts["kind"] = "strokes";
  facts["canvas"] = {painting.canvas_colour.r, painting.canvas_colour.g, painting.canvas_colour.b};
  facts["opaque"] = !painting.canvas_shows;
  facts["stepsAPixel"] = rounding.steps_a_px;
  facts["colourStep"] = rounding.colour_step;
  Json layers = Json::array();
  Plans plans;
  for (const Layer& layer : painting.layers) {
    parts.push_back(strokes_part(fmt::format("layer-{}", layers.size()), layer, rounding, plans));
    layers.push_back({{"radius", layer.radius_px}});
  }
  facts["layers"] = layers;
  facts["planned"] = facts_of(plans);
}

template <class Marks>
void add_marks(const Marks& /*painting*/, const Rounding& /*rounding*/, Json& /*facts*/,
               std::vector<PagePart>& /*parts*/) {
  throw Error(ErrorKind::bad_input, "only paintings of strokes can be shared");
}

/// Bytes of the page, but for its code.
std::size_t size_of(const SharedPicture& picture) {
  std::size_t bytes = picture.facts.size() + picture.still_jpeg.size() * 4 / 3;
  for (const PagePart& part : picture.parts) bytes += part.bytes.size() * 4 / 3;
  return bytes;
}

}  // namespace

SharedPicture share_painting(const Painting& painting, const SharePaintingOptions& options) {
  SharedPicture ground{.width = width_of(painting), .height = height_of(painting)};
  const bool is_of_two_eyes = painting.surfaces.seen.empty();
  const ViewRange known = is_of_two_eyes ? ViewRange{} : known_views(painting.surfaces);
  Json common{{"title", options.title},
              {"width", ground.width},
              {"height", ground.height},
              {"separation", comfortable_separation(painting, comfortable_parallax_share)},
              {"zeroParallax", nearest_disparity(painting)},
              {"first", known.first.eye_separations()},
              {"last", known.last.eye_separations()}};
  common["surfaces"] = add_surfaces(painting.surfaces, ground.parts);
  ground.still_jpeg = encode_jpeg(draw(painting, is_of_two_eyes ? left_eye : central_view).picture, still_quality);

  constexpr double usual_pixels = 640 * 480;
  const double most_bytes = std::max(static_cast<double>(ground.width) * ground.height / usual_pixels, 1.) *
                                static_cast<double>(options.most_bytes) -
                            static_cast<double>(page_element_code().size());
  SharedPicture shared;
  for (const Rounding& rounding : {Rounding{8, 1}, Rounding{4, 2}, Rounding{2, 4}}) {
    shared = ground;
    Json facts = common;
    std::visit([&](const auto& marks) { add_marks(marks, rounding, facts, shared.parts); }, painting.marks);
    shared.facts = facts.dump(-1, ' ', true, Json::error_handler_t::replace);
    if (static_cast<double>(size_of(shared)) <= most_bytes) break;
  }
  return shared;
}

}  // namespace wheatstone
