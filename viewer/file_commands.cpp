#include <memory>

#include "command_groups_internal.h"
#include "command_line.h"
#include "particle_moves.h"
#include "particle_reader.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/marks/style_parameters.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::viewer {
namespace {

void step_item(Viewer& viewer, int by) {
  const auto count = static_cast<int>(viewer.session().items.size());
  if (count > 0) viewer.open(static_cast<std::size_t>((static_cast<int>(viewer.session().item) + by + count) % count));
}

void open_files(Viewer& viewer, const Words& words) {
  Session& session = viewer.session();
  const Item files(words.begin(), words.end());
  const auto series = series_of_files(files);
  session.items.push_back(series ? Item{*series} : files);
  viewer.open(session.items.size() - 1);
}

void open_series(Viewer& viewer, const Words& /*words*/) {
  const Item* const item = open_item(viewer.session());
  const auto pattern = item == nullptr ? std::nullopt : series_pattern_of(item->front());
  if (!pattern || open_particles(viewer) == nullptr)
    return viewer.tell("no snapshot is open that is one of several with numbered names", true);
  open_files(viewer, {pattern->string()});
}

void save_painting(Viewer& viewer, const Words& words) {
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  if (content == nullptr || !content->painting) throw Error(ErrorKind::wrong_usage, "there is no painting to save");
  viewer.save(words[0], [path = words[0], painting = content->painting] { write_painting(path, *painting); });
}

void save_style(Viewer& viewer, const Words& words) {
  write_whole_file(words[0], style_to_toml(state_of(viewer).style));
  viewer.tell("saved " + words[0]);
}

constexpr Command file_table[] = {
    // name, arguments, menu, text, keys
    {"open", "FILE [RIGHT]", "File", "Open…", "Ctrl+O", open_files},
    {"open-series", "", "File", "Open the series of this snapshot", "Ctrl+Shift+O", open_series},
    {"next-file", "", "File", "Next file", "PgDown", [](Viewer& v, const Words&) { step_item(v, 1); }},
    {"previous-file", "", "File", "Previous file", "PgUp", [](Viewer& v, const Words&) { step_item(v, -1); }},
    {"save-picture", "FILE", "File", "Save picture…", "Ctrl+S",
     [](Viewer& v, const Words& w) {
       const auto picture = std::make_shared<const Image<Rgb8>>(frame_of(v).picture);
       v.save(w[0], [path = w[0], picture] { write_image(path, *picture); });
     }},
    {"save-painting", "FILE", "File", "Save painting…", "Ctrl+Shift+S", save_painting},
    {"save-style", "FILE", "File", "Save style…", "", save_style},
    {"copy-command", "", "File", "Copy command", "Ctrl+Shift+C",
     [](Viewer& v, const Words&) { v.tell(command_line_of(v.session())); }},
    {"quit", "", "File", "Quit", "Q, Ctrl+Q", [](Viewer& v, const Words&) { v.session().ends = true; }},
};

}  // namespace

std::span<const Command> file_commands() { return file_table; }

}  // namespace wheatstone::viewer
