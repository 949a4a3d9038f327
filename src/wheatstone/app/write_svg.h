#pragma once

#include <filesystem>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// Writes a painting as one view sees it as an SVG document. Diffusion curves lie over the drawn view, which is
/// embedded as PNG, so that the document looks like the painting. Throws Error{cannot_read_write}.
void write_svg(const std::filesystem::path& path, const Painting& painting, ViewPosition view);

}  // namespace wheatstone
