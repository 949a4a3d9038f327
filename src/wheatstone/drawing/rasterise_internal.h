#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/drawing/flatten_internal.h"
#include "wheatstone/drawing/rasterise.h"

namespace wheatstone {

/// The brush: a disc whose cover falls from 1 to 0 across a soft rim a tenth of its radius wide, but never less than a
/// pixel, which is the antialiasing. Half cover lies at 0.95 R, the middle of the rim.
struct BrushProfile {
  explicit BrushProfile(float radius_px)
      : rim_px(radius_px > 10 ? 0.1f * radius_px : 1.f),
        middle_px(0.95f * radius_px),
        reach_px(middle_px + rim_px / 2) {}
  float rim_px;
  float middle_px;
  float reach_px;  ///< cover is 0 from here on

  float cover(float distance_px) const {
    const float c = (middle_px - distance_px) / rim_px + 0.5f;
    return c < 0 ? 0 : c > 1 ? 1 : c;
  }
};

/// Rows of a canvas that one thread draws at a time: 32 rows of four float planes 1920 wide are just under a megabyte
/// and stay in the second-level cache.
inline constexpr int band_rows = 32;

/// For every band of a picture, the strokes that touch it, in drawing order.
std::vector<std::vector<std::uint32_t>> strokes_by_band(const FlatLayer& layer, int height);

/// The pixels of a band that a brush touches along one segment; rows are counted from the band's first.
struct SegmentBox {
  int first_row, end_row;
  int begin, end;
};

/// Below which disparity paint is hidden, in a band; empty where nothing hides it.
struct HiddenBelow {
  static constexpr int block_px = Canvas::widest_vector;
  std::vector<float> pixels;  ///< row_count × stride of the band
  std::vector<float> blocks;  ///< the largest of each block of columns
};

/// Squared distances to one stroke's chain within one band, reused from stroke to stroke.
struct DistanceBand {
  DistanceBand(int top, int canvas_width, int canvas_height);

  int top;  ///< the picture's row that is the band's first
  int row_count;
  int stride;
  std::vector<float> squared;      ///< row_count × stride
  int first_row = 0, end_row = 0;  ///< the band's rows that the stroke touches
  std::vector<int> begin, end;     ///< the columns that it touches in each of them
  std::vector<SegmentBox> boxes;   ///< of its segments
};

/// What hides the marks of each kind in a band.
struct BandHiding {
  BandHiding(const Hiding& hiding, const DistanceBand& band, int canvas_width);

  HiddenBelow own;        ///< those of the reference view
  HiddenBelow other;      ///< those of other views that photographs show
  HiddenBelow continued;  ///< those of other views
  HiddenBelow gaps;       ///< those that fill what the reference view's leave bare

  /// What hides a stroke at first.
  const HiddenBelow& of(const FlatStroke& stroke, const Hiding& hiding) const {
    if (hiding.is_own(stroke.reference_view)) return own;
    return hiding.is_continued(stroke.reference_view) ? continued : other;
  }
};

/// Which blocks of columns still let light through, a bit each.
class TransmittanceMask {
 public:
  TransmittanceMask(int rows, int blocks)
      : words_(static_cast<std::size_t>(rows) * words_for(blocks), ~std::uint64_t{0}), stride_(words_for(blocks)) {}

  void close(int row, int block) { word(row, block) &= ~(std::uint64_t{1} << (block % 64)); }

  bool is_open(int row, int block) const { return (words_[row * stride_ + block / 64] >> (block % 64) & 1) != 0; }

  /// Whether any of the blocks from `first` to `last` is.
  bool is_any_open(int row, int first, int last) const {
    const std::uint64_t* words = words_.data() + static_cast<std::ptrdiff_t>(row) * stride_;
    for (int word = first / 64; word <= last / 64; ++word) {
      std::uint64_t bits = words[word];
      if (word == first / 64) bits &= ~std::uint64_t{0} << (first % 64);
      if (word == last / 64) bits &= ~std::uint64_t{0} >> (63 - last % 64);
      if (bits != 0) return true;
    }
    return false;
  }

  /// Shrinks the columns [begin, end) to those between the first and the last open block; begin ≥ end where none is.
  void clamp(int row, int& begin, int& end) const;

 private:
  static int words_for(int blocks) { return (blocks + 63) / 64; }
  std::uint64_t& word(int row, int block) { return words_[row * stride_ + block / 64]; }

  std::vector<std::uint64_t> words_;
  int stride_;
};

/// A band that is drawn from the nearest stroke to the farthest: what is drawn, times what it covers, and how much
/// light still comes through. A stroke that lies wholly behind opaque paint costs next to nothing.
struct FrontToBackAccumulator {
  static constexpr int block_px = Canvas::widest_vector;
  static constexpr float dark = 1.f / 1024;  ///< light below this changes an 8-bit value by less than a quarter step

  FrontToBackAccumulator(int row_count, int canvas_width);

  int width;
  int stride;
  std::vector<float> red, green, blue, light;
  TransmittanceMask open;
};

/// A stroke of a layer as a view sees it, and what hides it in the band at hand.
struct StrokeInBand {
  const SeenLayer& layer;
  const FlatStroke& stroke;
  const HiddenBelow& hidden_below;
};

/// Draws what is seen of a stroke over a canvas, with vectors of whatever width the processor has.
void draw_stroke_over(const StrokeInBand& stroke, DistanceBand& band, Canvas& canvas);

/// Draws what is seen of a stroke under everything that was drawn before.
void draw_stroke_under(const StrokeInBand& stroke, DistanceBand& band, FrontToBackAccumulator& accumulator);

/// The part of a stroke in one band, drawn once for all views: how far inside its rim each pixel lies. Views see its
/// rows shifted, by whole pixels and a fraction, between which the rim is interpolated.
struct Stamp {
  // Levels: cover 0 is `zero`, cover 1 is `steps` more; they go on beyond both, so that rims are interpolated rightly.
  static constexpr float steps = 20000, zero = 20000, most = 3 * steps;
  static constexpr int margin = 2;  ///< columns without cover before the first one
  static constexpr std::size_t slack =
      Canvas::widest_vector + margin + 1;  ///< values after the last one, which hold nothing

  std::size_t first_value = 0;
  int first_row = 0, end_row = 0;  ///< of the band
  int left = 0;                    ///< column of the central view
  int width = 0;                   ///< columns; 0: not made yet
  std::size_t stride() const { return static_cast<std::size_t>(width) + margin + 1; }
};

/// Makes the stamp of a stroke, whose layer is seen in columns from stamp.left on; `band` is as wide as the stamp.
void make_stamp(const StrokeInBand& stroke, DistanceBand& band, Stamp& stamp, std::vector<std::uint16_t>& values);

/// A stamp as a view sees it.
struct StampInBand {
  const Stamp& stamp;
  const std::uint16_t* values;  ///< its first
  const FlatStroke& stroke;
  const HiddenBelow& hidden_below;
  float view;   ///< eye separations to the right of the central view
  int top;      ///< the picture's row that is the band's first
  bool tested;  ///< a surface may hide some of it
};

/// Draws what is seen of a stamp under everything that was drawn before.
void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator);

}  // namespace wheatstone
