#pragma once

#include <filesystem>

#include "render_arguments.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/progress.h"

namespace wheatstone::cli {

/// The views of depth planes that were written before, with the depth that --near, --far or
/// --depth-mapping ask for.
RenderedParticles render_slice_file(const std::filesystem::path& file, const Given& given,
                                    const RenderParticlesOptions& options, const Progress& progress);

}  // namespace wheatstone::cli
