#include "wheatstone/depth/rig.h"

namespace wheatstone {

Rig evenly_spaced(int width, int height, int count, float span) {
  Rig rig{.width = width, .height = height, .positions = {}};
  for (int i = 0; i < count; ++i)
    rig.positions.emplace_back(count > 1 ? span * (static_cast<float>(i) / static_cast<float>(count - 1) - 0.5f) : 0.f);
  return rig;
}

}  // namespace wheatstone
