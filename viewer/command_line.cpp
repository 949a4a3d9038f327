#include "command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "depth_seen.h"
#include "film_player.h"
#include "output_mode.h"
#include "particle_film.h"
#include "particle_scene.h"
#include "style_controls.h"
#include "wheatstone/painting/style_parameters.h"

namespace wheatstone::viewer {
namespace {

/// A word as a shell takes it.
std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text;
  for (const char letter : word) {
    if (letter == '\'')
      text += "'\\''";
    else
      text += letter;
  }
  return fmt::format("'{}'", text);
}

std::string files_of(const Item& item) {
  std::string text;
  for (const auto& file : item) text += fmt::format(" {}", shell_word(file.string()));
  return text;
}

/// The options that make a preset this style.
std::string style_options(const Style& style) {
  const auto names = style_names();
  const bool is_preset = std::ranges::find(names, style.name) != names.end();
  const Style preset = is_preset ? style_by_name(style.name) : Style();
  std::string text = fmt::format(" --style {}", shell_word(is_preset ? style.name : preset.name));
  for (const StyleParameter& parameter : style_parameters()) {
    const std::string plain = plain_value(parameter, style);
    if (plain == plain_value(parameter, preset) || parameter.name == "seed") continue;
    if (!parameter.is_switch) {
      text += fmt::format(" --{} {}", parameter.name, shell_word(plain));
    } else {
      text += plain == "true" ? fmt::format(" --{}", parameter.name) : fmt::format(" --{}=false", parameter.name);
    }
  }
  return text;
}

/// The mapping, and the viewer that it is for unless a display tells.
std::string mapping_options(const ViewState& state, bool with_viewer) {
  if (state.depth_regions.empty()) return {};
  std::string text = fmt::format(" --depth-mapping {}", text_of(state.depth_regions));
  const ViewingGeometry viewing = placing_of(state).viewing;
  if (with_viewer)
    text +=
        fmt::format(" --distance {:.6g} --screen-width {:.6g}", viewing.viewing_distance_mm, viewing.screen_width_mm);
  return text;
}

/// What says where the screen plane lies.
std::string plane_options(const ViewState& state, bool for_display) {
  if (!state.depth_regions.empty()) return mapping_options(state, !for_display);
  return fmt::format(" --zero-parallax {:.2f}", state.adjustment.zero_parallax_px);
}

/// What is left out of a painting that is drawn again.
std::string slicing_options(const Slicing& slicing) {
  std::string text;
  if (slicing.finest_layer != Slicing().finest_layer) text += fmt::format(" --slice-layer {}", slicing.finest_layer);
  if (slicing.depths.empty()) return text;
  text += fmt::format(" --slice-depth={}", slice_depths_text(slicing.depths));
  return slicing.keeps == SliceKeeps::front ? text + " --slice-keep front" : text;
}

/// `zero_parallax_px` is that of the eyes as they are, before they are swapped.
std::string packed(const ViewState& state, const std::string& input, float zero_parallax_px) {
  const OutputMode& mode = find_output_mode(state.mode);
  if (shows_display_views(mode)) {
    const bool has_screen = state.mode == "lenticular" && !state.screen.empty();
    return fmt::format("wheatstone pack {} --to {} {} {} -o {}", input, state.mode,
                       has_screen ? "--screen" : "--display", shell_word(has_screen ? state.screen : state.display),
                       state.mode);
  }
  const bool is_one_picture =
      std::holds_alternative<StereoLayout>(mode.kind) || std::holds_alternative<const AnaglyphKind*>(mode.kind);
  if (!is_one_picture && state.mode != "wiggle") return {};
  const std::string views = state.adjustment.separation == 1
                                ? std::string()
                                : fmt::format(" --views 2 --span {:.4g}", state.adjustment.separation);
  return fmt::format("wheatstone pack {}{} --to {} --zero-parallax {:.2f}{} -o {}", input, views, state.mode,
                     state.swap ? -zero_parallax_px : zero_parallax_px, state.swap ? " --swap" : "",
                     state.mode == "wiggle" ? "wiggle.gif" : "picture.png");
}

std::string for_painting(const Session& session, const Item& item, const PaintedContent& content) {
  const ViewState& state = session.state;
  const float screen_px = state.adjustment.zero_parallax_px;
  const std::string slices = slicing_options(state.slicing);
  if (!content.photograph) {
    if (shows_display_views(find_output_mode(state.mode)))
      return fmt::format("wheatstone paint{} --display {}{}{} -o painted", files_of(item), shell_word(state.display),
                         plane_options(state, true), slices);
    const bool is_placed = !state.depth_regions.empty();
    std::string placed =
        fmt::format("wheatstone paint{}{}{} -o painted", files_of(item), mapping_options(state, true), slices);
    const std::string pack =
        packed(state, is_placed ? "painted/painting.wst" : shell_word(item.front().string()) + slices,
               screen_px * state.adjustment.separation);
    if (pack.empty()) return placed;
    return is_placed ? fmt::format("{} && {}", placed, pack) : pack;
  }
  const bool for_display = shows_display_views(find_output_mode(state.mode));
  const std::string display = for_display ? fmt::format(" --display {}", shell_word(state.display)) : std::string();
  std::string paint = fmt::format("wheatstone paint{}{}{}{} -o painted", files_of(item), style_options(state.style),
                                  plane_options(state, for_display), display);
  if (!display.empty()) return paint;
  const std::string pack = packed(state, "painted/painting.wst" + slices, screen_px * state.adjustment.separation);
  return pack.empty() ? paint : fmt::format("{} && {}", paint, pack);
}

/// The options of `render` that make particles, models or slices as deep.
std::string depth_options(const ViewState& state) {
  if (!state.depth_regions.empty()) return mapping_options(state, true);
  const PerceivedDepth depth = perceived_depth(state);
  return fmt::format(" --distance {} --screen-width {} --near {} --far {}", depth.viewing.viewing_distance_mm,
                     depth.viewing.screen_width_mm, depth.near_mm, depth.far_mm);
}

/// The options of `render` that make these views of particles or a model.
std::string view_options(const Session& session, const std::array<double, 3>& origin) {
  const ViewState& state = session.state;
  const Framing& orbit = state.orbit;
  std::string text =
      fmt::format(" --azimuth {} --elevation {} --zoom {}", orbit.azimuth_deg, orbit.elevation_deg, orbit.zoom);
  if (orbit.orthographic) text += " --projection orthographic";
  if (const auto& at = orbit.look_at)
    text += fmt::format(" --look-at={},{},{}", (*at)[0] + origin[0], (*at)[1] + origin[1], (*at)[2] + origin[2]);
  if (shows_display_views(find_output_mode(state.mode))) {
    text += fmt::format(" --display {}", state.display);
  } else {
    text += fmt::format(" --views 2 --span {} --size {}x{}", state.adjustment.separation, session.eye.width,
                        session.eye.height);
  }
  return text + depth_options(state);
}

/// The point with more depth.
std::string focus_options(const ScreenFocus& focus) {
  if (!focus.at) return {};
  return fmt::format(" --focus {},{} --focus-radius {} --focus-gain {}", (*focus.at)[0], (*focus.at)[1], focus.radius,
                     focus.gain);
}

/// The options of `render` that show mass, or a quantity.
std::string mass_options(const ParticleLook& look) {
  std::string text;
  if (!look.choice.quantity.empty()) text += fmt::format(" --quantity {}", shell_word(look.choice.quantity));
  if (look.stretch == Stretch::log) text += " --stretch log";
  if (look.stretch == Stretch::linear) text += " --stretch linear";
  if (look.least) text += fmt::format(" --least={}", *look.least);
  if (look.most) text += fmt::format(" --most={}", *look.most);
  return text;
}

/// The options of `render` that make particles look so.
std::string look_options(const ViewState& state) {
  const ParticleLook& look = state.look;
  const ParticleLook usual;
  std::string text;
  if (!look.choice.where.empty()) text += " --where " + shell_word(look.choice.where);
  if (!look.choice.type_colours.empty()) text += " --type-colours " + shell_word(look.choice.type_colours);
  if (drawn_look(look) == Look::thesis) {
    text += " --look thesis";
    if (look.exposure) text += fmt::format(" --exposure {}", *look.exposure);
    if (look.opacity != usual.opacity) text += fmt::format(" --opacity {}", look.opacity);
    if (look.opaque) text += " --opaque";
  } else {
    text += mass_options(look);
  }
  const bool has_hues = drawn_look(look) == Look::thesis || look.choice.quantity.empty();
  if (look.coldest && has_hues) text += fmt::format(" --coldest {}", *look.coldest);
  if (look.hottest && has_hues) text += fmt::format(" --hottest {}", *look.hottest);
  if (!look.colours.empty()) text += fmt::format(" --colours {}", look.colours);
  if (look.smallest_px != usual.smallest_px || look.largest_px != usual.largest_px)
    text += fmt::format(" --splat {},{}", look.smallest_px, look.largest_px);
  return text + focus_options(look.focus);
}

/// The bars, and what stands beside them.
std::string annotation_options(const ParticleLook& look) {
  if (!look.annotated) return {};
  std::string text = " --annotate";
  if (!look.title.empty()) text += " --title " + shell_word(look.title);
  if (look.annotation_behind_mm != 0) text += fmt::format(" --annotation-depth={}", look.annotation_behind_mm);
  return text;
}

/// The options of `render` that make the film of what goes on in time. A path that no file holds is left out.
std::string film_options(const Session& session) {
  const std::string camera =
      session.camera_file.empty() ? std::string() : " --camera " + shell_word(session.camera_file.string());
  const auto frames = std::llround(session.film->duration_s * particle_frames_a_second) + 1;
  return fmt::format(" --frames {}{} -o film.mp4", frames, camera);
}

std::string for_film(const Session& session, const Item& item) {
  const std::string mono = session.opened.film && session.opened.film->film.quilt ? " --layout mono" : std::string();
  return fmt::format("wheatstone rotoscope{}{}{} -o painted.mp4", files_of(item), mono,
                     style_options(session.state.style));
}

struct LineOf {
  const Session& session;
  const Item& item;

  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(const PaintedContent& content) const { return for_painting(session, item, content); }
  std::string operator()(const ViewsContent& /*content*/) const {
    return packed(session.state, shell_word(item.front().string()), 0);
  }
  std::string operator()(const SlicesContent& /*content*/) const {
    const ViewState& state = session.state;
    const bool has_depth = state.look.near_mm || state.look.far_mm || !state.depth_regions.empty();
    if (has_depth || state.look.focus.at || session.film)
      return fmt::format("wheatstone render{} --filter centroid --views 2 --span {}{}{} -o {}", files_of(item),
                         state.adjustment.separation, has_depth ? depth_options(state) : std::string(),
                         focus_options(state.look.focus), session.film ? "film.mp4" : "views");
    return packed(session.state, shell_word(item.front().string()),
                  session.state.adjustment.zero_parallax_px * session.state.adjustment.separation);
  }
  std::string operator()(const ParticlesContent& content) const {
    const std::array<double, 3>& origin = content.particles->cloud.origin;
    const std::string options =
        view_options(session, origin) + look_options(session.state) + annotation_options(session.state.look);
    return rendered(options);
  }
  std::string operator()(const ModelContent& content) const {
    return rendered(view_options(session, content.model->origin));
  }

  /// `render` with options that make views, or the film of what is shown.
  std::string rendered(const std::string& options) const {
    return fmt::format("wheatstone render{}{}{}", files_of(item), options,
                       session.film ? film_options(session) : std::string(" -o views"));
  }
};

}  // namespace

std::string command_line_of(const Session& session) {
  const Item* const item = open_item(session);
  if (item == nullptr) return {};
  const bool is_of_pictures = session.opened.film && session.opened.film->film.slices.empty();
  return is_of_pictures ? for_film(session, *item) : std::visit(LineOf{session, *item}, session.opened.content);
}

}  // namespace wheatstone::viewer
