#pragma once

#include <hwy/cache_control.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/drawing/flatten_internal.h"
#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/marks/brush.h"

namespace wheatstone {

/// For every band of a picture, the strokes that touch it, in drawing order.
std::vector<std::vector<std::uint32_t>> strokes_by_band(const FlatLayer& layer, int height);

/// The segments of a stroke's chain as a band sees them; a dot is one segment of length 0.
struct Chain {
  /// Makes room for `count` segments.
  void resize(std::size_t count);

  std::vector<float> x, y;    ///< where each begins; rows are counted from the band's first
  std::vector<float> dx, dy;  ///< from there to its end
  std::vector<float> disparity, disparity_step;
  std::vector<float> along_x, along_y;  ///< (dx, dy) by the squared length; 0 where that is 0
  std::vector<float> course_x, course_y, length;
  std::vector<float> begins_px;  ///< length of the stroke before each, in the central view

  // A segment paints a rectangle: on a row, those columns that are both in a run along it and in one across it.
  std::vector<float> along_slope, along_middle, along_half;
  std::vector<float> across_slope, across_half;
  std::vector<int> first_row, end_row;

  std::vector<int> begin, end;  ///< the columns that each segment paints in each row of the band: band_rows for each
};

/// Columns [begin, end).
struct ColumnRun {
  int begin, end;
};

/// The index of a row of a block of columns in a band that is stored block by block.
inline std::size_t place_in_blocks(int row, int number, int row_count) {
  return static_cast<std::size_t>(number) * static_cast<std::size_t>(row_count) + static_cast<std::size_t>(row);
}

/// The disparities below which paint of one kind is hidden in a band; empty if nothing hides it.
struct HiddenBelow {
  static constexpr int block_px = Canvas::widest_vector;
  struct Block {
    float most, least;         ///< of its pixels
    std::uint32_t shown_rows;  ///< rows that are not wholly hidden: bits, from the lowest
  };
  std::span<const float> pixels;        ///< row_count × stride of the band, for columns that are shown at all
  std::vector<Block> blocks;            ///< of columns
  std::span<const float> most_of_rows;  ///< the most in each row of each block: row_count × blocks, and a vector more
  /// The columns of a block in a row that are not wholly hidden, a bit each, from the lowest: row_count × blocks, and a
  /// vector more.
  std::vector<std::uint16_t> shown_columns;

  /// The same of the block `number` in a row of the band.
  std::uint32_t shown_columns_in(int row, int number, int row_count) const {
    return shown_columns.empty() ? 0xffff : shown_columns[place_in_blocks(row, number, row_count)];
  }
};

/// Squared distances to one stroke's chain within one band, reused from stroke to stroke.
struct DistanceBand {
  DistanceBand(int top, int canvas_width, int canvas_height);

  int top;  ///< the picture's row that is the band's first
  int row_count;
  int stride;
  std::vector<float> squared;  ///< row_count × stride
  /// Three more planes of this size for paint that varies within a stroke, empty until there is such a stroke: the
  /// place along the stroke, in pixels from its first point, which continues beyond both ends; the place across it,
  /// positive to the right of its course; and the share of the light from the upper left that meets a surface facing
  /// right of the course, −1..1.
  std::vector<float> along, across, facing;
  int first_row = 0, end_row = 0;  ///< the band's rows that the stroke touches
  std::vector<int> begin, end;     ///< the columns that it touches in each of them
  Chain chain;
};

/// Notes the rows of a band that a stroke touches, and in them the columns within `aside_px` of what it touches. The
/// band is as wide as the canvas, or wider.
void find_extents(const SeenLayer& layer, const FlatStroke& stroke, int canvas_width, float aside_px,
                  DistanceBand& band);

/// Then fills the band with the stroke's squared distances, within its extents; far away where a surface hides it.
/// `with_places`: also with the places along and across it.
void measure_distances(const FlatStroke& stroke, const HiddenBelow& below, bool with_places, DistanceBand& band);

/// What hides the marks of each kind in a band.
struct BandHiding {
  BandHiding(const Hiding& hiding, const DistanceBand& band, int canvas_width);
  BandHiding(BandHiding&&) = default;  // the kinds refer to what they share

  std::vector<float> nearest_below;  ///< the nearest surface's disparity, less the tolerance
  std::vector<float> most_of_rows;   ///< of it
  HiddenBelow own;                   ///< those of the reference view
  HiddenBelow other;                 ///< those of other views that photographs show
  HiddenBelow continued;             ///< those of other views
  HiddenBelow gaps;                  ///< those that fill what the reference view's leave bare

  /// What hides a stroke when it is first drawn; a stroke of another view is drawn once more, to fill gaps.
  const HiddenBelow& of(const FlatStroke& stroke, const Hiding& hiding) const {
    if (hiding.is_own(stroke.reference_view)) return own;
    return hiding.is_continued(stroke.reference_view) ? continued : other;
  }
};

/// A band that is drawn from the nearest stroke to the farthest: what is drawn, times what it covers, and how much
/// light still comes through. A stroke that lies wholly behind opaque paint costs next to nothing. The pixels of a band
/// stand in blocks of columns, whose rows follow each other in memory: a stroke touches few places of it.
class FrontToBackAccumulator {
 public:
  static constexpr int block_px = Canvas::widest_vector;
  static constexpr float dark = 1.f / 1024;  ///< light below this changes an 8-bit value by less than a quarter step
  static constexpr float least_gap_light = 1 - 1.f / 64;  ///< a pixel that lets more through counts as unpainted

  /// The columns of a block in one row.
  struct alignas(64) Block {
    float red[block_px], green[block_px], blue[block_px], light[block_px];
  };

  /// The columns of a block in one row: how much of each one stroke covers, whatever light it lets through.
  using Cover = std::array<float, block_px>;

  FrontToBackAccumulator() = default;
  FrontToBackAccumulator(int row_count, int canvas_width, bool keeps_cover = false);

  /// Removes everything that was drawn.
  void clear();

  /// Lets light through only where `mask` is not 0, in a row in which nothing is drawn yet. Returns whether any light
  /// comes through.
  bool open_only(int row, std::span<const std::uint8_t> mask);

  int width() const { return width_; }
  int rows() const { return rows_; }
  int block_count() const { return static_cast<int>(open_rows_.size()); }
  Block& block(int row, int number) { return blocks_[place_in_blocks(row, number, rows_)]; }
  const Block& block(int row, int number) const { return blocks_[place_in_blocks(row, number, rows_)]; }
  Cover* cover(int row, int number) {
    return covers_.empty() ? nullptr : &covers_[place_in_blocks(row, number, rows_)];
  }
  float light(int row, int x) const { return block(row, x / block_px).light[x % block_px]; }

  // Where light still comes through: bits, from the lowest.

  /// The columns of a block.
  std::uint32_t open_columns(int row, int number) const { return open_columns_[place_in_blocks(row, number, rows_)]; }
  /// The columns from this row of a block on; a vector may be loaded beyond the last row.
  const std::uint16_t* open_columns_from(int row, int number) const {
    return &open_columns_[place_in_blocks(row, number, rows_)];
  }
  std::uint16_t* open_columns_of(int number) { return &open_columns_[place_in_blocks(0, number, rows_)]; }

  /// Notes in which rows of a block something was drawn, and through which no light comes any more: bits, from the
  /// lowest.
  void note_rows(int number, std::uint32_t drawn, std::uint32_t closed) {
    touched_rows_[static_cast<std::size_t>(number)] |= drawn;
    open_rows_[static_cast<std::size_t>(number)] &= ~closed;
  }
  void set_open_columns(int row, int number, std::uint32_t columns) {
    open_columns_[place_in_blocks(row, number, rows_)] = static_cast<std::uint16_t>(columns);
    touched_rows_[static_cast<std::size_t>(number)] |= std::uint32_t{1} << row;
    if (columns == 0) open_rows_[static_cast<std::size_t>(number)] &= ~(std::uint32_t{1} << row);
  }

  bool is_touched(int row, int number) const {
    return (touched_rows_[static_cast<std::size_t>(number)] >> row & 1) != 0;
  }

  /// The rows in which light may come through.
  std::uint32_t open_rows(int number) const { return open_rows_[static_cast<std::size_t>(number)]; }

  /// The same of any of the columns [begin, end).
  std::uint32_t open_rows(int begin, int end) const {
    std::uint32_t rows = 0;
    for (int number = begin / block_px; number * block_px < end; ++number)
      rows |= open_rows_[static_cast<std::size_t>(number)];
    return rows;
  }

  /// Shrinks the columns [begin, end) to those between the first and the last open block; begin ≥ end where none is.
  void clamp(int row, int& begin, int& end) const;

 private:
  int width_ = 0, rows_ = 0;
  std::vector<Block> blocks_;
  std::vector<Cover> covers_;
  std::vector<std::uint16_t> open_columns_;
  std::vector<std::uint32_t> open_rows_, touched_rows_;  ///< of each block
};
static_assert(band_rows <= 32 && FrontToBackAccumulator::block_px <= 16);

/// What a finished row of a view is made with, and where it goes.
struct RowToFinish {
  std::span<const Rgb8> background;  ///< empty: the canvas
  Rgb8 canvas_colour;
  bool is_opaque;    ///< nothing shows through thin paint
  float bare_light;  ///< a pixel that lets more through is bare
  std::span<Rgb8> picture;
  std::span<std::uint8_t> bare;  ///< 255 for bare pixels
  std::span<Rgb16> deep = {};    ///< empty: it is not asked for
};

/// Returns whether some pixels count as unpainted.
bool finish_row(const FrontToBackAccumulator& accumulator, int row, const RowToFinish& to);

/// A stroke of a layer as a view sees it, and what hides it in the band at hand.
struct StrokeInBand {
  const SeenLayer& layer;
  const FlatStroke& stroke;
  const HiddenBelow& hidden_below;
  const Brush& brush;

  /// Whether its paint varies within the stroke.
  bool varies() const { return brush.varies() || stroke.changes_colour(); }
};

/// Draws what is seen of a stroke under everything that was drawn before, with vectors of whatever width the processor
/// has.
void draw_stroke_under(const StrokeInBand& stroke, DistanceBand& band, FrontToBackAccumulator& accumulator);

/// Lays the drawn band over the rows of a canvas from `top` on. The accumulator must keep its cover.
void lay_over(FrontToBackAccumulator& accumulator, int top, Canvas& canvas);

/// The part of a stroke in one band, drawn once for all views: how far inside its rim each pixel lies. Views see its
/// rows shifted, by whole pixels and a fraction, between which the rim is interpolated.
struct Stamp {
  // Levels: cover 0 is `zero`, cover 1 is `steps` more; they go on beyond both, so that rims are interpolated rightly.
  static constexpr float steps = 20000, zero = 20000, most = 3 * steps;

  std::uint32_t first_line = 0;    ///< of the stroke's rows
  int first_row = 0, end_row = 0;  ///< of the band
  float left = 0;                  ///< place in the central view from which the columns of the lines are counted
  std::uint32_t made = 0;          ///< rows whose lines are there: bits, from the lowest

  std::uint32_t rows() const {
    const auto below = [](int row) { return static_cast<std::uint32_t>((std::uint64_t{1} << row) - 1); };
    return below(end_row) & ~below(first_row);
  }
};

/// The stamps of a band.
struct Stamps {
  static constexpr int margin = 2;      ///< columns beside a line that tell how its rim goes on
  static constexpr float aside_px = 1;  ///< beyond a rim cover is below nothing so far
  static constexpr std::size_t slack =
      2 * std::size_t{Canvas::widest_vector};  ///< values before the first and after the last one

  /// Makes room for the lines of a stamp, which cover nothing yet. Returns the first one's number.
  std::uint32_t add_lines(std::size_t count);

  // The lines, one for each row of a stamp, and a vector more.
  std::vector<std::uint32_t> first_values;  ///< of the margin before a line
  std::vector<std::int32_t> begins, ends;   ///< the columns that it covers when it is moved by less than one
  std::size_t line_count = 0;
  std::vector<std::uint16_t> values = std::vector<std::uint16_t>(2 * slack);
  /// Only for strokes whose paint varies, one for each value: the share of the colour's change, in 255ths, and the
  /// tone, in half levels from `even_tone` on. Both are empty until there is such a stroke.
  std::vector<std::uint8_t> shares, tones;
  static constexpr std::uint8_t even_tone = 128;
};

/// Rows of a band, a bit each, and the columns that are wanted in each of them.
struct RowsOfStamp {
  std::uint32_t rows;
  const std::array<ColumnRun, band_rows>* columns;  ///< as the band counts them; null: all
};

/// Adds rows of a band to the stamp of a stroke, whose layer is seen in columns from stamp.left on; `band` is `width`
/// columns wide.
void make_stamp(const StrokeInBand& stroke, int width, const RowsOfStamp& wanted, DistanceBand& band, Stamp& stamp,
                Stamps& stamps);

/// Colour, opacity and disparity of a stamped stroke.
struct StampPaint {
  float red, green, blue, opacity;
  float red_change, green_change, blue_change;
  float disparity, depth_slope;
};

/// A stamp as a view sees it.
struct StampInBand {
  const Stamp& stamp;
  const Stamps& stamps;
  const StampPaint& paint;
  const HiddenBelow& hidden_below;
  const DistanceBand& band;
  float view;          ///< eye separations to the right of the central view
  ColumnRun columns;   ///< columns of the picture that contain its visible part
  std::uint32_t rows;  ///< the open ones, a bit each
  bool tested;         ///< a surface may hide some of it
  bool varies;         ///< its paint varies within the stroke
};

/// Selects the rows of a band, a bit each, in which at least one of the columns is open and shown.
std::uint32_t rows_to_draw(std::uint32_t rows, const ColumnRun& columns, const HiddenBelow& below,
                           const FrontToBackAccumulator& accumulator);

/// Draws what is seen of a stamp under everything that was drawn before.
void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator);

}  // namespace wheatstone
