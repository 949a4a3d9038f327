#pragma once

#include <filesystem>
#include <optional>

#include "wheatstone/image/image.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Disparities that were made by hand for the left eye of a frame (read_disparity). Throws Error{bad_input} that begins
/// with the file, also where its size is not the frame's.
Image<float> read_frame_disparity(const std::filesystem::path& file, PictureSize frame);

/// The geometry of a frame with what was corrected by hand, none where nothing is: where the disparities of the file
/// `by_hand` differ from the left eye's that were `found` by more than a pixel of the frame. If there is no file, with
/// the `corrections` of the frame before, brought along the left eye's flow `to_before`. The right eye's disparities
/// follow from the left one's. Those found have the size of the frame, or half of it. `corrections` become this
/// frame's: NaN where it is as found, empty where nothing is corrected. Throws as read_frame_disparity.
std::optional<StereoGeometry> corrected(const Image<float>& found, const std::filesystem::path& by_hand,
                                        PictureSize frame, const Flow& to_before, Image<float>& corrections);

}  // namespace wheatstone
