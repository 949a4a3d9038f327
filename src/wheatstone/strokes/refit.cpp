#include "wheatstone/strokes/refit_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace wheatstone {
namespace {

/// The depth edges that a layer's weights depend on.
ImageView<const std::uint8_t> outlines(const LayerPlan& plan) {
  return weighs_outlines(plan) ? plan.depth_edges.view() : ImageView<const std::uint8_t>();
}

/// Whether two sets of weights of one reference can differ only where the detail or the outlines do.
bool same_but_for_rows(const LayerPlan& plan, const LayerFit& before) {
  return before.reference == plan.reference && same_size(before.detail, plan.view.detail) &&
         same_size(before.outlines, outlines(plan));
}

bool may_compare(const LayerPlan& plan, std::size_t blocks, const LayerFit& before) {
  return before.blocks.size() == blocks && before.style == plan.style && before.radius_px == plan.radius_px &&
         before.least_gain == plan.least_gain && before.depth_threshold_px == plan.depth_threshold_px &&
         same_size(before.disparity, plan.view.disparity) && same_size(before.seeds, plan.seeds) &&
         (!before.weights.empty() || same_but_for_rows(plan, before));
}

LayerFit nothing_known(const LayerPlan& plan, std::size_t blocks) {
  LayerFit fit{plan.style, plan.radius_px, plan.least_gain, plan.depth_threshold_px};
  fit.seeds = Image<std::uint8_t>(plan.seeds.width(), plan.seeds.height());
  fit.disparity = Image<float>(plan.canvas.width, plan.canvas.height);
  for (PaintedPicture& canvas : fit.canvases) canvas = PaintedPicture(plan.canvas.width, plan.canvas.height);
  fit.canvas = PaintedPicture(plan.canvas.width, plan.canvas.height);
  fit.blocks.resize(blocks);
  return fit;
}

template <class Pixel>
bool are_equal(std::span<const Pixel> a, std::span<const Pixel> b) {
  return std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// Marks the pixels in which two rows differ.
template <class Pixel>
void mark_differences(std::span<const Pixel> before, std::span<const Pixel> now, std::span<std::uint8_t> differs) {
  if (are_equal(before, now)) return;
  for (std::size_t x = 0; x < before.size(); ++x)
    if (!(before[x] == now[x])) differs[x] = 255;
}

/// Marks the pixels in which two rows differ, and makes the first one equal the second.
template <class Pixel>
void take_over(std::span<Pixel> before, std::span<const Pixel> now, std::span<std::uint8_t> differs) {
  if (are_equal<Pixel>(before, now)) return;
  mark_differences<Pixel>(before, now, differs);
  std::ranges::copy(now, before.begin());
}

/// The same for whole pictures, whose sizes may differ.
void take_over(Image<std::uint8_t>& before, ImageView<const std::uint8_t> now, Image<std::uint8_t>& differs) {
  if (!same_size(before, now)) before = Image<std::uint8_t>(now.width(), now.height());
  tbb::parallel_for(0, now.height(),
                    [&](int y) { take_over<std::uint8_t>(before.row(y), now.row(y), differs.row(y)); });
}

bool has_any(std::span<const std::uint8_t> marks) { return std::memchr(marks.data(), 255, marks.size()) != nullptr; }

template <class Pixel>
bool are_equal(ImageView<const Pixel> a, ImageView<const Pixel> b) {
  if (!same_size(a, b)) return false;
  for (int y = 0; y < a.height(); ++y)
    if (!are_equal(a.row(y), b.row(y))) return false;
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

bool LayerFit::is_made_from(ImageView<const Rgb8> now, float radius_now_px, const Style& style_now) const {
  return reference != nullptr && radius_px == radius_now_px && style == style_now && are_equal<Rgb8>(colour, now);
}

Image<float> weights_again(const LayerPlan& plan, LayerFit& fit) {
  if (fit.weights.empty() || !same_but_for_rows(plan, fit)) return difference_weights(plan);
  Image<float> weights = std::exchange(fit.weights, {});
  const ImageView<const std::uint8_t> edges = outlines(plan), detail = plan.view.detail;
  const auto differs = [&](int y) {
    return (!detail.empty() && !are_equal<std::uint8_t>(fit.detail.row(y), detail.row(y))) ||
           (!edges.empty() && !are_equal<std::uint8_t>(fit.outlines.row(y), edges.row(y)));
  };
  for (int first = 0, height = weights.height(); first < height;) {
    if (!differs(first)) {
      ++first;
      continue;
    }
    int end = first + 1;
    while (end < height && differs(end)) ++end;
    weigh_rows(plan, first, end, weights);
    first = end;
  }
  return weights;
}

Refit::Refit(const LayerPlan& plan, std::size_t blocks, LayerFit& before)
    : before_(before), differs_(plan.canvas.width, plan.canvas.height) {
  if (!may_compare(plan, blocks, before)) {
    before_ = nothing_known(plan, blocks);
    std::ranges::fill(differs_.pixels(), std::uint8_t{255});
  } else if (before_.reference != plan.reference) {
    plan.reference->orientation.visit_differences(before_.reference->orientation,
                                                  [this](int left, int top, int right, int bottom) {
                                                    mark({left, top, right, bottom});
                                                  });
  }
  take_over(before_.detail, plan.view.detail, differs_);
  take_over(before_.outlines, outlines(plan), differs_);
  tbb::parallel_for(0, differs_.height(), [&](int y) { compare_row(plan, y); });
  if (before_.reference == plan.reference) return;
  before_.colour = copy_of<Rgb8>(plan.view.colour);
  before_.reference = plan.reference;
}

void Refit::compare_row(const LayerPlan& plan, int y) {
  const auto differs = differs_.row(y);
  if (before_.reference != nullptr && before_.reference != plan.reference) {
    const ReferencePicture &was = *before_.reference, &is = *plan.reference;
    mark_differences(was.red.row(y), is.red.row(y), differs);
    mark_differences(was.green.row(y), is.green.row(y), differs);
    mark_differences(was.blue.row(y), is.blue.row(y), differs);
  }
  if (!before_.weights.empty())
    mark_differences(std::as_const(before_.weights).row(y), std::as_const(plan.weights).row(y), differs);
  take_over(before_.disparity.row(y), std::span<const float>(plan.view.disparity.row(y)), differs);
  if (!plan.seeds.empty()) take_over(before_.seeds.row(y), plan.seeds.row(y), differs);
  thread_local std::vector<PaintedPixel> painted;
  painted.resize(differs.size());
  take_painted_row(plan.canvas, y, painted);
  take_over(before_.canvases.front().row(y), std::span<const PaintedPixel>(painted), differs);
  if (has_any(differs)) std::ranges::copy(painted, before_.canvas.row(y).begin());
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

void Refit::end_wave(int wave) {
  if (wave + 1 == fit_waves) return;
  PaintedPicture& begun = before_.canvases[static_cast<std::size_t>(wave) + 1];
  tbb::parallel_for(0, begun.height(), [&](int y) {
    const auto differs = differs_.row(y);
    if (!has_any(differs)) return;
    const auto from = before_.canvas.row(y);
    const auto to = begun.row(y);
    for (std::size_t x = 0; x < to.size(); ++x)
      if (differs[x] != 0) to[x] = from[x];
  });
}

}  // namespace wheatstone
