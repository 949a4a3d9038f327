#pragma once

#include <span>
#include <variant>

#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

/// How views become one picture for a display: under lenses, as a quilt, for coloured glasses, or both eyes as a layout
/// has them.
using DisplayComposition = std::variant<LenticularScreen, QuiltLayout, AnaglyphKind, StereoLayout>;

/// The picture: what interleave, make_quilt, anaglyph and put_together make. Throws as these do, and Error{wrong_usage}
/// where there are not two views for two eyes.
Image<Rgb8> compose(std::span<const Image<Rgb8>> views, const DisplayComposition& composition);

/// The same by a device, with the same bytes. A graphics processor throws Error{wrong_usage} where there is none, or it
/// fails; what it does not compose (composes_on_gpu), and views for a device that is automatic, are composed by the
/// processor, as they lie in its memory.
Image<Rgb8> compose(std::span<const Image<Rgb8>> views, const DisplayComposition& composition, Device device);

/// All but layouts that squeeze or place whole eyes.
bool composes_on_gpu(const DisplayComposition& composition);

}  // namespace wheatstone
