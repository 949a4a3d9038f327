#include "film_mask_argument.h"

#include "wheatstone/app/film_mask.h"
#include "wheatstone/painting/style_parameters.h"

namespace wheatstone::cli {

Rows mask_rows(MaskArguments& arguments, const Reasons& unless) {
  return under("Masks",
               {row("--mask", of_type("FILE", text(arguments.file)),
                    "Paint only where this picture, film, or numbered pictures (matte_%04d.png) are white; grey mixes. "
                    "Of the left eye, and moved to the right one, or of both eyes as the film's frames have them",
                    unless),
                row("--outside", text(arguments.outside),
                    "What is shown elsewhere: none, which is the film's own picture, or another style, by its name or "
                    "file",
                    {}, "--mask")});
}

void take_mask(const MaskArguments& arguments, const FilmFiles& film, const StereoFilmReader& source,
               const Session& session, RotoscopeFilmOptions& options) {
  if (arguments.file.empty()) return;
  options.mask = mask_of_film(arguments.file, {film.film, source.facts(), options.reading}, source.layout());
  options.made_from.emplace_back(arguments.file);
  options.frames.depth_budget.reset();
  if (arguments.outside == "none") return;
  options.frames.outside = read_style(arguments.outside);
  options.frames.outside->seed = session.seed;
}

}  // namespace wheatstone::cli
