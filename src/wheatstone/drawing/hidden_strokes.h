#pragma once

#include <span>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// The strokes of a painting, without those that none of these views shows. Each layer is judged as if it were the
/// last, so that pictures of fewer layers do not change either. A stroke that would change no pixel by more than
/// `least_share` of its colour's distance counts as hidden.
StrokePainting without_hidden_strokes(const StrokePainting& painting, const Surfaces& surfaces,
                                      std::span<const ViewPosition> views, float least_share);

}  // namespace wheatstone
