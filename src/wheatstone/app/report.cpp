#include "wheatstone/app/report.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace wheatstone {
namespace {

using Json = nlohmann::ordered_json;

/// Enough digits to compare by, few enough to read.
double rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json to_json(const PairMeasures& m) {
  return {{"left_right_mean_absolute", rounded(m.difference.mean_absolute)},
          {"left_right_rmse", rounded(m.difference.rmse)},
          {"compared_share", rounded(m.difference.compared_share)},
          {"survival_density", rounded(m.survival.density)},
          {"survival_end_point_error_px", rounded(m.survival.end_point_error)},
          {"survival_bad_1", rounded(m.survival.bad_1)},
          {"survival_bad_2", rounded(m.survival.bad_2)},
          {"left_gradient_energy", rounded(m.left_gradient_energy)},
          {"right_gradient_energy", rounded(m.right_gradient_energy)}};
}

Json to_json(const StrokeMeasures& m) {
  return {{"strokes", m.strokes},
          {"visible_to_both", m.visible_to_both},
          {"paired_share", rounded(m.paired_share)},
          {"shape_differs_share", rounded(m.shape_differs_share)}};
}

Json to_json(const WrongSpots& spots) {
  return {{"spots_per_100000_px", rounded(spots.spots_per_100000_px)}, {"share", rounded(spots.share)}};
}

Json layers_json(std::span<const Layer> of_painting) {
  Json layers = Json::array();
  for (const Layer& layer : of_painting)
    layers.push_back({{"radius_px", rounded(layer.radius_px)}, {"strokes", count_strokes(layer)}});
  return layers;
}

double occluded_share(const Image<std::uint8_t>& occlusion) {
  const auto occluded = std::ranges::count_if(occlusion.pixels(), [](std::uint8_t value) { return value != 0; });
  return rounded(static_cast<double>(occluded) / static_cast<double>(occlusion.pixels().size()));
}

}  // namespace

PaintingMeasures measure_painting(const StereoPair& photographs, const PaintedPhotograph& result,
                                  ImageView<const float> left_disparity, const Progress& progress) {
  PaintingMeasures measures;
  report(progress, "measuring", 0);
  measures.painting = measure_pair(result.painted.pictures, left_disparity);
  report(progress, "measuring", 0.45);
  measures.photographs = measure_pair(photographs, left_disparity);
  report(progress, "measuring", 0.9);
  measures.strokes = measure_strokes(layers_of(result.painted.painting), result.geometry);
  measures.wrong_spots = measure_wrong_spots(result.painted.pictures, photographs);
  report(progress, "measuring", 1);
  return measures;
}

std::string wrong_spots_json(const WrongSpots& spots) {
  return to_json(spots).dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string pair_measures_json(const PairMeasures& measures) {
  return to_json(measures).dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string rectification_json(const Rectification& how) {
  const auto map_json = [](const RectifyingMap& map) {
    return Json{{"straightening", map.straightening},
                {"homography", map.homography},
                {"row_correction_px", map.row_correction}};
  };
  return Json{{"left", map_json(how.left)}, {"right", map_json(how.right)}}.dump(2, ' ', false,
                                                                                 Json::error_handler_t::replace);
}

std::string preparation_json(const PreparedPair& pair) {
  const std::string warning = row_warning(pair);
  const auto rows_json = [](const std::optional<VerticalDisparity>& rows) -> Json {
    if (!rows) return nullptr;
    return {{"median_px", rounded(rows->median_px)}, {"percentile_95_px", rounded(rows->percentile_95_px)}};
  };
  Json facts{{"rectified", pair.rectification.has_value()},
             {"compared_features", pair.compared_features},
             {"row_difference", rows_json(pair.rows)},
             {"kept_area", pair.rectification ? Json(kept_area(*pair.rectification)) : Json()},
             {"photographs_row_difference", rows_json(pair.photographed_rows)},
             {"rectification", nullptr},
             {"eyes_look_swapped", nullptr},
             {"warning", nullptr}};
  if (pair.eyes != EyeOrder::undecided) facts["eyes_look_swapped"] = pair.eyes == EyeOrder::swapped;
  if (pair.rectification) facts["rectification"] = Json::parse(rectification_json(*pair.rectification));
  if (!warning.empty()) facts["warning"] = warning;
  return facts.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string confidence_json(const MatchConfidence& confidence) {
  const std::string warning = match_warning(confidence);
  Json facts{{"found_share", rounded(confidence.found_share)},
             {"streak_share", rounded(confidence.streak_share)},
             {"patch_share", rounded(confidence.patch_share)},
             {"colour_difference", rounded(confidence.colour_difference)},
             {"plain_share", rounded(confidence.plain_share)},
             {"overlap_share", rounded(confidence.overlap_share)},
             {"sharper_share", rounded(confidence.sharper_share)},
             {"depth_px", rounded(confidence.depth_px)},
             {"warning", nullptr}};
  if (!warning.empty()) facts["warning"] = warning;
  return facts.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string report_json(const PaintingReport& told) {
  const auto& [result, style, pair, measures, whole] = told;
  const Painting& painting = result.painted.painting;
  const MarkCount marks = count_marks(painting);
  Json report{{"width", width_of(painting)},
              {"height", height_of(painting)},
              {"style", style.name},
              {"propagation", name_of(style.propagation)},
              {"seed", style.seed},
              {std::string(marks.kind), marks.count},
              {"layers", layers_json(layers_of(painting))},
              {"zero_parallax_px", rounded(result.zero_parallax_px)},
              {"presented_separation", rounded(result.painted.separation)},
              {"left_bare_share", rounded(result.painted.left_bare_share)},
              {"planning_s", rounded(result.painted.times.planning_s)},
              {"rasterising_s", rounded(result.painted.times.rasterising_s)}};
  report["flat"] = result.painted.pictures.right.empty();
  if (!result.painted.pictures.right.empty()) {
    report["right_bare_share"] = rounded(result.painted.right_bare_share);
    report["left_occluded_share"] = occluded_share(result.geometry.left_occlusion);
    report["right_occluded_share"] = occluded_share(result.geometry.right_occlusion);
  }
  if (result.matched) {
    report["matched"] = {{"least_disparity_px", result.matched->range.least},
                         {"largest_disparity_px", result.matched->range.largest},
                         {"left_found_share", rounded(result.matched->left_found_share)},
                         {"right_found_share", rounded(result.matched->right_found_share)}};
  }
  if (result.confidence) report["confidence"] = Json::parse(confidence_json(*result.confidence));
  if (whole.width > 0) report["reduced_from"] = {{"width", whole.width}, {"height", whole.height}};
  if (pair != nullptr) report["pair"] = Json::parse(preparation_json(*pair));
  if (measures != nullptr) {
    report["measures"] = {{"painting", to_json(measures->painting)},
                          {"photographs", to_json(measures->photographs)},
                          {"strokes", to_json(measures->strokes)},
                          {"wrong_spots", to_json(measures->wrong_spots)}};
  }
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace wheatstone
