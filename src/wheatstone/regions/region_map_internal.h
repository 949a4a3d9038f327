#pragma once

#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A picture cut into connected regions, none of which spans two surfaces.
struct RegionMap {
  Image<std::int32_t> of;  ///< the number of each pixel's region, 0 … count − 1; −1: none
  int count = 0;
};

/// Mean colour and disparity of a region, and its size in pixels.
struct RegionMeans {
  double red = 0, green = 0, blue = 0, disparity = 0;
  std::int64_t area = 0;
};

/// Rounded to bytes.
Rgb8 mean_colour(const RegionMeans& means);

/// Two neighbours share a region where their labels are equal and their disparities differ by at most `threshold_px`.
/// Pixels with a negative label belong to none. Both pictures are of one size.
RegionMap connected_regions(ImageView<const std::int32_t> labels, ImageView<const float> disparity, float threshold_px);

std::vector<RegionMeans> means_of(const RegionMap& regions, ImageView<const Rgb8> photograph,
                                  ImageView<const float> disparity);

/// Joins every region smaller than `least_area` pixels to the neighbour on its own surface whose colour is nearest. A
/// speck that is alone on its surface stays.
RegionMap without_small_regions(RegionMap regions, ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                                float threshold_px, std::int64_t least_area);

}  // namespace wheatstone
