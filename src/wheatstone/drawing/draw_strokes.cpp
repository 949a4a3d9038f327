#include <tbb/blocked_range.h>
#include <tbb/concurrent_queue.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/rasterise_internal.h"

namespace wheatstone {
namespace {

/// Gives wholly uncovered pixels of a row the colour beside them on the farther surface.
template <class Pixel>
void continue_paint(const FrontToBackAccumulator& accumulator, int band_row, std::span<const float> surface,
                    std::span<Pixel> row) {
  const int width = static_cast<int>(row.size());
  const auto depth = [&](int x) { return surface.empty() || std::isnan(surface[x]) ? 0 : surface[x]; };
  const auto is_gap = [&](int x) { return accumulator.light(band_row, x) >= FrontToBackAccumulator::least_gap_light; };
  for (int begin = 0; begin < width; ++begin) {
    if (!is_gap(begin)) continue;
    int end = begin;
    while (end < width && is_gap(end)) ++end;
    const bool from_left = end == width || (begin > 0 && depth(begin - 1) <= depth(end));
    if (begin > 0 || end < width) std::fill(row.begin() + begin, row.begin() + end, row[from_left ? begin - 1 : end]);
    begin = end;
  }
}

/// The part of a stroke in a band, with copies of all values that its stamps need, because the strokes themselves are
/// far apart in memory.
struct alignas(64) Piece {
  std::uint32_t stroke;
  std::uint32_t rows;       ///< a bit each
  float left, right;        ///< columns in the central view, including the brush's reach
  float farthest, nearest;  ///< disparities
  StampPaint paint;
  ViewRange views;
  PlannedIn planned_in;
  bool is_rigid, is_thin;
  float middle;  ///< row

  ColumnRun columns_in(float view, int width) const {
    const auto [least, most] = std::minmax({view * farthest, view * nearest});
    return {std::max(static_cast<int>(left - most), 0), std::min(static_cast<int>(right - least) + 1, width)};
  }

  /// Whether a view uses the second stamp of a thin stroke. Thin strokes have two stamps, half a pixel apart, because
  /// their rims are too round to be interpolated far.
  bool lies_between(float view) const {
    if (!is_thin) return false;
    const float moved = view * (paint.disparity + paint.depth_slope * middle);
    const float fraction = moved - static_cast<float>(floor_of(moved));
    return fraction > 0.25f && fraction < 0.75f;
  }
};

Piece piece_of(const FlatStroke& stroke, std::uint32_t index, const Surfaces& surfaces, const DistanceBand& band) {
  constexpr float thin_px = 1.25f;
  const float reach_px = BrushProfile(stroke.radius_px).reach_px, reach = reach_px + 1;
  // Rows have their centres half a pixel down.
  const int first = std::max(static_cast<int>(std::ceil(stroke.top - reach_px - 0.5f)) - band.top, 0);
  const int end =
      std::min(static_cast<int>(std::floor(stroke.bottom + reach_px - 0.5f)) - band.top + 1, band.row_count);
  Piece piece{
      .stroke = index,
      .rows = 0,
      .left = stroke.left - reach,
      .right = stroke.right + reach,
      .farthest = stroke.farthest_disparity,
      .nearest = stroke.nearest_disparity,
      .paint = {stroke.red, stroke.green, stroke.blue, stroke.opacity, stroke.red_change, stroke.green_change,
                stroke.blue_change, stroke.disparity, stroke.depth_slope},
      .views = stroke.views,
      .planned_in = kind_of(stroke.reference_view, surfaces),
      .is_rigid = stroke.is_rigid,
      .is_thin = stroke.radius_px < thin_px,
      .middle = (stroke.top + stroke.bottom) / 2,
  };
  for (int row = first; row < end; ++row) piece.rows |= std::uint32_t{1} << row;
  if (!stroke.is_rigid) return piece;
  const float top = stroke.disparity + stroke.depth_slope * (stroke.top - reach),
              bottom = stroke.disparity + stroke.depth_slope * (stroke.bottom + reach);
  std::tie(piece.farthest, piece.nearest) = std::minmax({top, bottom});
  return piece;
}

/// The pieces of a layer in a band, in drawing order.
struct PiecesOfLayer {
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> of_other_views;  ///< indices of pieces that were planned in other views
  std::vector<Stamp> stamps;
  std::vector<Stamp> stamps_between;  ///< half a pixel to the side
};

/// Whether nothing shows through thin paint.
bool is_opaque(const PreparedStrokes& painting, const ViewToDraw& view) {
  return view.background.empty() && !painting.canvas_shows;
}

/// One band of a painting, drawn for many views: the parts of strokes in it are made once, when a view first needs
/// them.
class BandOfViews {
 public:
  static constexpr std::size_t few_views = 2;  ///< up to this number, only the visible parts of stamps are made

  /// `accumulators`: taken over from another band, or empty. `view_count`: number of views that will be drawn, in one
  /// call or in several.
  BandOfViews(const PreparedStrokes& painting, const Surfaces& surfaces, int number, std::size_t view_count,
              std::vector<FrontToBackAccumulator>& accumulators)
      : painting_(painting),
        surfaces_(surfaces),
        band_(number * band_rows, painting.width, painting.height),
        scratch_(band_.top, 0, painting.height),
        view_count_(view_count),
        accumulators_(accumulators) {
    if (!accumulators_.empty() && accumulators_.front().rows() != band_.row_count) accumulators_.clear();
    for (const BandedLayer& layer : painting.layers) {
      PiecesOfLayer& of_layer = layers_.emplace_back();
      const std::vector<std::uint32_t>& strokes = layer.bands[static_cast<std::size_t>(number)];
      of_layer.pieces.reserve(strokes.size());
      for (std::size_t i = 0; i < strokes.size(); ++i) {
        if (i + FlatLayer::strokes_ahead < strokes.size())
          layer.flat.ask_for_stroke(strokes[i + FlatLayer::strokes_ahead]);
        const FlatStroke& stroke = layer.flat.strokes[strokes[i]];
        const Piece& piece = of_layer.pieces.emplace_back(piece_of(stroke, strokes[i], surfaces, band_));
        if (piece.planned_in != PlannedIn::reference_view)
          of_layer.of_other_views.push_back(static_cast<std::uint32_t>(i));
      }
      of_layer.stamps.resize(of_layer.pieces.size());
      of_layer.stamps_between.resize(of_layer.pieces.size());
    }
  }

  /// Draws some views, stroke by stroke, so that the stamp of a stroke is still in the cache for the next view. With
  /// `only_under_top`, draws only where strokes of the last layer may lie.
  void draw(std::span<const ViewToDraw> views, bool only_under_top) {
    while (accumulators_.size() < views.size()) accumulators_.emplace_back(band_.row_count, painting_.width);
    std::vector<ViewAtWork> at_work;
    for (std::size_t i = 0; i < views.size(); ++i) {
      at_work.push_back(begin(views[i], accumulators_[i]));
      if (only_under_top) open_under_top(at_work.back());
    }
    for (std::size_t above = layers_.size(); above-- > 0;) {
      const std::vector<Piece>& pieces = layers_[above].pieces;
      for (std::size_t nearer = pieces.size(); nearer-- > 0;) {
        ask_ahead(painting_.layers[above].flat, layers_[above], nearer);
        draw_piece(above, nearer, at_work, [&piece = pieces[nearer]](const ViewAtWork& view) -> const HiddenBelow& {
          return view.hides_at_first(piece);
        });
      }
    }
    for (std::size_t above = layers_.size(); above-- > 0;) {
      const std::vector<std::uint32_t>& others = layers_[above].of_other_views;
      for (std::size_t nearer = others.size(); nearer-- > 0;)
        draw_piece(above, others[nearer], at_work,
                   [](const ViewAtWork& view) -> const HiddenBelow& { return view.hides.gaps; });
    }
    for (const ViewAtWork& view : at_work) finish(view);
  }

 private:
  /// Prefetches strokes that are drawn soon, because they lie far apart in memory.
  static HWY_INLINE void ask_ahead(const FlatLayer& layer, const PiecesOfLayer& of_layer, std::size_t nearer) {
    if (nearer < FlatLayer::strokes_ahead) return;
    layer.ask_for_stroke(of_layer.pieces[nearer - FlatLayer::strokes_ahead].stroke);
    layer.ask_for_vertices(of_layer.pieces[nearer - FlatLayer::vertices_ahead].stroke);
    hwy::Prefetch(&of_layer.stamps[nearer - FlatLayer::vertices_ahead]);
  }

  /// One view of the band, before it is finished.
  struct ViewAtWork {
    const HiddenBelow& hides_at_first(const Piece& piece) const {
      if (piece.planned_in == PlannedIn::reference_view) return hides.own;
      return piece.planned_in == PlannedIn::photographed_view ? hides.other : hides.continued;
    }

    const ViewToDraw& view;
    SeenSurfaces seen;
    BandHiding hides;
    FrontToBackAccumulator& accumulator;
    Image<std::uint8_t> wanted = {};  ///< not 0 for the pixels that are drawn; empty: all are
  };

  ViewAtWork begin(const ViewToDraw& view, FrontToBackAccumulator& accumulator) const {
    accumulator.clear();
    SeenSurfaces seen = seen_surfaces(surfaces_, view.position, {painting_.width, band_.top, band_.row_count});
    BandHiding hides(seen.hiding, band_, painting_.width);
    return {view, std::move(seen), std::move(hides), accumulator};
  }

  void open_under_top(ViewAtWork& at_work) const {
    at_work.wanted = Image<std::uint8_t>(painting_.width, band_.row_count);
    for (const Piece& piece : layers_.back().pieces) {
      const auto [begin, end] = piece.columns_in(at_work.view.position - central_view, painting_.width);
      if (begin >= end || !piece.views.contains(at_work.view.position)) continue;
      for (std::uint32_t rows = piece.rows; rows != 0; rows &= rows - 1)
        std::fill_n(&at_work.wanted(begin, std::countr_zero(rows)), end - begin, std::uint8_t{255});
    }
    for (int row = 0; row < band_.row_count; ++row) at_work.accumulator.open_only(row, at_work.wanted.row(row));
  }

  /// A piece that a view may see.
  struct PieceInView {
    const ViewAtWork* at_work;
    const HiddenBelow* below;  ///< what hides it
    ColumnRun columns;
    std::uint32_t rows;  ///< that may have something to draw: a bit each
    bool may_be_hidden;
  };

  /// Draws a piece in all views that may see part of it. These views are found first, because the stamp is made only
  /// where they see it.
  template <class HiddenBelowOf>
  void draw_piece(std::size_t above, std::size_t number, std::span<const ViewAtWork> views, HiddenBelowOf below_of) {
    in_views_.clear();
    for (const ViewAtWork& view : views) find_in_view(layers_[above].pieces[number], view, below_of(view));
    std::uint32_t rows = 0;
    for (const PieceInView& in_view : in_views_) rows |= in_view.rows;
    const Piece& piece = layers_[above].pieces[number];
    // Pieces of other views are drawn twice; and among many views, some view sees nearly every row.
    const bool is_drawn_once = views.size() == view_count_ && piece.planned_in == PlannedIn::reference_view;
    const bool leaves_out_columns = is_drawn_once && views.size() <= few_views && piece.is_rigid && rows != 0;
    if (leaves_out_columns) find_columns_to_draw(piece, rows);
    for (const PieceInView& in_view : in_views_)
      draw_in_view(above, number, {rows, leaves_out_columns ? &columns_to_draw_ : nullptr}, in_view);
  }

  /// Finds, for each of these rows, the columns of the central view that any of the views at hand may draw.
  void find_columns_to_draw(const Piece& piece, std::uint32_t rows) {
    constexpr int margin_px = Stamps::margin + 2;  // columns beside these tell how a rim goes on
    for (std::uint32_t left = rows; left != 0; left &= left - 1) {
      const int row = std::countr_zero(left);
      ColumnRun run{std::numeric_limits<int>::max() / 2, std::numeric_limits<int>::min() / 2};
      for (const PieceInView& in_view : in_views_) {
        const ColumnRun seen = columns_in_row(in_view, row);
        if (seen.begin >= seen.end) continue;
        const float disparity =
            piece.paint.disparity + piece.paint.depth_slope * (static_cast<float>(band_.top + row) + 0.5f);
        const int shift = floor_of((in_view.at_work->view.position - central_view) * disparity);
        run = {std::min(run.begin, seen.begin + shift - margin_px), std::max(run.end, seen.end + shift + margin_px)};
      }
      columns_to_draw_[static_cast<std::size_t>(row)] = run;
    }
  }

  /// The columns from the first to the last block of a row in which a piece may be drawn.
  static ColumnRun columns_in_row(const PieceInView& in_view, int row) {
    constexpr int block_px = FrontToBackAccumulator::block_px;
    const FrontToBackAccumulator& accumulator = in_view.at_work->accumulator;
    const auto is_closed = [&](int number) {
      return (accumulator.open_columns(row, number) &
              in_view.below->shown_columns_in(row, number, accumulator.rows())) == 0;
    };
    int first = in_view.columns.begin / block_px, last = (in_view.columns.end - 1) / block_px;
    while (first <= last && is_closed(first)) ++first;
    while (last > first && is_closed(last)) --last;
    return {first * block_px, (last + 1) * block_px};
  }

  void find_in_view(const Piece& piece, const ViewAtWork& at_work, const HiddenBelow& below) {
    const ViewPosition view = at_work.view.position;
    const FrontToBackAccumulator& accumulator = at_work.accumulator;
    const ColumnRun columns = piece.columns_in(view - central_view, painting_.width);
    if (columns.begin >= columns.end || !piece.views.contains(view)) return;
    constexpr int block_px = FrontToBackAccumulator::block_px;
    std::uint32_t rows = 0;
    bool may_be_hidden = false;
    if (below.pixels.empty()) {
      rows = accumulator.open_rows(columns.begin, columns.end);
    } else {
      for (int number = columns.begin / block_px; number * block_px < columns.end; ++number) {
        const HiddenBelow::Block& block = below.blocks[static_cast<std::size_t>(number)];
        const std::uint32_t seen = piece.nearest < block.least ? 0 : block.shown_rows;
        rows |= seen & accumulator.open_rows(number);
        may_be_hidden |= piece.farthest < block.most;
      }
    }
    rows &= piece.rows;
    // Among many views, some view sees nearly every row.
    if (rows != 0 && view_count_ <= few_views) rows = rows_to_draw(rows, columns, below, accumulator);
    if (rows == 0) return;
    in_views_.push_back({&at_work, &below, columns, rows, may_be_hidden});
  }

  /// `of_views`: the rows, and columns of the central view, that any of the views at hand may draw.
  void draw_in_view(std::size_t above, std::size_t number, const RowsOfStamp& of_views, const PieceInView& in_view) {
    const auto& [at_work, below, columns, rows, may_be_hidden] = in_view;
    PiecesOfLayer& of_layer = layers_[above];
    const Piece& piece = of_layer.pieces[number];
    const FlatLayer& layer = painting_.layers[above].flat;
    const Brush& brush = painting_.layers[above].brush;
    const ViewPosition view = at_work->view.position;
    if (!piece.is_rigid) {
      draw_stroke_under({SeenLayer(layer, view), layer.strokes[piece.stroke], *below, brush}, band_,
                        at_work->accumulator);
      return;
    }
    const float shift = view - central_view;
    const bool between = piece.lies_between(shift);
    Stamp& stamp = (between ? of_layer.stamps_between : of_layer.stamps)[number];
    if ((rows & ~stamp.made) != 0)
      make({SeenLayer(layer, central_view), layer.strokes[piece.stroke], nothing_hides_, brush}, between,
           {of_views.rows & ~stamp.made, of_views.columns}, stamp);
    lay_stamp_under({stamp, stamps_, piece.paint, *below, band_, shift, columns, rows, may_be_hidden,
                     StrokeInBand{SeenLayer(layer, view), layer.strokes[piece.stroke], *below, brush}.varies()},
                    at_work->accumulator);
  }

  /// `wanted.columns` are the central view's.
  void make(const StrokeInBand& of, bool between, const RowsOfStamp& wanted, Stamp& stamp) {
    const FlatStroke& stroke = of.stroke;
    const float reach = BrushProfile(stroke.radius_px).reach_px + Stamps::margin;
    const float left = std::floor(stroke.left - reach);
    stamp.left = left - (between ? 0.5f : 0);
    const int width = static_cast<int>(std::ceil(stroke.right + reach - stamp.left)) + 1;
    if (scratch_.stride < width + 2 * Canvas::widest_vector)
      scratch_ = DistanceBand(band_.top, width, painting_.height);
    if (wanted.columns != nullptr)
      for (std::uint32_t rows = wanted.rows; rows != 0; rows &= rows - 1) {
        const auto row = static_cast<std::size_t>(std::countr_zero(rows));
        const auto [begin, end] = (*wanted.columns)[row];
        columns_of_stamp_[row] = {begin - static_cast<int>(left), end - static_cast<int>(left)};
      }
    make_stamp({SeenLayer(of.layer.flat, central_view, stamp.left), stroke, of.hidden_below, of.brush}, width,
               {wanted.rows, wanted.columns != nullptr ? &columns_of_stamp_ : nullptr}, scratch_, stamp, stamps_);
  }

  void finish(const ViewAtWork& at_work) const {
    if (!at_work.wanted.empty()) return finish_wanted(at_work);
    const ImageView<const float> surface = at_work.seen.hiding.surface;
    DrawnView& drawn = at_work.view.drawn;
    for (int row = 0; row < band_.row_count; ++row) {
      const int y = band_.top + row;
      const std::span<Rgb16> deep = drawn.deep.empty() ? std::span<Rgb16>() : drawn.deep.row(y);
      const bool has_gap = finish_row_of(at_work, row, drawn.picture.row(y), drawn.bare.row(y), deep);
      if (!has_gap || !is_opaque(painting_, at_work.view)) continue;
      const std::span<const float> of_row = surface.empty() ? std::span<const float>() : surface.row(row);
      continue_paint(at_work.accumulator, row, of_row, drawn.picture.row(y));
      continue_paint(at_work.accumulator, row, of_row, deep);
    }
  }

  /// Leaves the other pixels as they are.
  void finish_wanted(const ViewAtWork& at_work) const {
    DrawnView& drawn = at_work.view.drawn;
    const auto width = static_cast<std::size_t>(painting_.width);
    std::vector<Rgb8> picture_row(width);
    std::vector<std::uint8_t> bare_row(width);
    std::vector<Rgb16> deep_row(drawn.deep.empty() ? 0 : width);
    for (int row = 0; row < band_.row_count; ++row) {
      finish_row_of(at_work, row, picture_row, bare_row, deep_row);
      const auto take = [&, wanted = at_work.wanted.row(row)](const auto& from, auto to) {
        for (std::size_t x = 0; x < to.size(); ++x)
          if (wanted[x] != 0) to[x] = from[x];
      };
      const int y = band_.top + row;
      take(picture_row, drawn.picture.row(y));
      take(bare_row, drawn.bare.row(y));
      if (!deep_row.empty()) take(deep_row, drawn.deep.row(y));
    }
  }

  bool finish_row_of(const ViewAtWork& at_work, int row, std::span<Rgb8> picture, std::span<std::uint8_t> bare,
                     std::span<Rgb16> deep) const {
    const ImageView<const Rgb8> background = at_work.view.background;
    return finish_row(
        at_work.accumulator, row,
        {background.empty() ? std::span<const Rgb8>() : background.row(band_.top + row), painting_.canvas_colour,
         is_opaque(painting_, at_work.view), painting_.bare_light, picture, bare, deep});
  }

  const PreparedStrokes& painting_;
  const Surfaces& surfaces_;
  DistanceBand band_;
  DistanceBand scratch_;  ///< as wide as the widest stamp so far
  HiddenBelow nothing_hides_;
  std::vector<PiecesOfLayer> layers_;
  Stamps stamps_;
  std::size_t view_count_;
  std::vector<PieceInView> in_views_;                 ///< of the piece at hand
  std::array<ColumnRun, band_rows> columns_to_draw_;  ///< of the piece at hand, in the central view
  std::array<ColumnRun, band_rows> columns_of_stamp_;
  std::vector<FrontToBackAccumulator>& accumulators_;
};

/// The number of views of a band that are drawn together, stroke by stroke: more would not stay in the second-level
/// cache.
std::size_t views_at_once(int width) {
  constexpr std::size_t most_bytes = 3u << 18, bytes_a_pixel = 4 * sizeof(float);
  return std::max<std::size_t>(most_bytes / (bytes_a_pixel * band_rows * static_cast<std::size_t>(width)), 1);
}

/// The light that one stroke leaves where it covers half a pixel. The largest opacity decides, because fading strokes
/// are less opaque than the paint.
float bare_light_of(const StrokePainting& painting) {
  float opacity = 0;
  for (const Layer& layer : painting.layers)
    for (const Stroke& stroke : layer.strokes) opacity = std::max(opacity, stroke.opacity);
  return 1 - (opacity > 0 ? opacity : 1) / 2;
}

BandedLayer banded(const Layer& layer, int height, const Brush& brush) {
  BandedLayer made{.flat = flatten(layer), .bands = {}, .brush = brush};
  made.bands = strokes_by_band(made.flat, height);
  return made;
}

}  // namespace

PreparedStrokes prepare_marks(const StrokePainting& painting) {
  PreparedStrokes prepared{painting.width,          painting.height,
                           painting.canvas_colour,  std::vector<BandedLayer>(painting.layers.size()),
                           bare_light_of(painting), painting.canvas_shows};
  tbb::parallel_for(std::size_t{0}, prepared.layers.size(), [&](std::size_t i) {
    prepared.layers[i] =
        banded(painting.layers[i], painting.height, i == 0 ? ground_brush(painting.brush) : painting.brush);
  });
  return prepared;
}

namespace {

/// The bands, the most expensive first: a long band that is begun last would keep other threads waiting.
std::vector<int> bands_by_cost(const PreparedStrokes& painting) {
  std::vector<int> bands(static_cast<std::size_t>((painting.height + band_rows - 1) / band_rows));
  std::iota(bands.begin(), bands.end(), 0);
  const auto cost = [&](int band) {
    std::size_t strokes = 0;
    for (const BandedLayer& layer : painting.layers) strokes += layer.bands[static_cast<std::size_t>(band)].size();
    return strokes;
  };
  std::ranges::stable_sort(bands, std::greater{}, cost);
  return bands;
}

}  // namespace

void draw_bands(const PreparedStrokes& painting, const Surfaces& surfaces, std::span<const ViewToDraw> views,
                std::span<const int> bands, bool only_under_top) {
  const std::size_t at_once = views_at_once(painting.width);
  tbb::concurrent_queue<std::vector<FrontToBackAccumulator>> kept;  // reused, because fresh memory is slow
  std::atomic<std::size_t> next = 0;
  const auto draw_next = [&](const auto&) {
    const int i = bands[next++];
    std::vector<FrontToBackAccumulator> accumulators;
    kept.try_pop(accumulators);
    BandOfViews band(painting, surfaces, i, views.size(), accumulators);
    for (std::size_t first = 0; first < views.size(); first += at_once)
      band.draw(views.subspan(first, std::min(at_once, views.size() - first)), only_under_top);
    kept.push(std::move(accumulators));
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bands.size()), draw_next, tbb::simple_partitioner());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    DrawnView& drawn = views[i].drawn;
    const auto pixels = drawn.bare.pixels();
    drawn.bare_share =
        static_cast<double>(std::ranges::count(pixels, std::uint8_t{255})) / static_cast<double>(pixels.size());
  });
}

void draw_marks(const PreparedStrokes& painting, const Surfaces& surfaces, std::span<const ViewToDraw> views) {
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    const ViewToDraw& view = views[i];
    assert(view.background.empty() ||
           (view.background.width() == painting.width && view.background.height() == painting.height));
    view.drawn.picture = Image<Rgb8>(painting.width, painting.height);
    view.drawn.bare = Image<std::uint8_t>(painting.width, painting.height);
  });
  draw_bands(painting, surfaces, views, bands_by_cost(painting));
}

void draw_marks_over(PreparedStrokes& painting, const Surfaces& surfaces, const Layer& strokes,
                     const ViewToDraw& view) {
  const Brush brush = painting.layers.back().brush;
  const BandedLayer& added = painting.layers.emplace_back(banded(strokes, painting.height, brush));
  std::vector<int> bands;
  for (std::size_t band = 0; band < added.bands.size(); ++band)
    if (!added.bands[band].empty()) bands.push_back(static_cast<int>(band));
  // Gaps in opaque paint are filled from beside them, however far away that is.
  draw_bands(painting, surfaces, {&view, 1}, bands, !is_opaque(painting, view));
}

}  // namespace wheatstone
