#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "commands.h"
#include "wheatstone/error.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/pictures/read_image.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct MeasureViewsArguments {
  std::vector<std::string> views, against;
  ViewMeasuresOptions options;
};

/// The files named, and in place of a folder its pictures in the order of their names.
std::vector<fs::path> files_of(const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const std::string& name : names) {
    if (!fs::is_directory(name)) {
      files.emplace_back(name);
      continue;
    }
    const std::vector<fs::path> inside = pictures_in_folder(name);
    if (inside.empty()) throw Error(ErrorKind::bad_input, fmt::format("{}: has no pictures, expected views", name));
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

struct MeasuredView {
  std::string name;
  ViewMeasures measures;
};

/// Each measure where it is the worst; of splats, how many there are at most.
ViewMeasures worst_of(const std::vector<MeasuredView>& measured) {
  ViewMeasures worst{.psnr_db = std::numeric_limits<double>::infinity()};
  for (const auto& [name, m] : measured) {
    worst.psnr_db = std::min(worst.psnr_db, m.psnr_db);
    worst.differing_pixels = std::max(worst.differing_pixels, m.differing_pixels);
    worst.differing_share = std::max(worst.differing_share, m.differing_share);
    worst.isolated_splats = std::max(worst.isolated_splats, m.isolated_splats);
    worst.lost_splats = std::max(worst.lost_splats, m.lost_splats);
    worst.largest_position_error_px = std::max(worst.largest_position_error_px, m.largest_position_error_px);
  }
  return worst;
}

Json to_json(const ViewMeasures& m) {
  Json facts;
  // JSON has no infinity: equal pictures have no PSNR.
  if (std::isfinite(m.psnr_db)) facts["psnr_db"] = m.psnr_db;
  facts["equal"] = !std::isfinite(m.psnr_db);
  facts["differing_pixels"] = m.differing_pixels;
  facts["differing_share"] = m.differing_share;
  facts["isolated_splats"] = m.isolated_splats;
  facts["lost_splats"] = m.lost_splats;
  facts["largest_position_error_px"] = m.largest_position_error_px;
  return facts;
}

std::string line_of(const std::string& name, std::size_t width, const ViewMeasures& m) {
  return fmt::format("{:<{}}{:>10}{:>11}{:>11.2f}{:>9}{:>7}{:>14.2f}", name, width,
                     std::isfinite(m.psnr_db) ? fmt::format("{:.1f}", m.psnr_db) : "equal", m.differing_pixels,
                     100 * m.differing_share, m.isolated_splats, m.lost_splats, m.largest_position_error_px);
}

std::string table_of(const std::vector<MeasuredView>& measured, int noticeable) {
  std::size_t width = 16;
  for (const MeasuredView& view : measured) width = std::max(width, view.name.size());
  constexpr auto heads = "{:<{}}{:>10}{:>11}{:>11}{:>9}{:>7}{:>14}";
  std::vector<std::string> all{fmt::format(heads, "", width, "PSNR", fmt::format("off by >{}", noticeable),
                                           "off at all", "isolated", "lost", "position off"),
                               fmt::format(heads, "view", width, "dB", "pixels", "%", "splats", "", "px, at most")};
  for (const auto& [name, measures] : measured) all.push_back(line_of(name, width, measures));
  if (measured.size() > 1) all.push_back(line_of("worst", width, worst_of(measured)));
  return lines({}, all);
}

Report run_measure_views(const MeasureViewsArguments& arguments, const Session& session) {
  const std::vector<fs::path> views = files_of(arguments.views);
  const std::vector<fs::path> against = files_of(arguments.against);
  if (views.size() != against.size())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("measure views: {} views against {}, expected as many", views.size(), against.size()));
  std::vector<MeasuredView> measured;
  for (std::size_t i = 0; i < views.size(); ++i) {
    report(session.progress, "views", static_cast<double>(i) / static_cast<double>(views.size()));
    const auto [view, reference] = read_two_images(views[i], against[i]);
    if (!same_size(view, reference))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", views[i].string(), view.width(),
                              view.height(), reference.width(), reference.height(), against[i].string()));
    measured.push_back({views[i].filename().string(), measure_view(view, reference, arguments.options)});
  }
  const int noticeable = arguments.options.noticeable;
  Json each = Json::array();
  for (const auto& [name, measures] : measured) {
    Json facts{{"view", name}};
    facts.update(to_json(measures));
    each.push_back(facts);
  }
  return {{{"noticeable", noticeable},
           {"views", each, table_of(measured, noticeable)},
           {"worst", to_json(worst_of(measured))}}};
}

Rows measure_views_rows(MeasureViewsArguments& a) {
  return {row("VIEWS", required(texts(a.views)),
              "Pictures, or folders of pictures, which are taken in the order of their names"),
          row("--against", required(texts(a.against)), "Reference views: the same number, of the same sizes"),
          row("--noticeable", number(a.options.noticeable, {0, 255}),
              "Count the pixels that differ by more than this, in 0..255")};
}

}  // namespace

Command measure_views_command() {
  return make_command("views", "Compare views with reference views", measure_views_rows, run_measure_views,
                      R"(Example:
  wheatstone render universe.hdf5 --views 9 --method exact -o exact
  wheatstone render universe.hdf5 --views 9 --method layered -o layered
  wheatstone measure views layered --against exact)");
}

}  // namespace wheatstone::cli
