#include "model_argument.h"

#include <array>

#include "options.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/files/struct_fields.h"

namespace wheatstone::cli {

ModelArguments::ModelArguments() {
  seen.framing.zoom = Framing().zoom;
  // About 3 % of the width from the nearest point to the farthest.
  seen.depth.near_mm = 55;
  seen.depth.far_mm = 60;
}

Rows model_rows(ModelArguments& arguments) {
  RenderParticlesOptions& seen = arguments.seen;
  constexpr static std::array<Choice<UpAxis>, 3> axes{
      {{"auto", UpAxis::by_format}, {"y", UpAxis::y}, {"z", UpAxis::z}}};
  return {
      row("--azimuth", number(seen.framing.azimuth_deg, {-360, 360}),
          "Direction that the camera looks from, in degrees"),
      row("--elevation", number(seen.framing.elevation_deg, elevation_range),
          "Height of the camera above the horizon, in degrees"),
      row("--fov", number(seen.framing.field_of_view_deg, field_of_view_range), "Horizontal field of view, in degrees"),
      row("--zoom", number(seen.framing.zoom, zoom_range), "Magnification: 2 shows half as much"),
      row("--picture-size", size(arguments.size, view_side_range), "Size of the pictures: WIDTHxHEIGHT"),
      row("--up", choice(seen.model.choice.up, axes),
          "Axis of the model that is up; auto: y in OBJ and glTF, z in PLY and STL"),
      row("--crease", number(seen.model.choice.crease_deg, crease_range_deg),
          "For models without normals: triangles that meet at a larger angle than this, in degrees, have an edge "
          "between them"),
      row("--model-texture", of_type("FILE", text(seen.model.choice.texture)),
          "Texture picture for a model that names none"),
      row("--model-background", parsed(seen.model.background, parse_colour, "COLOUR", "#3a3e44"),
          "Colour around the model")};
}

namespace {

RenderParticlesOptions seen_by(const ModelArguments& arguments) {
  RenderParticlesOptions seen = arguments.seen;
  seen.width = arguments.size.width;
  seen.height = arguments.size.height;
  return seen;
}

}  // namespace

ModelPictures render_model_argument(const std::filesystem::path& file, const ModelArguments& arguments,
                                    ViewRange wanted, const Session& session) {
  const RenderParticlesOptions seen = seen_by(arguments);
  return model_pictures(ready_model(file, seen, session.progress), seen, wanted, session.progress);
}

ModelFilm film_of_model_argument(const std::filesystem::path& file, const ModelArguments& arguments,
                                 const CameraMotion& motion, Rational rate, const Session& session) {
  const RenderParticlesOptions seen = seen_by(arguments);
  return film_of_model(ready_model(file, seen, session.progress), moved(motion, seen), rate);
}

std::string recipe_of(const ModelArguments& arguments, const CameraMotion& motion, Rational rate) {
  return fmt::format("{}{}{}{}{}", text_of_fields(arguments.seen.framing), text_of_fields(arguments.seen.model),
                     text_of_fields(arguments.size), text_of_fields(motion), text_of_fields(rate));
}

}  // namespace wheatstone::cli
