#include "wheatstone/multiview/slice_band_internal.h"

namespace wheatstone {

SliceBand::SliceBand(int left, int right, int rows, int planes, bool hides)
    : left_(left),
      right_(right),
      rows_(rows),
      planes_(planes),
      channels_(hides ? 4 : 3),
      stride_(LightBand(left, right, 0, LightBand::most_channels).width_with_margins()),
      // A vector may be read from the last pixel on.
      values_(static_cast<std::size_t>(stride_) * channels_ * rows * planes + 16),
      lit_(static_cast<std::size_t>(planes) * rows) {}

}  // namespace wheatstone
