#include "wheatstone/strokes/refit_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace wheatstone {
namespace {

bool may_compare(const LayerPlan& plan, std::size_t blocks, const LayerFit& before) {
  return before.blocks.size() == blocks && before.style == plan.style && before.radius_px == plan.radius_px &&
         before.least_gain == plan.least_gain && before.depth_threshold_px == plan.depth_threshold_px &&
         same_size(before.red, plan.reference.red) && same_size(before.seeds, plan.seeds);
}

template <class Pixel>
Image<Pixel> of_size(const LayerPlan& plan) {
  return {plan.canvas.width, plan.canvas.height};
}

LayerFit nothing_known(const LayerPlan& plan, std::size_t blocks) {
  LayerFit fit{plan.style, plan.radius_px, plan.least_gain, plan.depth_threshold_px};
  for (Image<std::uint8_t>* const plane : {&fit.red, &fit.green, &fit.blue}) *plane = of_size<std::uint8_t>(plan);
  fit.seeds = Image<std::uint8_t>(plan.seeds.width(), plan.seeds.height());
  fit.disparity = fit.weights = of_size<float>(plan);
  for (PaintedPicture& canvas : fit.canvases) canvas = of_size<PaintedPixel>(plan);
  fit.blocks.resize(blocks);
  return fit;
}

/// Marks the pixels in which two rows differ, and makes the first one equal the second.
template <class Pixel>
void take_over(std::span<Pixel> before, std::span<const Pixel> now, std::span<std::uint8_t> differs) {
  if (std::memcmp(before.data(), now.data(), before.size_bytes()) == 0) return;
  for (std::size_t x = 0; x < before.size(); ++x)
    if (!(before[x] == now[x])) differs[x] = 255;
  std::ranges::copy(now, before.begin());
}

template <class Pixel>
bool are_equal(ImageView<const Pixel> a, ImageView<const Pixel> b) {
  if (!same_size(a, b)) return false;
  for (int y = 0; y < a.height(); ++y)
    if (std::memcmp(a.row(y).data(), b.row(y).data(), a.row(y).size_bytes()) != 0) return false;
  return true;
}

}  // namespace

bool ViewFit::holds(const View& now, const Style& style_now, const ViewsBeside& beside_now,
                    int reference_width_now) const {
  return style == style_now && reference_width == reference_width_now && beside == beside_now &&
         view.position == now.position && view.frame == now.frame && view.continued == now.continued &&
         are_equal<std::uint8_t>(view.detail, now.detail) && are_equal<std::uint8_t>(view.wanted, now.wanted) &&
         are_equal<float>(view.disparity, now.disparity) && are_equal<Rgb8>(view.colour, now.colour);
}

Refit::Refit(const LayerPlan& plan, const PaintedPicture& canvas, std::size_t blocks, LayerFit& before)
    : before_(before), differs_(canvas.width(), canvas.height()) {
  const bool comparable = may_compare(plan, blocks, before);
  if (!comparable) before_ = nothing_known(plan, blocks);
  tbb::parallel_for(0, canvas.height(), [&](int y) { compare_row(plan, canvas, y); });
  if (!comparable) {
    before_.orientation = plan.reference.orientation;
    std::ranges::fill(differs_.pixels(), std::uint8_t{255});
    return;
  }
  plan.reference.orientation.visit_differences(before_.orientation, [this](int left, int top, int right, int bottom) {
    mark({left, top, right, bottom});
  });
  before_.orientation = plan.reference.orientation;
}

void Refit::compare_row(const LayerPlan& plan, const PaintedPicture& canvas, int y) {
  const auto differs = differs_.row(y);
  take_over(before_.red.row(y), std::as_const(plan.reference.red).row(y), differs);
  take_over(before_.green.row(y), std::as_const(plan.reference.green).row(y), differs);
  take_over(before_.blue.row(y), std::as_const(plan.reference.blue).row(y), differs);
  take_over(before_.disparity.row(y), std::span<const float>(plan.view.disparity.row(y)), differs);
  take_over(before_.weights.row(y), std::as_const(plan.weights).row(y), differs);
  if (!plan.seeds.empty()) take_over(before_.seeds.row(y), plan.seeds.row(y), differs);
  take_over(before_.canvases.front().row(y), canvas.row(y), differs);
}

bool Refit::differs(const PixelArea& area) const {
  const int left = std::max(area.left, 0), top = std::max(area.top, 0);
  const int right = std::min(area.right, differs_.width()), bottom = std::min(area.bottom, differs_.height());
  for (int y = top; y < bottom && left < right; ++y)
    if (std::memchr(&differs_(left, y), 255, static_cast<std::size_t>(right - left)) != nullptr) return true;
  return false;
}

void Refit::mark(const PixelArea& area) {
  const int left = std::max(area.left, 0), right = std::min(area.right, differs_.width());
  for (int y = std::max(area.top, 0); y < std::min(area.bottom, differs_.height()) && left < right; ++y)
    std::fill_n(&differs_(left, y), right - left, std::uint8_t{255});
}

void Refit::restore(int wave, const PixelArea& area, PaintedPicture& canvas) const {
  const PaintedPicture& begun = before_.canvases[static_cast<std::size_t>(wave)];
  for (int y = area.top; y < area.bottom; ++y)
    for (int x = area.left; x < area.right; ++x)
      if (differs_(x, y) == 0) canvas(x, y) = begun(x, y);
}

void Refit::end_wave(int wave, const PaintedPicture& canvas) {
  if (wave + 1 == fit_waves) return;
  PaintedPicture& begun = before_.canvases[static_cast<std::size_t>(wave) + 1];
  tbb::parallel_for(0, canvas.height(), [&](int y) {
    const auto differs = differs_.row(y);
    const auto from = canvas.row(y);
    const auto to = begun.row(y);
    for (std::size_t x = 0; x < to.size(); ++x)
      if (differs[x] != 0) to[x] = from[x];
  });
}

}  // namespace wheatstone
