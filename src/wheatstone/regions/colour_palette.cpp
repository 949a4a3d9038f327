#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/random.h"
#include "wheatstone/regions/colour_palette_internal.h"

namespace wheatstone {
namespace {

using Colour = PaletteColour;

Colour colour_of(Rgb8 c) { return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)}; }

double squared_distance(const Colour& a, const Colour& b) {
  const double red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
  return red * red + green * green + blue * blue;
}

/// Pixels on a regular lattice: as many as tell the colours of any picture.
std::vector<Colour> sampled(ImageView<const Rgb8> picture) {
  constexpr double most_samples = 30000;
  const double pixels = static_cast<double>(picture.width()) * picture.height();
  const int step = std::max(static_cast<int>(std::ceil(std::sqrt(pixels / most_samples))), 1);
  std::vector<Colour> samples;
  for (int y = step / 2; y < picture.height(); y += step)
    for (int x = step / 2; x < picture.width(); x += step) samples.push_back(colour_of(picture(x, y)));
  if (samples.empty()) samples.push_back(colour_of(picture(0, 0)));
  return samples;
}

/// Each centre is drawn with a chance proportional to the squared distance to the nearest one so far.
std::vector<Colour> first_centres(const std::vector<Colour>& samples, int count, std::uint64_t seed) {
  std::vector<Colour> centres{samples[hash_keys({seed, 0}) % samples.size()]};
  std::vector<double> distance(samples.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(centres.size()) < count) {
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      distance[i] = std::min(distance[i], squared_distance(samples[i], centres.back()));
      sum += distance[i];
    }
    if (sum <= 0) break;
    double left = sum * static_cast<double>(unit_float(hash_keys({seed, centres.size()})));
    std::size_t chosen = 0;
    while (chosen + 1 < samples.size() && (left -= distance[chosen]) >= 0) ++chosen;
    centres.push_back(samples[chosen]);
  }
  return centres;
}

std::size_t nearest(const std::vector<Colour>& centres, const Colour& colour) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double distance = squared_distance(centres[i], colour);
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

/// Lloyd's rounds. A centre that no sample is nearest to stays.
void move_to_means(const std::vector<Colour>& samples, int rounds, std::vector<Colour>& centres) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<Colour> sums(centres.size());
    std::vector<double> members(centres.size());
    for (const Colour& sample : samples) {
      const std::size_t i = nearest(centres, sample);
      sums[i].red += sample.red;
      sums[i].green += sample.green;
      sums[i].blue += sample.blue;
      ++members[i];
    }
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (members[i] > 0)
        centres[i] = {sums[i].red / members[i], sums[i].green / members[i], sums[i].blue / members[i]};
  }
}

}  // namespace

std::vector<PaletteColour> find_palette(ImageView<const Rgb8> picture, int count, std::uint64_t seed) {
  const std::vector<Colour> samples = sampled(picture);
  std::vector<Colour> centres = first_centres(samples, count, seed);
  constexpr int rounds = 24;
  move_to_means(samples, rounds, centres);
  return centres;
}

void follow_palette(ImageView<const Rgb8> picture, std::vector<PaletteColour>& palette) {
  constexpr int rounds = 2;
  constexpr double share = 0.15;
  std::vector<Colour> target = palette;
  move_to_means(sampled(picture), rounds, target);
  for (std::size_t i = 0; i < palette.size(); ++i) {
    palette[i].red += share * (target[i].red - palette[i].red);
    palette[i].green += share * (target[i].green - palette[i].green);
    palette[i].blue += share * (target[i].blue - palette[i].blue);
  }
}

std::vector<Rgb8> rounded(const std::vector<PaletteColour>& palette) {
  const auto level = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  std::vector<Rgb8> colours;
  for (const PaletteColour& colour : palette)
    colours.push_back({level(colour.red), level(colour.green), level(colour.blue)});
  return colours;
}

std::size_t nearest_colour(const std::vector<Rgb8>& palette, Rgb8 colour) {
  std::size_t best = 0;
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const int red = palette[i].r - colour.r, green = palette[i].g - colour.g, blue = palette[i].b - colour.b;
    const int distance = red * red + green * green + blue * blue;
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

}  // namespace wheatstone
