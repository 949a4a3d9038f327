#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "options.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/image/image.h"
#include "wheatstone/pictures/picture_notes.h"
#include "wheatstone/progress.h"

namespace wheatstone::cli {

/// The pictures in a folder, by their endings, in the order of their names.
std::vector<std::filesystem::path> pictures_in_folder(const std::filesystem::path& folder);

/// Where views go, and what must not be written over.
struct ViewsOutput {
  std::string name;                           ///< of a file or a folder
  std::vector<std::filesystem::path> inputs;  ///< the files that the run reads
  std::string format = "png";                 ///< of pictures whose names are not typed in full
  PictureNotes notes = {};                    ///< what the files say beside the pictures
};

/// Says before the work what writing would refuse: an output that is an input, or a folder whose views are inputs.
/// Throws Error{wrong_usage} that names the file.
void check_views_output(const ViewsOutput& output);

/// Writes one quilt and returns its name: the output's where that has an ending, and else the output's with the
/// display's convention. `aspect` is the screen's; 0: a view's own. Throws Error: cannot_read_write, or wrong_usage
/// where that is an input.
std::string write_quilt(ImageView<const Rgb8> quilt, const QuiltLayout& layout, double aspect,
                        const ViewsOutput& output);

/// Writes one picture with the views interleaved under a screen's lenses, and returns its name: the output's, with the
/// format's ending where that has none. Throws Error: cannot_read_write, or wrong_usage where that is an input.
std::string write_lenticular(ImageView<const Rgb8> picture, const ViewsOutput& output);

/// png, jpg, tif or webp.
Value picture_format(std::string& format);

/// Throws Error{wrong_usage} where --format was given beside a file name whose ending says another.
void check_format_fits(const Given& given, const ViewsOutput& output);

/// Throws Error{wrong_usage} where an output that is one picture has an ending that no picture has, naming those that
/// there are. `option` is the output's.
void check_picture_ending(const std::string& option, const std::string& output);

/// Writes view_000.png, the leftmost, and so on, or in another format, into a folder that appears when all are there.
/// In a folder that exists they replace all views that are there. Throws Error: cannot_read_write, or wrong_usage where
/// an input is in the way.
void write_view_folder(std::span<const Image<Rgb8>> views, const ViewsOutput& output, const Progress& progress = {});

}  // namespace wheatstone::cli
