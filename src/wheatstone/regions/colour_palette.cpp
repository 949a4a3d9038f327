#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/marks/residual.h"
#include "wheatstone/random.h"
#include "wheatstone/regions/colour_palette_internal.h"

namespace wheatstone {
namespace {

using Colour = PaletteColour;

Colour colour_of(Rgb8 c) { return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)}; }

/// Of two colours with these differences of their channels, with Rec. 601's luminance. Greys are as far apart as in
/// RGB.
double unlikeness_of(double red, double green, double blue) {
  const double luminance = 0.299 * red + 0.587 * green + 0.114 * blue;
  const double redness = red - luminance, blueness = blue - luminance;
  return 3 * (luminance * luminance + redness * redness + blueness * blueness);
}

double unlikeness(const Colour& a, const Colour& b) {
  return unlikeness_of(a.red - b.red, a.green - b.green, a.blue - b.blue);
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

/// Each centre is drawn with a chance proportional to its unlikeness to the nearest one so far.
std::vector<Colour> first_centres(const std::vector<Colour>& samples, int count, std::uint64_t seed) {
  std::vector<Colour> centres{samples[hash_keys({seed, 0}) % samples.size()]};
  std::vector<double> distance(samples.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(centres.size()) < count) {
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      distance[i] = std::min(distance[i], unlikeness(samples[i], centres.back()));
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
    const double distance = unlikeness(centres[i], colour);
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

/// Colours whose unlikeness to all of a palette is above the square of this are missed: nobody takes the palette's
/// nearest for them. A little below that, because regions have the mean of their pixels.
constexpr double missed_from = 0.8 * unlike_colours;

std::vector<Colour> missed_by(const std::vector<Colour>& centres, const std::vector<Colour>& samples) {
  std::vector<Colour> missed;
  for (const Colour& sample : samples)
    if (unlikeness(centres[nearest(centres, sample)], sample) > missed_from * missed_from) missed.push_back(sample);
  return missed;
}

/// The mean of the colours about the one that has most others near it.
Colour densest(const std::vector<Colour>& colours) {
  constexpr std::size_t most_tried = 100;
  const std::size_t step = (colours.size() + most_tried - 1) / most_tried;
  Colour best;
  double most = 0;
  for (std::size_t i = 0; i < colours.size(); i += step) {
    Colour sum;
    double count = 0;
    for (const Colour& colour : colours) {
      if (unlikeness(colour, colours[i]) > missed_from * missed_from) continue;
      sum = {sum.red + colour.red, sum.green + colour.green, sum.blue + colour.blue};
      ++count;
    }
    if (count <= most) continue;
    most = count;
    best = {sum.red / count, sum.green / count, sum.blue / count};
  }
  return best;
}

/// The centre for whose samples the others stand in best: by the unlikeness that each of them gains. Neighbouring
/// shades move together and heal the gap that one of them leaves; nothing heals that of a colour of its own.
std::size_t least_needed(const std::vector<Colour>& centres, const std::vector<Colour>& samples) {
  std::vector<double> losses(centres.size()), members(centres.size());
  for (const Colour& sample : samples) {
    const std::size_t own = nearest(centres, sample);
    double next = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (i != own) next = std::min(next, unlikeness(centres[i], sample));
    losses[own] += next - unlikeness(centres[own], sample);
    ++members[own];
  }
  for (std::size_t i = 0; i < losses.size(); ++i) losses[i] /= std::max(members[i], 1.0);
  return static_cast<std::size_t>(std::ranges::min_element(losses) - losses.begin());
}

/// The mean squared error spends its colours on large areas that change slowly. Where small things of colours of their
/// own are missed, the colour that is least needed goes to them, as long as fewer are missed then.
void give_to_missed(const std::vector<Colour>& samples, std::vector<Colour>& centres) {
  constexpr int most_moves = 8, most_rounds = 4;
  std::vector<Colour> missed = missed_by(centres, samples);
  for (int move = 0; move < most_moves && !missed.empty() && centres.size() > 1; ++move) {
    const std::size_t before = missed.size();
    std::vector<Colour> changed = centres;
    changed[least_needed(centres, samples)] = densest(missed);
    // The rounds make the mean error small again, and in time bring back what was.
    for (int round = 0; round <= most_rounds; ++round) {
      if (round > 0) move_to_means(samples, 1, changed);
      std::vector<Colour> still_missed = missed_by(changed, samples);
      if (still_missed.size() >= missed.size()) continue;
      centres = changed;
      missed = std::move(still_missed);
    }
    if (missed.size() == before) return;
  }
}

}  // namespace

std::vector<PaletteColour> find_palette(ImageView<const Rgb8> picture, int count, std::uint64_t seed) {
  const std::vector<Colour> samples = sampled(picture);
  std::vector<Colour> centres = first_centres(samples, count, seed);
  constexpr int rounds = 24;
  move_to_means(samples, rounds, centres);
  give_to_missed(samples, centres);
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

int squared_distance(Rgb8 a, Rgb8 b) {
  const int red = a.r - b.r, green = a.g - b.g, blue = a.b - b.b;
  return red * red + green * green + blue * blue;
}

float unlikeness(Rgb8 a, Rgb8 b) { return static_cast<float>(unlikeness(colour_of(a), colour_of(b))); }

std::size_t nearest_colour(const std::vector<Rgb8>& palette, Rgb8 colour) {
  std::size_t best = 0;
  float least = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const float distance = unlikeness(palette[i], colour);
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

}  // namespace wheatstone
