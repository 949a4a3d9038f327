#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Pixels to read, lent or owned. Made from an image that goes on to exist, it borrows the pixels; made from one that
/// is given away (`std::move`, or a function's result), it owns them. Copies share the pixels.
template <class Pixel>
class SharedImage : public ImageView<const Pixel> {
 public:
  SharedImage() = default;
  SharedImage(ImageView<const Pixel> lent) : ImageView<const Pixel>(lent) {}
  SharedImage(ImageView<Pixel> lent) : ImageView<const Pixel>(lent) {}
  SharedImage(const Image<Pixel>& lent) : ImageView<const Pixel>(lent.view()) {}
  SharedImage(Image<Pixel>&& given) : SharedImage(std::make_shared<const Image<Pixel>>(std::move(given))) {}

 private:
  explicit SharedImage(std::shared_ptr<const Image<Pixel>> owned)
      : ImageView<const Pixel>(owned->view()), owned_(std::move(owned)) {}

  std::shared_ptr<const Image<Pixel>> owned_;
};

template <class Pixel>
Image<Pixel> copy_of(ImageView<const Pixel> pixels) {
  Image<Pixel> copy(pixels.width(), pixels.height());
  for (int y = 0; y < pixels.height(); ++y) std::ranges::copy(pixels.row(y), copy.row(y).begin());
  return copy;
}

}  // namespace wheatstone
