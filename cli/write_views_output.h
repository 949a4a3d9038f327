#pragma once

#include <span>
#include <string>

#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/image/image.h"
#include "wheatstone/progress.h"

namespace wheatstone::cli {

/// Writes one quilt and returns its name: the output's where that has an ending, and else the output's with the
/// display's convention. `aspect` is the screen's; 0: a view's own. Throws Error{cannot_read_write}.
std::string write_quilt(std::span<const Image<Rgb8>> views, const QuiltLayout& layout, double aspect,
                        const std::string& output);

/// Writes one picture with the views interleaved under the screen's lenses, and returns its name: the output's, with
/// ".png" where that has no ending. Throws Error{cannot_read_write}.
std::string write_lenticular(std::span<const Image<Rgb8>> views, const LenticularScreen& screen,
                             const std::string& output);

/// Writes view_000.png, the leftmost, and so on into a folder that appears when all are there.
/// Throws Error{cannot_read_write}.
void write_view_folder(std::span<const Image<Rgb8>> views, const std::string& folder, const Progress& progress = {});

}  // namespace wheatstone::cli
