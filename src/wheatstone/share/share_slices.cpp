#include "wheatstone/share/share_pictures.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/error.h"
#include "wheatstone/multiview/colour_bar.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/slices_part_internal.h"
#include "wheatstone/share/surface_parts_internal.h"

namespace wheatstone {
namespace {

SliceChannels channels_of(const ToneSettings& tone) {
  if (tone.look == Look::thesis) return SliceChannels::colours;
  switch (tone.shown) {
    case Shown::ramp:
      return SliceChannels::share;
    case Shown::column:
      return SliceChannels::light;
    case Shown::mean:
      return SliceChannels::mean;
    default:
      return SliceChannels::colours;
  }
}

/// From what is far too faint to be seen to the brightest that makes a difference.
LightCode light_code_of(const SliceStack& stack, int steps) {
  float brightest = 0;
  for (const Slice& slice : stack.slices)
    for (const LinearRgba& pixel : slice.pixels.pixels()) brightest = std::max({brightest, pixel.r, pixel.g, pixel.b});
  constexpr float faint = 1e-5f;
  const ToneSettings& tone = stack.tone;
  const bool is_thesis = tone.look == Look::thesis;
  if (!is_thesis && tone.shown == Shown::mean) return {brightest * faint / 10, brightest, steps};
  const float unit = is_thesis ? 1 / tone.exposure : tone.most;
  const float most = std::min(brightest, unit * (is_thesis ? 1000 : 8));
  const float least = !is_thesis && tone.stretch == Stretch::log ? tone.least / 32 : unit * faint;
  return {std::min(least, most), most, steps};
}

Json facts_of(const ToneSettings& tone) {
  constexpr std::array<const char*, 3> stretches{"asinh", "log", "linear"};
  constexpr std::array<const char*, 4> shown{"ramp", "colours", "column", "mean"};
  const char* const stretch = stretches.at(static_cast<std::size_t>(tone.stretch));
  if (tone.look == Look::thesis) return {{"shown", "light"}, {"stretch", stretch}, {"exposure", tone.exposure}};
  return {{"shown", shown.at(static_cast<std::size_t>(tone.shown))},
          {"stretch", stretch},
          {"least", tone.least},
          {"most", tone.most}};
}

Json facts_of(const SliceStack& stack, const LightCode& code, SliceHiding hiding, const std::string& title) {
  constexpr std::array<const char*, 3> hides{"nothing", "sharply", "softly"};
  const float depth_px = std::max(stack.slices.back().parallax_px - stack.slices.front().parallax_px, 1e-3f),
              budget_px = comfortable_parallax_share * static_cast<float>(stack.width);
  Json planes = Json::array();
  for (const Slice& slice : stack.slices)
    planes.push_back({{"parallax", slice.parallax_px},
                      {"left", slice.left},
                      {"top", slice.top},
                      {"width", slice.pixels.width()},
                      {"height", slice.pixels.height()}});
  return {{"kind", "slices"},
          {"title", title},
          {"width", stack.width},
          {"height", stack.height},
          {"separation", std::min({budget_px / depth_px, 1.f, stack.span})},
          {"zeroParallax", 0},
          {"first", -stack.span / 2},
          {"last", stack.span / 2},
          {"planes", planes},
          {"hides", hides.at(static_cast<std::size_t>(hiding))},
          {"light", {{"least", code.least}, {"most", code.most}, {"steps", code.steps}}},
          {"tone", facts_of(stack.tone)}};
}

std::vector<PagePart> parts_of(const SliceStack& stack, const LightCode& code, bool has_alpha) {
  const SliceChannels channels = channels_of(stack.tone);
  std::vector<PagePart> parts(stack.slices.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    parts[i] = slice_part(fmt::format("slice-{}", i), stack.slices[i], channels, has_alpha, code);
  });
  if (channels != SliceChannels::colours) {
    constexpr int brightnesses = 256, hues = 64;
    const std::string bar = encode_png(colour_bar(stack.tone, brightnesses, hues));
    parts.push_back({"colours", {bar.begin(), bar.end()}});
  }
  return parts;
}

}  // namespace

SharedPicture share_slices(SliceStack stack, const ShareSlicesOptions& options) {
  if (stack.slices.empty()) throw Error(ErrorKind::bad_input, "the slices are empty: there is nothing to show");
  constexpr std::array all_steps{255, 127, 63};
  constexpr int smallest_px = 64;
  const SliceHiding hiding = hiding_of(stack);
  const int width = stack.width;
  SharedPicture shared;
  for (bool is_small_enough = false; !is_small_enough;) {
    for (const int steps : all_steps) {
      const LightCode code = light_code_of(stack, steps);
      const Rig middle{stack.width, stack.height, {central_view}};
      shared = {.parts = parts_of(stack, code, hiding != SliceHiding::nothing),
                .still_jpeg = still_of(render_slices(stack, middle).front()),
                .width = stack.width,
                .height = stack.height};
      shared.facts = text_of(facts_of(stack, code, hiding, options.title));
      if (steps < all_steps.front() || stack.width < width)
        shared.note = fmt::format("the light of the slices is rounded to {} steps, and the picture is {}x{} pixels",
                                  steps, stack.width, stack.height);
      is_small_enough = page_bytes(shared) <= options.most_bytes;
      if (is_small_enough) break;
    }
    if (is_small_enough || std::min(stack.width, stack.height) < 2 * smallest_px) break;
    stack = halved(stack);
  }
  return shared;
}

}  // namespace wheatstone
