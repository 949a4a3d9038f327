#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "wheatstone/marks/style.h"

namespace wheatstone {

/// Under which heading people look for a parameter.
enum class StyleSection { strokes, colour, depth };
inline constexpr std::array<std::string_view, 3> style_section_names{"Strokes", "Colour", "Depth"};  ///< in their order

/// One parameter of a style, as the command line and style files know it.
struct StyleParameter {
  std::string_view name;   ///< "depth-threshold": an option without its dashes, and a key of a style file
  std::string_view title;  ///< for people: "Stroke spacing"
  StyleSection section;
  std::string_view help;
  bool is_switch;                                       ///< true or false
  std::function<std::string(const Style&)> toml_value;  ///< as it stands in a TOML file
  std::function<void(Style&, std::string_view)> set;    ///< from "4", "8,4,2", "true", "median"; throws wrong_usage
  std::span<const Marks> read_by;  ///< the kinds of marks that it changes, empty: all; on others it has no effect
};

/// Whether a parameter changes paintings of these marks.
bool is_read_by(const StyleParameter& parameter, Marks marks);

/// Every parameter of Style, in the order in which they are shown. Option parser, help and style files come from here.
std::span<const StyleParameter> style_parameters();

/// A style as a TOML document that `read_style` turns back into an equal style.
std::string style_to_toml(const Style& style);

/// Changes `style` by what a TOML document says; what it does not name stays. `name` stands for the file in messages.
/// Throws Error{bad_input}: not TOML, an unknown key (the known ones are listed), a value that does not fit.
void apply_toml(std::string_view document, std::string_view name, Style& style);

/// A preset by its name, or a style file by its path. A file may say `style = "impressionist"` to start from a preset.
Style read_style(const std::string& name_or_path);

}  // namespace wheatstone
