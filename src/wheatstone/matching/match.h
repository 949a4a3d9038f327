#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "wheatstone/progress.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How corresponding pixels are found.
enum class Matcher {
  census,  ///< semi-global matching of census transforms from coarse to fine; its own, and the best for photographs
  sgbm,    ///< semi-global matching (OpenCV, MODE_SGBM_3WAY)
  bm,      ///< block matching (OpenCV)
  dp,  ///< dynamic programming along scan lines (Birchfield & Tomasi 1998), one of the two of Stavrakis & Gelautz 2005
  onnx,  ///< a neural network from a file (OpenCV's DNN module)
};

std::span<const std::string_view> matcher_names();
std::optional<Matcher> matcher_by_name(std::string_view name);
std::string_view name_of(Matcher matcher);

/// What a network's pictures consist of; red, green, blue.
enum class NetworkValues {
  to_255,    ///< 0..255
  to_1,      ///< 0..1
  imagenet,  ///< 0..1 less ImageNet's mean, divided by its deviation
};

std::span<const std::string_view> network_values_names();
std::optional<NetworkValues> network_values_by_name(std::string_view name);

/// Disparities looked for, in whole pixels, both ends included; either may be negative.
struct DisparityRange {
  int least = 0;
  int largest = 64;
};

/// Presets of MatchOptions.
enum class MatchQuality {
  fast,  ///< at half the pictures' size
  good,  ///< the defaults
  best,  ///< parts of a pixel found in copies of twice the size; with other matchers than census doubtful places are
         ///< replaced by their surroundings and edges refined
};

std::span<const std::string_view> match_quality_names();
std::optional<MatchQuality> match_quality_by_name(std::string_view name);

struct MatchOptions {
  Matcher matcher = Matcher::census;
  /// For onnx: a network with two inputs of 1×3×H×W, left and right, or one of 1×6×H×W; open sides are the picture's,
  /// rounded up to 32. It answers with one map of disparities, in pixels of W; where they are mostly negative they are
  /// taken for a flow and turned round.
  std::filesystem::path model;
  NetworkValues model_values = NetworkValues::to_255;
  std::optional<DisparityRange> range;  ///< none: from sparse matches
  int block_px = 3;                     ///< side of the compared windows; odd. bm takes at least 11
  bool left_right_check = true;         ///< drop what the other view does not confirm
  float check_tolerance_px = 1;
  int least_surface_px = 100;  ///< smaller connected patches of like disparity are dropped as speckles
  double size = 1;             ///< matched in copies of this share of the pictures' width, above 0 and up to 1
  bool double_size = false;    ///< census only: parts of a pixel are found in copies of twice the size
  bool distrust = false;       ///< replace what is on plain surfaces and in repeated patterns; census does so by itself
  bool wls = false;            ///< edge-aware refinement (OpenCV ximgproc, weighted least squares)
  bool wls_keeps_confirmed = false;  ///< ... but for what it would move by no more than a pixel; not with census
  double wls_lambda = 2000;
  double wls_sigma = 1;
};

MatchOptions match_options_for(MatchQuality quality);

/// A matched pair. The shares are of the pixels, 0..1; found is what was not filled, and what the other view confirms
/// to a pixel, at the pictures' own size or in the copy in which noise does not hide it.
struct MatchedPair {
  StereoGeometry geometry;
  DisparityRange range;
  /// Of each pixel of the left view: 255, its disparity is confirmed and clear; 128, it is one of the two; 0, it is
  /// filled from its surroundings.
  Image<std::uint8_t> left_confidence;
  double left_found_share = 0;
  double right_found_share = 0;
  double plain_share = 0;  ///< of the left picture: large parts that show nothing but noise; census only
};

/// Finds the disparity of every pixel of a rectified pair, in both geometries, and both occlusion masks. Unknown places
/// are filled from their farther neighbours. Pairs of more than about 12 megapixels, or with more than 512 disparities,
/// are matched at a reduced size. The same result on every run and any number of threads.
/// Throws Error{bad_input}: sizes differ, fewer than 16 pixels a side, nothing matches, the model is missing or no
/// network that can be run; Error{wrong_usage}: a range or block that makes no sense.
MatchedPair match(const StereoPair& pair, const MatchOptions& options = {}, const Progress& progress = {});

/// As match, but none where no pixel matches, as in two black frames of a film.
std::optional<MatchedPair> match_if_any(const StereoPair& pair, const MatchOptions& options = {},
                                        const Progress& progress = {});

/// The range of disparities in a pair, from matched corners (ORB) and a coarse match of small copies, with some room at
/// either end. None where the pictures show nothing to tell it from.
std::optional<DisparityRange> find_disparity_range(const StereoPair& pair);

/// What a pair made for viewing keeps to.
DisparityRange usual_disparity_range(int width_px);

}  // namespace wheatstone
