#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "view_state.h"
#include "wheatstone/app/render_model_file.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/retouch.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::viewer {

/// A photograph that is painted from.
struct Photograph {
  StereoPair pictures;
  bool is_rectified = false;                  ///< the pictures are not as in the files
  std::optional<StereoGeometry> geometry;     ///< once it was found; as it was retouched
  std::optional<StereoGeometry> found;        ///< as it was before it was retouched by hand; none: it was not
  std::vector<Touch> touches;                 ///< that `geometry` was retouched with
  Image<Rgb8> retouched_right;                ///< the right picture that belongs to these; empty: as it is
  std::optional<Image<std::uint8_t>> detail;  ///< as detail_of_faces, once a style wanted it
};

/// The pictures that it is painted from.
inline StereoPairView pictures_to_paint(const Photograph& photograph) {
  const bool is_retouched = !photograph.retouched_right.empty();
  return {photograph.pictures.left, is_retouched ? photograph.retouched_right : photograph.pictures.right};
}

/// A painting, and what it was painted from. Either may be missing: a painting that was read has no photograph, and a
/// photograph has no painting yet.
struct PaintedContent {
  std::shared_ptr<const Painting> painting;
  std::shared_ptr<const Photograph> photograph;
  std::shared_ptr<const Painting> as_read =
      {};                           ///< a painting that was read, without what a hand did; none: it is the same
  std::vector<Touch> touches = {};  ///< by hand that the painting shows, where there is a photograph
  friend bool operator==(const PaintedContent&, const PaintedContent&) = default;
};

/// Pictures of so many views, from left to right.
struct ViewsContent {
  std::shared_ptr<const std::vector<Image<Rgb8>>> views;
  float span = 1;  ///< eye separations from the first view to the last
  friend bool operator==(const ViewsContent&, const ViewsContent&) = default;
};

struct SlicesContent {
  std::shared_ptr<const SliceStack> slices;
  friend bool operator==(const SlicesContent&, const SlicesContent&) = default;
};

/// Particles, ready to be rendered, and what a picture of them tells.
struct Particles : ReadyParticles {
  ParticleChoice choice;  ///< that they were read with
  ShownUnits units;       ///< of its quantity
  std::optional<double> redshift;
  std::optional<double> time;  ///< of the snapshot, or of a series
};
struct ParticlesContent {
  std::shared_ptr<const Particles> particles;
  friend bool operator==(const ParticlesContent&, const ParticlesContent&) = default;
};

struct ModelContent {
  std::shared_ptr<const ReadyModel> model;
  friend bool operator==(const ModelContent&, const ModelContent&) = default;
};

/// What is open, as the stage draws it; shared between threads, never changed.
using Content =
    std::variant<std::monostate, PaintedContent, ViewsContent, SlicesContent, ParticlesContent, ModelContent>;

/// Size of what is open, in its own pixels; {0, 0} where it has none of its own, as particles and models.
PictureSize size_of(const Content& content);

/// Whether it is a scene whose depth is chosen when it is shown: particles, a model or slices.
bool is_scene(const Content& content);

/// Whether there is one picture, so that both eyes would see the same.
bool has_one_view(const Content& content);

/// Disparities of the scene from its farthest point to its nearest, but for outliers, in pixels of a view at full eye
/// separation; none where they are not known. Looks at all of a painting's surface: not for the window's thread.
std::optional<DepthEnds> depth_of(const Content& content);

struct OpenedFilm;
class ParticleReader;

/// What was opened, and what to tell about it.
struct Opened {
  Content content;
  std::string kind;                             ///< "painting", "photograph", "slices" …, for people
  std::vector<std::string> notes;               ///< one line each
  std::shared_ptr<const OpenedFilm> film = {};  ///< of which the content is the first frame
  std::shared_ptr<ParticleReader> reader = {};  ///< of which the content is the first particles
  bool is_ready = true;                         ///< false: shown as it came, while it is made ready
  std::optional<DepthEnds> depth = {};          ///< of the content, or of the frame of the film that was painted last
};

/// Takes what can be shown already of something that is not ready.
using ShowFirst = std::function<void(Opened)>;

/// Opens what a file holds: a painting (.wst), a stereo photograph of two files or one, one picture with its depth, a
/// quilt, the views of a multi-view OpenEXR, slices, particles, a model or a film. Two files are the eyes of one
/// photograph. `show` is given a stereo photograph as it came, before it is rectified. Of particles, what
/// `particles` says is read; those of a pattern, "snap_%03d.hdf5", are a series. Throws Error that names the file.
Opened open_content(std::span<const std::filesystem::path> files, const Progress& progress = {},
                    const ShowFirst& show = {}, const ParticleChoice& particles = {});

/// Whether the names of two files differ as those of two eyes: left.png and right.png, tree_L.jpg and tree_R.jpg.
bool are_named_as_eyes(const std::filesystem::path& left, const std::filesystem::path& right);

/// The names that the other eye's picture may have beside that of the left eye; none where this names no left eye.
std::vector<std::string> names_of_right_eye(const std::string& left);

/// The picture of the other eye that lies beside a picture of one view, as their names tell (left and right, L and R,
/// or the next number) and what they show. None where there is no such. Reads pictures; the path is absolute.
std::optional<std::filesystem::path> find_other_eye(const std::filesystem::path& picture);

/// Whether two files are the eyes of one photograph: two pictures, each of one view, that show one scene. `show` is
/// given two pictures of one size before it is known.
bool are_eyes_of_one(const std::filesystem::path& left, const std::filesystem::path& right, const ShowFirst& show = {});

}  // namespace wheatstone::viewer
