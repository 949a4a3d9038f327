#include "wheatstone/share/share_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "wheatstone/depth/comfort.h"
#include "wheatstone/drawing/hidden_strokes.h"
#include "wheatstone/error.h"
#include "wheatstone/files/deflate.h"
#include "wheatstone/painting/pictures_on_surfaces.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/mark_parts_internal.h"
#include "wheatstone/share/surface_parts_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_plans = 16;  // page/strokes.ts: mostPlans

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
  const bool vary = strokes_vary(painting);
  const auto& [bristle_px, streaks, ridge, dry, picture] = painting.brush;
  if (vary)
    facts["brush"] = {{"bristle", bristle_px},
                      {"streaks", streaks},
                      {"ridge", ridge},
                      {"dry", dry},
                      {"hasPicture", !picture.empty()}};
  if (!picture.empty()) parts.push_back({"brush", deflated(picture.cover())});
  Json layers = Json::array();
  Plans plans;
  for (const Layer& layer : painting.layers) {
    parts.push_back(strokes_part(fmt::format("layer-{}", layers.size()), layer, vary, rounding, plans));
    layers.push_back({{"radius", layer.radius_px}});
  }
  facts["layers"] = layers;
  facts["planned"] = facts_of(plans);
}

void add_marks(const RegionPainting& painting, const Rounding& rounding, Json& facts, std::vector<PagePart>& parts) {
  facts["kind"] = "regions";
  facts["stepsAPixel"] = rounding.steps_a_px;
  Plans plans;
  parts.push_back(regions_part("regions", painting, rounding, plans));
  facts["planned"] = facts_of(plans);
}

/// Kinds of marks that the page draws; of the others, it gets the pictures that the surfaces' views show.
template <class Marks>
constexpr bool draws_marks = requires(const Marks& marks, Json& facts, std::vector<PagePart>& parts) {
  add_marks(marks, Rounding(), facts, parts);
};

bool needs_pictures(const Painting& painting) {
  const auto is_drawn = []<class Marks>(const Marks& /*marks*/) { return draws_marks<Marks>; };
  return !std::visit(is_drawn, painting.marks) || painting.relief.depth_px > 0;
}

/// The strokes that some view shows.
StrokePainting strokes_that_show(const Painting& painting) {
  constexpr float least_share = 1.f / 32;
  std::vector<ViewPosition> views{central_view, left_eye, right_eye};
  for (const Surface& surface : painting.surfaces.seen)
    if (surface.continued) views.push_back(surface.view);
  return without_hidden_strokes(std::get<StrokePainting>(painting.marks), painting.surfaces, views, least_share);
}

/// Bytes of a page of so many pixels where nothing else is wanted.
std::size_t usual_bytes(int width, int height) {
  constexpr double usual_pixels = 640 * 480, bytes = 1'500'000;
  return static_cast<std::size_t>(bytes * std::max(static_cast<double>(width) * height / usual_pixels, 1.));
}

/// All of the page but the marks.
struct Ground {
  SharedPicture shared;
  Json facts;
};

Ground ground_of(const Painting& painting, const std::string& title) {
  Ground ground{.shared = {.width = width_of(painting), .height = height_of(painting)}, .facts = {}};
  const bool is_of_two_eyes = painting.surfaces.seen.empty();
  const ViewRange known = is_of_two_eyes ? ViewRange{} : known_views(painting.surfaces);
  ground.facts = {{"title", title},
                  {"width", ground.shared.width},
                  {"height", ground.shared.height},
                  {"separation", comfortable_separation(painting, comfortable_parallax_share)},
                  {"zeroParallax", nearest_disparity(painting)},
                  {"first", known.first.eye_separations()},
                  {"last", known.last.eye_separations()}};
  ground.facts["surfaces"] = add_surfaces(painting.surfaces, ground.shared.parts);
  const Presentation still{.views = {is_of_two_eyes ? left_eye : central_view}};
  ground.shared.still_jpeg = still_of(present(painting, still).views.front());
  return ground;
}

/// Lines of colour, and relief.
SharedPicture share_as_pictures(const Painting& painting, const std::string& title) {
  if (painting.surfaces.seen.empty())
    throw Error(ErrorKind::bad_input,
                "the painting has no surfaces, which pages of lines of colour and of relief need; paint its "
                "photographs again, with strokes that are propagated");
  Ground ground = ground_of(painting, title);
  ground.facts["kind"] = "layered";
  add_pictures(pictures_on_surfaces(painting).pictures, painting.surfaces, ground.shared.parts);
  ground.shared.facts = text_of(ground.facts);
  return ground.shared;
}

/// With as little rounding as leads to so few bytes, else with the most.
SharedPicture share_marks(const Painting& painting, const std::string& title, std::size_t most_bytes) {
  constexpr std::array roundings{Rounding{8, 1}, Rounding{4, 2}, Rounding{2, 4}};
  const Ground ground = ground_of(painting, title);
  SharedPicture shared;
  for (const Rounding& rounding : roundings) {
    shared = ground.shared;
    Json facts = ground.facts;
    const auto add = [&]<class Marks>(const Marks& marks) {
      if constexpr (draws_marks<Marks>) add_marks(marks, rounding, facts, shared.parts);
    };
    std::visit(add, painting.marks);
    shared.facts = text_of(facts);
    if (rounding.colour_step > 1)
      shared.note = fmt::format("places of marks are rounded to 1/{} of a pixel, and colours to {} levels of 256",
                                rounding.steps_a_px, rounding.colour_step);
    if (page_bytes(shared) <= most_bytes) break;
  }
  return shared;
}

}  // namespace

SharedPicture share_painting(const Painting& painting, const SharePaintingOptions& options) {
  const std::size_t most_bytes = options.most_bytes.value_or(usual_bytes(width_of(painting), height_of(painting)));
  const bool as_pictures = needs_pictures(painting);
  const auto share = [&](const Painting& one) {
    return as_pictures ? share_as_pictures(one, options.title) : share_marks(one, options.title, most_bytes);
  };
  Painting needed = painting;
  if (auto* const strokes = std::get_if<StrokePainting>(&needed.marks); strokes && !as_pictures)
    *strokes = strokes_that_show(painting);
  SharedPicture shared = share(needed);
  constexpr int smallest_px = 64;
  while (options.most_bytes && page_bytes(shared) > most_bytes &&
         std::min(shared.width, shared.height) >= 2 * smallest_px) {
    needed = placed(std::move(needed), {.scale = 0.5});
    shared = share(needed);
    shared.note +=
        fmt::format("{}the picture is {}x{} pixels", shared.note.empty() ? "" : "; ", shared.width, shared.height);
  }
  return shared;
}

}  // namespace wheatstone
