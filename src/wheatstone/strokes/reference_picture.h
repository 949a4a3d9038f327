#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/image/orientation_field.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// The picture that a layer is planned from: the photograph, blurred to the detail that the layer's brush can show
/// (Hertzmann 1998; the median is Stavrakis & Gelautz 2004, sec. 3.2). In planes; all have the photograph's size.
struct ReferencePicture {
  Image<std::uint8_t> red, green, blue;
  Image<std::uint8_t> luminance;
  OrientationField orientation;
};

/// Width in pixels of the blur for a brush: K = 2·f_σ·R + 1, rounded to odd.
int blur_kernel_px(float blur, float radius_px);

/// Kernels wider than 5 pixels are applied to the picture reduced by a whole number until they are at most that wide.
ReferencePicture make_reference(ImageView<const Rgb8> photograph, float radius_px, const Style& style);

}  // namespace wheatstone
