#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/depth/view_position.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/multiview/model_scene.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/scene.h"
#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/particles/appearance.h"
#include "wheatstone/particles/cloud.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/cloud_statistics.h"
#include "wheatstone/particles/framed_region.h"
#include "wheatstone/particles/select.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// How deep the scene is to stand on the display.
struct PerceivedDepth {
  ViewingGeometry viewing;  ///< its width in pixels is taken from the views
  float near_mm = 100;      ///< the nearest particle stands so far in front of the screen
  float far_mm = 100;       ///< and the farthest so far behind it
  /// Many regions: share of the scene's depth, 0 the nearest and 1 the farthest particle, and what it becomes, in
  /// millimetres behind the screen. Empty: one region from `near_mm` to `far_mm`.
  using Region = DepthRegion;
  std::vector<Region> regions;
  bool smooth = false;  ///< a monotone curve through the regions' ends instead of a corner at each
};

/// The options of a model of triangles.
struct ModelOptions {
  ModelChoice choice;
  Rgb8 background = ModelLook().background;
  int samples = ModelLook().samples;  ///< a pixel: 4 or 8
};

struct RenderParticlesOptions {
  CloudChoice choice;
  Selection selection;
  int neighbours = 32;  ///< in a kernel, where the file has no density and it is estimated
  Appearance appearance;
  Framing framing{.zoom = 1.2f};  ///< a box seldom fills the sphere around it
  /// As the framing's, in the file's own units, where the cloud has an origin of its own.
  std::optional<std::array<double, 3>> look_at;
  Fit fit;  ///< what the views show and the depth is mapped to
  PerceivedDepth depth;
  int width = 640, height = 360;  ///< of a view
  int views = 2;
  float span = 1;                       ///< eye separations from the first view to the last
  std::vector<ViewPosition> positions;  ///< of the views, in place of `views` and `span`; empty: evenly spaced
  RenderOptions rendering;
  ModelOptions model;
  /// The values that are shown instead of the usual picture: "column-density"; or a quantity, whose mean along each
  /// line of sight, weighted by mass, is shown: "temperature", "density", or the name of a dataset or column
  /// (CloudChoice::quantity), with or without "mean:" before it. Empty: the usual picture.
  std::string quantity;
  /// The values at which the colours begin and end, in units of the shown values: of a column density, unless a
  /// quantity is shown. NaN: found.
  float least = ToneSettings::automatic, most = ToneSettings::automatic;
  bool values = false;         ///< views as numbers too
  bool slices = false;         ///< make slices, and the views from them
  bool without_views = false;  ///< make slices only
  bool stream = false;         ///< never hold all particles: two passes over the file, chunk by chunk; by slices
  /// A file whose chosen particles take up to so many bytes is kept and read once.
  std::size_t most_bytes_kept = std::size_t{128} << 20;
  std::size_t chunk = 1 << 16;  ///< particles; what is made of so few stays in the cache
};

/// What numbers of a picture are counted in, as far as the file tells, as unit_expression writes it: "kpc",
/// "code_length".
struct ShownUnits {
  std::string length;
  std::string value;  ///< of what is shown: "Msun/kpc**2"
  std::string name;   ///< of what is shown: "column density"
};

/// Where the densities of particles come from.
enum class DensitySource {
  file,        ///< or they are not needed
  neighbours,  ///< estimated from those of each particle
  grid,        ///< in which particles were counted that are not all held
};

/// The result of rendering a file of particles, of slices, or of a model.
struct RenderedParticles {
  RenderedViews rendered;
  SliceStack stack;  ///< empty unless slices were made
  Rig rig;
  Scene scene;
  ViewingGeometry viewing;  ///< of the views, of particles only
  std::optional<Focus> focus;
  std::vector<ViewValues> values;  ///< of the views, where they were asked for
  ShownUnits units;
  float least = 0, most = 0;       ///< where the brightness of what is shown begins and ends
  std::optional<double> redshift;  ///< of a universe that expands
  std::optional<double> time;      ///< of another simulation, in its own unit
  std::vector<TypeColour> types;   ///< that have colours of their own
  std::string format;
  std::uint64_t triangles = 0;   ///< of a model
  std::uint64_t degenerate = 0;  ///< triangles without an area, which were left out
  std::uint64_t particles = 0;   ///< drawn
  std::uint64_t unchosen = 0;    ///< left out: CloudChoice::where does not hold
  std::uint64_t dropped = 0;     ///< without a finite position
  std::uint64_t weightless = 0;  ///< left out: without a mass, or without what is to be shown
  std::uint64_t mended = 0;      ///< with a density or temperature that is not above 0, which got the least one
  std::uint64_t extreme = 0;     ///< densities and temperatures beyond single precision, put at its limits
  std::uint64_t outside = 0;     ///< of what the views are framed by
  DensitySource density = DensitySource::file;
  bool has_mass = false;              ///< else each particle counts 1
  std::vector<std::string> warnings;  ///< of comfort and of what is missing, in words for people
};

/// A file of particles to the views of a rig. Throws Error: bad_input for the file, wrong_usage for the options.
RenderedParticles render_particles(const std::filesystem::path& file, const RenderParticlesOptions& options,
                                   const Progress& progress = {});

/// All particles of a file, ready to be rendered.
struct ReadyParticles {
  Cloud cloud;                 ///< with densities, or colours of its own
  CloudStatistics statistics;  ///< with what the views are framed by
  SelectionCounts counts;
  DensitySource density = DensitySource::file;
};

/// Reads particles, selects, and estimates their density where the file has none. Throws Error: bad_input for the file,
/// wrong_usage for the options.
ReadyParticles read_particles(const std::filesystem::path& file, const RenderParticlesOptions& options = {},
                              const Progress& progress = {});

/// Selects from particles that were read, and estimates their density where the file has none. Throws as
/// read_particles.
ReadyParticles ready_particles(Cloud cloud, const std::filesystem::path& file,
                               const RenderParticlesOptions& options = {}, const Progress& progress = {});

/// The views of particles that are ready. Of what is told, `format` and the comfort of the depth are left to the
/// caller.
RenderedParticles render_ready(const ReadyParticles& particles, const RenderParticlesOptions& options,
                               const Progress& progress = {});

/// The exposure, or the limits between which brightness lies, that views of such particles would get.
struct Brightness {
  float exposure;     ///< of the thesis's look
  float least, most;  ///< in units of what is shown
};
Brightness brightness_for(const CloudStatistics& statistics, const RenderParticlesOptions& options);

/// The name of the column that a quantity is the mean of, without "mean:"; empty where none is shown.
std::string quantity_name_of(const std::string& quantity);

/// The units of the numbers in a picture of these particles. `has_mass`: they have masses.
ShownUnits units_of(const CloudSource& source, const RenderParticlesOptions& options, bool has_mass);

/// Which part of a file becomes the cloud. Its origin is the middle of the shown region, if the options give it.
CloudChoice choice_of(const RenderParticlesOptions& options);

/// The viewing geometry for views of the options' width.
ViewingGeometry viewing_of(const RenderParticlesOptions& options);

/// The scene as the central camera has it, of particles of which this is known. Throws Error{wrong_usage} for the
/// options.
Scene scene_of(const CloudStatistics& statistics, const RenderParticlesOptions& options);

/// The central camera, and where depths go.
struct StagedCamera {
  Camera camera;
  DepthMapping mapping;
  float distance;  ///< depth of the point that is looked at
};

/// The same for anything within a sphere, whose centre is relative to an origin. Throws Error{wrong_usage} where the
/// point that is looked at lies too far away.
StagedCamera staged_camera(const std::array<float, 3>& centre, float radius, const std::array<double, 3>& origin,
                           const RenderParticlesOptions& options);

/// The ways in which the depth of the options' views may strain the eyes, in words for people.
std::vector<std::string> discomforts_of(const RenderParticlesOptions& options);

/// The default depth before and behind the screen, in millimetres: the same share of the screen's width as 10 cm on a
/// desk's screen.
float usual_depth_mm(float screen_width_mm);

/// The mapping of a scene between these depths, in scene units.
DepthMapping mapping_for(const PerceivedDepth& depth, int width_px, float nearest, float farthest);

}  // namespace wheatstone
