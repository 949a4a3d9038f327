#pragma once

#include <filesystem>

#include "camera_motion.h"
#include "command.h"
#include "wheatstone/app/model_pictures.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::cli {

/// How a model of triangles is seen that becomes a photograph of two views, as it is typed.
struct ModelArguments {
  ModelArguments();
  RenderParticlesOptions seen;
  PictureSize size{1200, 900};  ///< of the pictures
};

/// The options of a camera and of the file.
Rows model_rows(ModelArguments& arguments);

/// Renders it for all `wanted` views. Throws as ready_model and model_pictures.
ModelPictures render_model_argument(const std::filesystem::path& file, const ModelArguments& arguments,
                                    ViewRange wanted, const Session& session);

/// A film of it, whose camera moves. Throws as ready_model and film_of_model.
ModelFilm film_of_model_argument(const std::filesystem::path& file, const ModelArguments& arguments,
                                 const CameraMotion& motion, Rational rate, const Session& session);

/// All that is typed of a model's look in a film and decides a byte of its pictures, as text.
std::string recipe_of(const ModelArguments& arguments, const CameraMotion& motion, Rational rate);

}  // namespace wheatstone::cli
