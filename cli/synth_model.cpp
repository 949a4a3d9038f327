#include <array>
#include <string>

#include "commands.h"
#include "wheatstone/models/write_obj.h"
#include "wheatstone/synthetic/synthetic_models.h"

namespace wheatstone::cli {
namespace {

enum class Shape { knot, city, sphere, tree };

constexpr std::array<Choice<Shape>, 4> shapes{
    {{"knot", Shape::knot}, {"city", Shape::city}, {"sphere", Shape::sphere}, {"tree", Shape::tree}}};

struct SynthModelArguments {
  std::string file = "model.obj";
  Shape shape = Shape::knot;
  std::size_t triangles = 20'000;
};

Model made(const SynthModelArguments& a, std::uint64_t seed) {
  if (a.shape == Shape::city) return make_city(a.triangles, seed);
  if (a.shape == Shape::sphere) return make_textured_sphere(a.triangles);
  return a.shape == Shape::tree ? make_tree(a.triangles, seed) : make_knot(a.triangles);
}

Report run_synth_model(const SynthModelArguments& arguments, const Session& session) {
  const Model model = made(arguments, session.seed);
  write_obj(arguments.file, model);
  return {{{"file", arguments.file, fmt::format("written to {}", arguments.file)},
           {"triangles", model.triangles.size()},
           {"seed", session.seed}}};
}

Rows synth_model_rows(SynthModelArguments& a) {
  return {
      row("-o,--output", output_name(a.file), "OBJ file; the files of its materials and textures are named after it"),
      row("--shape", choice(a.shape, shapes),
          "Shape of the model: a knot, boxes in rows, a sphere with a map, or a tree"),
      row("--triangles", number(a.triangles, {100, 2e7}), "Number of triangles, about")};
}

}  // namespace

Command synth_model_command() {
  return make_command("model", "A model of triangles, as an OBJ file", synth_model_rows, run_synth_model,
                      R"(Examples:
  wheatstone synth model --shape tree --triangles 100000 -o tree.obj
  wheatstone synth model -o knot.obj && wheatstone render knot.obj -o views)");
}

}  // namespace wheatstone::cli
