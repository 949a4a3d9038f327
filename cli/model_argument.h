#pragma once

#include <filesystem>

#include "command.h"
#include "wheatstone/app/render_model_file.h"
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

}  // namespace wheatstone::cli
