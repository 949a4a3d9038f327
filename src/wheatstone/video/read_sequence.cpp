#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/video/read_sequence_internal.h"

namespace wheatstone {

PictureSequence::PictureSequence(const std::filesystem::path& path, FramePattern pattern, Rational rate)
    : pattern_(std::move(pattern)) {
  const std::vector<std::int64_t> numbers = numbers_without_hole(pattern_);
  first_ = numbers.front();
  count_ = static_cast<std::int64_t>(numbers.size());
  is_multiview_ = is_multiview_exr(pattern_.file(first_));
  const Image<Rgb8> first = picture(first_);
  facts_.container = "sequence";
  facts_.codec = path.extension().empty() ? "" : path.extension().string().substr(1);
  facts_.pixel_format = describe_image(pattern_.file(first_)).bits > 8 ? "rgb48le" : "rgb24";
  facts_.width = first.width();
  facts_.height = first.height();
  facts_.frame_rate = rate;
  facts_.time_base = {rate.denominator, rate.numerator};
  facts_.duration_s = static_cast<double>(count_) / rate.value();
  facts_.frame_count = count_;
  if (pattern_.after != ".exr") return;
  facts_.layout = is_multiview_ ? StereoLayout::left_right : StereoLayout::mono;
  facts_.layout_how = "the views of the pictures";
}

/// The views of both eyes lie side by side.
Image<Rgb8> PictureSequence::picture(std::int64_t number) const {
  const std::filesystem::path file = pattern_.file(number);
  if (!is_multiview_) return read_image(file);
  const std::vector<Image<Rgb8>> views = read_multiview_exr(file);
  if (views.size() != 2) refuse_film(file, fmt::format("{} views, expected two", views.size()));
  return put_together(views[0], views[1], StereoLayout::left_right);
}

void PictureSequence::convert_deep(Image<Rgb16>& picture) const {
  const std::filesystem::path file = pattern_.file(first_ + next_ - 1);
  if (!is_multiview_) {
    picture = read_deep_image(file);
    return;
  }
  const std::vector<Image<Rgb16>> views = read_deep_multiview_exr(file);
  picture = put_together(views.front(), views.back(), StereoLayout::left_right);
}

void PictureSequence::seek_before(double seconds) {
  const double frame = std::floor(seconds * facts_.frame_rate.value());
  next_ = static_cast<std::int64_t>(std::clamp(frame, 0.0, static_cast<double>(count_)));
}

bool PictureSequence::step() {
  if (next_ >= count_) return false;
  ++next_;
  return true;
}

void PictureSequence::convert(Image<Rgb8>& picture) const {
  picture = this->picture(first_ + next_ - 1);
  if (picture.width() == facts_.width && picture.height() == facts_.height) return;
  refuse_film(pattern_.file(first_ + next_ - 1),
              fmt::format("{}x{} pixels, expected {}x{} like the first of its sequence", picture.width(),
                          picture.height(), facts_.width, facts_.height));
}

}  // namespace wheatstone
